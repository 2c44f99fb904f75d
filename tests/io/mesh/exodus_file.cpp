#include "exodus_file.hpp"

#include <exodusII.h>
#include <gtest/gtest.h>

namespace cleave::io::testing {
namespace {

void put_block(int file, const ExodusBlock& block) {
  const auto per_element = static_cast<std::size_t>(block.nodes_per_element);
  const auto count = static_cast<int>(block.nodes.size() / per_element);
  EXPECT_EQ(ex_put_block(file, EX_ELEM_BLOCK, block.id, block.type.c_str(), count,
                         block.nodes_per_element, 0, 0, 0),
            0);
  if (count > 0) {
    EXPECT_EQ(ex_put_conn(file, EX_ELEM_BLOCK, block.id, block.nodes.data(), nullptr, nullptr), 0);
  }
  if (!block.name.empty()) {
    EXPECT_EQ(ex_put_name(file, EX_ELEM_BLOCK, block.id, block.name.c_str()), 0);
  }
}

void put_set(int file, ex_entity_type type, const ExodusSet& set) {
  EXPECT_EQ(ex_put_set_param(file, type, set.id, static_cast<std::int64_t>(set.entries.size()), 0),
            0);
  if (!set.entries.empty()) {
    EXPECT_EQ(ex_put_set(file, type, set.id, set.entries.data(),
                         set.sides.empty() ? nullptr : set.sides.data()),
              0);
  }
  if (!set.name.empty()) {
    EXPECT_EQ(ex_put_name(file, type, set.id, set.name.c_str()), 0);
  }
}

}  // namespace

void write_exodus(const std::string& path, int mode, const ExodusContent& content) {
  int in_memory = sizeof(double), in_file = sizeof(double);
  const int file = ex_create(path.c_str(), EX_CLOBBER | mode, &in_memory, &in_file);
  ASSERT_GE(file, 0) << path;
  int elements = 0;
  for (const ExodusBlock& block : content.blocks)
    elements += static_cast<int>(block.nodes.size()) / block.nodes_per_element;
  EXPECT_EQ(
      ex_put_init(file, "test", content.dimension, static_cast<std::int64_t>(content.x.size()),
                  elements, static_cast<std::int64_t>(content.blocks.size()),
                  static_cast<std::int64_t>(content.node_sets.size()),
                  static_cast<std::int64_t>(content.side_sets.size())),
      0);
  EXPECT_EQ(ex_put_coord(file, content.x.data(), content.y.data(), content.z.data()), 0);
  if (!content.node_numbers.empty()) {
    EXPECT_EQ(ex_put_id_map(file, EX_NODE_MAP, content.node_numbers.data()), 0);
  }
  for (const ExodusBlock& block : content.blocks) put_block(file, block);
  for (const ExodusSet& set : content.node_sets) put_set(file, EX_NODE_SET, set);
  for (const ExodusSet& set : content.side_sets) put_set(file, EX_SIDE_SET, set);
  EXPECT_EQ(ex_close(file), 0);
}

ExodusContent exodus_plate() {
  ExodusContent plate;
  plate.x = {0, 1, 2, 0, 1, 2, 0, 1, 2};
  plate.y = {0, 0, 0, 1, 1, 1, 2, 2, 2};
  plate.node_numbers = {11, 12, 13, 14, 15, 16, 17, 18, 19};
  plate.blocks = {{10, "steel", "TRI3", 3, {1, 2, 5, 1, 5, 4, 4, 5, 8, 4, 8, 7}},
                  {20, "", "QUAD4", 4, {2, 3, 6, 5, 5, 6, 9, 8}},
                  {25, "nothing", "TRI3", 3, {}},
                  {30, "seam", "bar2", 2, {2, 5, 5, 8}},
                  {40, "grain", "Sphere", 1, {9}}};
  plate.node_sets = {{1, "left", {7, 1, 4}, {}}, {2, "", {9}, {}}, {3, "empty", {}, {}}};
  // Elements are numbered through all blocks; side 3 of triangle 2 is (4,1); element 5 is a quad.
  plate.side_sets = {{7, "outer", {1, 2, 5}, {1, 3, 2}}, {8, "", {4}, {3}}};
  return plate;
}

ExodusContent exodus_solid() {
  ExodusContent solid;
  solid.dimension = 3;
  solid.x = {0, 1, 0, 0, 1};
  solid.y = {0, 0, 1, 0, 1};
  solid.z = {0, 0, 0, 1, 1};
  solid.blocks = {{1, "body", "TETRA", 4, {1, 2, 3, 4, 2, 3, 4, 5}},
                  {2, "skin", "triangle", 3, {2, 3, 4}}};
  solid.node_sets = {{1, "tip", {5}, {}}};
  solid.side_sets = {{1, "hull", {1, 1, 1, 1}, {1, 2, 3, 4}}, {2, "rim", {3}, {4}}};
  return solid;
}

}  // namespace cleave::io::testing
