// Truncated and damaged files give an io::Error or a mesh, never a crash or a gigantic allocation.
// Most is to be learnt from this under the sanitizers.
#include <exodusII.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <random>

#include "allocation_meter.hpp"
#include "exodus_file.hpp"
#include "io/error.hpp"
#include "io/exodus_mesh_trial.hpp"
#include "io/gmsh.hpp"
#include "mesh_support.hpp"

namespace cleave::io::testing {
namespace {

using Reader = std::function<Mesh(const std::string& bytes)>;

struct Outcome {
  bool is_mesh = false;
  Mesh mesh;
  std::string message;
};

Outcome attempt(const Reader& read, const std::string& bytes) {
  reset_largest_allocation();
  Outcome outcome;
  try {
    outcome.mesh = read(bytes);
    outcome.is_mesh = true;
  } catch (const Error& error) {
    outcome.message = error.what();
    EXPECT_GT(outcome.message.size(), 20U) << outcome.message;
  }
  // Doubled vectors of 8-byte numbers for 2-byte words, and the dense table of node numbers.
  const std::size_t most = 64 * bytes.size() + 65536;
  EXPECT_LE(largest_allocation(), most) << outcome.message;
  return outcome;
}

void expect_consistent(const Mesh& mesh) {
  const std::int64_t n = mesh.point_count();
  EXPECT_EQ(static_cast<std::int64_t>(mesh.point_ids.size()), n);
  for (const CellBlock* block : {&mesh.lines, &mesh.triangles, &mesh.tetrahedra})
    for (const std::int64_t node : block->nodes) ASSERT_TRUE(node >= 0 && node < n);
  for (const MeshGroup& group : mesh.groups) {
    for (const std::int64_t node : group.nodes) ASSERT_TRUE(node >= 0 && node < n);
    const std::int64_t cells = group.dimension == 0   ? 0
                               : group.dimension == 1 ? mesh.lines.count()
                               : group.dimension == 2 ? mesh.triangles.count()
                                                      : mesh.tetrahedra.count();
    for (const std::int64_t cell : group.cells) ASSERT_TRUE(cell >= 0 && cell < cells);
  }
}

// Some `cuts` lengths, and one byte less than the shortest that is whole.
void truncate_everywhere(const Reader& read, const std::string& bytes, std::size_t shortest_whole,
                         std::size_t cuts) {
  const std::size_t stride = bytes.size() / cuts + 1;
  for (std::size_t length = 0; length < shortest_whole; length += stride)
    EXPECT_FALSE(attempt(read, bytes.substr(0, length)).is_mesh) << "first " << length << " bytes";
  EXPECT_FALSE(attempt(read, bytes.substr(0, shortest_whole - 1)).is_mesh);
  EXPECT_TRUE(attempt(read, bytes).is_mesh);
}

void mutate(const Reader& read, const std::string& bytes, int times) {
  std::mt19937 random(20240229);
  int meshes = 0, errors = 0;
  for (int i = 0; i < times; ++i) {
    std::string damaged = bytes;
    const auto changes = 1 + random() % 4;
    // Every second time near the beginning, where the counts are.
    const std::size_t range = i % 2 == 0 ? bytes.size() : std::min<std::size_t>(bytes.size(), 600);
    for (unsigned k = 0; k < changes; ++k)
      damaged[random() % range] = static_cast<char>(i % 3 == 0 ? 0xFF : random() % 256);
    const Outcome outcome = attempt(read, damaged);
    if (outcome.is_mesh) expect_consistent(outcome.mesh);
    ++(outcome.is_mesh ? meshes : errors);
  }
  EXPECT_GT(errors, times / 10);  // the mutations reach what is checked,
  EXPECT_GT(meshes, 0);           // and go beyond the first check
}

Mesh read_gmsh(const std::string& bytes) { return gmsh::read("damaged.msh", bytes); }

class DamagedGmsh : public ::testing::TestWithParam<const char*> {};

TEST_P(DamagedGmsh, Truncated) {
  const std::string bytes = read_bytes(gmsh_file(GetParam()));
  // Every section ends with a mark; only the line end behind the last one can be missed.
  const std::string last = bytes.substr(bytes.rfind("$End"));
  truncate_everywhere(read_gmsh, bytes,
                      bytes.size() - (last.size() - last.find_last_not_of("\r\n") - 1), 500);
}

TEST_P(DamagedGmsh, Mutated) { mutate(read_gmsh, read_bytes(gmsh_file(GetParam())), 1500); }

INSTANTIATE_TEST_SUITE_P(Formats, DamagedGmsh,
                         ::testing::Values("plate-22-text.msh", "plate-22-binary.msh",
                                           "plate-41-text.msh", "plate-41-binary.msh",
                                           "plate-41-binary-partitioned.msh"));

class DamagedExodus : public ::testing::Test {
 protected:
  void write(int mode) {
    path_ = scratch_path("damaged.exo");
    write_exodus(path_, mode, exodus_plate());
    bytes_ = read_bytes(path_);
    read_ = [this](const std::string& bytes) {
      std::remove(path_.c_str());  // writing over a file would wait for the disk
      write_bytes(path_, bytes);
      return read_mesh(path_);
    };
  }
  void TearDown() override { std::remove(path_.c_str()); }

  std::string path_, bytes_;
  Reader read_;
};

TEST_F(DamagedExodus, Truncated) {
  write(0);
  truncate_everywhere(read_, bytes_, bytes_.size(), 500);
}

TEST_F(DamagedExodus, Mutated) {
  write(0);
  mutate(read_, bytes_, 1500);
}

// Each costs a process; the HDF5 library does not survive some of them.
TEST_F(DamagedExodus, TruncatedNetcdf4) {
  write(EX_NETCDF4);
  truncate_everywhere(read_, bytes_, bytes_.size(), 20);
}

TEST_F(DamagedExodus, MutatedNetcdf4) {
  write(EX_NETCDF4);
  mutate(read_, bytes_, 300);
}

TEST(TryInChild, TellsACrashFromAnError) {
  constexpr unsigned long kSeconds = 60;
  EXPECT_FALSE(try_in_child([] {}, kSeconds).crashed);
  EXPECT_EQ(try_in_child([] {}, kSeconds).error, "");
  EXPECT_EQ(try_in_child([] { throw Error("no crash"); }, kSeconds).error, "no crash");
  EXPECT_FALSE(try_in_child([] { throw Error("no crash"); }, kSeconds).crashed);
  EXPECT_TRUE(try_in_child([] { std::abort(); }, kSeconds).crashed);
}

TEST(TryInChild, EndsWhatDoesNotEnd) {
  const auto forever = [] {
    for (volatile unsigned count = 0;;) count = count + 1;
  };
  EXPECT_TRUE(try_in_child(forever, 1).crashed);
}

}  // namespace
}  // namespace cleave::io::testing
