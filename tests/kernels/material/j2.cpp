// J2 plasticity against the tables of its theory page, an extended-precision version of the textbook
// algorithm, and the statements that hold for any hardening.
#include <cstring>
#include <limits>

#include "j2_support.hpp"

namespace cleave::test {
namespace {

TEST(J2, GivesTheSingleStepsOfTheTheoryPage) {
  struct Row {
    Matrix3 H;
    double dg;
    Matrix3 P;
  };
  const Row rows[] = {
      {{{{0.01, 0, 0}, {0, 0, 0}, {0, 0, 0}}},
       4.676722834696e-03,
       {{{1928.470758994, 0, 0}, {0, 1476.978308821, 0}, {0, 0, 1476.978308821}}}},
      {{{{0, 0.1, 0}, {0, 0, 0}, {0, 0, 0}}},
       5.514246313523e-02,
       {{{-17.81618220, 356.3236439, 0}, {358.1052621, -17.81618220, 0}, {0, 0, 0}}}},
      {{{{0.05, .02, 0}, {-.01, -0.03, .03}, {0, .01, 0.02}}},
       4.964519837591e-02,
       {{{6213.023434, 98.96678244, -0.9073663341},
         {-83.75612583, 6089.212788, 95.13092809},
         {0.5967057287, -28.11934257, 6173.580130}}}}};
  for (const Row& row : rows) {
    const Point p = ask(row.H);
    ASSERT_EQ(p.status, CLEAVE_OK) << last_message();
    EXPECT_NEAR(p.strain(), row.dg, 1e-12 * row.dg);         // measured: the digits shown
    EXPECT_LT(distance(p.P, row.P), 1e-9 * largest(row.P));  // the digits shown
  }
}

// P_xx = 0 by Newton with differences, F_zz = 1, steps of 1e-4.
TEST(J2, FollowsPlaneStrainTensionOfTheTheoryPage) {
  const double table[][5] = {
      {0.001, 0.999592, 225.56, 201.20, 0},         {0.002, 0.999184, 450.44, 402.20, 0},
      {0.0025, 0.998863, 508.17, 451.25, 0.000271}, {0.005, 0.996580, 531.15, 463.36, 0.002965},
      {0.01, 0.991784, 556.38, 486.68, 0.008517},   {0.02, 0.982208, 597.15, 527.49, 0.019637},
      {0.03, 0.972788, 629.32, 561.36, 0.030693},   {0.05, 0.954433, 674.11, 612.99, 0.052580},
      {0.08, 0.928085, 708.75, 662.90, 0.084799},   {0.10, 0.911280, 718.57, 684.53, 0.105853},
      {0.12, 0.895057, 721.96, 700.26, 0.126561},   {0.15, 0.871759, 719.64, 716.71, 0.156982},
      {0.20, 0.835485, 705.84, 733.53, 0.206021}};
  std::array<double, 8> history{};
  double lateral = 0, most = 0, first_yield = 0;
  std::size_t row = 0;
  for (int n = 1; n <= 2000; ++n) {
    Matrix3 H{};
    H[1][1] = 1e-4 * n;
    const auto at = [&](double x) {
      H[0][0] = x;
      return ask(CLEAVE_MATERIAL_j2, CLEAVE_PLANE_STRAIN, kSteel, H, history);
    };
    Point p = at(lateral);
    for (int k = 0; k < 20 && std::fabs(p.P[0][0]) > 1e-9; ++k) {
      const double slope = (at(lateral + 1e-7).P[0][0] - p.P[0][0]) / 1e-7;
      lateral -= p.P[0][0] / slope;
      p = at(lateral);
    }
    history = p.history;
    most = std::fmax(most, p.P[1][1]);
    if (first_yield == 0 && p.strain() > 0) first_yield = 1e-4 * n;
    if (row < std::size(table) && std::fabs(1e-4 * n - table[row][0]) < 1e-9) {
      EXPECT_NEAR(1 + lateral, table[row][1], 1e-4 * table[row][1]);
      EXPECT_NEAR(p.P[1][1], table[row][2], 1e-4 * table[row][2]);
      EXPECT_NEAR(p.strain(), table[row][4], 1e-4 * table[row][4] + 1e-6);
      if (p.strain() > 0) {
        EXPECT_NEAR(static_cast<double>(steel_yield(p.strain())), table[row][3],
                    1e-4 * table[row][3]);
      }
      ++row;
    }
  }
  EXPECT_EQ(row, std::size(table));
  EXPECT_NEAR(first_yield, 0.0023, 1e-9);
  EXPECT_NEAR(most, 722.1, 0.1);
}

// Three steps from the virgin state, elastic and plastic, and every size up to stretch 3.
TEST(J2, AgreesWithTheTextbookAlgorithmInExtendedPrecision) {
  Random random(11);
  double worst = 0, worst_metric = 0, worst_strain = 0;
  for (int trial = 0; trial < 400; ++trial) {
    const double size = std::pow(10.0, -3 + 3.3 * std::fabs(random()));
    std::array<double, 8> history{};
    for (int step = 0; step < 3; ++step) {
      const Matrix3 H = random_matrix(random, size);
      Wide before = kVirgin;
      const int order[3][3] = {{0, 3, 5}, {3, 1, 4}, {5, 4, 2}};
      for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t j = 0; j < 3; ++j)
          before[i][j] += static_cast<Real>(history[static_cast<std::size_t>(order[i][j])]);
      Matrix3 F = H;
      for (std::size_t k = 0; k < 3; ++k) F[k][k] += 1;
      const Point p = ask(H, history);
      if (determinant(F) < 0.05) break;
      ASSERT_EQ(p.status, CLEAVE_OK) << last_message();
      const Reference r = reference(kG, kKappa, steel_yield, H, before, history[6]);
      const Matrix3 inv = inverse(F);
      const double scale = kE * largest(inv) * r.condition;
      worst = std::fmax(worst, distance(p.P, r.P) / scale);
      worst_strain = std::fmax(worst_strain,
                               std::fabs(p.strain() - static_cast<double>(r.strain)) / r.condition);
      EXPECT_NEAR(p.energy, static_cast<double>(r.energy),
                  3e-14 * r.condition * static_cast<double>(r.energy));
      for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t j = 0; j < 3; ++j) {
          const Real mine = static_cast<Real>(p.history[static_cast<std::size_t>(order[i][j])]) +
                            (i == j ? 1 : 0);
          const Real size_here = largest(inv) * largest(inv) * largest(F) * largest(F) *
                                 static_cast<Real>(r.condition);
          worst_metric = std::fmax(worst_metric,
                                   static_cast<double>(std::fabs(mine - r.cpi[i][j]) / size_here));
        }
      history = p.history;
    }
  }
  EXPECT_LT(worst, 1e-15);         // measured 2.4e-16
  EXPECT_LT(worst_strain, 1e-15);  // measured 1.4e-16
  EXPECT_LT(worst_metric, 2e-15);  // measured 3.3e-16
}

