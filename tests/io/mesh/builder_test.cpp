// Node numbers to indices, and repeated cells.
#include <gtest/gtest.h>

#include "io/mesh_builder.hpp"

namespace cleave::io {
namespace {

using Numbers = std::vector<std::int64_t>;

TEST(NodeNumbers, FindEveryNumberAndNoOther) {
  for (const Numbers& ids : {Numbers{4, 5, 6}, Numbers{6, 4, 5}, Numbers{9, 2, 5},
                             Numbers{7, 1000000, 3}, Numbers{0}, Numbers{}}) {
    NodeNumbers numbers;
    EXPECT_EQ(numbers.build(ids), -1);
    for (std::size_t i = 0; i < ids.size(); ++i)
      EXPECT_EQ(numbers.index(ids[i]), static_cast<std::int64_t>(i));
    for (const std::int64_t absent : {std::int64_t{-1}, std::int64_t{8}, std::int64_t{1000001}})
      EXPECT_EQ(numbers.index(absent), -1);
  }
}

TEST(NodeNumbers, TellWhichNumberOccursTwice) {
  NodeNumbers numbers;
  EXPECT_EQ(numbers.build(Numbers{3, 1, 3}), 3);
  EXPECT_EQ(numbers.build(Numbers{7000000, 1, 7000000}), 7000000);
}

TEST(RepeatedCells, TheFirstIsKept) {
  CellBlock block{CellKind::triangle, {0, 1, 2, 1, 2, 3, 2, 1, 0, 3, 4, 0, 1, 3, 2, 4, 3, 0}};
  const Numbers index = remove_repeated_cells(block, 5);
  EXPECT_EQ(index, (Numbers{0, 1, 0, 2, 1, 2}));
  EXPECT_EQ(block.nodes, (Numbers{0, 1, 2, 1, 2, 3, 3, 4, 0}));
  EXPECT_TRUE(remove_repeated_cells(block, 5).empty());
  EXPECT_EQ(block.count(), 3);
}

TEST(MeshBuilder, GroupsFollowTheirCells) {
  MeshBuilder builder("test");
  builder.points().assign(3 * 100, 0.0);
  for (std::int64_t i = 0; i < 100; ++i) builder.point_ids().push_back(i);
  builder.block(CellKind::line).nodes = {0, 1, 1, 2, 1, 0, 50, 99};
  builder.add_cells(builder.group("b", 1), 0, 2);
  builder.add_cells(builder.group("a", 1), 2, 4);
  builder.add_cells(builder.group("b", 1), 2, 3);
  builder.add_node(builder.group("z", 0), 7);
  builder.add_node(builder.group("z", 0), 7);
  const Mesh mesh = builder.finish();
  ASSERT_EQ(mesh.groups.size(), 3U);
  EXPECT_EQ(mesh.lines.count(), 3);
  EXPECT_EQ(mesh.groups[0].name, "z");
  EXPECT_EQ(mesh.groups[0].nodes, Numbers{7});
  EXPECT_EQ(mesh.groups[1].name, "a");
  EXPECT_EQ(mesh.groups[1].cells, (Numbers{0, 2}));
  EXPECT_EQ(mesh.groups[1].nodes, (Numbers{0, 1, 50, 99}));
  EXPECT_EQ(mesh.groups[2].cells, (Numbers{0, 1}));
  EXPECT_EQ(mesh.groups[2].nodes, (Numbers{0, 1, 2}));
}

}  // namespace
}  // namespace cleave::io
