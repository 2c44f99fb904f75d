#include "io/results_read.hpp"

#include <gtest/gtest.h>
#include <netcdf.h>

#include <bit>
#include <random>

#include "io/error.hpp"
#include "scratch_folder.hpp"

namespace {

using namespace cleave::io;

bool contains(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

// A square of two triangles, a rod, two lone particles.
ResultLayout plate(int dimension) {
  ResultLayout layout;
  layout.title = "plate";
  layout.dimension = dimension;
  layout.points = {0, 0, 0, 1, 0.1, 0, 1, 1, 0, 0, 1, 0, 3, 0, 0, 4, 0, 0};
  if (dimension == 3) layout.points[17] = 0.3;
  layout.point_ids = {11, 12, 13, 14, 25, 26};
  layout.blocks = {{"plate", CellKind::triangle, {0, 1, 2, 0, 2, 3}},
                   {"empty", CellKind::tetrahedron, {}},
                   {"rod", CellKind::line, {3, 4}},
                   {"dust", CellKind::point, {4, 5}}};
  layout.nodal = {{"DISPLX", "mm", "displacement"}, {"damage", "1", "damage"}};
  layout.element = {{"status", "1", "1 whole, 0 deleted"}, {"energy", "mJ", "energy"}};
  layout.global = {{"kinetic", "mJ", "kinetic energy"}, {"dt", "ms", "time step"}};
  layout.information = {{"units", "mm-ms-g-MPa"}};
  return layout;
}

using Values = std::vector<std::vector<double>>;

// Bits of all kinds: what is written must come back, not what is near it.
double value(std::int64_t frame, std::size_t variable, std::size_t i) {
  const auto seed = static_cast<std::uint64_t>(frame * 1000) + variable * 100 + i + 1;
  return std::bit_cast<double>(seed * 0x9e3779b97f4a7c15u >> 2);
}

Values values(std::int64_t frame, std::size_t first, std::size_t count) {
  Values all(2, std::vector<double>(count));
  for (std::size_t v = 0; v < 2; ++v) {
    for (std::size_t i = 0; i < count; ++i) all[v][i] = value(frame, first + v, i);
  }
  return all;
}

class ResultsRead : public testing::Test {
 protected:
  void write(const ResultLayout& layout, std::int64_t frames) {
    ResultsWriter results = ResultsWriter::create(path_, layout);
    for (std::int64_t f = 0; f < frames; ++f) {
      results.write_frame(0.1 * static_cast<double>(f), values(f, 0, 6), values(f, 2, 5),
                          values(f, 4, 2)[0]);
    }
  }
  // Everything that can be read of the file at path_.
  void read_all() {
    const StoredResults results = read_results(path_);
    for (std::int64_t f = 0; f < std::ssize(results.times); ++f) results.read_frame(f);
  }
  ScratchFolder folder_;
  std::string path_ = folder_.file("plate.exo");
};

TEST_F(ResultsRead, GivesBackTheLayout) {
  for (const int dimension : {2, 3}) {
    const ResultLayout layout = plate(dimension);
    write(layout, 3);
    const StoredResults results = read_results(path_);
    EXPECT_EQ(results.title, "plate");
    EXPECT_EQ(results.dimension, dimension);
    EXPECT_EQ(results.points, layout.points);
    EXPECT_EQ(results.point_ids, layout.point_ids);
    EXPECT_EQ(results.times, (std::vector<double>{0.0, 0.1, 0.2}));
    EXPECT_EQ(results.global, (std::vector<std::string>{"kinetic", "dt"}));
    EXPECT_EQ(results.information, std::vector<std::string>{"units: mm-ms-g-MPa"});
    ASSERT_EQ(results.nodal.size(), 2u);
    EXPECT_EQ(results.nodal[0].name + results.nodal[0].units + results.nodal[0].description,
              "DISPLXmmdisplacement");
    ASSERT_EQ(results.element.size(), 2u);
    EXPECT_EQ(results.element[1].name + results.element[1].units, "energymJ");
    ASSERT_EQ(results.blocks.size(), 3u);
    const char* const types[] = {"TRI3", "BAR2", "SPHERE"};
    const std::size_t in_layout[] = {0, 2, 3};
    for (std::size_t b = 0; b < 3; ++b) {
      EXPECT_EQ(results.blocks[b].name, layout.blocks[in_layout[b]].name);
      EXPECT_EQ(results.blocks[b].type, types[b]);
      EXPECT_EQ(results.blocks[b].nodes, layout.blocks[in_layout[b]].nodes);
    }
    EXPECT_EQ(results.element_count(), 5);
  }
}

TEST_F(ResultsRead, GivesBackEveryBit) {
  write(plate(3), 4);
  const StoredResults results = read_results(path_);
  for (const std::int64_t f : {3, 0, 2}) {
    const ResultFrame frame = results.read_frame(f);
    EXPECT_EQ(frame.time, 0.1 * static_cast<double>(f));
    EXPECT_EQ(frame.nodal, values(f, 0, 6));
    EXPECT_EQ(frame.element, values(f, 2, 5));
    EXPECT_EQ(frame.global, values(f, 4, 2)[0]);
    const std::vector<std::size_t> second{1}, both{1, 0};
    const ResultFrame some = results.read_frame(f, second, both);
    EXPECT_EQ(some.nodal, Values{frame.nodal[1]});
    EXPECT_EQ(some.element, (Values{frame.element[1], frame.element[0]}));
  }
}

TEST_F(ResultsRead, SeesFramesThatARunAppends) {
  ResultsWriter writer = ResultsWriter::create(path_, plate(3));
  const StoredResults before = read_results(path_);
  EXPECT_TRUE(before.times.empty());
  EXPECT_TRUE(contains(error_of<Error>([&] { before.read_frame(0); }),
                       "there is no frame 1; the file has 0 complete frames"));
  writer.write_frame(0, values(0, 0, 6), values(0, 2, 5), values(0, 4, 2)[0]);
  EXPECT_EQ(before.read_frame(0).nodal, values(0, 0, 6));
  EXPECT_EQ(read_results(path_).times.size(), 1u);
  EXPECT_TRUE(contains(error_of<Error>([&] { before.read_frame(-1); }), "no frame 0"));
}

TEST_F(ResultsRead, MayHaveNoVariablesAndNoElements) {
  ResultLayout layout;
  layout.points = {1, 2, 3};
  layout.point_ids = {1};
  { ResultsWriter::create(path_, layout).write_frame(0.5, {}, {}, {}); }
  const StoredResults results = read_results(path_);
  EXPECT_EQ(results.points, layout.points);
  EXPECT_EQ(results.element_count(), 0);
  EXPECT_EQ(results.read_frame(0).time, 0.5);
}

TEST_F(ResultsRead, UnfinishedFilesShowTheirCompleteFrames) {
  write(plate(3), 1);
  const std::size_t one = bytes_of(path_).size();
  write(plate(3), 2);
  const std::string two = bytes_of(path_);
  put_bytes(path_, two.substr(0, (one + two.size()) / 2));
  const StoredResults results = read_results(path_);
  EXPECT_EQ(results.times.size(), 1u);
  EXPECT_EQ(results.read_frame(0).nodal, values(0, 0, 6));
  EXPECT_TRUE(contains(error_of<Error>([&] { results.read_frame(1); }), "no frame 2"));
}

TEST_F(ResultsRead, RefusesNodesThatAreNotInTheFile) {
  for (const int wrong : {0, 7, -3}) {
    write(plate(3), 1);
    int file = -1, variable = -1;
    const std::size_t start[] = {1, 2};
    ASSERT_EQ(nc_open(path_.c_str(), NC_WRITE, &file), NC_NOERR);
    ASSERT_EQ(nc_inq_varid(file, "connect1", &variable), NC_NOERR);
    ASSERT_EQ(nc_put_var1_int(file, variable, start, &wrong), NC_NOERR);
    ASSERT_EQ(nc_close(file), NC_NOERR);
    EXPECT_TRUE(contains(
        error_of<Error>([&] { read_all(); }),
        "'connect1' refers to node " + std::to_string(wrong) + ", the file has nodes 1 to 6"));
  }
}

TEST_F(ResultsRead, DamagedFilesDoNotCrash) {
  write(plate(2), 0);
  const std::size_t fixed = bytes_of(path_).size();
  write(plate(2), 2);
  const std::string bytes = bytes_of(path_);
  for (std::size_t length = 0; length < fixed; length += 11) {
    put_bytes(path_, bytes.substr(0, length));
    EXPECT_TRUE(contains(error_of<Error>([&] { read_all(); }), path_)) << length;
  }
  // The header is where damage can mislead the reader.
  std::mt19937 random(17);
  int refused = 0;
  for (int i = 0; i < 2000; ++i) {
    std::string damaged = bytes;
    const std::size_t within = i % 2 == 0 ? fixed : damaged.size();
    for (int k = 0; k < 4; ++k) damaged[random() % within] = static_cast<char>(random());
    put_bytes(path_, damaged);
    try {
      read_all();
    } catch (const Error& error) {
      EXPECT_TRUE(contains(error.what(), path_)) << error.what();
      ++refused;
    }
  }
  EXPECT_GT(refused, 1000);
}

}  // namespace
