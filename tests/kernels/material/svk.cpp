// St Venant-Kirchhoff through the array call, against its definition written another way.
#include <gtest/gtest.h>

#include <cmath>

#include "support/bonds.hpp"

namespace cleave::test {
namespace {

// PMMA of the fracture plates.
constexpr double kRho = 1190, kE = 3.24e9, kNu = 0.35;
constexpr double kMu = kE / (2 * (1 + kNu)), kLambda = kE * kNu / ((1 + kNu) * (1 - 2 * kNu));
const std::vector<double> kProperties = {kRho, kE, kNu};

struct Point {
  Matrix3 P{};
  double energy = 0;
  int32_t status = CLEAVE_OK;
};
Point ask(int32_t kinematics, const Matrix3& H) {
  double h[9], p[9], energy = -1;
  for (std::size_t r = 0; r < 3; ++r)
    for (std::size_t c = 0; c < 3; ++c) h[r + 3 * c] = H[r][c];
  Point out;
  out.status = cleave_material_stress(CLEAVE_MATERIAL_svk, kinematics, 3, kProperties.data(), 0, 1,
                                      h, nullptr, p, &energy, nullptr);
  for (std::size_t r = 0; r < 3; ++r)
    for (std::size_t c = 0; c < 3; ++c) out.P[r][c] = p[r + 3 * c];
  out.energy = energy;
  return out;
}

Matrix3 random_gradient(Random& random, int dimension, double size) {
  Matrix3 H{};
  for (std::size_t r = 0; r < static_cast<std::size_t>(dimension); ++r)
    for (std::size_t c = 0; c < static_cast<std::size_t>(dimension); ++c) H[r][c] = size * random();
  return H;
}

TEST(SvkStress, FollowsTheDefinitionInThreeDimensions) {
  Random random(1);
  for (int trial = 0; trial < 20; ++trial) {
    const Matrix3 H = random_gradient(random, 3, 0.4);
    Matrix3 F = H, E{}, S{}, P{};
    for (std::size_t k = 0; k < 3; ++k) F[k][k] += 1;
    double trace = 0, energy = 0;
    for (std::size_t r = 0; r < 3; ++r)
      for (std::size_t c = 0; c < 3; ++c) {
        for (std::size_t k = 0; k < 3; ++k) E[r][c] += 0.5 * F[k][r] * F[k][c];
        if (r == c) {
          E[r][c] -= 0.5;
          trace += E[r][c];
        }
      }
    for (std::size_t r = 0; r < 3; ++r)
      for (std::size_t c = 0; c < 3; ++c) {
        S[r][c] = 2 * kMu * E[r][c] + (r == c ? kLambda * trace : 0);
        energy += 0.5 * S[r][c] * E[r][c];
      }
    for (std::size_t r = 0; r < 3; ++r)
      for (std::size_t c = 0; c < 3; ++c)
        for (std::size_t k = 0; k < 3; ++k) P[r][c] += F[r][k] * S[k][c];
    const Point p = ask(CLEAVE_3D, H);
    EXPECT_NEAR(p.energy, energy, 1e-14 * kE);  // measured 6e-16
    for (std::size_t r = 0; r < 3; ++r)
      for (std::size_t c = 0; c < 3; ++c) EXPECT_NEAR(p.P[r][c], P[r][c], 1e-14 * kE);
  }
}

TEST(SvkStress, IsTheGradientOfTheEnergy) {
  Random random(2);
  for (const int32_t kinematics : {CLEAVE_3D, CLEAVE_PLANE_STRAIN, CLEAVE_PLANE_STRESS}) {
    const int d = kinematics == CLEAVE_3D ? 3 : 2;
    const Matrix3 H = random_gradient(random, d, 0.3);
    const Point p = ask(kinematics, H);
    for (std::size_t r = 0; r < static_cast<std::size_t>(d); ++r)
      for (std::size_t c = 0; c < static_cast<std::size_t>(d); ++c) {
        Matrix3 more = H, less = H;
        more[r][c] += 1e-5;
        less[r][c] -= 1e-5;
        const double slope = (ask(kinematics, more).energy - ask(kinematics, less).energy) / 2e-5;
        EXPECT_NEAR(p.P[r][c], slope, 5e-10 * kE);  // measured 1e-10
      }
  }
}

// The law in plane stress is the law in three dimensions at the H33 for which P33 vanishes.
TEST(SvkStress, PlaneStressIsThreeDimensionalWithoutP33) {
  Random random(3);
  for (int trial = 0; trial < 20; ++trial) {
    Matrix3 H = random_gradient(random, 2, 0.3);
    const Point plane = ask(CLEAVE_PLANE_STRESS, H);
    ASSERT_EQ(plane.status, CLEAVE_OK);
    // P33 = F33 S33 changes sign once for F33 > 1/sqrt(3): bisection.
    double low = -0.4, high = 0.9;
    for (int k = 0; k < 200; ++k) {
      H[2][2] = 0.5 * (low + high);
      (ask(CLEAVE_3D, H).P[2][2] > 0 ? high : low) = H[2][2];
    }
    const Point solid = ask(CLEAVE_3D, H);
    ASSERT_NEAR(solid.P[2][2], 0, 1e-14 * kE);
    EXPECT_NEAR(plane.energy, solid.energy, 1e-13 * kE);  // measured 2e-17
    for (std::size_t r = 0; r < 2; ++r)
      for (std::size_t c = 0; c < 2; ++c)
        EXPECT_NEAR(plane.P[r][c], solid.P[r][c], 1e-13 * kE);  // measured 7e-17
    EXPECT_EQ(plane.P[2][2], 0);
  }
}

TEST(SvkStress, PlaneStrainIsThreeDimensionalWithoutH33) {
  Random random(4);
  for (int trial = 0; trial < 20; ++trial) {
    const Matrix3 H = random_gradient(random, 2, 0.3);
    const Point plane = ask(CLEAVE_PLANE_STRAIN, H), solid = ask(CLEAVE_3D, H);
    EXPECT_NEAR(plane.energy, solid.energy, 1e-15 * kE);
    for (std::size_t r = 0; r < 3; ++r)
      for (std::size_t c = 0; c < 3; ++c) EXPECT_NEAR(plane.P[r][c], solid.P[r][c], 1e-15 * kE);
    EXPECT_NE(plane.P[2][2], 0);
  }
}

// E = (F^T F - I)/2 would lose ten digits here.
TEST(SvkStress, KeepsItsDigitsAtStrain1e12) {
  Random random(5);
  for (const int32_t kinematics : {CLEAVE_3D, CLEAVE_PLANE_STRAIN, CLEAVE_PLANE_STRESS}) {
    const std::size_t d = kinematics == CLEAVE_3D ? 3 : 2;
    const double lambda = kinematics == CLEAVE_PLANE_STRESS ? kE * kNu / (1 - kNu * kNu) : kLambda;
    const Matrix3 H = random_gradient(random, static_cast<int>(d), 1e-12);
    const Point p = ask(kinematics, H);
    double trace = 0;
    for (std::size_t k = 0; k < d; ++k) trace += H[k][k];
    for (std::size_t r = 0; r < d; ++r)
      for (std::size_t c = 0; c < d; ++c) {
        const double linear = kMu * (H[r][c] + H[c][r]) + (r == c ? lambda * trace : 0);
        EXPECT_NEAR(p.P[r][c], linear,
                    2e-11 * std::fabs(linear));  // measured 1.3e-11, of a small one
      }
  }
}

// Nominal stress of uniaxial strain turns at stretch 1/sqrt(3) and vanishes at collapse.
TEST(SvkStress, SoftensInCompressionBeyondTheTurningPoint) {
  const auto slope = [](double stretch) {
    Matrix3 more{}, less{};
    more[0][0] = stretch - 1 + 1e-6;
    less[0][0] = stretch - 1 - 1e-6;
    return ask(CLEAVE_3D, more).P[0][0] - ask(CLEAVE_3D, less).P[0][0];
  };
  double low = 0.3, high = 0.9;  // stress falls below the turning point, rises above it
  for (int k = 0; k < 100; ++k) {
    const double middle = 0.5 * (low + high);
    (slope(middle) > 0 ? high : low) = middle;
  }
  EXPECT_NEAR(low, 1 / std::sqrt(3.0), 1e-8);  // measured 8e-12
  Matrix3 collapsed{};
  collapsed[0][0] = -1;
  EXPECT_EQ(ask(CLEAVE_3D, collapsed).P[0][0], 0);
}

TEST(SvkStress, HasNoAnswerWhereThePlateWouldHaveNoThickness) {
  Matrix3 H{};
  H[0][0] = H[1][1] = 1.0;  // E33 = -0.35/0.65 * 3 = -1.6
  const Point p = ask(CLEAVE_PLANE_STRESS, H);
  EXPECT_EQ(p.status, CLEAVE_BAD_JACOBIAN);
  for (const auto& row : p.P)
    for (const double c : row) EXPECT_EQ(c, 0);
  EXPECT_EQ(ask(CLEAVE_PLANE_STRAIN, H).status, CLEAVE_OK);
  H[0][0] = H[1][1] = 0.25;  // E33 = -0.30: just inside
  EXPECT_EQ(ask(CLEAVE_PLANE_STRESS, H).status, CLEAVE_OK);
}

TEST(SvkWaveSpeed, IsThatOfTheBenchmarkTable) {
  const auto speed = [](int32_t kinematics) {
    double c = 0;
    EXPECT_EQ(
        cleave_material_wave_speed(CLEAVE_MATERIAL_svk, kinematics, 3, kProperties.data(), &c),
        CLEAVE_OK);
    return c;
  };
  // benchmarks B: plate P 1761 m/s, three-dimensional P 2090 m/s.
  EXPECT_NEAR(speed(CLEAVE_PLANE_STRESS), 1761, 0.5);
  EXPECT_NEAR(speed(CLEAVE_3D), 2090, 0.5);
  EXPECT_EQ(speed(CLEAVE_PLANE_STRAIN), speed(CLEAVE_3D));
  EXPECT_NEAR(speed(CLEAVE_PLANE_STRESS), std::sqrt(kE / (kRho * (1 - kNu * kNu))), 1e-9);
}

}  // namespace
}  // namespace cleave::test
