#include "scene/split.hpp"

#include <gtest/gtest.h>

#include "scene/surface.hpp"
#include "support.hpp"

namespace cleave::driver::testing {
namespace {

using Index = std::int64_t;

// 4 x 2 cells: particles 0..4 on y = 0, 5..9 on y = 1, 10..14 on y = 2.
TEST(Split, EdgeCrackDoublesItsParticlesButNotTheTip) {
  BodyGeometry body = unit_cells(4, 2);
  body.groups.push_back({"crack", {5, 6, 7}});
  EXPECT_EQ(split_along({5, 6, 7, 6}, body), 2);  // 5 at the surface and 6; 7 is the tip
  EXPECT_EQ(body.particles(), 17);
  EXPECT_EQ(body.point_ids.size(), 17u);
  EXPECT_EQ(body.point_ids[15], 16);
  EXPECT_EQ(body.groups[0].particles, (std::vector<Index>{5, 6, 7, 15, 16}));
  EXPECT_EQ(body.X[3 * 15], 0.0);
  EXPECT_EQ(body.X[3 * 16], 1.0);
  // two crack faces of two edges each are new surface
  std::vector<Index> all(17);
  for (std::size_t i = 0; i < all.size(); ++i) all[i] = static_cast<Index>(i);
  EXPECT_EQ(surface_facets(body, all).size(), 2u * (12u + 4u));
}

TEST(Split, NoSimplexOfOneSideSharesADoubledParticleWithTheOther) {
  BodyGeometry body = unit_cells(4, 2);
  split_along({5, 6, 6, 7, 7, 8, 8, 9}, body);  // right through
  EXPECT_EQ(body.particles(), 15 + 5);
  for (std::size_t s = 0; s < body.simplices.size(); s += 3) {
    double y = 0;
    for (std::size_t a = 0; a < 3; ++a)
      y += body.X[static_cast<std::size_t>(3 * body.simplices[s + a] + 1)];
    for (std::size_t a = 0; a < 3; ++a) {
      const Index particle = body.simplices[s + a];
      const bool on_crack = body.X[static_cast<std::size_t>(3 * particle + 1)] == 1.0;
      // the first group found, that of the lower simplices, keeps the old particles
      if (!on_crack) continue;
      EXPECT_EQ(particle < 15, y < 3.0);
    }
  }
}

TEST(Split, BranchesMakeAsManyParticlesAsSectors) {
  BodyGeometry body = unit_cells(4, 2);
  // three edges meet in particle 7: left, right and up
  EXPECT_EQ(split_along({6, 7, 7, 8, 7, 12}, body), 2 + 1);  // 7 in three; 12 at the surface in two
}

TEST(Split, SurfaceAndSingleInnerEdgesSeparateNothing) {
  BodyGeometry body = unit_cells(4, 2);
  EXPECT_EQ(split_along({0, 1, 1, 2}, body), 0);
  EXPECT_EQ(split_along({6, 7}, body), 0);
}

}  // namespace
}  // namespace cleave::driver::testing
