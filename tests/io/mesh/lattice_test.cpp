// Lattices: measures in closed form, conforming simplices, distances, faces, refusals.
#include "io/lattice.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <ostream>

#include "mesh_support.hpp"

namespace cleave::io::testing {
namespace {

using Numbers = std::vector<std::int64_t>;

constexpr double kSpacing = 0.25;
const double kBcc = 2 * kSpacing / std::numbers::sqrt3,
             kFcc = kSpacing * std::numbers::sqrt2;  // cube edges

LatticeSpec block(LatticeKind lattice, std::array<double, 3> size) {
  return lattice_block(lattice, size, kSpacing);
}

LatticeSpec rounded(LatticeKind lattice, ShapeKind shape, double radius, double height = 0) {
  LatticeSpec spec = block(lattice, {0, 0, 0});
  spec.shape = shape;
  spec.radius = radius;
  spec.height = height;
  return spec;
}

const CellBlock& simplices(const Mesh& mesh) {
  return mesh.tetrahedra.nodes.empty() ? mesh.triangles : mesh.tetrahedra;
}

std::map<Numbers, int> facets(const CellBlock& cells) {
  const auto corners = static_cast<std::size_t>(cells.kind);
  std::map<Numbers, int> count;
  for (std::size_t cell = 0; cell < cells.nodes.size(); cell += corners)
    for (std::size_t left_out = 0; left_out < corners; ++left_out) {
      Numbers facet;
      for (std::size_t k = 0; k < corners; ++k)
        if (k != left_out) facet.push_back(cells.nodes[cell + k]);
      std::sort(facet.begin(), facet.end());
      ++count[facet];
    }
  return count;
}

// On which planes of the box all corners of the facet lie.
bool on_face(const Mesh& mesh, const Numbers& facet) {
  for (const char* face : {"xmin", "xmax", "ymin", "ymax", "zmin", "zmax"}) {
    const MeshGroup* group = mesh.find_group(face);
    if (group != nullptr &&
        std::includes(group->nodes.begin(), group->nodes.end(), facet.begin(), facet.end()))
      return true;
  }
  return false;
}

struct Case {
  const char* name;
  LatticeSpec spec;
  double measure;        // closed form
  double second_length;  // longest edge, in spacings