// Where F^T F - I would have lost all digits: the linear law, up to the square of the strain.
TEST(J2, KeepsItsDigitsAtStrain1e12) {
  Random random(12);
  for (const double size : {1e-12, 1e-9}) {
    for (const int32_t kinematics : {CLEAVE_3D, CLEAVE_PLANE_STRAIN, CLEAVE_PLANE_STRESS}) {
      Matrix3 H = random_matrix(random, size);
      if (kinematics != CLEAVE_3D)
        for (std::size_t k = 0; k < 3; ++k) H[2][k] = H[k][2] = 0;
      const Point p = ask(CLEAVE_MATERIAL_j2, kinematics, kSteel, H);
      ASSERT_EQ(p.status, CLEAVE_OK);
      double lambda = kKappa - 2 * kG / 3;
      if (kinematics == CLEAVE_PLANE_STRESS) lambda = 2 * kG * lambda / (lambda + 2 * kG);
      const double trace = H[0][0] + H[1][1] + H[2][2];
      for (std::size_t r = 0; r < 3; ++r)
        for (std::size_t c = 0; c < 3; ++c) {
          if (kinematics == CLEAVE_PLANE_STRESS && (r == 2 || c == 2)) continue;
          const double linear = kG * (H[r][c] + H[c][r]) + (r == c ? lambda * trace : 0);
          EXPECT_NEAR(p.P[r][c], linear, (20 * size + 4e-15) * kE * size)
              << size << ' ' << kinematics;
        }
    }
  }
  EXPECT_EQ(largest(ask(Matrix3{}).P), 0);
}

