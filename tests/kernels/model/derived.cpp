// Measures of stress and strain by name, against their definitions evaluated here, and where digits
// are at stake.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "support/model.hpp"

namespace cleave::test {
namespace {

using Matrix = std::array<std::array<double, 3>, 3>;

Matrix tensor(const std::vector<double>& field) {  // of the first point
  Matrix m{};
  for (std::size_t r = 0; r < 3; ++r)
    for (std::size_t c = 0; c < 3; ++c) m[r][c] = field[r + 3 * c];
  return m;
}
Matrix product_transposed(const Matrix& a, const Matrix& b) {  // a b^T
  Matrix m{};
  for (std::size_t r = 0; r < 3; ++r)
    for (std::size_t c = 0; c < 3; ++c)
      for (std::size_t k = 0; k < 3; ++k) m[r][c] += a[r][k] * b[c][k];
  return m;
}
double determinant(const Matrix& m) {
  return m[0][0] * (m[1][1] * m[2][2] - m[1][2] * m[2][1]) -
         m[0][1] * (m[1][0] * m[2][2] - m[1][2] * m[2][0]) +
         m[0][2] * (m[1][0] * m[2][1] - m[1][1] * m[2][0]);
}
double size(const Matrix& m) {
  double sum = 0;
  for (const auto& row : m)
    for (const double x : row) sum += x * x;
  return std::sqrt(sum);
}
double equivalent(const Matrix& s) {
  const double x = s[0][0] - s[1][1], y = s[1][1] - s[2][2], z = s[2][2] - s[0][0];
  const double xy = 0.5 * (s[0][1] + s[1][0]), yz = 0.5 * (s[1][2] + s[2][1]),
               zx = 0.5 * (s[2][0] + s[0][2]);
  return std::sqrt(0.5 * (x * x + y * y + z * z) + 3 * (xy * xy + yz * yz + zx * zx));
}

// A patch moved by u = H X.
class Measures : public testing::TestWithParam<Case> {
 protected:
  void move(const Matrix& h) {
    const int d = dimension_of(GetParam());
    const SimplexMesh mesh = patch(d, 2, 1.0, 0.1, 4);
    model_.add(GetParam(), mesh);
    model_.setup();
    auto u = model_.real("displacement");
    for (std::size_t i = 0; i < u.size() / 3; ++i)
      for (int r = 0; r < d; ++r)
        for (int c = 0; c < d; ++c)
          u[3 * i + static_cast<std::size_t>(r)] +=
              h[static_cast<std::size_t>(r)][static_cast<std::size_t>(c)] *
              mesh.X[3 * i + static_cast<std::size_t>(c)];
    model_.put("displacement", u);
    model_.initialise();
  }
  Matrix get(const char* field) const { return tensor(model_.real(field)); }
  double scalar(const char* field) const { return model_.real(field).front(); }
  std::array<double, 3> principal(const std::string& name) const {
    return {scalar((name + "_1").c_str()), scalar((name + "_2").c_str()),
            scalar((name + "_3").c_str())};
  }
  Model model_;
};

constexpr Matrix kSome{{{0.11, 0.04, -0.02}, {-0.03, -0.06, 0.05}, {0.02, -0.01, 0.08}}};

TEST_P(Measures, AreTheirDefinitions) {
  move(kSome);
  const int d = dimension_of(GetParam());
  const Matrix f = get("deformation_gradient"), p = get("first_piola_kirchhoff_stress");
  for (int r = 0; r < d; ++r)
    for (int c = 0; c < d; ++c) {
      const auto i = static_cast<std::size_t>(r), j = static_cast<std::size_t>(c);
      EXPECT_NEAR(f[i][j], kSome[i][j] + (r == c ? 1 : 0), 1e-13);
    }
  if (GetParam().kinematics == CLEAVE_PLANE_STRAIN) {
    EXPECT_EQ(f[2][2], 1.0);
  }
  if (GetParam().kinematics == CLEAVE_PLANE_STRESS) {
    EXPECT_NE(f[2][2], 1.0);
  }
  const Matrix tau = product_transposed(p, f);
  const double j = determinant(f), scale = size(tau);
  const Matrix tau_field = get("kirchhoff_stress"), sigma = get("cauchy_stress"),
               e = get("green_lagrange_strain");
  for (std::size_t r = 0; r < 3; ++r)
    for (std::size_t c = 0; c < 3; ++c) {
      EXPECT_NEAR(tau_field[r][c], tau[r][c], 1e-14 * scale);
      EXPECT_NEAR(sigma[r][c], tau[r][c] / j, 1e-14 * scale);
      double ftf = 0;
      for (std::size_t k = 0; k < 3; ++k) ftf += f[k][r] * f[k][c];
      EXPECT_NEAR(e[r][c], 0.5 * (ftf - (r == c ? 1 : 0)), 1e-14);
    }
  EXPECT_NEAR(scalar("kirchhoff_equivalent_stress"), equivalent(tau), 1e-13 * scale);
  EXPECT_NEAR(scalar("equivalent_stress"), equivalent(tau) / j, 1e-13 * scale);
  EXPECT_NEAR(scalar("pressure"), -(sigma[0][0] + sigma[1][1] + sigma[2][2]) / 3, 1e-14 * scale);
  if (GetParam().kinematics == CLEAVE_PLANE_STRESS) {
    EXPECT_NEAR(sigma[2][2], 0.0, 1e-8 * scale);  // as good as the law's plane condition
  }
}

// Principal values are the roots of the characteristic polynomial, in descending order.
TEST_P(Measures, PrincipalValuesAreTheEigenvalues) {
  move(kSome);
  const Matrix sigma = get("cauchy_stress"), e = get("green_lagrange_strain");
  const auto s = principal("principal_stress");
  auto strain = principal("principal_logarithmic_strain");
  EXPECT_GE(s[0], s[1]);
  EXPECT_GE(s[1], s[2]);
  EXPECT_GE(strain[0], strain[1]);
  EXPECT_GE(strain[1], strain[2]);
  const auto invariants = [](const Matrix& m, const std::array<double, 3>& values, double scale) {
    Matrix sym = m;
    for (std::size_t r = 0; r < 3; ++r)
      for (std::size_t c = 0; c < 3; ++c) sym[r][c] = 0.5 * (m[r][c] + m[c][r]);
    double trace = 0, square = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      trace += values[k];
      square += values[k] * values[k];
    }
    EXPECT_NEAR(trace, sym[0][0] + sym[1][1] + sym[2][2], 1e-13 * scale);
    EXPECT_NEAR(std::sqrt(square), size(sym), 1e-13 * scale);
    EXPECT_NEAR(values[0] * values[1] * values[2] / (scale * scale * scale),
                determinant(sym) / (scale * scale * scale), 1e-13);
  };
  invariants(sigma, s, size(sigma));
  for (double& value : strain) value = 0.5 * std::expm1(2 * value);  // of E again
  invariants(e, strain, size(e));
}

// A rotation is no strain: what is left is rounding of H, not of F.
TEST_P(Measures, RotationIsNoStrain) {
  const double angle = 0.7;
  Matrix h{};
  h[0] = {-2 * std::sin(angle / 2) * std::sin(angle / 2), -std::sin(angle), 0};
  h[1] = {std::sin(angle), -2 * std::sin(angle / 2) * std::sin(angle / 2), 0};
  move(h);
  EXPECT_LT(size(get("green_lagrange_strain")), 1e-14);
  EXPECT_NEAR(scalar("principal_logarithmic_strain_1"), 0.0, 1e-14);
}

TEST_P(Measures, SmallStrainsKeepTheirDigits) {
  const double small = 1e-11;
  Matrix h{};
  h[0][0] = small;
  h[1][1] = -0.25 * small;
  move(h);
  EXPECT_NEAR(scalar("principal_logarithmic_strain_1") / small, 1.0, 1e-10);  // measured 5e-12
  EXPECT_NEAR(get("green_lagrange_strain")[1][1] / small, -0.25, 1e-10);
}

std::vector<Case> some_cases() {
  std::vector<Case> cases;
  for (const std::int32_t f : {CLEAVE_FORMULATION_cbm, CLEAVE_FORMULATION_fem})
    for (const std::int32_t m : {CLEAVE_MATERIAL_svk, CLEAVE_MATERIAL_j2})
      for (const std::int32_t k : {CLEAVE_3D, CLEAVE_PLANE_STRAIN, CLEAVE_PLANE_STRESS})
        cases.push_back({f, m, k});
  return cases;
}
INSTANTIATE_TEST_SUITE_P(Cases, Measures, testing::ValuesIn(some_cases()), case_name);

}  // namespace
}  // namespace cleave::test