  friend void PrintTo(const Case& one, std::ostream* stream) { *stream << one.name; }
};

// n x n x n cubes. bcc: the pits between the outer body centres stay open, V = n^2 (n-1) a^3. fcc:
// the octahedra on the two y faces lack a corner of their diagonal, V = n^2 (n - 1/3) a^3.
// Hexagonal, rows of 6 and 5 spacings: 5 strips of 11 triangles.
std::vector<Case> cases() {
  const double d = kSpacing, n = 3;
  const auto cube = [&](double a) { return std::array<double, 3>{n * a, n * a, n * a}; };
  return {
      {"square", block(LatticeKind::square, {6 * d, 4 * d, 0}), 24 * d * d, std::numbers::sqrt2},
      {"hexagonal", block(LatticeKind::hexagonal, {6 * d, 5 * d * std::numbers::sqrt3 / 2, 0}),
       55 * d * d * std::numbers::sqrt3 / 4, 1},
      {"cubic", block(LatticeKind::cubic, {4 * d, 3 * d, 2 * d}), 24 * d * d * d,
       std::numbers::sqrt3},
      {"bcc", block(LatticeKind::bcc, cube(kBcc)), n * n * (n - 1) * std::pow(kBcc, 3),
       2 / std::numbers::sqrt3},
      {"fcc", block(LatticeKind::fcc, cube(kFcc)), n * n * (n - 1 / 3.0) * std::pow(kFcc, 3),
       std::numbers::sqrt2},
  };
}

constexpr double kRounding = 1e-13;  // sums over at most 324 simplices; measured 2e-15

class Lattices : public ::testing::TestWithParam<Case> {};

TEST_P(Lattices, FillTheVolumeWithPositiveSimplices) {
  const Mesh mesh = make_lattice(GetParam().spec);
  const CellBlock& cells = simplices(mesh);
  double sum = 0;
  for (std::int64_t cell = 0; cell < cells.count(); ++cell) {
    EXPECT_GT(measure(mesh, cells, cell), 0);
    sum += measure(mesh, cells, cell);
  }
  EXPECT_NEAR(sum / GetParam().measure, 1, kRounding);
}

TEST_P(Lattices, AreConforming) {
  const Mesh mesh = make_lattice(GetParam().spec);
  // Every facet belongs to two simplices or to the surface, and the surface is closed.
  std::map<Numbers, int> ridges;
  for (const auto& [facet, count] : facets(simplices(mesh))) {
    ASSERT_LE(count, 2);
    if (count == 2) continue;
    for (std::size_t left_out = 0; left_out < facet.size(); ++left_out) {
      Numbers ridge = facet;
      ridge.erase(ridge.begin() + static_cast<std::ptrdiff_t>(left_out));
      ++ridges[ridge];
    }
    const std::string name = GetParam().name;
    if (name == "square" || name == "cubic") {
      EXPECT_TRUE(on_face(mesh, facet));
    }
  }
  for (const auto& [ridge, count] : ridges) EXPECT_EQ(count % 2, 0);
}

TEST_P(Lattices, HaveTheirNeighbourDistance) {
  const Mesh mesh = make_lattice(GetParam().spec);
  double shortest = 1e300, longest = 0;
  for (std::int64_t a = 0; a < mesh.point_count(); ++a)
    for (std::int64_t b = 0; b < a; ++b) shortest = std::min(shortest, distance(mesh, a, b));
  const CellBlock& cells = simplices(mesh);
  const auto corners = static_cast<std::size_t>(cells.kind);
  for (std::size_t cell = 0; cell < cells.nodes.size(); cell += corners)
    for (std::size_t i = 0; i < corners; ++i)
      for (std::size_t j = 0; j < i; ++j)
        longest = std::max(longest, distance(mesh, cells.nodes[cell + i], cells.nodes[cell + j]));
  EXPECT_NEAR(shortest / kSpacing, 1, kRounding);
  EXPECT_NEAR(longest / kSpacing, GetParam().second_length, kRounding);
}

TEST_P(Lattices, NumberPointsAlongXThenYThenZ) {
  const Mesh mesh = make_lattice(GetParam().spec);
  std::vector<std::array<double, 3>> zyx;
  for (std::size_t i = 0; i < mesh.points.size(); i += 3)
    zyx.push_back({mesh.points[i + 2], mesh.points[i + 1], mesh.points[i]});
  EXPECT_TRUE(std::is_sorted(zyx.begin(), zyx.end()));
  EXPECT_EQ(mesh.point_ids.front(), 1);
  EXPECT_EQ(mesh.point_ids.back(), mesh.point_count());
  std::vector<bool> used(zyx.size(), false);
  for (const std::int64_t node : simplices(mesh).nodes)
    used.at(static_cast<std::size_t>(node)) = true;
  EXPECT_EQ(std::count(used.begin(), used.end(), false), 0);
}

TEST_P(Lattices, HaveGroups) {
  const Mesh mesh = make_lattice(GetParam().spec);
  const MeshGroup* all = mesh.find_group("all");
  ASSERT_NE(all, nullptr);
  EXPECT_EQ(all->dimension, mesh.tetrahedra.nodes.empty() ? 2 : 3);
  EXPECT_EQ(static_cast<std::int64_t>(all->nodes.size()), mesh.point_count());
  EXPECT_EQ(static_cast<std::int64_t>(all->cells.size()), simplices(mesh).count());
  ASSERT_NE(mesh.find_group("ymin"), nullptr);
  EXPECT_FALSE(mesh.find_group("ymin")->nodes.empty());
  for (const std::int64_t node : mesh.find_group("ymin")->nodes)
    EXPECT_EQ(mesh.points[3 * static_cast<std::size_t>(node) + 1], 2.0);
  EXPECT_EQ(mesh.find_group("zmax") != nullptr, all->dimension == 3);
}

INSTANTIATE_TEST_SUITE_P(All, Lattices, ::testing::ValuesIn(cases()),
                         [](const auto& one) { return std::string(one.param.name); });

TEST(Lattice, FacesOfABlockAreWhole) {
  const double d = kSpacing;
  const Mesh mesh = make_lattice(block(LatticeKind::cubic, {4 * d, 3 * d, 2 * d}));
  EXPECT_EQ(mesh.point_count(), 5 * 4 * 3);
  for (const auto& [face, count] : std::map<std::string, std::size_t>{
           {"xmin", 12}, {"xmax", 12}, {"ymin", 15}, {"ymax", 15}, {"zmin", 20}, {"zmax", 20}}) {
    ASSERT_NE(mesh.find_group(face), nullptr) << face;
    EXPECT_EQ(mesh.find_group(face)->nodes.size(), count) << face;
  }
}

TEST(Lattice, FittedBlockEndsWhereItShould) {
  LatticeSpec spec = block(LatticeKind::square, {30, 20, 0});
  spec.origin = {0, 0, 0};
  spec.spacing = 0.16666667;  // 180 and 120 steps within 2e-8
  const Mesh mesh = make_lattice(spec);
  EXPECT_EQ(mesh.point_count(), 181 * 121);
  EXPECT_EQ(mesh.points[mesh.points.size() - 3], 30.0);
  EXPECT_EQ(mesh.points[mesh.points.size() - 2], 20.0);
}

TEST(Lattice, DiagonalsOfTheSquareAlternate) {
  const double d = kSpacing;
  const Mesh mesh = make_lattice(block(LatticeKind::square, {4 * d, 4 * d, 0}));
  // Inner points have four or eight neighbours; a uniform diagonal would give six.
  std::map<std::int64_t, std::size_t> degree;
  for (const auto& [edge, count] : facets(mesh.triangles))
    for (const std::int64_t node : edge) ++degree[node];
  EXPECT_EQ(degree[6], 8U);
  EXPECT_EQ(degree[7], 4U);
  EXPECT_EQ(degree[12], 8U);
}

TEST(Lattice, DiscAndSphereConverge) {
  // The shape less a layer of about half a spacing. Measured, in the order of the kinds: 0.949 and
  // 0.957 (disc), 0.829, 0.882 and 0.869 (sphere).
  for (const LatticeKind kind : {LatticeKind::square, LatticeKind::hexagonal}) {
    const Mesh disc = make_lattice(rounded(kind, ShapeKind::sphere, 20 * kSpacing));
    const double ratio =
        total_measure(disc, disc.triangles) / (std::numbers::pi * std::pow(20 * kSpacing, 2));
    EXPECT_GT(ratio, 0.94);
    EXPECT_LT(ratio, 1);
  }
  for (const LatticeKind kind : {LatticeKind::cubic, LatticeKind::bcc, LatticeKind::fcc}) {
    const Mesh ball = make_lattice(rounded(kind, ShapeKind::sphere, 10 * kSpacing));
    const double ratio = total_measure(ball, ball.tetrahedra) /
                         (4 * std::numbers::pi / 3 * std::pow(10 * kSpacing, 3));
    EXPECT_GT(ratio, 0.81);
    EXPECT_LT(ratio, 1);
    for (std::int64_t node = 0; node < ball.point_count(); ++node) {
      double square = 0;
      for (std::size_t k = 0; k < 3; ++k)
        square += std::pow(ball.points[3 * static_cast<std::size_t>(node) + k] -
                               std::array<double, 3>{-1, 2, 0.5}[k],
                           2);
      EXPECT_LE(std::sqrt(square), 10 * kSpacing * (1 + 1e-6));
    }
  }
}

TEST(Lattice, PointsOnTheSurfaceAreInside) {
  // 0.6/0.1 is just below the integer.
  LatticeSpec disc = rounded(LatticeKind::square, ShapeKind::sphere, 0.6);
  disc.spacing = 0.1;
  disc.origin = {0, 0, 0};
  double reach = 0;
  const Mesh mesh = make_lattice(disc);
  for (std::size_t i = 0; i < mesh.points.size(); i += 3) reach = std::max(reach, mesh.points[i]);
  EXPECT_NEAR(reach, 0.6, 1e-15);
}

TEST(Lattice, CylinderAlongEveryAxis) {
  double first = 0;
  for (const int axis : {0, 1, 2}) {
    LatticeSpec spec = rounded(LatticeKind::cubic, ShapeKind::cylinder, 6 * kSpacing, 4 * kSpacing);
    spec.axis = axis;
    const Mesh mesh = make_lattice(spec);
    const double volume = total_measure(mesh, mesh.tetrahedra);
    if (axis == 0) first = volume;
    EXPECT_NEAR(volume / first, 1, 1e-12);  // the split treats the axes alike; measured 0
    const std::string letter(1, static_cast<char>('x' + axis));
    ASSERT_EQ(mesh.groups.size(), 3U);
    for (const std::int64_t node : mesh.find_group(letter + "max")->nodes)
      EXPECT_NEAR(mesh.points[static_cast<std::size_t>(3 * node + axis)],
                  spec.origin[static_cast<std::size_t>(axis)] + 4 * kSpacing, 1e-12);
    EXPECT_EQ(mesh.find_group(letter + "max")->nodes.size(),
              mesh.find_group(letter + "min")->nodes.size());
  }
}

TEST(Lattice, RefusalsSayWhatIsAllowed) {
  const auto refuse = [](LatticeSpec spec, const std::vector<std::string>& parts) {
    expect_error([&] { make_lattice(spec); }, parts);
  };
  const double d = kSpacing;
  refuse(block(LatticeKind::cubic, {4 * d, 3 * d, 2.4 * d}),
         {"the size along z, 0.6, is not a multiple", "0.25", "0.5 and 0.75"});
  refuse(block(LatticeKind::square, {0.4 * d, d, 0}), {"nearest sizes are 0.25"});
  refuse(block(LatticeKind::square, {d, 0, 0}), {"the size along y is 0", "greater than zero"});
  refuse(block(LatticeKind::square, {d, std::numeric_limits<double>::quiet_NaN(), 0}), {"nan"});
  refuse(block(LatticeKind::bcc, {d, d, d}), {"not one cell fits"});
  refuse(rounded(LatticeKind::cubic, ShapeKind::sphere, 0), {"the radius is 0"});
  refuse(rounded(LatticeKind::cubic, ShapeKind::cylinder, 1), {"the height is 0"});
  refuse(rounded(LatticeKind::square, ShapeKind::cylinder, 1, 1), {"take the shape sphere"});
  LatticeSpec spec = block(LatticeKind::cubic, {1, 1, 1});
  spec.spacing = 0;
  refuse(spec, {"the spacing is 0"});
  spec.spacing = -1;
  refuse(spec, {"the spacing is -1"});
  spec.spacing = 1e-4;
  refuse(spec, {"points", "2.14748365e+09", "right unit"});
  spec.spacing = 1e-300;
  refuse(spec, {"points"});
  spec = rounded(LatticeKind::cubic, ShapeKind::cylinder, 1, 1);
  spec.axis = 3;
  refuse(spec, {"0, 1 or 2, not 3"});
}

}  // namespace
}  // namespace cleave::io::testing
