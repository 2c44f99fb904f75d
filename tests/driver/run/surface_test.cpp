#include "scene/surface.hpp"

#include <gtest/gtest.h>

#include <numeric>

#include "io/lattice.hpp"
#include "support.hpp"

namespace cleave::driver::testing {
namespace {

std::vector<std::int64_t> all_particles(const BodyGeometry& body) {
  std::vector<std::int64_t> all(static_cast<std::size_t>(body.particles()));
  std::iota(all.begin(), all.end(), 0);
  return all;
}

BodyGeometry cube() {
  io::LatticeSpec spec;
  spec.lattice = io::LatticeKind::cubic;
  spec.spacing = 1;
  spec.size = {2, 2, 2};
  const io::Mesh mesh = io::make_lattice(spec);
  BodyGeometry body;
  body.X = mesh.points;
  body.simplices.assign(mesh.tetrahedra.nodes.begin(), mesh.tetrahedra.nodes.end());
  return body;
}

// Sum of x . area over the facets: dimension times the volume, if all normals point outwards.
double flux(const BodyGeometry& body, const std::vector<std::int64_t>& facets) {
  double sum = 0;
  const auto corners = static_cast<std::size_t>(body.dimension);
  for (std::size_t f = 0; f < facets.size(); f += corners) {
    const double* x[3] = {};
    for (std::size_t a = 0; a < corners; ++a) {
      x[a] = &body.X[static_cast<std::size_t>(3 * facets[f + a])];
    }
    double area[3];
    area_vector(body.dimension, x, area);
    for (std::size_t a = 0; a < corners; ++a) {
      for (int k = 0; k < 3; ++k) sum += x[a][k] * area[k] / static_cast<double>(corners);
    }
  }
  return sum;
}

TEST(Surface, RectangleHasItsPerimeterWithNormalsOutwards) {
  const BodyGeometry body = unit_cells(3, 2);
  const auto facets = surface_facets(body, all_particles(body));
  EXPECT_EQ(facets.size(), 2u * 10u);
  EXPECT_DOUBLE_EQ(flux(body, facets), 2 * 6.0);
}

TEST(Surface, CubeHasItsFacesWithNormalsOutwards) {
  const BodyGeometry body = cube();
  const auto facets = surface_facets(body, all_particles(body));
  EXPECT_EQ(facets.size(), 3u * 6u * 8u);
  EXPECT_NEAR(flux(body, facets), 3 * 8.0, 1e-13);  // measured 1.8e-14
}

TEST(Surface, SetTakesOnlyWholeFacets) {
  const BodyGeometry body = unit_cells(3, 2);
  EXPECT_EQ(surface_facets(body, {0, 1, 2}).size(), 2u * 2u);  // two edges of the bottom
  EXPECT_EQ(surface_facets(body, {0, 2}).size(), 0u);
  EXPECT_EQ(surface_facets(body, {5, 6}).size(), 0u);  // an inner edge
}

// A restart may meet simplices with their corners in another order.
TEST(Surface, DoesNotDependOnTheOrderOfSimplicesAndCorners) {
  const BodyGeometry body = cube();
  BodyGeometry turned = body;
  for (std::size_t s = 0; s < turned.simplices.size(); s += 4) {
    std::swap(turned.simplices[s], turned.simplices[s + 3]);
  }
  std::rotate(turned.simplices.begin(), turned.simplices.begin() + 40, turned.simplices.end());
  EXPECT_EQ(surface_facets(body, all_particles(body)), surface_facets(turned, all_particles(body)));
}

}  // namespace
}  // namespace cleave::driver::testing
