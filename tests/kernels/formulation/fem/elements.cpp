// Elements against closed forms: volumes, polynomial exactness, masses, patch tests of T6, the highest
// frequency against that of the whole body.
#include "formulation/fem/elements.hpp"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <cmath>

#include "support/model.hpp"

namespace cleave::test {
namespace {

// Corner coordinates of a triangle with the middles of its edges.
std::vector<double> triangle6(const double (&corner)[3][2]) {
  std::vector<double> X;
  for (const auto& c : corner) X.insert(X.end(), {c[0], c[1], 0.0});
  for (std::size_t a = 0; a < 3; ++a) {
    const auto& p = corner[a];
    const auto& q = corner[(a + 1) % 3];
    X.insert(X.end(), {0.5 * (p[0] + q[0]), 0.5 * (p[1] + q[1]), 0.0});
  }
  return X;
}

TEST(Elements, SixNodeTriangleDifferentiatesQuadraticsExactly) {
  const auto X = triangle6({{0.1, -0.2}, {1.3, 0.1}, {0.4, 0.9}});
  const int nodes[6] = {0, 1, 2, 3, 4, 5};
  const auto f = [](double x, double y) { return 2 * x * x - 3 * x * y + 0.5 * y * y + x - y; };
  constexpr double place[3][2] = {{1.0 / 6, 1.0 / 6}, {2.0 / 3, 1.0 / 6}, {1.0 / 6, 2.0 / 3}};
  double area = 0;
  const auto quadrature = fem::Triangle6::quadrature();
  for (std::size_t q = 0; q < 3; ++q) {
    const auto g = fem::point_geometry(quadrature[q], X.data(), nodes);
    area += g.volume;
    double x[2] = {}, slope[2] = {};
    const double l[3] = {1 - place[q][0] - place[q][1], place[q][0], place[q][1]};
    for (std::size_t a = 0; a < 3; ++a)
      for (std::size_t k = 0; k < 2; ++k) x[k] += l[a] * X[3 * a + k];
    for (std::size_t a = 0; a < 6; ++a)
      for (int k = 0; k < 2; ++k) slope[k] += f(X[3 * a], X[3 * a + 1]) * g.gradient[a][k];
    EXPECT_NEAR(slope[0], 4 * x[0] - 3 * x[1] + 1, 1e-13);  // measured 2e-15
    EXPECT_NEAR(slope[1], -3 * x[0] + x[1] - 1, 1e-13);
  }
  EXPECT_NEAR(area, 0.5 * (1.2 * 1.1 - 0.3 * 0.3), 1e-14);
}

TEST(Elements, LumpedSharesAreThoseOfTheDiagonalOfTheMassMatrix) {
  // Integral of L^2 (2L-1)^2 and 16 La^2 Lb^2 over a triangle of area A: A/30, 8A/45.
  const double corner = 1.0 / 30, middle = 8.0 / 45;
  for (int a = 0; a < 6; ++a) {
    EXPECT_NEAR(fem::Triangle6::mass_share(a),
                (a < 3 ? corner : middle) / (3 * corner + 3 * middle), 1e-15);
  }
}

// A strip of T6 with random orientation; middles of edges straight.
struct QuadraticMesh {
  std::vector<double> X;
  std::vector<std::int64_t> simplices;
};
QuadraticMesh quadratic(const SimplexMesh& linear) {
  QuadraticMesh out{linear.X, {}};
  std::vector<std::array<std::int64_t, 3>> middles;
  for (std::size_t s = 0; s < linear.simplices.size(); s += 3) {
    const std::int64_t* c = &linear.simplices[s];
    std::int64_t nodes[6] = {c[0], c[1], c[2], -1, -1, -1};
    for (int a = 0; a < 3; ++a) {
      const auto low = std::min(c[a], c[(a + 1) % 3]), high = std::max(c[a], c[(a + 1) % 3]);
      for (const auto& m : middles)
        if (m[0] == low && m[1] == high) nodes[3 + a] = m[2];
      if (nodes[3 + a] >= 0) continue;
      nodes[3 + a] = static_cast<std::int64_t>(out.X.size()) / 3;
      middles.push_back({low, high, nodes[3 + a]});
      for (int k = 0; k < 3; ++k)
        out.X.push_back(0.5 * (linear.X[static_cast<std::size_t>(3 * low + k)] +
                               linear.X[static_cast<std::size_t>(3 * high + k)]));
    }
    out.simplices.insert(out.simplices.end(), nodes, nodes + 6);
  }
  return out;
}

class SixNodes : public testing::Test {
 protected:
  SixNodes() {
    mesh_ = quadratic(patch(2, 4, 0.01, 0.15, 5));
    make();
  }
  void make() {
    cleave_model* handle = nullptr;
    ok(cleave_model_create(CLEAVE_ABI_VERSION, &handle));
    model_.reset(handle);
    cleave_body_spec spec{};
    ok(cleave_body_spec_init(&spec));
    spec.formulation = CLEAVE_FORMULATION_fem;
    spec.kinematics = CLEAVE_PLANE_STRAIN;
    spec.material = CLEAVE_MATERIAL_svk;
    spec.simplex_nodes = 6;
    spec.particles = static_cast<std::int64_t>(mesh_.X.size()) / 3;
    spec.X = mesh_.X.data();
    spec.simplex_count = static_cast<std::int64_t>(mesh_.simplices.size()) / 6;
    spec.simplices = mesh_.simplices.data();
    spec.name = "strip";
    std::int64_t body = 0;
    ok(cleave_body_add(handle, &spec, &body));
    for (const char* name : {"rho", "E", "nu"})
      ok(cleave_body_set_real(handle, 0, "material", name, test_property(name, 0)));
    ok(cleave_model_setup(handle));
  }
  std::vector<double> get(const char* name) {
    cleave_field f{};
    f.size = sizeof f;
    ok(cleave_field_find(model_.get(), 0, name, &f));
    std::vector<double> v(static_cast<std::size_t>(f.count * f.components));
    ok(cleave_field_get_real(model_.get(), 0, name, 0, f.count, v.data()));
    return v;
  }
  std::vector<double> force_at(const std::vector<double>& u) {
    make();
    ok(cleave_field_put_real(model_.get(), 0, "displacement", 0,
                             static_cast<std::int64_t>(u.size() / 3), u.data()));
    ok(cleave_model_initialise(model_.get(), 0));
    return get("internal_force");
  }
  struct Destroy {
    void operator()(cleave_model* m) const { cleave_model_destroy(m); }
  };
  std::unique_ptr<cleave_model, Destroy> model_;
  QuadraticMesh mesh_;
};

TEST_F(SixNodes, FieldsOfPointsBelongToIntegrationPoints) {
  cleave_field f{};
  f.size = sizeof f;
  ok(cleave_field_find(model_.get(), 0, "displacement_gradient", &f));
  EXPECT_EQ(f.relation, CLEAVE_RELATION_INTEGRATION_POINT);
  EXPECT_EQ(f.count, 3 * static_cast<std::int64_t>(mesh_.simplices.size()) / 6);
  ok(cleave_field_find(model_.get(), 0, "displacement", &f));
  EXPECT_EQ(f.relation, CLEAVE_RELATION_POINT);
}

TEST_F(SixNodes, QuadraticDisplacementHasItsGradientAtEveryPoint) {
  std::vector<double> u(mesh_.X.size(), 0.0);
  for (std::size_t i = 0; i < u.size(); i += 3) {
    const double x = mesh_.X[i], y = mesh_.X[i + 1];
    u[i] = 0.4 * x * x - 0.2 * x * y;
    u[i + 1] = 0.1 * y * y + 0.05 * x;
  }
  const auto f = force_at(u);
  const auto h = get("displacement_gradient"), volume = get("volume");
  double mean = 0, area = 0;
  for (std::size_t q = 0; q < volume.size(); ++q) {
    mean += volume[q] * h[9 * q + 4];
    area += volume[q];
    EXPECT_NEAR(h[9 * q + 1], 0.05, 1e-14);  // du_y/dx; measured 2e-16
  }
  EXPECT_NEAR(area, 0.04 * 0.04, 0.1 * 0.04 * 0.04);
  EXPECT_GT(mean, 0.0);
  double sum = 0, largest = 0;
  for (const double c : f) {
    sum += c;
    largest = std::fmax(largest, std::fabs(c));
  }
  EXPECT_LT(std::fabs(sum), 1e-12 * largest);
}

TEST_F(SixNodes, StableStepIsBelowTheLimitOfTheWholeBody) {
  // Columns of the stiffness by differences of the force; omega_max of M^-1 K.
  const auto mass = get("mass");
  std::vector<double> zero(mesh_.X.size(), 0.0);
  const std::size_t n = zero.size() / 3;
  Eigen::MatrixXd k(2 * n, 2 * n);
  const double step = 1e-9;
  for (std::size_t c = 0; c < 2 * n; ++c) {
    auto u = zero;
    u[3 * (c / 2) + c % 2] = step;
    const auto up = force_at(u);
    u[3 * (c / 2) + c % 2] = -step;
    const auto down = force_at(u);
    for (std::size_t r = 0; r < 2 * n; ++r) {
      const std::size_t entry = 3 * (r / 2) + r % 2;
      k(static_cast<Eigen::Index>(r), static_cast<Eigen::Index>(c)) =
          -(up[entry] - down[entry]) / (2 * step) / std::sqrt(mass[r / 2] * mass[c / 2]);
    }
  }
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(0.5 * (k + k.transpose()),
                                                              Eigen::EigenvaluesOnly);
  const double limit = 2 / std::sqrt(solver.eigenvalues().maxCoeff());
  double stable = 0;
  ok(cleave_model_stable_step(model_.get(), &stable));
  EXPECT_LT(stable, limit);
  EXPECT_GT(stable, 0.6 * limit);  // measured below
}

}  // namespace
}  // namespace cleave::test
