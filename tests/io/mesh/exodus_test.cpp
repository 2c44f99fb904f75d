// Exodus meshes written with the Exodus library and read back.
#include <exodusII.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>

#include "exodus_file.hpp"
#include "mesh_support.hpp"

namespace cleave::io::testing {
namespace {

using Numbers = std::vector<std::int64_t>;

Mesh read_back(const ExodusContent& content, int mode = 0) {
  const std::string path = scratch_path("mesh.exo");
  write_exodus(path, mode, content);
  Mesh mesh = read_mesh(path);
  std::remove(path.c_str());
  return mesh;
}

std::string refusal(const ExodusContent& content) {
  const std::string path = scratch_path("mesh.exo");
  write_exodus(path, 0, content);
  std::string message = error_of([&] { read_mesh(path); });
  std::remove(path.c_str());
  return message;
}

std::string contains(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos ? part : text;
}

void expect_plate(const Mesh& mesh) {
  EXPECT_EQ(mesh.point_ids, (Numbers{11, 12, 13, 14, 15, 16, 17, 18, 19}));
  ASSERT_EQ(mesh.points.size(), 27U);
  EXPECT_EQ(mesh.points[3 * 7 + 1], 2.0);
  EXPECT_EQ(mesh.points[3 * 7 + 2], 0.0);
  EXPECT_EQ(mesh.triangles.nodes, (Numbers{0, 1, 4, 0, 4, 3, 3, 4, 7, 3, 7, 6}));
  EXPECT_EQ(mesh.skipped_summary(), "2 QUAD4");
  // Bars, then the sides of the sets: outer (1,2) and (4,1), sideset_8 (7,4).
  EXPECT_EQ(mesh.lines.nodes, (Numbers{1, 4, 4, 7, 0, 1, 3, 0, 6, 3}));

  const auto expect_group = [&](const char* name, int dimension, const Numbers& nodes,
                                const Numbers& cells) {
    const MeshGroup* group = mesh.find_group(name);
    ASSERT_NE(group, nullptr) << name;
    EXPECT_EQ(group->dimension, dimension) << name;
    EXPECT_EQ(group->nodes, nodes) << name;
    EXPECT_EQ(group->cells, cells) << name;
  };
  expect_group("steel", 2, {0, 1, 3, 4, 6, 7}, {0, 1, 2, 3});
  expect_group("seam", 1, {1, 4, 7}, {0, 1});
  expect_group("grain", 0, {8}, {});
  expect_group("left", 0, {0, 3, 6}, {});
  expect_group("nodeset_2", 0, {8}, {});
  expect_group("empty", 0, {}, {});
  expect_group("outer", 1, {0, 1, 3}, {2, 3});
  expect_group("sideset_8", 1, {3, 6}, {4});
}

TEST(Exodus, PlateInEveryForm) {
  for (const int mode : {0, EX_LARGE_MODEL, EX_NETCDF4, EX_NETCDF4 | EX_ALL_INT64_DB})
    expect_plate(read_back(exodus_plate(), mode));
}

TEST(Exodus, SolidWithFacets) {
  const Mesh mesh = read_back(exodus_solid());
  EXPECT_EQ(mesh.tetrahedra.nodes, (Numbers{0, 1, 2, 3, 1, 2, 3, 4}));
  EXPECT_EQ(mesh.point_ids, (Numbers{1, 2, 3, 4, 5}));
  const MeshGroup* hull = mesh.find_group("hull");
  ASSERT_NE(hull, nullptr);
  EXPECT_EQ(hull->dimension, 2);
  EXPECT_EQ(hull->nodes, (Numbers{0, 1, 2, 3}));
  // Side 2 of the tetrahedron is the triangle of block "skin", which is kept once.
  EXPECT_EQ(mesh.triangles.count(), 4);
  EXPECT_EQ(hull->cells, (Numbers{0, 1, 2, 3}));
  EXPECT_EQ(mesh.find_group("skin")->cells, Numbers{0});
  // Half the unit square three times and the slanted face of area sqrt(3)/2. Measured: equal.
  EXPECT_NEAR(group_measure(mesh, "hull"), 1.5 + std::sqrt(3.0) / 2, 1e-15);
  // Side 4 of a triangle in space is its second edge.
  EXPECT_EQ(mesh.find_group("rim")->nodes, (Numbers{2, 3}));
}

TEST(Exodus, SideSetsPointOutwards) {
  const Mesh mesh = read_back(exodus_solid());
  const auto& t = mesh.triangles.nodes;  // side 4 of the first: (1, 3, 2), normal -z
  EXPECT_EQ(Numbers(t.end() - 3, t.end()), (Numbers{0, 2, 1}));
}

TEST(Exodus, SecondOrderSaysHowToMesh) {
  ExodusContent plate = exodus_plate();
  plate.blocks[0] = {10, "steel", "TRI6", 6, {1, 2, 5, 1, 5, 4}};
  plate.side_sets.clear();
  const std::string message = refusal(plate);
  EXPECT_EQ(contains(message, "block \"steel\""), "block \"steel\"");
  EXPECT_EQ(contains(message, "mesh again with first order"), "mesh again with first order");
}

TEST(Exodus, WrongReferences) {
  ExodusContent node = exodus_plate();
  node.blocks[0].nodes[0] = 10;
  EXPECT_EQ(contains(refusal(node), "connect1 refers to node 10"), "connect1 refers to node 10");
  ExodusContent set = exodus_plate();
  set.node_sets[0].entries[0] = 0;
  EXPECT_EQ(contains(refusal(set), "node_ns1 refers to node 0"), "node_ns1 refers to node 0");
  ExodusContent element = exodus_plate();
  element.side_sets[0].entries[0] = 100;
  EXPECT_EQ(contains(refusal(element), "\"outer\" refers to element 100"),
            "\"outer\" refers to element 100");
  ExodusContent side = exodus_plate();
  side.side_sets[0].sides[0] = 4;
  EXPECT_EQ(contains(refusal(side), "has no side 4"), "has no side 4");
  ExodusContent place = exodus_plate();
  place.y[2] = std::nan("");
  EXPECT_EQ(contains(refusal(place), "coordinate y of node 3"), "coordinate y of node 3");
}

TEST(Exodus, OtherNetcdfFilesAreRefused) {
  const std::string path = scratch_path("other.nc");
  write_bytes(path, std::string("CDF\1\0\0\0\0", 8) + std::string(24, '\0'));
  expect_error([&] { read_mesh(path); }, {"not an Exodus mesh"});
  write_bytes(path, "\211HDF\r\n\032\nand nothing else");
  expect_error([&] { read_mesh(path); }, {"not a readable netCDF file"});
  std::remove(path.c_str());
}

}  // namespace
}  // namespace cleave::io::testing
