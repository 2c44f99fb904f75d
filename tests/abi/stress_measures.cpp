// Stresses and tangents in the measures of host codes against their definitions: F = R U is built from a
// known rotation and stretch, tangents are compared with differences of the stress. Symmetric storage,
// absent components, plane kinematics, points without an answer.
#include <array>
#include <cmath>

#include "support/bonds.hpp"
#include "support/model.hpp"

namespace cleave::test {
namespace {

using Order = std::array<std::int64_t, 9>;
constexpr Order kNine = {0, 1, 2, 3, 4, 5, 6, 7, 8};
constexpr Order kSix = {0, 3, 5, 3, 1, 4, 5, 4, 2};       // 11 22 33 12 23 31
constexpr Order kStandard = {0, 3, 4, 3, 1, 5, 4, 5, 2};  // 11 22 33 12 13 23
constexpr Order kFour = {0, 3, -1, 3, 1, -1, -1, -1, 2};  // 11 22 33 12
const std::vector<double> kCopper = {8930, 117e9, 0.35, 400e6, 450e6, 100e6, 12};

Matrix3 product(const Matrix3& a, const Matrix3& b) {
  Matrix3 c{};
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j)
      for (std::size_t k = 0; k < 3; ++k) c[i][j] += a[i][k] * b[k][j];
  return c;
}
Matrix3 transposed(const Matrix3& a) {
  Matrix3 t{};
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j) t[i][j] = a[j][i];
  return t;
}
Matrix3 scaled(Matrix3 a, double s) {
  for (auto& row : a)
    for (double& x : row) x *= s;
  return a;
}

// Rotation by Rodrigues' formula about a random axis.
Matrix3 rotation(Random& random, double angle) {
  std::array<double, 3> n = {random(), random(), random()};
  const double length = std::sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
  for (double& x : n) x /= length;
  const Matrix3 w{{{0, -n[2], n[1]}, {n[2], 0, -n[0]}, {-n[1], n[0], 0}}}, ww = product(w, w);
  Matrix3 r{};
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j)
      r[i][j] = (i == j ? 1 : 0) + std::sin(angle) * w[i][j] + (1 - std::cos(angle)) * ww[i][j];
  return r;
}
Matrix3 stretch(Random& random, double size) {
  Matrix3 u{};
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j <= i; ++j) u[i][j] = u[j][i] = (i == j ? 1 : 0) + size * random();
  return u;
}

struct Answer {
  std::int32_t status, failed;
  std::array<double, 9> stress{};
  std::array<double, 81> tangent{};
};

// One point of J2 with some history, deformation F.
Answer ask(const Matrix3& f, std::int32_t measure, const Order& order,
           std::int32_t tangent = CLEAVE_TANGENT_FIRST_PIOLA,
           std::int32_t material = CLEAVE_MATERIAL_j2, std::int32_t kinematics = CLEAVE_3D) {
  std::array<double, 9> deformation{};
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j) deformation[i + 3 * j] = f[i][j];
  std::array<double, 8> history = {0.01, -0.02, 0.0101, 0.003, -0.004, 0.002, 0.02, 0};
  Answer answer;
  cleave_material_call call;
  ok(cleave_material_call_init(&call));
  call.material = material;
  call.kinematics = kinematics;
  call.property_count = material == CLEAVE_MATERIAL_j2 ? 7 : 3;
  call.properties = kCopper.data();
  call.last = 1;
  call.deformation = deformation.data();
  call.deformation_is_F = 1;
  call.history = history.data();
  call.stress = answer.stress.data();
  std::copy(order.begin(), order.end(), call.stress_order);
  call.stress_measure = measure;
  call.failed = &answer.failed;
  call.tangent = answer.tangent.data();
  call.tangent_measure = tangent;
  if (tangent != CLEAVE_TANGENT_FIRST_PIOLA) {
    EXPECT_EQ(cleave_material_tangent(&call), CLEAVE_OK) << last_message();
  }
  answer.status = cleave_material_update(&call);
  return answer;
}

Matrix3 full(const Answer& a, const Order& order) {
  Matrix3 s{};
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j)
      if (order[i + 3 * j] >= 0) s[i][j] = a.stress[static_cast<std::size_t>(order[i + 3 * j])];
  return s;
}

double distance(const Matrix3& a, const Matrix3& b) {
  double worst = 0;
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j) worst = std::fmax(worst, std::fabs(a[i][j] - b[i][j]));
  return worst;
}

// The rounding of F is a strain: stresses are good to that times the modulus.
const double kSize = kCopper[1];

