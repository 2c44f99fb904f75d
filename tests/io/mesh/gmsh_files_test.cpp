// Files written by the gmsh program: all formats give the same mesh, of the size the geometry has.
#include <gtest/gtest.h>

#include "mesh_support.hpp"

namespace cleave::io::testing {
namespace {

// The geometry's coordinates carry 16 digits; sums of about 100 cells. Measured: 3e-15.
constexpr double kRounding = 1e-13;

class PlateFormats : public ::testing::TestWithParam<const char*> {};

TEST_P(PlateFormats, AreTheSameMesh) {
  expect_same(read_mesh(gmsh_file("plate-22-text.msh")), read_mesh(gmsh_file(GetParam())));
}

INSTANTIATE_TEST_SUITE_P(Gmsh, PlateFormats,
                         ::testing::Values("plate-41-text.msh", "plate-22-binary.msh",
                                           "plate-41-binary.msh", "plate-41-parametric.msh",
                                           "plate-41-binary-parametric.msh"));

class SolidFormats : public ::testing::TestWithParam<const char*> {};

TEST_P(SolidFormats, AreTheSameMesh) {
  expect_same(read_mesh(gmsh_file("solid-22-text.msh")), read_mesh(gmsh_file(GetParam())));
}

INSTANTIATE_TEST_SUITE_P(Gmsh, SolidFormats,
                         ::testing::Values("solid-41-text.msh", "solid-22-binary.msh",
                                           "solid-41-binary.msh"));

TEST(GmshFiles, PlateHasTheSizeOfItsGeometry) {
  const Mesh mesh = read_mesh(gmsh_file("plate-41-binary.msh"));
  EXPECT_NEAR(total_measure(mesh, mesh.triangles), 3.0, 3 * kRounding);
  EXPECT_NEAR(group_measure(mesh, "plate"), 3.0, 3 * kRounding);
  EXPECT_NEAR(group_measure(mesh, "right"), 1.0, kRounding);
  EXPECT_NEAR(group_measure(mesh, "left side"), 1.0, kRounding);
  EXPECT_NEAR(group_measure(mesh, "crack"), 1.0, kRounding);
  EXPECT_NEAR(group_measure(mesh, "1:7"), 1.0, kRounding);
  ASSERT_NE(mesh.find_group("corner"), nullptr);
  ASSERT_EQ(mesh.find_group("corner")->nodes.size(), 1U);
  const auto corner = static_cast<std::size_t>(mesh.find_group("corner")->nodes[0]);
  for (std::size_t k = 0; k < 3; ++k) EXPECT_EQ(mesh.points[3 * corner + k], 0.0);
  ASSERT_NE(mesh.find_group("nowhere"), nullptr);
  EXPECT_TRUE(mesh.find_group("nowhere")->nodes.empty());
  EXPECT_EQ(mesh.find_group("left"), nullptr);
  ASSERT_NE(mesh.find_group("plate"), nullptr);
  EXPECT_EQ(static_cast<std::int64_t>(mesh.find_group("plate")->nodes.size()), mesh.point_count());
  EXPECT_EQ(mesh.skipped_summary(), "");
}

TEST(GmshFiles, SolidHasTheSizeOfItsGeometry) {
  const Mesh mesh = read_mesh(gmsh_file("solid-22-binary.msh"));
  EXPECT_NEAR(total_measure(mesh, mesh.tetrahedra), 2.0, 2 * kRounding);
  EXPECT_NEAR(group_measure(mesh, "block"), 2.0, 2 * kRounding);
  EXPECT_NEAR(group_measure(mesh, "outside"), 10.0, 10 * kRounding);
  EXPECT_NEAR(group_measure(mesh, "left"), 1.0, kRounding);
  EXPECT_NEAR(group_measure(mesh, "edge"), 1.0, kRounding);
  for (std::int64_t cell = 0; cell < mesh.tetrahedra.count(); ++cell)
    EXPECT_GT(measure(mesh, mesh.tetrahedra, cell), 0) << cell;
}

TEST(GmshFiles, ElementsInTwoGroupsAreReadOnce) {
  // MSH 2.2 writes the triangles of "right" twice, once for each of their groups.
  const Mesh mesh = read_mesh(gmsh_file("plate-22-text.msh"));
  const std::string text = read_bytes(mesh.path);
  const auto written = std::stoll(text.substr(text.find("$Elements") + 10));
  ASSERT_NE(mesh.find_group("right"), nullptr);
  const auto right = static_cast<std::int64_t>(mesh.find_group("right")->cells.size());
  EXPECT_GT(right, 0);
  const std::int64_t corner = 1;
  EXPECT_EQ(mesh.triangles.count() + mesh.lines.count() + corner + right, written);
}

class PartitionedFiles : public ::testing::TestWithParam<const char*> {};

TEST_P(PartitionedFiles, KeepTheGroups) {
  // gmsh sorts elements by partition, so that their order and corners' order differ.
  const Mesh whole = read_mesh(gmsh_file("plate-41-text.msh")),
             parts = read_mesh(gmsh_file(GetParam()));
  EXPECT_EQ(parts.triangles.count(), whole.triangles.count());
  ASSERT_EQ(parts.groups.size(), whole.groups.size());
  for (std::size_t i = 0; i < whole.groups.size(); ++i) {
    EXPECT_EQ(parts.groups[i].name, whole.groups[i].name);
    EXPECT_EQ(parts.groups[i].nodes.size(), whole.groups[i].nodes.size()) << whole.groups[i].name;
    EXPECT_NEAR(group_measure(parts, parts.groups[i].name),
                group_measure(whole, whole.groups[i].name), 3 * kRounding)
        << whole.groups[i].name;
  }
}

INSTANTIATE_TEST_SUITE_P(Gmsh, PartitionedFiles,
                         ::testing::Values("plate-22-text-partitioned.msh",
                                           "plate-41-text-partitioned.msh",
                                           "plate-41-binary-partitioned.msh"));

TEST(GmshFiles, OldVersionsSayHowToConvert) {
  for (const char* name : {"plate-10.msh", "plate-40.msh"})
    expect_error([&] { read_mesh(gmsh_file(name)); }, {name, "-format msh41", "only 2.2 and 4.1"});
}

TEST(GmshFiles, SecondOrderSaysHowToMesh) {
  expect_error([] { read_mesh(gmsh_file("plate-22-second-order.msh")); },
               {"plate-22-second-order.msh:", "type 8", "-order 1", "Mesh.ElementOrder = 1"});
  expect_error([] { read_mesh(gmsh_file("plate-41-second-order.msh")); },
               {"at byte", "type 8", "-order 1"});
}

TEST(GmshFiles, ParametricNodesSayHowToSave) {
  expect_error([] { read_mesh(gmsh_file("plate-22-parametric.msh")); },
               {"Mesh.SaveParametric = 0"});
}

TEST(GmshFiles, QuadranglesAreCounted) {
  const Mesh old = read_mesh(gmsh_file("plate-22-quadrangles.msh"));
  const Mesh mesh = read_mesh(gmsh_file("plate-41-quadrangles.msh"));
  EXPECT_EQ(mesh.triangles.count(), 0);
  ASSERT_EQ(mesh.skipped.size(), 1U);
  EXPECT_EQ(mesh.skipped[0].type, "quadrangle");
  EXPECT_GT(mesh.skipped[0].count, 0);
  EXPECT_EQ(mesh.skipped_summary(), old.skipped_summary());
}

TEST(GmshFiles, GeometryIsNotAMesh) {
  expect_error([] { read_mesh(gmsh_file("plate.geo")); }, {"plate.geo", "geometry", "gmsh -2"});
}

TEST(GmshFiles, MissingFileAndFolder) {
  expect_error([] { read_mesh(gmsh_file("absent.msh")); }, {"absent.msh", "no such"});
  expect_error([] { read_mesh(MESH_DIR); }, {"not a file"});
}

}  // namespace
}  // namespace cleave::io::testing
