#include "scene/piece_grid.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace cleave::driver {
namespace {

Box box_at(const double* centre, double half) {
  Box box{};
  for (int k = 0; k < 3; ++k) {
    box.lower[k] = centre[k] - half;
    box.upper[k] = centre[k] + half;
  }
  return box;
}

bool meet(const Box& a, const Box& b) {
  for (int k = 0; k < 3; ++k) {
    if (a.upper[k] < b.lower[k] || b.upper[k] < a.lower[k]) return false;
  }
  return true;
}

// Boxes on a wavy sheet over the unit square: what a meshed crack is like.
std::vector<Box> sheet(int side) {
  std::vector<Box> boxes;
  for (int j = 0; j < side; ++j) {
    for (int i = 0; i < side; ++i) {
      const double x = (i + 0.5) / side, y = (j + 0.5) / side;
      const double centre[3] = {x, y, 0.2 * std::sin(6 * x) * std::cos(5 * y)};
      boxes.push_back(box_at(centre, 1.5 / side));
    }
  }
  return boxes;
}

TEST(PieceGrid, FindsAllThatMeetTheBox) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> anywhere(-0.3, 1.3);
  for (const int side : {1, 2, 7, 40}) {
    const std::vector<Box> boxes = sheet(side);
    PieceGrid grid(boxes);
    for (int query = 0; query < 300; ++query) {
      const double centre[3] = {anywhere(random), anywhere(random), anywhere(random) - 0.5};
      const Box box = box_at(centre, 0.02 * (query % 10));
      const std::vector<std::int32_t>& near = grid.near(box);
      EXPECT_TRUE(std::is_sorted(near.begin(), near.end()));
      EXPECT_EQ(std::adjacent_find(near.begin(), near.end()), near.end());
      for (std::size_t piece = 0; piece < boxes.size(); ++piece) {
        if (!meet(box, boxes[piece])) continue;
        EXPECT_TRUE(std::binary_search(near.begin(), near.end(), static_cast<std::int32_t>(piece)));
      }
    }
  }
}

// Work for a bond of the mesh's size does not grow with the number of pieces.
TEST(PieceGrid, FindsAFewHoweverManyThereAre) {
  for (const int side : {10, 30, 100, 300}) {
    const std::vector<Box> boxes = sheet(side);
    PieceGrid grid(boxes);
    std::size_t most = 0, sum = 0;
    for (const Box& box : boxes) {
      const double centre[3] = {(box.lower[0] + box.upper[0]) / 2,
                                (box.lower[1] + box.upper[1]) / 2,
                                (box.lower[2] + box.upper[2]) / 2};
      const std::size_t found = grid.near(box_at(centre, 0.5 / side)).size();
      most = std::max(most, found);
      sum += found;
    }
    EXPECT_LE(most, 100u) << side;
    EXPECT_LE(sum, 60 * boxes.size()) << side;
  }
}

TEST(PieceGrid, OfNothingAndOfOnePoint) {
  PieceGrid nothing({});
  const double zero[3] = {0, 0, 0};
  EXPECT_TRUE(nothing.near(box_at(zero, 1)).empty());
  PieceGrid point({box_at(zero, 0), box_at(zero, 0)});
  EXPECT_EQ(point.near(box_at(zero, 0)), (std::vector<std::int32_t>{0, 1}));
}

}  // namespace
}  // namespace cleave::driver