class Measures : public testing::TestWithParam<double> {
 protected:
  void SetUp() override {
    for (int k = 0; k < 40; ++k) {
      const Matrix3 r = rotation(random, 3.0 * random()), u = stretch(random, GetParam());
      points.push_back({product(r, u), r});
    }
  }
  struct Point {
    Matrix3 f, r;
  };
  Random random{17};
  std::vector<Point> points;
};

TEST_P(Measures, FollowTheirDefinitions) {
  double worst = 0;
  for (const auto& [f, r] : points) {
    const Matrix3 p = full(ask(f, CLEAVE_STRESS_FIRST_PIOLA, kNine), kNine);
    const Matrix3 tau = product(p, transposed(f)), sigma = scaled(tau, 1 / determinant(f));
    const auto expect = [&](std::int32_t measure, const Order& order, const Matrix3& s) {
      worst = std::fmax(worst, distance(full(ask(f, measure, order), order), s));
    };
    expect(CLEAVE_STRESS_KIRCHHOFF, kNine, tau);
    expect(CLEAVE_STRESS_CAUCHY, kSix, sigma);
    expect(CLEAVE_STRESS_CAUCHY, kStandard, sigma);
    expect(CLEAVE_STRESS_COROTATED, kSix, product(transposed(r), product(sigma, r)));
    expect(CLEAVE_STRESS_SECOND_PIOLA, kStandard, product(inverse(f), p));
  }
  EXPECT_LT(worst, 3e-14 * kSize);  // measured 3e-15
  EXPECT_GT(worst, 0);
}

// The corotated stress does not see the rotation, and is that of the stretch alone.
TEST_P(Measures, CorotatedStressIsTheStressOfTheStretch) {
  double worst = 0;
  for (const auto& [f, r] : points) {
    const Matrix3 u = product(transposed(r), f);
    worst = std::fmax(worst, distance(full(ask(f, CLEAVE_STRESS_COROTATED, kSix), kSix),
                                      full(ask(u, CLEAVE_STRESS_CAUCHY, kSix), kSix)));
  }
  EXPECT_LT(worst, 1e-13 * kSize);  // measured 1e-14
}

double entry(const Answer& a, const Order& o, std::size_t i, std::size_t j, std::size_t k,
             std::size_t l) {
  return a.tangent[static_cast<std::size_t>(o[i + 3 * j] + 6 * o[k + 3 * l])];
}

// (s(+) - s(-)) / (2 step) of all nine components against sum_kl C_ijkl D_kl.
double against_difference(const Answer& a, const Order& o, const Matrix3& d, const Matrix3& above,
                          const Matrix3& below, double step) {
  double worst = 0;
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j) {
      double sum = 0;
      for (std::size_t k = 0; k < 3; ++k)
        for (std::size_t l = 0; l < 3; ++l) sum += entry(a, o, i, j, k, l) * d[k][l];
      worst = std::fmax(worst, std::fabs(sum - (above[i][j] - below[i][j]) / (2 * step)));
    }
  return worst / kCopper[1];
}

TEST_P(Measures, TangentsAreDerivatives) {
  const double step = 1e-6;
  double jaumann = 0, second = 0, turned = 0;
  for (const auto& [f, r] : points) {
    Matrix3 d = stretch(random, 1.0);
    // Stretching without spin: the Jaumann rate is the plain one.
    Matrix3 plus{}, minus{};
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t j = 0; j < 3; ++j) {
        plus[i][j] = (i == j ? 1 : 0) + step * d[i][j];
        minus[i][j] = (i == j ? 1 : 0) - step * d[i][j];
      }
    const auto tau = [&](const Matrix3& g) {
      return scaled(full(ask(product(g, f), CLEAVE_STRESS_KIRCHHOFF, kNine), kNine),
                    1 / determinant(f));
    };
    const Answer c = ask(f, CLEAVE_STRESS_CAUCHY, kSix, CLEAVE_TANGENT_JAUMANN);
    jaumann = std::fmax(jaumann, against_difference(c, kSix, d, tau(plus), tau(minus), step));

    // dF = F^-T dE changes the strain by dE.
    const Matrix3 df = product(transposed(inverse(f)), d);
    const auto s = [&](double e) {
      Matrix3 g = f;
      for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t j = 0; j < 3; ++j) g[i][j] += e * df[i][j];
      return full(ask(g, CLEAVE_STRESS_SECOND_PIOLA, kStandard), kStandard);
    };
    const Answer m = ask(f, CLEAVE_STRESS_SECOND_PIOLA, kStandard, CLEAVE_TANGENT_SECOND_PIOLA);
    second = std::fmax(second, against_difference(m, kStandard, d, s(step), s(-step), step));

    const Answer t = ask(f, CLEAVE_STRESS_COROTATED, kSix, CLEAVE_TANGENT_COROTATED);
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t k = 0; k < 3; ++k) {
        double sum = 0;
        for (std::size_t a = 0; a < 3; ++a)
          for (std::size_t b = 0; b < 3; ++b)
            for (std::size_t e = 0; e < 3; ++e)
              for (std::size_t g = 0; g < 3; ++g)
                sum += r[a][i] * r[b][k] * r[e][k] * r[g][1] * entry(c, kSix, a, b, e, g);
        turned = std::fmax(turned, std::fabs(sum - entry(t, kSix, i, k, k, 1)) / kCopper[1]);
      }
  }
  EXPECT_LT(jaumann, 1e-6);  // measured 2e-8, the truncation of the difference
  EXPECT_LT(second, 1e-6);   // measured 6e-8
  EXPECT_LT(turned, 1e-13);  // measured 3e-15
  EXPECT_GT(turned, 0);
}

