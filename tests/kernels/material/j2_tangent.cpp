// The consistent tangents against central differences of the stress, in the cases where a formula in
// eigenvectors goes wrong first.
#include "core/tangent.hpp"
#include "j2_support.hpp"
#include "material/consistent_tangent.hpp"
#include "material/material.hpp"

namespace cleave::test {
namespace {

struct Errors {
  double difference = 0, symmetry = 0;
};

// A_ijkl by differences of the update from the same history, D directions.
template <int D, class Law>
Errors errors_of(const Law& law, const Mat<D>& h, const std::array<double, 8>& committed,
                 double step) {
  const auto respond = [&](const Mat<D>& at) {
    auto copy = committed;
    History history;
    history.variable = {copy.data(), copy.data() + 6, copy.data() + 7};
    const auto r = law.respond(at, history, Increment{});
    EXPECT_TRUE(r.valid);
    return r.stress;
  };
  auto copy = committed;
  History history;
  history.variable = {copy.data(), copy.data() + 6, copy.data() + 7};
  Tangent<D> a;
  EXPECT_TRUE((law.template tangent<D>(h, history, Increment{}, a)));
  EXPECT_EQ(copy, committed);
  double size = 0;
  for (int i = 0; i < D; ++i)
    for (int j = 0; j < D; ++j)
      for (int k = 0; k < D; ++k)
        for (int l = 0; l < D; ++l) size = std::fmax(size, std::fabs(a(i, j, k, l)));
  Errors e;
  for (int k = 0; k < D; ++k)
    for (int l = 0; l < D; ++l) {
      Mat<D> more = h, less = h;
      more(k, l) += step;
      less(k, l) -= step;
      const Mat<D> above = respond(more), below = respond(less);
      for (int i = 0; i < D; ++i)
        for (int j = 0; j < D; ++j) {
          const double slope = (above(i, j) - below(i, j)) / (more(k, l) - less(k, l));
          e.difference = std::fmax(e.difference, std::fabs(a(i, j, k, l) - slope) / size);
          e.symmetry = std::fmax(e.symmetry, std::fabs(a(i, j, k, l) - a(k, l, i, j)) / size);
        }
    }
  return e;
}

template <int D>
Mat<D> gradient(const Matrix3& m) {
  Mat<D> h;
  for (int i = 0; i < D; ++i)
    for (int j = 0; j < D; ++j)
      h(i, j) = m[static_cast<std::size_t>(i)][static_cast<std::size_t>(j)];
  return h;
}

// R U - I with the given stretches about random axes.
Matrix3 stretched(Random& random, double a, double b, double c) {
  const Matrix3 q = random_rotation(random), r = random_rotation(random);
  const double s[3] = {a, b, c};
  Matrix3 u{};
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j)
      for (std::size_t k = 0; k < 3; ++k) u[i][j] += q[i][k] * s[k] * q[j][k];
  Matrix3 h = product(r, u);
  for (std::size_t k = 0; k < 3; ++k) h[k][k] -= 1;
  return h;
}

TEST(J2Tangent, IsTheDerivativeOfTheStress) {
  Random random(41);
  const J2Voce law(kSteel, CLEAVE_3D);
  const double stretches[][3] = {{1.0005, 0.9998, 1.0001},  // elastic
                                 {1.05, 0.97, 1.01},        // plastic
                                 {2.2, 0.6, 0.8},           // far
                                 {1, 1, 1},                 // at rest
                                 {1.1, 1.1, 0.9},           // two equal
                                 {1.1, 1.1 + 1e-9, 0.9},    // nearly
                                 {1.1, 1.1 + 1e-5, 0.9},
                                 {1.2, 1.2, 1.2},  // three equal
                                 {1.0003, 1.0003, 0.9999}};
  double worst = 0, asymmetry = 0;
  for (const auto& s : stretches) {
    const Matrix3 h = stretched(random, s[0], s[1], s[2]);
    const Errors e = errors_of<3>(law, gradient<3>(h), {}, 1e-6);
    worst = std::fmax(worst, e.difference);
    asymmetry = std::fmax(asymmetry, e.symmetry);
    EXPECT_LT(e.difference, 4e-9) << s[0] << ' ' << s[1] << ' ' << s[2];
  }
  EXPECT_LT(asymmetry, 4e-15);
  EXPECT_GT(worst, 0);
}

TEST(J2Tangent, IsTheDerivativeFromAFlowedStateWithEveryHardening) {
  Random random(42);
  std::vector<double> curve = {7.8e-9, kE, kNu, 450, 0.02, 520, 0.06, 500, 0.2, 680};
  curve.resize(4 + 24, 0.0);
  const auto check = [&](const auto& law, std::int32_t material, const auto& properties) {
    for (int trial = 0; trial < 10; ++trial) {
      const Point p = ask(material, CLEAVE_3D, properties, random_matrix(random, 0.1));
      ASSERT_EQ(p.status, CLEAVE_OK);
      const Errors e = errors_of<3>(law, gradient<3>(random_matrix(random, 0.1)), p.history, 1e-6);
      EXPECT_LT(e.difference, 4e-9);
      EXPECT_LT(e.symmetry, 4e-15);
    }
  };
  check(J2Voce(kSteel, CLEAVE_3D), CLEAVE_MATERIAL_j2, kSteel);
  const std::vector<double> power = {7.8e-9, kE, kNu, 450, 0.01, 0.2};
  check(J2Power(power, CLEAVE_3D), CLEAVE_MATERIAL_j2_power, power);
  check(J2Table(curve, CLEAVE_3D), CLEAVE_MATERIAL_j2_table, curve);
}

TEST(J2Tangent, HoldsInThePlane) {
  Random random(43);
  for (const Kinematics kinematics : {CLEAVE_PLANE_STRAIN, CLEAVE_PLANE_STRESS}) {
    const J2Voce law(kSteel, kinematics);
    for (int trial = 0; trial < 20; ++trial) {
      Matrix3 first = random_matrix(random, 0.05), second = random_matrix(random, 0.05);
      if (trial < 3) second = {};
      for (std::size_t k = 0; k < 3; ++k)
        first[2][k] = first[k][2] = second[2][k] = second[k][2] = 0;
      const Point p = ask(CLEAVE_MATERIAL_j2, kinematics, kSteel, first);
      ASSERT_EQ(p.status, CLEAVE_OK);
      const Errors e = errors_of<2>(law, gradient<2>(second), p.history, 1e-6);
      EXPECT_LT(e.difference, 1e-8) << kinematics;
      EXPECT_LT(e.symmetry, 1e-14);
    }
  }
}

TEST(SvkTangent, IsTheDerivativeOfTheStress) {
  Random random(44);
  const std::vector<double> pmma = {1190, 3.24e9, 0.35};
  for (int trial = 0; trial < 10; ++trial) {
    const Matrix3 m = random_matrix(random, 0.3);
    EXPECT_LT(errors_of<3>(StVenantKirchhoff(pmma, CLEAVE_3D), gradient<3>(m), {}, 1e-5).difference,
              1e-9);
    for (const Kinematics k : {CLEAVE_PLANE_STRAIN, CLEAVE_PLANE_STRESS}) {
      const Errors e = errors_of<2>(StVenantKirchhoff(pmma, k), gradient<2>(m), {}, 1e-5);
      EXPECT_LT(e.difference, 1e-9);
      EXPECT_LT(e.symmetry, 1e-15);
    }
  }
}

// (ln b_a - ln b_b)/(b_a - b_b) at every gap.
TEST(J2Tangent, KeepsTheShearModulusWhereEigenvaluesMeet) {
  EXPECT_EQ(log_quotient(0), 1);
  for (double x = 1e-18; x < 3; x *= 1.7)
    for (const double y : {x, -x / 4}) {
      const double exact = static_cast<double>(std::log1p(static_cast<Real>(y)) / y);
      EXPECT_NEAR(log_quotient(y), exact, 4e-16 * exact);  // measured 2.3e-16
    }
}

}  // namespace
}  // namespace cleave::test
