// Turned lattices, and lattices cut to a mesh: against distances, areas and what is inside in closed form.
#include "io/lattice_cut.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>

#include "io/outline.hpp"
#include "mesh_support.hpp"

namespace cleave::io::testing {
namespace {

using Point = const double*;

std::int64_t count_inside(const Mesh& mesh, const std::function<bool(Point)>& inside) {
  std::int64_t count = 0;
  for (std::int64_t i = 0; i < mesh.point_count(); ++i)
    count += inside(&mesh.points[3 * static_cast<std::size_t>(i)]) ? 1 : 0;
  return count;
}

std::vector<std::string> names(const Mesh& mesh) {
  std::vector<std::string> found;
  for (const MeshGroup& group : mesh.groups) found.push_back(group.name);
  return found;
}

TEST(TurnedLattice, HasItsRowsAlongTheAxis) {
  for (const double angle : {0.3, 1.1, std::numbers::pi / 2, -2.0}) {
    LatticeSpec spec = lattice_block(LatticeKind::hexagonal, {6, 4, 0}, 0.25);
    spec.x_axis = {3 * std::cos(angle), 3 * std::sin(angle), 0};
    const Mesh mesh = make_lattice(spec);
    const auto& v = mesh.triangles.nodes;
    bool along = false;
    for (std::size_t s = 0; s < v.size(); s += 3)
      for (std::size_t a = 0; a < 3; ++a) {
        const std::int64_t p = v[s + a], q = v[s + (a + 1) % 3];
        EXPECT_NEAR(distance(mesh, p, q), 0.25, 1e-13);
        const std::size_t i = 3 * static_cast<std::size_t>(p), j = 3 * static_cast<std::size_t>(q);
        along =
            along || std::abs((mesh.points[j] - mesh.points[i]) * std::sin(angle) -
                              (mesh.points[j + 1] - mesh.points[i + 1]) * std::cos(angle)) < 1e-13;
      }
    EXPECT_TRUE(along) << angle;
    for (std::int64_t s = 0; s < mesh.triangles.count(); ++s)
      EXPECT_GT(measure(mesh, mesh.triangles, s), 0);
    // What is missing are parts of triangles along the edge, less than a spacing wide.
    const double area = total_measure(mesh, mesh.triangles);
    EXPECT_LT(area, 24.0);
    EXPECT_GT(area, 24.0 - 20 * 0.25) << angle;
    // A point in the middle.
    EXPECT_EQ(count_inside(mesh, [](Point x) { return std::hypot(x[0] - 2, x[1] - 4) < 1e-12; }),
              1);
    EXPECT_EQ(names(mesh), (std::vector<std::string>{"xmax", "xmin", "ymax", "ymin", "all"}));
    for (const std::int64_t i : mesh.find_group("xmin")->nodes)
      EXPECT_LE(mesh.points[3 * static_cast<std::size_t>(i)], -1 + 2 * 0.25);
    EXPECT_GT(mesh.find_group("xmin")->nodes.size(), 4u);
  }
}

// Every inner point of a face-centred lattice has twelve neighbours, also in a turned one.
TEST(TurnedLattice, KeepsNeighboursInSpace) {
  for (const ShapeKind shape : {ShapeKind::block, ShapeKind::cylinder, ShapeKind::sphere}) {
    LatticeSpec spec = lattice_block(LatticeKind::fcc, {2, 2, 2}, 0.3);
    spec.shape = shape;
    spec.radius = 1.2;
    spec.height = 2.0;
    spec.x_axis = {1, 1, 0};
    spec.y_axis = {0, 1, 1};
    const Mesh mesh = make_lattice(spec);
    for (std::int64_t s = 0; s < mesh.tetrahedra.count(); ++s)
      ASSERT_GT(measure(mesh, mesh.tetrahedra, s), 0);
    const bool centred = shape == ShapeKind::sphere;
    const std::array<double, 3> middle = {centred                     ? -1.0
                                          : shape == ShapeKind::block ? 0.0
                                                                      : -1.0,
                                          centred || shape == ShapeKind::cylinder ? 2.0 : 3.0,
                                          centred ? 0.5 : 1.5};
    const auto from = [&](Point x) {
      return std::hypot(x[0] - middle[0], x[1] - middle[1], x[2] - middle[2]);
    };
    EXPECT_EQ(count_inside(mesh, [&](Point x) { return from(x) < 1e-12; }), 1);
    EXPECT_EQ(count_inside(mesh, [&](Point x) { return from(x) < 0.3 * 1.0001; }), 13);
    EXPECT_EQ(mesh.find_group("zmax") != nullptr, shape != ShapeKind::sphere);
    EXPECT_EQ(mesh.find_group("xmin") != nullptr, shape == ShapeKind::block);
  }
}

TEST(TurnedLattice, RefusesAxesThatAreNone) {
  LatticeSpec plane = lattice_block(LatticeKind::hexagonal, {6, 4, 0}, 0.25);
  plane.x_axis = {1, 0, 1};
  expect_error([&] { make_lattice(plane); }, {"x_axis", "in the plane"});
  plane.x_axis = {0, 0, 0};
  expect_error([&] { make_lattice(plane); }, {"x_axis", "direction"});
  plane.x_axis = {1, 1, 0};
  plane.shape = ShapeKind::cylinder;
  plane.radius = plane.height = 1;
  expect_error([&] { make_lattice(plane); }, {"cylinder", "disc"});
  LatticeSpec solid = lattice_block(LatticeKind::bcc, {2, 2, 2}, 0.3);
  solid.x_axis = {0, 2, 0};
  expect_error([&] { make_lattice(solid); }, {"parallel", "y_axis"});
  solid.y_axis = {0, 0, 1};
  EXPECT_GT(make_lattice(solid).point_count(), 0);
  solid.size[2] = 0;
  expect_error([&] { make_lattice(solid); }, {"along z", "size"});
}

// An L of two rectangles, 2 x 1 and 1 x 2, as four triangles.
Mesh corner_piece() {
  Mesh mesh;
  mesh.path = "L.msh";
  mesh.points = {0, 0, 0, 2, 0, 0, 2, 1, 0, 1, 1, 0, 1, 2, 0, 0, 2, 0, 0, 1, 0};
  mesh.triangles.nodes = {0, 1, 2, 0, 6, 2, 6, 3, 4, 4, 5, 6};
  return mesh;
}
bool in_corner_piece(Point x, double margin) {
  const auto between = [&](double a, double low, double high) {
    return a >= low - margin && a <= high + margin;
  };
  return (between(x[0], 0, 2) && between(x[1], 0, 1)) ||
         (between(x[0], 0, 1) && between(x[1], 0, 2));
}

TEST(CutLattice, HasThePointsWithinTheMesh) {
  const Mesh outline = corner_piece();
  LatticeSpec spec = lattice_block(LatticeKind::square, {0, 0, 0}, 0.1);
  const Mesh whole = make_lattice(around(spec, outline));
  Mesh cut = whole;
  cut_to_outline(outline, 0.1, cut);
  EXPECT_EQ(whole.point_count(), 21 * 21);
  EXPECT_EQ(cut.point_count(), 21 * 11 + 11 * 10);
  EXPECT_EQ(cut.point_count(),
            count_inside(whole, [](Point x) { return in_corner_piece(x, 1e-9); }));
  EXPECT_NEAR(total_measure(cut, cut.triangles), 3.0, 1e-12);
  EXPECT_EQ(names(cut), (std::vector<std::string>{"xmax", "xmin", "ymax", "ymin", "all"}));
  EXPECT_EQ(cut.find_group("xmax")->nodes.size(), 11u);
  EXPECT_EQ(cut.find_group("xmin")->nodes.size(), 21u);
  EXPECT_EQ(cut.find_group("all")->cells.size(), static_cast<std::size_t>(cut.triangles.count()));

  spec.lattice = LatticeKind::hexagonal;
  spec.x_axis = {1, 0.4, 0};
  Mesh turned = make_lattice(around(spec, outline));
  cut_to_outline(outline, 0.1, turned);
  EXPECT_EQ(count_inside(turned, [](Point x) { return in_corner_piece(x, 1e-6); }),
            turned.point_count());
  EXPECT_GT(total_measure(turned, turned.triangles), 3.0 - 8 * 0.1);
}

TEST(CutLattice, HasThePointsWithinATetrahedron) {
  Mesh outline;
  outline.path = "one.msh";
  outline.points = {0, 0, 0, 3, 0, 0, 0, 3, 0, 0, 0, 3};
  outline.tetrahedra.nodes = {0, 2, 1, 3};  // either orientation
  LatticeSpec spec = lattice_block(LatticeKind::cubic, {0, 0, 0}, 0.25);
  const Mesh whole = make_lattice(around(spec, outline));
  Mesh cut = whole;
  cut_to_outline(outline, 0.25, cut);
  const auto inside = [](Point x) { return x[0] + x[1] + x[2] < 3 + 1e-9; };
  EXPECT_EQ(count_inside(cut, inside), cut.point_count());
  // All tetrahedra of a cell share its main diagonal: whole cells are left, with i + j + k <= 9, and their corners.
  EXPECT_NEAR(total_measure(cut, cut.tetrahedra), 220 * std::pow(0.25, 3), 1e-12);
  EXPECT_EQ(count_inside(whole, inside), 455);
  EXPECT_EQ(cut.point_count(), 455 - 39);
}

// Many triangles: bins against all of them.
TEST(CutLattice, FindsWhatASearchThroughAllTrianglesFinds) {
  LatticeSpec disc = lattice_block(LatticeKind::hexagonal, {0, 0, 0}, 0.21);
  disc.shape = ShapeKind::sphere;
  disc.radius = 2.3;
  const Mesh outline = make_lattice(disc);
  const Outline within(outline, 2, 0);
  std::int64_t inside = 0;
  for (double x = -3.5; x < 1.6; x += 0.037)
    for (double y = -0.5; y < 4.5; y += 0.041) {
      bool found = false;
      for (std::size_t s = 0; s < outline.triangles.nodes.size() && !found; s += 3) {
        const auto corner = [&](std::size_t a) {
          return &outline.points[3 * static_cast<std::size_t>(outline.triangles.nodes[s + a])];
        };
        found = true;
        for (std::size_t a = 0; a < 3; ++a) {
          const double *p = corner(a), *q = corner((a + 1) % 3);
          found = found && (q[0] - p[0]) * (y - p[1]) - (q[1] - p[1]) * (x - p[0]) >= 0;
        }
      }
      const std::array point{x, y, 0.0};
      EXPECT_EQ(within.contains(point.data()), found) << x << " " << y;
      inside += found ? 1 : 0;
    }
  EXPECT_GT(inside, 8000);
}

TEST(CutLattice, SaysThatNothingIsLeft) {
  Mesh lattice = make_lattice(lattice_block(LatticeKind::square, {1, 1, 0}, 0.1));  // elsewhere
  expect_error([&] { cut_to_outline(corner_piece(), 0.1, lattice); }, {"L.msh", "same place"});
  Mesh none = corner_piece();
  none.triangles.nodes.clear();
  expect_error([&] { cut_to_outline(none, 0.1, lattice); }, {"no triangles", "L.msh"});
}

}  // namespace
}  // namespace cleave::io::testing