TEST(J2, TurnsWithARotationAndForgetsAnEarlierOne) {
  Random random(13);
  double worst = 0;
  for (int trial = 0; trial < 100; ++trial) {
    const double size = trial % 2 == 0 ? 1e-3 : 0.2;
    const Matrix3 q = random_rotation(random);
    std::array<double, 8> plain{}, turned{};
    for (int step = 0; step < 3; ++step) {
      Matrix3 F = random_matrix(random, size);
      for (std::size_t k = 0; k < 3; ++k) F[k][k] += 1;
      Matrix3 H = F, QH = product(q, F);
      for (std::size_t k = 0; k < 3; ++k) H[k][k] -= 1, QH[k][k] -= 1;
      const Point a = ask(H, plain);
      const Point b = step == 1 ? ask(H, turned) : ask(QH, turned);
      ASSERT_EQ(a.status, CLEAVE_OK);
      worst = std::fmax(worst, distance(b.P, step == 1 ? a.P : product(q, a.P)) / kE);
      for (std::size_t k = 0; k < 7; ++k) EXPECT_NEAR(a.history[k], b.history[k], 2e-14);
      plain = a.history;
      turned = b.history;
    }
  }
  EXPECT_LT(worst, 4e-15);  // measured 8.3e-16
}

TEST(J2, IsTheSameInEveryConsistentSetOfUnits) {
  Random random(14);
  auto si = kSteel;  // t mm-3 -> kg m-3, MPa -> Pa
  si[0] *= 1e12;
  for (const std::size_t k : {1u, 3u, 4u, 5u}) si[k] *= 1e6;
  for (int trial = 0; trial < 100; ++trial) {
    const Matrix3 H = random_matrix(random, std::pow(10.0, -5 + 4.5 * std::fabs(random())));
    const Point a = ask(H), b = ask(CLEAVE_MATERIAL_j2, CLEAVE_3D, si, H);
    ASSERT_EQ(a.status, b.status);
    for (std::size_t k = 0; k < 7; ++k)
      EXPECT_NEAR(a.history[k], b.history[k],
                  1e-14 * (1e-9 + std::fabs(a.history[k])) + 1e-15 * a.strain());
    Matrix3 scaled = b.P;
    for (auto& row : scaled)
      for (double& x : row) x *= 1e-6;
    EXPECT_LT(distance(a.P, scaled), 1e-15 * kE);
  }
}

// int P:dF = psi_e + w_p along a path, by Simpson's rule on each step of a fine path.
TEST(J2, StoresAndDissipatesWhatIsPutIn) {
  for (const int32_t material :
       {CLEAVE_MATERIAL_j2, CLEAVE_MATERIAL_j2_power, CLEAVE_MATERIAL_j2_table}) {
    std::vector<double> properties = kSteel;
    if (material == CLEAVE_MATERIAL_j2_power) properties = {7.8e-9, kE, kNu, 450, 0.01, 0.15};
    if (material == CLEAVE_MATERIAL_j2_table) {
      properties = {7.8e-9, kE, kNu, 450};
      properties.resize(4 + 24, 0.0);
      const double curve[] = {0.02, 520, 0.06, 600, 0.2, 680};
      std::copy(std::begin(curve), std::end(curve), properties.begin() + 4);
    }
    const int steps = 4000;
    std::array<double, 8> history{};
    Matrix3 last{}, H{};
    Point before = ask(material, CLEAVE_3D, properties, H);
    double work = 0, dissipated = 0;
    for (int n = 1; n <= steps; ++n) {
      const double s = static_cast<double>(n) / steps;
      H = {{{0.2 * s, 0.1 * s * s, 0}, {-0.05 * s, -0.12 * s, 0.1 * s}, {0, 0, -0.05 * s}}};
      const Point p = ask(material, CLEAVE_3D, properties, H, history);
      ASSERT_EQ(p.status, CLEAVE_OK);
      for (std::size_t r = 0; r < 3; ++r)
        for (std::size_t c = 0; c < 3; ++c)
          work += 0.5 * (p.P[r][c] + before.P[r][c]) * (H[r][c] - last[r][c]);
      dissipated += p.plastic;
      history = p.history;
      before = p;
      last = H;
    }
    EXPECT_GT(dissipated, 0.8 * work) << dissipated << ' ' << work;
    EXPECT_NEAR(before.energy + dissipated, work, 2e-6 * work) << material;  // measured 6e-7
  }
}