// A symmetric tensor kept with nine places gets the same bits on both sides.
TEST_P(Measures, SymmetryIsExact) {
  for (const auto& [f, r] : points) {
    const Matrix3 s = full(ask(f, CLEAVE_STRESS_CAUCHY, kNine), kNine);
    const Answer c = ask(f, CLEAVE_STRESS_CAUCHY, kNine, CLEAVE_TANGENT_COROTATED);
    const auto at = [&](std::size_t i, std::size_t j, std::size_t k, std::size_t l) {
      return c.tangent[i + 3 * j + 9 * (k + 3 * l)];
    };
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t j = 0; j < i; ++j) {
        EXPECT_EQ(s[i][j], s[j][i]);
        for (std::size_t k = 0; k < 3; ++k)
          for (std::size_t l = 0; l <= k; ++l) {
            EXPECT_EQ(at(i, j, k, l), at(j, i, k, l));
            EXPECT_EQ(at(i, j, k, l), at(i, j, l, k));
          }
      }
  }
}

// Elastic, plastic, large.
INSTANTIATE_TEST_SUITE_P(Strains, Measures, testing::Values(1e-3, 0.03, 0.3));

// Elements of four stress components hand over F without its out-of-plane shear.
TEST(MeasuresOf, AbsentComponentsAreZero) {
  const Matrix3 f{{{1.02, 0.01, 0}, {-0.005, 0.99, 0}, {0, 0, 1.01}}};
  const Answer whole = ask(f, CLEAVE_STRESS_CAUCHY, kNine),
               four = ask(f, CLEAVE_STRESS_CAUCHY, kFour);
  EXPECT_EQ(whole.stress[0], four.stress[0]);
  EXPECT_EQ(whole.stress[4], four.stress[1]);
  EXPECT_EQ(whole.stress[8], four.stress[2]);
  EXPECT_EQ(whole.stress[1], four.stress[3]);
  EXPECT_EQ(four.stress[4], 0);  // untouched

  // Reading: 11 22 33 12 21 with the rest absent.
  std::array<double, 5> five = {1.02, 0.99, 1.01, 0.01, -0.005};
  std::array<double, 8> history = {0.01, -0.02, 0.0101, 0.003, -0.004, 0.002, 0.02, 0};
  std::array<double, 9> stress{};
  cleave_material_call call;
  ok(cleave_material_call_init(&call));
  call.material = CLEAVE_MATERIAL_j2;
  call.kinematics = CLEAVE_3D;
  call.property_count = 7;
  call.properties = kCopper.data();
  call.last = 1;
  call.deformation = five.data();
  call.deformation_is_F = 1;
  const Order order = {0, 4, -1, 3, 1, -1, -1, -1, 2};
  std::copy(order.begin(), order.end(), call.deformation_order);
  call.history = history.data();
  call.stress = stress.data();
  call.stress_measure = CLEAVE_STRESS_CAUCHY;
  ok(cleave_material_update(&call));
  for (std::size_t k = 0; k < 9; ++k) EXPECT_EQ(stress[k], whole.stress[k]);
}

