// Interpolation at points through the C interface: exact for what the elements can represent, and at
// home in the right simplex.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <map>

#include "support/model.hpp"

namespace cleave::test {
namespace {

constexpr double kSpacing = 0.01;
constexpr int kCells = 4;

using Point = std::array<double, 3>;

// The value of a linear or quadratic test function, about 1 on the patch.
double linear(const Point& x, int k) {
  return 0.3 * k + (1 + k) * x[0] / kSpacing - 0.7 * x[1] / kSpacing + 0.2 * x[2] / kSpacing;
}
double quadratic(const Point& x, int k) {
  const double a = x[0] / kSpacing, b = x[1] / kSpacing;
  return linear(x, k) + 0.4 * a * a - 0.3 * a * b + (0.1 + k) * b * b;
}

Point node(const SimplexMesh& mesh, std::int64_t i) {
  Point x{};
  for (std::size_t k = 0; k < static_cast<std::size_t>(mesh.dimension); ++k)
    x[k] = mesh.X[static_cast<std::size_t>(3 * i) + k];
  return x;
}

// Points in the inside of the patch, whose outline is jittered.
std::vector<Point> points_inside(int dimension, std::size_t count) {
  Random random(17);
  std::vector<Point> points(count);
  for (Point& x : points)
    for (std::size_t k = 0; k < static_cast<std::size_t>(dimension); ++k)
      x[k] = kSpacing * kCells * (0.5 + 0.42 * random());
  return points;
}

struct Located {
  std::vector<std::int64_t> simplex;
  std::vector<double> weight;
};
Located locate(Model& model, const std::vector<Point>& points) {
  Located found{std::vector<std::int64_t>(points.size(), -7),
                std::vector<double>(4 * points.size(), 7.0)};
  ok(cleave_body_locate(model, 0, static_cast<std::int64_t>(points.size()), points.front().data(),
                        found.simplex.data(), found.weight.data()));
  return found;
}
std::vector<double> interpolated(Model& model, const char* field, const Located& at) {
  const auto components = static_cast<std::size_t>(model.field(field).components);
  std::vector<double> values(components * at.simplex.size(), 7.0);
  ok(cleave_field_interpolate(model, 0, field, static_cast<std::int64_t>(at.simplex.size()),
                              at.simplex.data(), at.weight.data(), values.data()));
  return values;
}

class Interpolation : public testing::TestWithParam<Case> {
 protected:
  int dimension() const { return dimension_of(GetParam()); }
  const SimplexMesh mesh = patch(dimension(), kCells, kSpacing, 0.2, 9);
};

TEST_P(Interpolation, PointsAreInTheirSimplex) {
  Model model;
  model.add(GetParam(), mesh);
  model.setup();
  const auto points = points_inside(dimension(), 500);
  const Located at = locate(model, points);
  for (std::size_t p = 0; p < points.size(); ++p) {
    ASSERT_GE(at.simplex[p], 0);
    Point x{};
    double sum = 0;
    for (int a = 0; a <= dimension(); ++a) {
      const double weight = at.weight[4 * p + static_cast<std::size_t>(a)];
      EXPECT_GE(weight, -1e-9);
      sum += weight;
      const auto corner = static_cast<std::size_t>((dimension() + 1) * at.simplex[p] + a);
      const Point n = node(mesh, mesh.simplices[corner]);
      for (std::size_t k = 0; k < 3; ++k) x[k] += weight * n[k];
    }
    EXPECT_NEAR(sum, 1.0, 1e-14);  // measured 2e-16
    for (std::size_t k = 0; k < 3; ++k) EXPECT_NEAR(x[k], points[p][k], 1e-14 * kSpacing * kCells);
  }
}

TEST_P(Interpolation, LinearFieldsOfParticlesAreExact) {
  Model model;
  model.add(GetParam(), mesh);
  model.setup();
  auto v = model.real("velocity");
  for (std::int64_t i = 0; i < mesh.particles(); ++i)
    for (int k = 0; k < dimension(); ++k)
      v[static_cast<std::size_t>(3 * i + k)] = linear(node(mesh, i), k);
  model.put("velocity", v);
  const auto points = points_inside(dimension(), 300);
  const auto values = interpolated(model, "velocity", locate(model, points));
  for (std::size_t p = 0; p < points.size(); ++p)
    for (int k = 0; k < 3; ++k) {
      const double exact = k < dimension() ? linear(points[p], k) : 0.0;
      EXPECT_NEAR(values[3 * p + static_cast<std::size_t>(k)], exact, 1e-13);  // measured 4e-15
    }
}

// Corners, middles of edges and middles of simplices belong to the body, whichever simplex has them.
TEST_P(Interpolation, EdgesAndCornersAreInside) {
  Model model;
  model.add(GetParam(), mesh);
  model.setup();
  auto v = model.real("velocity");
  for (std::int64_t i = 0; i < mesh.particles(); ++i)
    v[static_cast<std::size_t>(3 * i)] = linear(node(mesh, i), 0);
  model.put("velocity", v);
  std::vector<Point> points;
  const auto corners = static_cast<std::size_t>(dimension() + 1);
  for (std::size_t s = 0; s < mesh.simplices.size(); s += corners) {
    const Point a = node(mesh, mesh.simplices[s]), b = node(mesh, mesh.simplices[s + 1]);
    points.push_back(a);
    points.push_back({0.5 * (a[0] + b[0]), 0.5 * (a[1] + b[1]), 0.5 * (a[2] + b[2])});
  }
  const Located at = locate(model, points);
  const auto values = interpolated(model, "velocity", at);
  for (std::size_t p = 0; p < points.size(); ++p) {
    ASSERT_GE(at.simplex[p], 0) << "point " << p;
    EXPECT_NEAR(values[3 * p], linear(points[p], 0), 1e-12);
  }
}

TEST_P(Interpolation, OutsideIsSaidAndZero) {
  Model model;
  model.add(GetParam(), mesh);
  model.setup();
  auto v = model.real("velocity");
  for (double& value : v) value = 3;
  model.put("velocity", v);
  const double far = kSpacing * (kCells + 1), middle = 0.5 * kSpacing * kCells;
  std::vector<Point> points{{-kSpacing, middle, 0}, {far, middle, 0}, {middle, far, 0}};
  if (dimension() == 3) points = {{middle, middle, -kSpacing}, {middle, middle, far}};
  const Located at = locate(model, points);
  const auto values = interpolated(model, "velocity", at);
  for (std::size_t p = 0; p < points.size(); ++p) {
    EXPECT_EQ(at.simplex[p], -1);
    for (std::size_t k = 0; k < 3; ++k) EXPECT_EQ(values[3 * p + k], 0.0);
  }
}

// A measure that is computed when asked for: constant under affine motion.
TEST_P(Interpolation, DerivedFieldsAreInterpolatedToo) {
  Model model;
  model.add(GetParam(), mesh);
  model.setup();
  constexpr double kGradient[3][3] = {{0.02, 0.01, 0}, {-0.01, 0.03, 0}, {0, 0, 0}};
  auto u = model.real("displacement");
  for (std::int64_t i = 0; i < mesh.particles(); ++i) {
    const Point x = node(mesh, i);
    for (std::size_t k = 0; k < 2; ++k)
      u[static_cast<std::size_t>(3 * i) + k] = kGradient[k][0] * x[0] + kGradient[k][1] * x[1];
  }
  model.put("displacement", u);
  model.initialise();
  const auto points = points_inside(dimension(), 20);
  const auto f = interpolated(model, "deformation_gradient", locate(model, points));
  for (std::size_t p = 0; p < points.size(); ++p)
    for (std::size_t r = 0; r < 2; ++r)
      for (std::size_t c = 0; c < 2; ++c)
        EXPECT_NEAR(f[9 * p + r + 3 * c], kGradient[r][c] + (r == c ? 1.0 : 0.0), 1e-13);
}

std::vector<Case> with_simplices() {
  std::vector<Case> cases;
  for (const std::int32_t f : {CLEAVE_FORMULATION_cbm, CLEAVE_FORMULATION_fem,
                               CLEAVE_FORMULATION_tlsph, CLEAVE_FORMULATION_nosb})
    for (const std::int32_t k : {CLEAVE_3D, CLEAVE_PLANE_STRAIN})
      cases.push_back({f, CLEAVE_MATERIAL_svk, k});
  return cases;
}
INSTANTIATE_TEST_SUITE_P(Formulations, Interpolation, testing::ValuesIn(with_simplices()),
                         case_name);

// Finite elements keep stress where it is evaluated: constant in linear elements.
TEST(GaussPoints, OfLinearElementsAreConstantInTheElement) {
  for (const std::int32_t kinematics : {CLEAVE_3D, CLEAVE_PLANE_STRAIN}) {
    const Case c{CLEAVE_FORMULATION_fem, CLEAVE_MATERIAL_svk, kinematics};
    const SimplexMesh mesh = patch(dimension_of(c), kCells, kSpacing, 0.2, 9);
    Model model;
    model.add(c, mesh);
    model.setup();
    auto w = model.real("strain_energy_density");
    ASSERT_EQ(w.size(), static_cast<std::size_t>(mesh.simplex_count()));
    for (std::size_t s = 0; s < w.size(); ++s) w[s] = static_cast<double>(s) + 1;
    model.put("strain_energy_density", w);
    const Located at = locate(model, points_inside(mesh.dimension, 100));
    const auto values = interpolated(model, "strain_energy_density", at);
    for (std::size_t p = 0; p < values.size(); ++p)
      EXPECT_EQ(values[p], static_cast<double>(at.simplex[p]) + 1);
  }
}

// Triangles with straight edges and a node in the middle of each.
class QuadraticTriangles : public testing::Test {
 protected:
  QuadraticTriangles() {
    std::map<std::pair<std::int64_t, std::int64_t>, std::int64_t> middle;
    for (std::size_t s = 0; s < mesh_.simplices.size(); s += 3) {
      const std::int64_t* v = &mesh_.simplices[s];
      six_.insert(six_.end(), v, v + 3);
      for (int a = 0; a < 3; ++a) {
        const auto ends = std::minmax(v[a], v[(a + 1) % 3]);
        const auto [entry, is_new] =
            middle.try_emplace({ends.first, ends.second}, static_cast<std::int64_t>(x_.size()));
        six_.push_back(entry->second);
        if (!is_new) continue;
        const Point p = node(mesh_, ends.first), q = node(mesh_, ends.second);
        x_.push_back({0.5 * (p[0] + q[0]), 0.5 * (p[1] + q[1]), 0});
      }
    }
    cleave_body_spec spec;
    ok(cleave_body_spec_init(&spec));
    spec.formulation = CLEAVE_FORMULATION_fem;
    spec.kinematics = CLEAVE_PLANE_STRAIN;
    spec.material = CLEAVE_MATERIAL_svk;
    spec.particles = static_cast<std::int64_t>(x_.size());
    spec.X = x_.front().data();
    spec.simplex_nodes = 6;
    spec.simplex_count = static_cast<std::int64_t>(six_.size()) / 6;
    spec.simplices = six_.data();
    std::int64_t body = 0;
    ok(cleave_body_add(model_, &spec, &body));
    model_.set(0, {{"material", "rho", 1190}, {"material", "E", 3e9}, {"material", "nu", 0.3}});
    model_.setup();
  }
  const SimplexMesh mesh_ = patch(2, kCells, kSpacing, 0.2, 9);
  std::vector<Point> x_ = [this] {
    std::vector<Point> x;
    for (std::int64_t i = 0; i < mesh_.particles(); ++i) x.push_back(node(mesh_, i));
    return x;
  }();
  std::vector<std::int64_t> six_;
  Model model_;
};

TEST_F(QuadraticTriangles, QuadraticFieldsOfParticlesAreExact) {
  auto v = model_.real("velocity");
  for (std::size_t i = 0; i < x_.size(); ++i)
    for (std::size_t k = 0; k < 2; ++k) v[3 * i + k] = quadratic(x_[i], static_cast<int>(k));
  model_.put("velocity", v);
  const auto points = points_inside(2, 300);
  const auto values = interpolated(model_, "velocity", locate(model_, points));
  for (std::size_t p = 0; p < points.size(); ++p)
    for (std::size_t k = 0; k < 2; ++k)
      EXPECT_NEAR(values[3 * p + k], quadratic(points[p], static_cast<int>(k)), 1e-12);
}

TEST_F(QuadraticTriangles, LinearFieldsOfGaussPointsAreExact) {
  auto w = model_.real("strain_energy_density");
  ASSERT_EQ(w.size(), six_.size() / 2);
  for (std::size_t s = 0; s < six_.size() / 6; ++s)
    for (std::size_t q = 0; q < 3; ++q) {  // the point beside corner q: area coordinate 2/3 there
      Point x{};
      for (std::size_t a = 0; a < 3; ++a)
        for (std::size_t k = 0; k < 2; ++k)
          x[k] += (a == q ? 2.0 / 3 : 1.0 / 6) * x_[static_cast<std::size_t>(six_[6 * s + a])][k];
      w[3 * s + q] = linear(x, 1);
    }
  model_.put("strain_energy_density", w);
  const auto points = points_inside(2, 300);
  const auto values = interpolated(model_, "strain_energy_density", locate(model_, points));
  for (std::size_t p = 0; p < points.size(); ++p)
    EXPECT_NEAR(values[p], linear(points[p], 1), 1e-12);
}

TEST(QuadraticElsewhere, AreRefused) {
  const double X[18] = {0, 0, 0, 1, 0, 0, 0, 1, 0, 0.5, 0, 0, 0.5, 0.5, 0, 0, 0.5, 0};
  const std::int64_t nodes[6] = {0, 1, 2, 3, 4, 5};
  for (const std::int32_t f :
       {CLEAVE_FORMULATION_cbm, CLEAVE_FORMULATION_tlsph, CLEAVE_FORMULATION_nosb}) {
    Model model;
    cleave_body_spec spec;
    ok(cleave_body_spec_init(&spec));
    spec.formulation = f;
    spec.kinematics = CLEAVE_PLANE_STRAIN;
    spec.material = CLEAVE_MATERIAL_svk;
    spec.particles = 6;
    spec.X = X;
    spec.simplex_nodes = 6;
    spec.simplex_count = 1;
    spec.simplices = nodes;
    std::int64_t body = 0;
    ok(cleave_body_add(model, &spec, &body));
    model.set(0, {{"material", "rho", 1}, {"material", "E", 1}, {"material", "nu", 0.3}});
    if (f != CLEAVE_FORMULATION_cbm) model.set(0, {{"kernel", "radius", 1.0}});
    EXPECT_NE(cleave_model_setup(model), CLEAVE_OK);
    EXPECT_NE(last_message().find("first order"), std::string::npos) << last_message();
  }
}

}  // namespace
}  // namespace cleave::test