// The work of the flow in one large step is that of many small ones with the same sum.
TEST(J2, DissipatesTheIntegralOfTheYieldStress) {
  const double strain = ask({{{0, 0.1, 0}, {0, 0, 0}, {0, 0, 0}}}).strain();
  double sum = 0;
  const int parts = 2000;  // Simpson
  for (int n = 0; n <= parts; ++n)
    sum += (n == 0 || n == parts ? 1
            : n % 2 == 1         ? 4
                                 : 2) *
           static_cast<double>(steel_yield(strain * n / parts));
  const Point p = ask({{{0, 0.1, 0}, {0, 0, 0}, {0, 0, 0}}});
  EXPECT_NEAR(p.plastic, sum * strain / (3 * parts), 1e-13 * p.plastic);
}

TEST(J2Power, FollowsItsCurve) {
  Random random(15);
  const std::vector<double> law = {7.8e-9, kE, kNu, 300, 0.005, 0.22};
  const auto yield = [](Real e) { return 300 * std::pow(1 + e / 0.005L, 0.22L); };
  for (int trial = 0; trial < 200; ++trial) {
    const Matrix3 H = random_matrix(random, std::pow(10.0, -2.5 + 2 * std::fabs(random())));
    const Point p = ask(CLEAVE_MATERIAL_j2_power, CLEAVE_3D, law, H);
    if (p.status != CLEAVE_OK) continue;
    const Reference r = reference(kG, kKappa, yield, H, kVirgin, 0);
    EXPECT_NEAR(p.strain(), static_cast<double>(r.strain), 2e-14 * (0.01 + p.strain()));
    EXPECT_LT(distance(p.P, r.P), 1e-12 * kE);
  }
}

TEST(J2Table, FollowsItsCurveAndStaysAtItsEnd) {
  Random random(16);
  std::vector<double> law = {7.8e-9, kE, kNu, 450};
  law.resize(4 + 24, 0.0);
  const double curve[] = {0.01, 500, 0.05, 480, 0.3, 700};  // with a softening part
  std::copy(std::begin(curve), std::end(curve), law.begin() + 4);
  const auto yield = [](Real e) {
    const Real x[] = {0, 0.01L, 0.05L, 0.3L}, y[] = {450, 500, 480, 700};
    for (int k = 0; k < 3; ++k)
      if (e < x[k + 1]) return y[k] + (y[k + 1] - y[k]) * (e - x[k]) / (x[k + 1] - x[k]);
    return y[3];
  };
  int beyond = 0;
  for (int trial = 0; trial < 400; ++trial) {
    const Matrix3 H = random_matrix(random, std::pow(10.0, -2.7 + 2.5 * std::fabs(random())));
    const Point p = ask(CLEAVE_MATERIAL_j2_table, CLEAVE_3D, law, H);
    if (p.status != CLEAVE_OK) continue;
    const Reference r = reference(kG, kKappa, yield, H, kVirgin, 0);
    if (p.strain() > 0.3) ++beyond;
    EXPECT_NEAR(p.strain(), static_cast<double>(r.strain), 2e-14 * (0.01 + p.strain()));
    EXPECT_LT(distance(p.P, r.P), 1e-12 * kE * (1 + largest(p.P) / kE));
  }
  EXPECT_GT(beyond, 10);
}

