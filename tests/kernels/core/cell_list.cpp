// Neighbours by cells against all pairs, and the rule at the radius.
#include "core/cell_list.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/error.hpp"
#include "support/meshes.hpp"

namespace cleave::test {
namespace {

std::size_t at(std::int64_t i) { return static_cast<std::size_t>(i); }

NeighbourRows rows_of(const std::vector<double>& X, double radius, Radius rule = Radius::open) {
  return neighbours_within(X.data(), static_cast<std::int64_t>(X.size()) / 3, radius, rule, "test");
}

std::vector<double> cloud(int dimension, int n, double size, unsigned seed) {
  Random random(seed);
  std::vector<double> X;
  for (int i = 0; i < n; ++i)
    for (int k = 0; k < 3; ++k) X.push_back(k < dimension ? size * random() : 0.0);
  return X;
}

void expect_all_pairs(const std::vector<double>& X, double radius) {
  const NeighbourRows rows = rows_of(X, radius);
  const auto n = static_cast<std::int64_t>(X.size()) / 3;
  for (std::int64_t i = 0; i < n; ++i) {
    std::vector<std::int32_t> expected;
    for (std::int64_t p = 0; p < n; ++p) {
      double square = 0;
      for (std::int64_t k = 0; k < 3; ++k)
        square += (X[at(3 * p + k)] - X[at(3 * i + k)]) * (X[at(3 * p + k)] - X[at(3 * i + k)]);
      if (p != i && std::sqrt(square) < radius) expected.push_back(static_cast<std::int32_t>(p));
    }
    const std::vector<std::int32_t> found(rows.neighbour.begin() + rows.row_begin[at(i)],
                                          rows.neighbour.begin() + rows.row_begin[at(i + 1)]);
    ASSERT_EQ(found, expected) << i;
  }
}

TEST(CellList, FindsWhatAllPairsFind) {
  for (const int d : {1, 2, 3})
    for (const double radius : {0.05, 0.3, 0.9, 10.0})
      expect_all_pairs(cloud(d, 400, 1.0, 3), radius);
  // Two clouds far apart: most cells of the box are empty.
  auto far = cloud(3, 100, 1.0, 4), other = cloud(3, 100, 1.0, 5);
  for (double& x : other) x += 1e4;
  far.insert(far.end(), other.begin(), other.end());
  expect_all_pairs(far, 0.7);
}

TEST(CellList, ReverseLeadsBack) {
  const auto X = cloud(3, 500, 1.0, 6);
  const NeighbourRows rows = rows_of(X, 0.4);
  ASSERT_GT(rows.neighbour.size(), 1000u);
  for (std::int64_t i = 0; i < 500; ++i)
    for (auto b = rows.row_begin[at(i)]; b < rows.row_begin[at(i + 1)]; ++b) {
      const auto p = rows.neighbour[at(b)], back = rows.reverse[at(b)];
      ASSERT_EQ(rows.neighbour[at(back)], i);
      ASSERT_GE(back, rows.row_begin[at(p)]);
      ASSERT_LT(back, rows.row_begin[at(p) + 1]);
      ASSERT_EQ(rows.reverse[at(back)], b);
    }
}

// Theory chapter: cut-offs of 4, 6, 8 spacings on a triangular lattice leave out the particles that
// stand exactly there; whatever the unit, the place and the rounding of coordinates to 9 digits.
TEST(CellList, LatticePointsOnTheRadiusAreDecidedAlike) {
  const SimplexMesh lattice = triangular_lattice(24, 24, 1.0, 0.0, 1);
  const std::size_t middle = 12 * 24 + 12;
  const int open[] = {54, 120, 234}, closed[] = {60, 126, 240};
  for (const double scale : {1.0, 0.55, 1e-3 / 3, 7e5}) {
    for (const double shift : {0.0, 0.1, 37.3}) {
      for (const bool rounded : {false, true}) {
        auto X = lattice.X;
        for (std::size_t k = 0; k < X.size(); ++k) {
          if (rounded) X[k] = std::round(X[k] * 1e8) / 1e8;
          X[k] = k % 3 == 2 ? 0.0 : scale * (X[k] + shift);
        }
        for (int c = 0; c < 3; ++c) {
          const auto count = [&](Radius rule) {
            const NeighbourRows rows = rows_of(X, scale * (4 + 2 * c), rule);
            return rows.row_begin[middle + 1] - rows.row_begin[middle];
          };
          EXPECT_EQ(count(Radius::open), open[c]) << scale << ' ' << shift;
          EXPECT_EQ(count(Radius::closed), closed[c]) << scale << ' ' << shift;
        }
      }
    }
  }
}

TEST(CellList, RefusesMoreHalfBondsThanIndicesCanCount) {
  const auto X = cloud(3, 100, 1.0, 7);  // all of them neighbours
  EXPECT_NO_THROW(neighbours_within(X.data(), 100, 10.0, Radius::open, "test", 9900));
  try {
    neighbours_within(X.data(), 100, 10.0, Radius::open, "test", 9899);
    FAIL() << "no error";
  } catch (const Error& e) {
    EXPECT_EQ(e.status, CLEAVE_BAD_ARGUMENT);
    EXPECT_NE(std::string(e.what()).find("2^31"), std::string::npos) << e.what();
  }
}

}  // namespace
}  // namespace cleave::test
