// Statics: forces of given deformations.
#include <cmath>

#include "support/model.hpp"

namespace cleave::test {
namespace {

class Deformation : public testing::TestWithParam<Case> {
 protected:
  static constexpr double kSpacing = 0.01;
  int dimension() const { return dimension_of(GetParam()); }
  SimplexMesh mesh(double jitter = 0.15) const {
    return solid(GetParam(), dimension() == 2 ? 6 : 3, kSpacing, jitter, 7);
  }

  // u = G X + b
  static std::vector<double> affine(const SimplexMesh& m, const double (&g)[3][3]) {
    std::vector<double> u(m.X.size(), 0.0);
    for (std::size_t i = 0; i < m.X.size() / 3; ++i)
      for (std::size_t r = 0; r < 3; ++r)
        for (std::size_t c = 0; c < 3; ++c) u[3 * i + r] += g[r][c] * m.X[3 * i + c];
    return u;
  }
  std::vector<double> random_displacement(const SimplexMesh& m, double size, unsigned seed) const {
    Random random(seed);
    std::vector<double> u(m.X.size(), 0.0);
    for (std::size_t i = 0; i < u.size() / 3; ++i)
      for (int k = 0; k < dimension(); ++k)
        u[3 * i + static_cast<std::size_t>(k)] = size * random();
    return u;
  }
  static double largest(const std::vector<double>& v) {
    double m = 0;
    for (const double x : v) m = std::fmax(m, std::fabs(x));
    return m;
  }
};

TEST_P(Deformation, ReferenceHasExactlyNoForce) {
  Model model;
  model.add(GetParam(), mesh());
  model.setup();
  model.initialise();
  EXPECT_EQ(largest(model.real("internal_force")), 0.0);
  EXPECT_EQ(model.energies().elastic, 0.0);
}

TEST_P(Deformation, AffinePatchIsExactOnAnyMesh) {
  const double g[3][3] = {{0.03, 0.02, dimension() == 3 ? 0.01 : 0.0},
                          {-0.01, 0.05, dimension() == 3 ? -0.02 : 0.0},
                          {dimension() == 3 ? 0.02 : 0.0, dimension() == 3 ? 0.01 : 0.0,
                           dimension() == 3 ? -0.04 : 0.0}};
  Model model;
  const SimplexMesh m = mesh();
  model.add(GetParam(), m);
  model.setup();
  model.put("displacement", affine(m, g));
  model.initialise();
  const auto h = model.real("displacement_gradient");
  for (std::size_t i = 0; i < h.size() / 9; ++i)
    for (std::size_t r = 0; r < static_cast<std::size_t>(dimension()); ++r)
      for (std::size_t c = 0; c < static_cast<std::size_t>(dimension()); ++c) {
        EXPECT_NEAR(h[9 * i + r + 3 * c], g[r][c], 1e-13);  // measured 1e-15
      }
}

TEST_P(Deformation, RigidMotionHasNoForce) {
  if (!objective(GetParam())) GTEST_SKIP() << "the law is not objective";
  const SimplexMesh m = mesh();
  const double c = std::cos(1.1), s = std::sin(1.1);
  const double g[3][3] = {{c - 1, -s, 0}, {s, c - 1, 0}, {0, 0, 0}};
  auto u = affine(m, g);
  for (std::size_t i = 0; i < u.size() / 3; ++i) {
    u[3 * i] += 0.3;
    u[3 * i + 1] -= 0.7;
  }
  Model model;
  model.add(GetParam(), m);
  model.setup();
  model.put("displacement", u);
  model.initialise();
  // Compared with E times the area of a cell face: measured 3e-14.
  const double scale = 3.24e9 * std::pow(kSpacing, dimension() - 1);
  EXPECT_LT(largest(model.real("internal_force")) / scale, 1e-12);
}

TEST_P(Deformation, ForceIsMinusTheEnergyGradient) {
  if (!has_potential(GetParam())) GTEST_SKIP() << "the law has no potential of a step";
  const SimplexMesh m = mesh();
  const auto energy_of = [&](const std::vector<double>& u) {
    Model model;
    model.add(GetParam(), m);
    model.setup();
    model.put("displacement", u);
    model.initialise();
    // A step of associated plasticity from the virgin state has a potential: stored energy and plastic
    // work together.
    return model.energies().elastic + model.energies().plastic;
  };
  const auto u = random_displacement(m, 0.05 * kSpacing, 3);
  Model model;
  model.add(GetParam(), m);
  model.setup();
  model.put("displacement", u);
  model.initialise();
  const auto f = model.real("internal_force");
  const double size = largest(f), step = 1e-6 * kSpacing;
  for (std::size_t k = 0; k < u.size(); k += 11) {
    if (dimension() == 2 && k % 3 == 2) continue;
    auto plus = u, minus = u;
    plus[k] += step;
    minus[k] -= step;
    EXPECT_NEAR(f[k], -(energy_of(plus) - energy_of(minus)) / (2 * step),
                1e-7 * size);  // measured 2e-9
  }
}

TEST_P(Deformation, ForcesBalanceAndHaveNoTorque) {
  const SimplexMesh m = mesh();
  const auto u = random_displacement(m, 0.08 * kSpacing, 4);
  Model model;
  model.add(GetParam(), m);
  model.setup();
  model.put("displacement", u);
  model.initialise();
  const auto f = model.real("internal_force"), x = model.real("position");
  double sum[3] = {}, torque[3] = {};
  for (std::size_t i = 0; i < f.size() / 3; ++i)
    for (std::size_t k = 0; k < 3; ++k) {
      const std::size_t a = (k + 1) % 3, b = (k + 2) % 3;
      sum[k] += f[3 * i + k];
      torque[k] += x[3 * i + a] * f[3 * i + b] - x[3 * i + b] * f[3 * i + a];
    }
  for (int k = 0; k < 3; ++k) {
    EXPECT_LT(std::fabs(sum[k]), 1e-12 * largest(f));  // measured 2e-14
    if (!objective(GetParam())) continue;
    EXPECT_LT(std::fabs(torque[k]), 1e-12 * largest(f) * 10 * kSpacing);  // measured 3e-14
  }
}

TEST_P(Deformation, RenumberingPermutesTheForces) {
  const SimplexMesh m = mesh();
  const auto u = random_displacement(m, 0.05 * kSpacing, 5);
  const std::int64_t n = m.particles();
  SimplexMesh other = m;
  std::vector<double> other_u(u.size());
  const auto to = [n](std::int64_t i) {
    return (i * 17 + 5) % n;
  };  // n and 17 have no common factor
  for (std::int64_t i = 0; i < n; ++i)
    for (int k = 0; k < 3; ++k) {
      other.X[static_cast<std::size_t>(3 * to(i) + k)] = m.X[static_cast<std::size_t>(3 * i + k)];
      other_u[static_cast<std::size_t>(3 * to(i) + k)] = u[static_cast<std::size_t>(3 * i + k)];
    }
  for (auto& c : other.simplices) c = to(c);
  const auto force = [&](const SimplexMesh& mm, const std::vector<double>& uu) {
    Model model;
    model.add(GetParam(), mm);
    model.setup();
    model.put("displacement", uu);
    model.initialise();
    return model.real("internal_force");
  };
  const auto f = force(m, u), g = force(other, other_u);
  for (std::int64_t i = 0; i < n; ++i)
    for (int k = 0; k < 3; ++k) {
      EXPECT_NEAR(f[static_cast<std::size_t>(3 * i + k)],
                  g[static_cast<std::size_t>(3 * to(i) + k)],
                  1e-12 * largest(f));  // measured 2e-15
    }
}

INSTANTIATE_TEST_SUITE_P(Tables, Deformation, testing::ValuesIn(all_cases()), case_name);

}  // namespace
}  // namespace cleave::test