TEST(J2Table, RefusesACurveThatGoesBackOrHasAGap) {
  std::vector<double> law = {7.8e-9, kE, kNu, 450};
  law.resize(4 + 24, 0.0);
  const auto refused = [&](std::initializer_list<double> curve) {
    auto bad = law;
    std::copy(curve.begin(), curve.end(), bad.begin() + 4);
    EXPECT_EQ(ask(CLEAVE_MATERIAL_j2_table, CLEAVE_3D, bad, Matrix3{}).status, CLEAVE_BAD_ARGUMENT);
    return last_message();
  };
  EXPECT_NE(refused({0.1, 500, 0.1, 600}).find("strain_2 is 0.1 after 0.1"), std::string::npos);
  EXPECT_NE(refused({0.1, 500, 0, 0, 0.2, 600}).find("stress_3 is given"), std::string::npos);
  EXPECT_NE(refused({0.1, 500, 0.2}).find("strain_2 is given"), std::string::npos);
  // Softening as steep as the elastic unloading.
  EXPECT_NE(refused({0.001, 450 - 3.1 * kG * 0.001}).find("3 G"), std::string::npos);
}

// What is left of the law when the yield stress softens: the flow is still on the curve.
TEST(J2, FollowsASofteningSaturation) {
  auto law = kSteel;
  law[4] = 200;
  law[5] = 0;
  const auto yield = [](Real e) { return 450 - 250 * (1 - std::exp(-16.93L * e)); };
  Random random(17);
  for (int trial = 0; trial < 200; ++trial) {
    const Matrix3 H = random_matrix(random, std::pow(10.0, -2.7 + 2 * std::fabs(random())));
    const Point p = ask(CLEAVE_MATERIAL_j2, CLEAVE_3D, law, H);
    if (p.status != CLEAVE_OK) continue;
    const Reference r = reference(kG, kKappa, yield, H, kVirgin, 0);
    EXPECT_NEAR(p.strain(), static_cast<double>(r.strain), 2e-14 * (0.01 + p.strain()));
  }
  law[6] = 1000;  // 250 * 1000 > 3 G
  EXPECT_EQ(ask(CLEAVE_MATERIAL_j2, CLEAVE_3D, law, Matrix3{}).status, CLEAVE_BAD_ARGUMENT);
}

// Plane stress is the law in three dimensions at the H33 for which P33 vanishes.
TEST(J2, PlaneStressIsThreeDimensionalWithoutP33) {
  Random random(18);
  for (int trial = 0; trial < 60; ++trial) {
    std::array<double, 8> history{};
    for (int step = 0; step < 4; ++step) {
      Matrix3 H = random_matrix(random, trial % 3 == 0 ? 1e-3 : 0.05 * (step + 1));
      for (std::size_t k = 0; k < 3; ++k) H[2][k] = H[k][2] = 0;
      const Point plane = ask(CLEAVE_MATERIAL_j2, CLEAVE_PLANE_STRESS, kSteel, H, history);
      ASSERT_EQ(plane.status, CLEAVE_OK) << last_message();
      H[2][2] = plane.history[7];
      const Point solid = ask(H, history);
      EXPECT_LT(std::fabs(solid.P[2][2]), 2e-14 * kE);
      EXPECT_EQ(plane.P[2][2], 0);
      for (std::size_t r = 0; r < 2; ++r)
        for (std::size_t c = 0; c < 2; ++c) EXPECT_EQ(plane.P[r][c], solid.P[r][c]);
      EXPECT_EQ(plane.energy, solid.energy);
      EXPECT_EQ(plane.plastic, solid.plastic);
      history = plane.history;
    }
  }
}

TEST(J2, PlaneStrainIsThreeDimensionalWithoutH33) {
  Random random(19);
  std::array<double, 8> a{}, b{};
  for (int step = 0; step < 20; ++step) {
    Matrix3 H = random_matrix(random, 0.1);
    for (std::size_t k = 0; k < 3; ++k) H[2][k] = H[k][2] = 0;
    const Point plane = ask(CLEAVE_MATERIAL_j2, CLEAVE_PLANE_STRAIN, kSteel, H, a);
    const Point solid = ask(H, b);
    EXPECT_EQ(distance(plane.P, solid.P), 0);
    EXPECT_EQ(plane.history, solid.history);
    a = plane.history;
    b = solid.history;
  }
}

