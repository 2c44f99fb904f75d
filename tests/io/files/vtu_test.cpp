#include "io/vtu.hpp"

#include <gtest/gtest.h>

#include "file_size_limit.hpp"
#include "io/error.hpp"
#include "scratch_folder.hpp"

namespace {

using namespace cleave::io;

bool contains(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

VtuGrid triangle() {
  VtuGrid grid;
  grid.time = 0.5;
  grid.points = {0, 0, 0, 1, 0, 0, 0, 1, 0};
  grid.connectivity = {0, 1, 2, 1};
  grid.offsets = {3, 4};
  grid.types = {VtkCell::triangle, VtkCell::vertex};
  grid.point_data = {{"u", "mm", {"x", "y", "z"}, std::vector<double>(9, 1.0)}};
  grid.cell_data = {{"id", "", {}, std::vector<std::int64_t>{1, 2}}};
  return grid;
}

class Vtu : public testing::Test {
 protected:
  std::string written(const VtuGrid& grid) {
    write_vtu(path_, grid);
    return bytes_of(path_);
  }
  ScratchFolder folder_;
  std::string path_ = folder_.file("grid.vtu");
};

// The texts are those of Python: base64.b64encode(struct.pack("<Q...", bytes, ...)).
TEST_F(Vtu, ArraysStandAsBase64BehindTheirLength) {
  const std::string text = written(triangle());
  EXPECT_TRUE(contains(text, "<Piece NumberOfPoints=\"3\" NumberOfCells=\"2\">"));
  EXPECT_TRUE(contains(text,
                       "Name=\"TimeValue\" NumberOfTuples=\"1\" format=\"binary\">\n"
                       "CAAAAAAAAAAAAAAAAADgPw==\n</DataArray>"));
  EXPECT_TRUE(contains(text,
                       "type=\"Int64\" Name=\"offsets\" format=\"binary\">\n"
                       "EAAAAAAAAAADAAAAAAAAAAQAAAAAAAAA\n</DataArray>"));
  EXPECT_TRUE(contains(text,
                       "type=\"UInt8\" Name=\"types\" format=\"binary\">\n"
                       "AgAAAAAAAAAFAQ==\n</DataArray>"));
  EXPECT_TRUE(contains(text,
                       "Name=\"u\" NumberOfComponents=\"3\" ComponentName0=\"x\" "
                       "ComponentName1=\"y\" ComponentName2=\"z\" format=\"binary\">"));
}

TEST_F(Vtu, NamesCannotBreakTheXml) {
  VtuGrid grid = triangle();
  grid.cell_data[0].name = "a<\"b\"&c>\n";
  grid.cell_data[0].units = "<mm>";
  const std::string text = written(grid);
  EXPECT_TRUE(contains(text, "Name=\"a&lt;&quot;b&quot;&amp;c&gt; \""));
  EXPECT_TRUE(contains(text, ">&lt;mm&gt;</InformationKey>"));
}

TEST_F(Vtu, RefusesGridsThatContradictThemselves) {
  const auto message = [&](auto change) {
    VtuGrid grid = triangle();
    change(grid);
    return error_of<Error>([&] { write_vtu(path_, grid); });
  };
  EXPECT_TRUE(contains(message([](VtuGrid& g) { g.point_data[0].values = std::vector(8, 1.0); }),
                       "array 'u' has 8 values, 9 are needed for 3 points"));
  EXPECT_TRUE(contains(message([](VtuGrid& g) {
                         g.cell_data[0].components = {"a", "b"};
                       }),
                       "array 'id' has 2 values, 4 are needed for 2 cells"));
  for (const auto& change : std::vector<void (*)(VtuGrid&)>{
           [](VtuGrid& g) { g.connectivity[0] = 3; }, [](VtuGrid& g) { g.connectivity[0] = -1; },
           [](VtuGrid& g) { g.offsets[1] = 3; }, [](VtuGrid& g) { g.offsets[0] = 5; },
           [](VtuGrid& g) { g.types.pop_back(); }, [](VtuGrid& g) { g.points.push_back(0); }}) {
    EXPECT_TRUE(contains(message(change), "the cells of the grid contradict its 3 points"));
  }
  EXPECT_EQ(folder_.entries(), 0u);
}

TEST_F(Vtu, AFullDiskLeavesTheOldFile) {
  const std::string before = written(triangle());
  VtuGrid grid = triangle();
  grid.time = 1;
  for (std::size_t limit = 0; limit < before.size(); limit += 97) {
    const FileSizeLimit full(limit);
    EXPECT_TRUE(contains(error_of<Error>([&] { write_vtu(path_, grid); }), "File too large"));
    EXPECT_TRUE(bytes_of(path_) == before);
    EXPECT_EQ(folder_.entries(), 1u);
  }
  EXPECT_FALSE(written(grid) == before);
}

}  // namespace
