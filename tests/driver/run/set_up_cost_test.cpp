// What set-up does with a body costs time in proportion to its size: for 1024 times the cells, less than
// 16000 times as long. Linear work takes 400 to 7000 times (caches and new memory count); what the bound is
// there to find, work for every pair of a crack and a bond, or of two particles, takes 33000 times and more.
#include <time.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numeric>

#include "io/mesh_builder.hpp"
#include "scene/precrack.hpp"
#include "scene/split.hpp"
#include "scene/surface.hpp"
#include "support.hpp"

namespace cleave::driver::testing {
namespace {

using Index = std::int64_t;

// Of this thread: other programs do not count.
double cpu_seconds() {
  timespec time{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

double seconds_of(const std::function<void()>& work, int times) {
  const double begin = cpu_seconds();
  for (int i = 0; i < times; ++i) work();
  return (cpu_seconds() - begin) / times;
}

constexpr Index kSmall = 16, kLarge = 512;  // cells along a side

// Best of three of time for the large body over that for the small one.
double growth(const std::function<void(BodyGeometry)>& work) {
  const BodyGeometry small = unit_cells(kSmall, kSmall), large = unit_cells(kLarge, kLarge);
  double of_small = 1e9, of_large = 1e9;
  for (int round = 0; round < 3; ++round) {
    of_small = std::min(of_small, seconds_of([&] { work(small); }, 40));
    of_large = std::min(of_large, seconds_of([&] { work(large); }, 1));
  }
  return of_large / of_small;
}

constexpr double kMost = 16000;

Index side_of(const BodyGeometry& body) {
  return static_cast<Index>(std::lround(std::sqrt(static_cast<double>(body.particles())))) - 1;
}

// Edges along the diagonal of the square, from corner to corner.
std::vector<Index> diagonal(const BodyGeometry& body) {
  const Index side = side_of(body);
  std::vector<Index> facets;
  for (Index i = 0; i < side; ++i)
    facets.insert(facets.end(), {i * (side + 2), (i + 1) * (side + 2)});
  return facets;
}

std::vector<Index> all_particles(const BodyGeometry& body) {
  std::vector<Index> all(static_cast<std::size_t>(body.particles()));
  std::iota(all.begin(), all.end(), Index{0});
  return all;
}

TEST(SetUpCost, OfTheSurfaceIsLinear) {
  EXPECT_LT(growth([](const BodyGeometry& body) { surface_facets(body, all_particles(body)); }),
            kMost);
}

TEST(SetUpCost, OfAMeshedCrackIsLinear) {
  EXPECT_LT(growth([](const BodyGeometry& body) {
              std::vector<Index> bonds;
              for (std::size_t s = 0; s < body.simplices.size(); s += 3) {
                const auto* v = &body.simplices[s];
                bonds.insert(bonds.end(), {v[0], v[1], v[1], v[2], v[2], v[0]});
              }
              crossing_bonds(crack_pieces(diagonal(body), body), body, bonds);
            }),
            kMost);
}

TEST(SetUpCost, OfSplittingIsLinear) {
  EXPECT_LT(growth([](BodyGeometry body) { split_along(diagonal(body), body); }), kMost);
}

TEST(SetUpCost, OfQuadraticElementsIsLinear) {
  EXPECT_LT(growth([](BodyGeometry body) {
              body.groups.push_back({"all", all_particles(body)});
              make_quadratic(body);
            }),
            kMost);
}

TEST(SetUpCost, OfRepeatedCellsIsLinear) {
  EXPECT_LT(
      growth([](const BodyGeometry& body) {
        io::CellBlock block{io::CellKind::triangle, {body.simplices.begin(), body.simplices.end()}};
        block.nodes.insert(block.nodes.end(), body.simplices.begin(), body.simplices.end());
        io::remove_repeated_cells(block, body.particles());
      }),
      kMost);
}

}  // namespace
}  // namespace cleave::driver::testing