TEST(J2, RefusesDegenerateStatesAndLeavesTheHistory) {
  const double nan = std::numeric_limits<double>::quiet_NaN(),
               inf = 1 / std::numeric_limits<double>::min() * 10;
  const std::array<double, 8> start = {0.01, -0.01, 0, 0.02, 0, 0, 0.05, 0};
  const auto refused = [&](const Matrix3& H, const std::array<double, 8>& history) {
    for (const int32_t kinematics : {CLEAVE_3D, CLEAVE_PLANE_STRAIN, CLEAVE_PLANE_STRESS}) {
      const Point p = ask(CLEAVE_MATERIAL_j2, kinematics, kSteel, H, history);
      EXPECT_EQ(p.status, CLEAVE_BAD_JACOBIAN);
      EXPECT_EQ(p.failed, 1);
      EXPECT_EQ(largest(p.P), 0);
      EXPECT_EQ(p.energy, 0);
      EXPECT_EQ(std::memcmp(p.history.data(), history.data(), sizeof history), 0);
    }
  };
  const Matrix3 rest{};
  Matrix3 H{};
  for (const double bad : {-1.0, -1.5, nan, inf * 2, -inf * 2, 1e200}) {  // det F <= 0, not finite
    H = rest;
    H[0][0] = bad;
    refused(H, start);
  }
  H = rest;
  H[0][1] = H[1][0] = 1.0 + 1e-12;
  refused(H, start);
  for (std::size_t k = 0; k < 7; ++k) {
    auto history = start;
    history[k] = nan;
    refused(rest, history);
  }
  auto history = start;
  history[6] = -1e-300;
  refused(rest, history);
  history = start;
  history[0] = -1.0;  // not positive definite
  refused(rest, history);
  history = start;
  history[3] = 1.5;
  refused(rest, history);
  history = start;
  history[0] = 1e9;  // ln b > 20
  refused(rest, history);
}

TEST(J2, HasNoDirectionOfFlowWithoutADeviator) {
  for (const double stretch : {0.5, 0.9, 1.0, 1.1, 2.5}) {
    Matrix3 H{};
    for (std::size_t k = 0; k < 3; ++k) H[k][k] = stretch - 1;
    const Point p = ask(H);
    ASSERT_EQ(p.status, CLEAVE_OK);
    EXPECT_EQ(p.strain(), 0);
    const double pressure = kKappa * 3 * std::log(stretch) / stretch;
    EXPECT_NEAR(p.P[0][0], pressure, 4e-15 * std::fabs(pressure));
    EXPECT_EQ(p.P[0][0], p.P[1][1]);
    EXPECT_EQ(p.P[0][1], 0);
  }
}

// Two and three equal stretches, and gaps between them down to the last bit.
TEST(J2, IsExactWhereEigenvaluesMeet) {
  Random random(20);
  for (const double gap : {0.0, 1e-15, 1e-12, 1e-8, 1e-4}) {
    for (const double stretch : {1.001, 1.3, 2.9}) {
      const Matrix3 q = random_rotation(random);
      Matrix3 d{}, H{};
      d[0][0] = stretch;
      d[1][1] = stretch * (1 + gap);
      d[2][2] = 1 / stretch;
      for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t j = 0; j < 3; ++j) {
          H[i][j] = i == j ? -1 : 0;
          for (std::size_t k = 0; k < 3; ++k) H[i][j] += q[i][k] * d[k][k] * q[j][k];
        }
      const Point p = ask(H);
      const Reference r = reference(kG, kKappa, steel_yield, H, kVirgin, 0);
      EXPECT_LT(distance(p.P, r.P), 3e-15 * kE * stretch * stretch);
      EXPECT_NEAR(p.strain(), static_cast<double>(r.strain), 5e-15 * (0.01 + p.strain()));
    }
  }
}

}  // namespace
}  // namespace cleave::test