TEST(MeasuresOf, PlaneStrainIsTheSolidWithoutThicknessStrain) {
  const Matrix3 f{{{1.02, 0.01, 0}, {-0.005, 0.99, 0}, {0, 0, 1}}};
  const auto solid = ask(f, CLEAVE_STRESS_CAUCHY, kSix),
             plane = ask(f, CLEAVE_STRESS_CAUCHY, kSix, CLEAVE_TANGENT_FIRST_PIOLA,
                         CLEAVE_MATERIAL_svk, CLEAVE_PLANE_STRAIN),
             svk = ask(f, CLEAVE_STRESS_CAUCHY, kSix, CLEAVE_TANGENT_FIRST_PIOLA,
                       CLEAVE_MATERIAL_svk);
  for (std::size_t k = 0; k < 6; ++k)
    EXPECT_NEAR(plane.stress[k], svk.stress[k], 1e-14 * kCopper[1]);  // measured 1e-17
  EXPECT_NE(solid.stress[0], svk.stress[0]);
  // Plane stress: with its thickness; uniaxial strain of svk by hand.
  const double e = 0.01 + 0.5 * 0.01 * 0.01, nu = kCopper[2];
  const Matrix3 pulled{{{1.01, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
  const auto sheet = ask(pulled, CLEAVE_STRESS_CAUCHY, kSix, CLEAVE_TANGENT_FIRST_PIOLA,
                         CLEAVE_MATERIAL_svk, CLEAVE_PLANE_STRESS);
  const double thickness = std::sqrt(1 - 2 * nu / (1 - nu) * e);
  const double expected = 1.01 * kCopper[1] / (1 - nu * nu) * e / thickness;
  EXPECT_NEAR(sheet.stress[0], expected, 1e-13 * expected);  // measured 2e-16
  EXPECT_EQ(sheet.stress[2], 0);
}

// An elastic law answers for a turned-over body; the Cauchy stress does not exist there.
TEST(MeasuresOf, TurnedOverPointsHaveNoCauchyStress) {
  const Matrix3 f{{{-1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
  const auto p =
      ask(f, CLEAVE_STRESS_FIRST_PIOLA, kNine, CLEAVE_TANGENT_FIRST_PIOLA, CLEAVE_MATERIAL_svk);
  EXPECT_EQ(p.status, CLEAVE_OK);
  const auto s =
      ask(f, CLEAVE_STRESS_CAUCHY, kSix, CLEAVE_TANGENT_FIRST_PIOLA, CLEAVE_MATERIAL_svk);
  EXPECT_EQ(s.status, CLEAVE_BAD_JACOBIAN);
  EXPECT_EQ(s.failed, 1);
  for (const double x : s.stress) EXPECT_EQ(x, 0);
}

TEST(MeasuresOf, ImpossibleOrdersAreRefused) {
  const Matrix3 one{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
  EXPECT_EQ(ask(one, CLEAVE_STRESS_FIRST_PIOLA, kSix).status, CLEAVE_BAD_ARGUMENT);
  EXPECT_NE(last_message().find("not symmetric"), std::string::npos) << last_message();
  Order shared = kNine;
  shared[1] = 2;  // 21 and 31
  EXPECT_EQ(ask(one, CLEAVE_STRESS_CAUCHY, shared).status, CLEAVE_BAD_ARGUMENT);
  EXPECT_NE(last_message().find("stress_order[1] and [2]"), std::string::npos) << last_message();
  EXPECT_EQ(ask(one, 7, kNine).status, CLEAVE_BAD_ARGUMENT);
  EXPECT_NE(last_message().find("stress_measure is 7"), std::string::npos) << last_message();
}

TEST(DamagePlace, IsThatOfTheFieldsTable) {
  std::int64_t laws = 0, with_damage = 0;
  ok(cleave_table_count(CLEAVE_TABLE_MATERIAL, &laws));
  for (std::int64_t m = 0; m < laws; ++m) {
    cleave_table_entry law{};
    law.size = sizeof law;
    ok(cleave_table_get(CLEAVE_TABLE_MATERIAL, m, &law));
    std::int64_t place = -7, fields = 0, components = 0, expected = -1;
    ok(cleave_material_damage_place(law.value, &place));
    ok(cleave_field_table_count(&fields));
    for (std::int64_t k = 0; k < fields; ++k) {
      cleave_field field{};
      field.size = sizeof field;
      ok(cleave_field_table_get(k, &field));
      if (std::string(field.owner) != law.name) continue;
      if (std::string(field.name).rfind("damage", 0) == 0) expected = components;
      components += field.components;
    }
    EXPECT_EQ(place, expected) << law.name;
    with_damage += place >= 0;
  }
  EXPECT_EQ(with_damage, 2);  // the two laws of Johnson and Cook
}

}  // namespace
}  // namespace cleave::test
