// Neo-Hookean and linear elasticity against closed forms and differences.
#include <limits>

#include "impact_support.hpp"
#include "material/tangent.hpp"

namespace cleave::test {
namespace {

constexpr double kE = 5e6, kNu = 0.4;
constexpr double kMu = kE / (2 * (1 + kNu)), kLambda = kE * kNu / ((1 + kNu) * (1 - 2 * kNu));
const std::vector<double> kRubber = {1000, kE, kNu};
constexpr Kinematics kAll[] = {CLEAVE_3D, CLEAVE_PLANE_STRAIN, CLEAVE_PLANE_STRESS};

Matrix3 plane(Matrix3 h, Kinematics kinematics) {
  if (kinematics != CLEAVE_3D)
    for (std::size_t k = 0; k < 3; ++k) h[2][k] = h[k][2] = 0;
  return h;
}

TEST(NeoHooke, FollowsTheDefinition) {
  Random random(31);
  for (int trial = 0; trial < 100; ++trial) {
    const Matrix3 h = random_matrix(random, 0.4);
    Matrix3 f = h;
    for (std::size_t k = 0; k < 3; ++k) f[k][k] += 1;
    const double j = determinant(f);
    Sample s = Sample::of<NeoHooke>(kRubber);
    if (!(j > 0)) {
      EXPECT_FALSE(s.step(h));
      continue;
    }
    ASSERT_TRUE(s.step(h));
    const Matrix3 inv = inverse(f);
    Matrix3 p{};
    double square = 0;
    for (std::size_t r = 0; r < 3; ++r)
      for (std::size_t c = 0; c < 3; ++c) {
        p[r][c] = kMu * (f[r][c] - inv[c][r]) + kLambda * std::log(j) * inv[c][r];
        square += f[r][c] * f[r][c];
      }
    EXPECT_LT(distance(p, s.P), 3e-14 * kE * largest(inv));
    const double w =
        0.5 * kMu * (square - 3 - 2 * std::log(j)) + 0.5 * kLambda * std::log(j) * std::log(j);
    EXPECT_NEAR(s.energy, w, 1e-14 * kE + 1e-13 * w);
  }
}

TEST(NeoHooke, KeepsItsDigitsAtStrain1e12) {
  Random random(32);
  for (const auto kinematics : kAll) {
    const double lambda = kinematics == CLEAVE_PLANE_STRESS ? kE * kNu / (1 - kNu * kNu) : kLambda;
    const std::size_t d = kinematics == CLEAVE_3D ? 3 : 2;
    for (const double size : {1e-12, 1e-7}) {
      const Matrix3 h = plane(random_matrix(random, size), kinematics);
      Sample s = Sample::of<NeoHooke>(kRubber, kinematics);
      ASSERT_TRUE(s.step(h));
      double trace = 0, energy = 0;
      for (std::size_t k = 0; k < d; ++k) trace += h[k][k];
      for (std::size_t r = 0; r < d; ++r)
        for (std::size_t c = 0; c < d; ++c) {
          const double linear = kMu * (h[r][c] + h[c][r]) + (r == c ? lambda * trace : 0);
          EXPECT_NEAR(s.P[r][c], linear, (20 * size + 1e-14) * kE * size);
          energy += 0.5 * linear * h[r][c];
        }
      EXPECT_NEAR(s.energy, energy, (20 * size + 1e-13) * energy);
    }
    Sample rest = Sample::of<NeoHooke>(kRubber, kinematics);
    ASSERT_TRUE(rest.step(Matrix3{}));
    EXPECT_EQ(largest(rest.P), 0);
    EXPECT_EQ(rest.energy, 0);
  }
}

TEST(NeoHooke, StressIsTheGradientOfTheEnergyAndTheTangentThatOfTheStress) {
  Random random(33);
  double worst_stress = 0, worst_tangent = 0;
  for (const auto kinematics : kAll) {
    for (int trial = 0; trial < 20; ++trial) {
      const Matrix3 h = plane(random_matrix(random, 0.25), kinematics);
      Sample s = Sample::of<NeoHooke>(kRubber, kinematics);
      ASSERT_TRUE(s.step(h));
      const auto compare = [&](auto dimension) {
        constexpr int D = dimension;
        Mat<D> at;
        for (int i = 0; i < D; ++i)
          for (int j = 0; j < D; ++j)
            at(i, j) = h[static_cast<std::size_t>(i)][static_cast<std::size_t>(j)];
        Tangent<D> own, difference;
        ASSERT_TRUE(tangent_at<D>(s.material(), {}, at, {}, 0, own));
        ASSERT_TRUE(difference_tangent<D>(s.material(), {}, at, {}, 0, difference));
        for (int k = 0; k < D * D * D * D; ++k)
          worst_tangent = std::fmax(
              worst_tangent, std::fabs((&own.c[0][0][0][0])[k] - (&difference.c[0][0][0][0])[k]));
        for (int i = 0; i < D; ++i)
          for (int j = 0; j < D; ++j) {
            Mat<D> above = at, below = at;
            above(i, j) += 1e-6;
            below(i, j) -= 1e-6;
            const double slope = (trial_response<D>(s.material(), {}, above, {}, 0).energy -
                                  trial_response<D>(s.material(), {}, below, {}, 0).energy) /
                                 2e-6;
            worst_stress = std::fmax(
                worst_stress,
                std::fabs(slope - s.P[static_cast<std::size_t>(i)][static_cast<std::size_t>(j)]));
          }
      };
      if (kinematics == CLEAVE_3D) {
        compare(std::integral_constant<int, 3>{});
      } else {
        compare(std::integral_constant<int, 2>{});
      }
    }
  }
  EXPECT_LT(worst_stress, 1e-8 * kE);
  EXPECT_LT(worst_tangent, 1e-7 * kE);
}

TEST(NeoHooke, PlaneStressHasNoP33) {
  Random random(34);
  for (int trial = 0; trial < 60; ++trial) {
    Matrix3 h = plane(random_matrix(random, trial % 2 == 0 ? 0.5 : 3.0), CLEAVE_PLANE_STRESS);
    Sample sheet = Sample::of<NeoHooke>(kRubber, CLEAVE_PLANE_STRESS);
    if (!((1 + h[0][0]) * (1 + h[1][1]) - h[0][1] * h[1][0] > 0)) {
      EXPECT_FALSE(sheet.step(h));
      continue;
    }
    ASSERT_TRUE(sheet.step(h));
    Mat<2> in_plane;
    for (int i = 0; i < 2; ++i)
      for (int j = 0; j < 2; ++j)
        in_plane(i, j) = h[static_cast<std::size_t>(i)][static_cast<std::size_t>(j)];
    h[2][2] = NeoHooke(kRubber, CLEAVE_PLANE_STRESS).thickness_stretch(in_plane, History{}) - 1;
    Sample solid = Sample::of<NeoHooke>(kRubber);
    ASSERT_TRUE(solid.step(h));
    EXPECT_LT(std::fabs(solid.P[2][2]), 1e-12 * (kE + largest(solid.P)));
    EXPECT_NEAR(solid.energy, sheet.energy, 1e-12 * solid.energy);
    for (std::size_t r = 0; r < 2; ++r)
      for (std::size_t c = 0; c < 2; ++c)
        EXPECT_NEAR(solid.P[r][c], sheet.P[r][c], 1e-12 * (kE + largest(solid.P)));
  }
}

TEST(NeoHooke, HasNoAnswerForNonsense) {
  for (const double bad : {-1.0, -2.0, std::numeric_limits<double>::quiet_NaN(),
                           std::numeric_limits<double>::infinity(), 1e300}) {
    for (const auto kinematics : kAll) {
      Sample s = Sample::of<NeoHooke>(kRubber, kinematics);
      EXPECT_FALSE(s.step(uniaxial(bad))) << bad;
    }
  }
}

TEST(LinearElastic, IsHookesLawWithItsTangent) {
  Random random(35);
  for (const auto kinematics : kAll) {
    const Matrix3 h = plane(random_matrix(random, 0.3), kinematics);
    Sample s = Sample::of<LinearElastic>(kRubber, kinematics);
    ASSERT_TRUE(s.step(h));
    const std::size_t d = kinematics == CLEAVE_3D ? 3 : 2;
    // sigma = E/(1+nu) (eps + nu/(1-2nu) tr eps I), with eps_33 from sigma_33 = 0 in plane stress.
    double trace = 0, energy = 0;
    for (std::size_t k = 0; k < d; ++k) trace += h[k][k];
    if (kinematics == CLEAVE_PLANE_STRESS) trace *= (1 - 2 * kNu) / (1 - kNu);
    for (std::size_t r = 0; r < d; ++r)
      for (std::size_t c = 0; c < d; ++c) {
        const double e = 0.5 * (h[r][c] + h[c][r]);
        const double sigma = kE / (1 + kNu) * (e + (r == c ? kNu / (1 - 2 * kNu) * trace : 0.0));
        EXPECT_NEAR(s.P[r][c], sigma, 1e-14 * kE);
        energy += 0.5 * sigma * e;
      }
    EXPECT_NEAR(s.energy, energy, 1e-14 * kE);
    if (kinematics == CLEAVE_PLANE_STRAIN) {
      EXPECT_NEAR(s.P[2][2], kNu * (s.P[0][0] + s.P[1][1]), 1e-14 * kE);
    }
    if (kinematics == CLEAVE_3D) {
      Tangent<3> a;
      ASSERT_TRUE(tangent_at<3>(s.material(), {}, Mat<3>{}, {}, 0, a));
      for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j) {
          double p = 0;
          for (int k = 0; k < 3; ++k)
            for (int l = 0; l < 3; ++l)
              p += a(i, j, k, l) * h[static_cast<std::size_t>(k)][static_cast<std::size_t>(l)];
          EXPECT_NEAR(p, s.P[static_cast<std::size_t>(i)][static_cast<std::size_t>(j)], 1e-14 * kE);
        }
    }
  }
}

}  // namespace
}  // namespace cleave::test
