// Johnson-Cook strength, heating and failure, with and without the equation of state.
#include <cfenv>
#include <limits>

#include "impact_support.hpp"
#include "material/tangent.hpp"

namespace cleave::test {
namespace {

Real strength(Real e) { return kA + (e > 0 ? kB * std::pow(e, static_cast<Real>(kN)) : 0.0L); }

TEST(JohnsonCook, ReturnsToItsCurveFromAnyState) {
  Random random(21);
  Strength cold;
  cold.melt = cold.heat = cold.rate = 0;
  const Real g = kYoungs / (2 * (1 + kPoisson)), kappa = kYoungs / (3 * (1 - 2 * kPoisson));
  double worst = 0;
  for (int trial = 0; trial < 400; ++trial) {
    const double strain = trial % 4 == 0 ? 0 : std::pow(10.0, -10 + 10 * std::fabs(random()));
    Sample s = Sample::of<JohnsonCook>(copper(cold));
    s["equivalent_plastic_strain"] = strain;
    const Matrix3 h = random_matrix(random, std::pow(10.0, -3.5 + 3 * std::fabs(random())));
    Matrix3 f = h;
    for (std::size_t k = 0; k < 3; ++k) f[k][k] += 1;
    const double j = determinant(f);
    if (!s.step(h)) continue;
    const Reference r = reference(
        g, kappa, [&](Real e) { return j * strength(e); }, h, kVirgin, strain);
    const double flow = static_cast<double>(r.strain) - strain;
    EXPECT_NEAR(s["equivalent_plastic_strain"] - strain, flow,
                2e-13 * flow + 4e-16 * strain + 1e-30);
    worst = std::fmax(worst, distance(s.P, r.P) / (kYoungs * largest(h)));
  }
  EXPECT_LT(worst, 3e-12);  // measured 2e-14 .. of large strains
}

// The Cauchy stress, not the Kirchhoff stress, meets the yield curve: at J = 0.9 they differ by a tenth.
TEST(JohnsonCook, YieldsAtTheCauchyStress) {
  Strength cold;
  cold.melt = cold.heat = cold.rate = 0;
  for (const double strain : {-0.1, 0.05}) {
    Sample s = Sample::of<JohnsonCook>(copper(cold));
    const Matrix3 h = uniaxial(strain);
    ASSERT_TRUE(s.step(h));
    const Real e = s["equivalent_plastic_strain"];
    EXPECT_GT(e, 0.02);
    EXPECT_NEAR(s.equivalent_stress(h), static_cast<double>(strength(e)), 1e-4);
  }
}

TEST(JohnsonCook, HasTheFactorOfTheRate) {
  Strength isothermal;
  isothermal.melt = isothermal.heat = 0;
  const Matrix3 h = shear(0.02);
  for (const double dt : {1e-9, 1e-5, 1e-3, 0.02, 1.0, 0.0}) {
    Sample s = Sample::of<JohnsonCook>(copper(isothermal));
    ASSERT_TRUE(s.step(h, dt));
    const double e = s["equivalent_plastic_strain"];
    const double rate = dt > 0 ? std::fmax(e / dt, 1.0) : 1.0;
    const double factor = 1 + kRate * std::log(rate), curve = static_cast<double>(strength(e));
    EXPECT_NEAR(s.equivalent_stress(h), factor * curve, 1e-11 * curve) << dt;
    // The work: int of A + B e^n, with the factor.
    const double work = factor * (kA * e + kB * std::pow(e, kN + 1) / (kN + 1));
    EXPECT_NEAR(s.plastic, work, 1e-12 * work);
  }
}

TEST(JohnsonCook, HeatsAdiabaticallyAndSoftens) {
  Sample s = Sample::of<JohnsonCook>(copper());
  double work = 0, before = 0;
  for (int n = 1; n <= 400; ++n) {
    const Matrix3 h = shear(0.005 * n);
    const double frozen = s["temperature_rise"];
    ASSERT_TRUE(s.step(h, 1e-6));
    work += s.plastic;
    EXPECT_NEAR(s["temperature_rise"], 0.9 * work / (kRho * kHeat), 1e-12 * s["temperature_rise"]);
    const double e = s["equivalent_plastic_strain"], rate = (e - before) / 1e-6;
    before = e;
    const double expected = static_cast<double>(strength(e)) * (1 + kRate * std::log(rate)) *
                            (1 - std::pow(frozen / (kMelt - kRoom), kThermal));
    EXPECT_NEAR(s.equivalent_stress(h), expected, 1e-9 * expected);
  }
  EXPECT_GT(s["temperature_rise"], 50);  // shear strain 2 of copper: about 150 K
  EXPECT_LT(s["temperature_rise"], 300);
}

TEST(JohnsonCook, HasNoDeviatorAtTheMeltingPoint) {
  Sample s = Sample::of<JohnsonCook>(copper());
  s["temperature_rise"] = 1.2 * (kMelt - kRoom);
  Matrix3 h = shear(0.3);
  h[1][1] = -0.05;
  ASSERT_TRUE(s.step(h, 1e-6));
  EXPECT_LT(s.equivalent_stress(h), 1e-14 * kYoungs);
  EXPECT_LT(s.mean_stress(h), -0.04 * kYoungs);
  EXPECT_EQ(s.plastic, 0);
}

// D grows by dg/eps_f with the triaxiality, rate and temperature of the step.
TEST(JohnsonCook, DamageFollowsTheFailureStrain) {
  Strength strength_set;
  strength_set.fails = true;
  // Shear: triaxiality 0, isothermal.
  strength_set.melt = strength_set.heat = 0;
  Sample s = Sample::of<JohnsonCook>(copper(strength_set));
  double expected = 0, before = 0;
  for (int n = 1; n <= 100; ++n) {
    const Matrix3 h = shear(0.01 * n);
    ASSERT_TRUE(s.step(h, 1e-5));
    const double e = s["equivalent_plastic_strain"], rate = (e - before) / 1e-5;
    const double triaxiality = s.mean_stress(h) / s.equivalent_stress(h);
    EXPECT_LT(std::fabs(triaxiality), 0.01);
    if (e > before)
      expected += (e - before) / ((kD[0] + kD[1] * std::exp(kD[2] * triaxiality)) *
                                  (1 + kD[3] * std::log(std::fmax(rate, 1.0))));
    EXPECT_NEAR(s["damage_johnson_cook"], expected, 1e-12 * expected);
    before = e;
  }
  EXPECT_GT(expected, 0.08);
  // The cap: uniaxial strain in tension, triaxiality far above 1.5.
  Sample t = Sample::of<JohnsonCook>(copper(strength_set));
  ASSERT_TRUE(t.step(uniaxial(0.02)));
  EXPECT_GT(t.mean_stress(uniaxial(0.02)), 1.5 * t.equivalent_stress(uniaxial(0.02)));
  EXPECT_NEAR(t["damage_johnson_cook"],
              t["equivalent_plastic_strain"] / (kD[0] + kD[1] * std::exp(1.5 * kD[2])), 1e-13);
}

template <class Law>
void fails_for_good(const std::vector<double>& properties, double tolerance) {
  Sample s = Sample::of<Law>(properties);
  double strain = 0, stored = 0, work = 0, dissipated = 0;
  Matrix3 last{}, before{};
  int failed_at = 0;
  for (int n = 1; n <= 4000; ++n) {
    strain = 5e-4 * n;
    Matrix3 h = uniaxial(strain);
    h[1][1] = h[2][2] = std::pow(1 + strain, -0.45) - 1;
    ASSERT_TRUE(s.step(h, 1e-7));
    for (std::size_t k = 0; k < 3; ++k)
      work += 0.5 * (s.P[k][k] + before[k][k]) * (h[k][k] - last[k][k]);
    dissipated += s.plastic + s.viscous;
    const double released = stored - s.energy;
    stored = s.energy;
    last = h;
    before = s.P;
    if (s["damage_johnson_cook"] >= 1) {
      if (failed_at > 0) {
        EXPECT_NEAR(s.plastic, released, tolerance * released);
        break;
      }
      failed_at = n;
      EXPECT_GT(s.equivalent_stress(h), 1e8);
    }
  }
  ASSERT_GT(failed_at, 100);
  EXPECT_EQ(s["damage_johnson_cook"], 1);
  EXPECT_LT(largest(s.P), 1e-12 * kYoungs);  // no deviator, no tension
  EXPECT_LT(std::fabs(stored), 1e-9 * work);
  EXPECT_NEAR(dissipated, work, 2e-3 * work);  // what was stored is dissipated
  // Pressure only from now on, and again after a detour.
  for (const double squeeze : {-0.3, 0.1, -0.3}) {
    Matrix3 h = isotropic(0.2);
    h[0][1] = 0.4;
    Matrix3 f = h;
    for (std::size_t k = 0; k < 3; ++k) f[k][k] += 1;
    const double scale = std::cbrt((1 + squeeze / 3) / determinant(f));
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t j = 0; j < 3; ++j) h[i][j] = scale * f[i][j] - (i == j ? 1 : 0);
    ASSERT_TRUE(s.step(h, 1e-7));
    EXPECT_LT(s.equivalent_stress(h), 1e-10 * kYoungs);
    if (squeeze < 0) {
      EXPECT_LT(s.mean_stress(h), -0.05 * kYoungs);
    } else {
      EXPECT_LT(largest(s.P), 1e-10 * kYoungs);
    }
  }
}
TEST(JohnsonCook, FailsForGood) {
  Strength set;
  set.fails = true;
  fails_for_good<JohnsonCook>(copper(set), 1e-9);
  Shock still;
  still.q1 = still.q2 = 0;
  // The trapezoid of the energy adds half a step of the work of the last tension.
  fails_for_good<JohnsonCookEos>(copper_eos(set, still), 0.3);
}

TEST(JohnsonCook, TangentIsTheDerivativeOfTheStep) {
  Random random(22);
  for (const auto kinematics : {CLEAVE_3D, CLEAVE_PLANE_STRAIN, CLEAVE_PLANE_STRESS}) {
    const double sizes[] = {1e-4, 1e-3, 0.02, 0.2};
    for (int trial = 0; trial < 40; ++trial) {
      Sample s = Sample::of<JohnsonCook>(copper(), kinematics);
      Matrix3 h = random_matrix(random, 0.05);
      if (kinematics != CLEAVE_3D)
        for (std::size_t k = 0; k < 3; ++k) h[2][k] = h[k][2] = 0;
      ASSERT_TRUE(s.step(h, 1e-6));
      const double size = sizes[trial % 4];
      for (auto& row : h)
        for (double& x : row) x += x == 0 ? 0 : size * random();
      const Increment increment{trial % 3 == 0 ? 0.0 : 1e-6, 0};
      const auto compare = [&](auto d) {
        constexpr int D = d;
        Mat<D> at;
        for (int i = 0; i < D; ++i)
          for (int j = 0; j < D; ++j)
            at(i, j) = h[static_cast<std::size_t>(i)][static_cast<std::size_t>(j)];
        Tangent<D> own, difference;
        const HistoryArrays history = s.arrays().history;
        ASSERT_TRUE(tangent_at<D>(s.material(), history, at, increment, 0, own));
        const double step = 1e-8;  // the curvature of the law is 1/eps_p
        for (int k = 0; k < D; ++k)
          for (int l = 0; l < D; ++l) {
            Mat<D> above = at, below = at;
            above(k, l) += step;
            below(k, l) -= step;
            const auto up = trial_response<D>(s.material(), history, above, increment, 0);
            const auto down = trial_response<D>(s.material(), history, below, increment, 0);
            for (int i = 0; i < D; ++i)
              for (int j = 0; j < D; ++j)
                difference(i, j, k, l) =
                    (up.stress(i, j) - down.stress(i, j)) / (above(k, l) - below(k, l));
          }
        for (int k = 0; k < D * D * D * D; ++k) {
          EXPECT_NEAR((&own.c[0][0][0][0])[k], (&difference.c[0][0][0][0])[k], 2e-6 * kYoungs);
        }
      };
      kinematics == CLEAVE_3D ? compare(std::integral_constant<int, 3>{})
                              : [&] { compare(std::integral_constant<int, 2>{}); }();
    }
  }
}

template <class Law>
void same_in_mm(const std::vector<double>& si, std::vector<double> mm) {
  Random random(23);
  for (int trial = 0; trial < 50; ++trial) {
    Sample a = Sample::of<Law>(si), b = Sample::of<Law>(mm);
    for (int step = 0; step < 3; ++step) {
      const Matrix3 h = random_matrix(random, std::pow(10.0, -4 + 3.3 * std::fabs(random())));
      ASSERT_EQ(a.step(h, 1e-6, 1e-3), b.step(h, 1e-6, 1.0));
      Matrix3 scaled = b.P;
      for (auto& row : scaled)
        for (double& x : row) x *= 1e6;
      EXPECT_LT(distance(a.P, scaled), 1e-9 * (1e6 + largest(a.P)));
      EXPECT_NEAR(a["temperature_rise"], b["temperature_rise"], 1e-9 * a["temperature_rise"]);
      EXPECT_NEAR(a["damage_johnson_cook"], b["damage_johnson_cook"], 1e-9);
    }
  }
}
// Tonne, millimetre, second: stresses in MPa.
TEST(JohnsonCook, IsTheSameInEveryConsistentSetOfUnits) {
  Strength set;
  set.fails = true;
  auto mm = copper(set);
  mm[0] *= 1e-12;
  for (const std::size_t k : {1u, 3u, 4u}) mm[k] *= 1e-6;
  mm[11] *= 1e6;  // J kg-1 K-1 in mJ t-1 K-1
  same_in_mm<JohnsonCook>(copper(set), mm);
  auto eos = copper_eos(set);
  eos[0] *= 1e-12;
  eos[1] *= 1e3;
  for (const std::size_t k : {4u, 7u, 8u, 9u}) eos[k] *= 1e-6;
  eos[16] *= 1e6;
  same_in_mm<JohnsonCookEos>(copper_eos(set), eos);
}

// Points of every kind, degenerate ones too: whatever the lanes, the bits of one point alone.
template <int D, class Law>
void compare_lanes(const std::vector<double>& properties, Kinematics kinematics, double dt) {
  const Law law(properties, kinematics);
  constexpr std::size_t kPoints = 600, kHistory = Law::kLaneHistory + 1;  // with the thickness
  Random random(24);
  std::vector<double> h(9 * kPoints), history(kHistory * kPoints, 0.0), volume(kPoints, 1e-9);
  const double sizes[] = {1e-12, 1e-4, 1e-3, 0.02, 0.2, 0.0};
  // A first step makes a history, then another.
  for (double& x : h) x = 0.03 * random();
  std::vector<double> p[2] = {std::vector<double>(9 * kPoints), {}},
                      energy[2] = {std::vector<double>(kPoints), {}};
  const auto arrays = [&](std::vector<double>& past, std::size_t which) {
    StressArrays a;
    a.h = h.data();
    a.volume = volume.data();
    a.dt = dt;
    std::size_t place = 0;
    for (std::size_t k = 0; k < Law::kHistory.size(); ++k) {
      a.history.base[k] = past.data() + place;
      a.history.stride[k] = kHistory;
      place += static_cast<std::size_t>(Law::kHistory[k].components);
    }
    a.p = p[which].data();
    a.energy = energy[which].data();
    return a;
  };
  const std::int64_t n = kPoints;
  update_stress_pointwise<D>(law, arrays(history, 0), 0, n);
  for (std::size_t q = 0; q < kPoints; ++q) {
    const double size = sizes[static_cast<std::size_t>(2.99 + 2.99 * random())];
    for (std::size_t k = 0; k < 9; ++k) h[9 * q + k] += size * random();
    if (q % 17 == 3) h[9 * q] = -1.2;
    if (q % 29 == 5) h[9 * q + 4] = std::numeric_limits<double>::quiet_NaN();
    if (q % 31 == 7) h[9 * q + 4] = -0.8;
    if (q % 13 == 6) volume[q] = 0;
    if (kHistory > 9 && q % 11 == 2) history[kHistory * q + 8] = 1;     // failed
    if (kHistory > 9 && q % 11 == 4) history[kHistory * q + 7] = 2000;  // molten
  }
  p[1] = p[0];
  energy[1] = energy[0];
  auto other = history;
#if defined(__GLIBC__)
  // Hosts run with traps on, NaN in the input included.
  std::feclearexcept(FE_ALL_EXCEPT);
  feenableexcept(FE_INVALID | FE_DIVBYZERO | FE_OVERFLOW);
#endif
  const StressResult one = update_stress_pointwise<D>(law, arrays(history, 0), 0, n);
  const StressResult many = update_stress<D>(law, arrays(other, 1), 0, n);
#if defined(__GLIBC__)
  std::feclearexcept(FE_ALL_EXCEPT);
  fedisableexcept(FE_INVALID | FE_DIVBYZERO | FE_OVERFLOW);
#endif
  EXPECT_EQ(one.plastic, many.plastic);
  EXPECT_EQ(one.viscous, many.viscous);
  EXPECT_EQ(one.first_failed, many.first_failed);
  EXPECT_EQ(std::memcmp(p[0].data(), p[1].data(), 9 * kPoints * sizeof(double)), 0);
  EXPECT_EQ(std::memcmp(history.data(), other.data(), kHistory * kPoints * sizeof(double)), 0);
  EXPECT_EQ(std::memcmp(energy[0].data(), energy[1].data(), kPoints * sizeof(double)), 0);
}
TEST(ImpactLaws, LanesHaveTheBitsOfOnePoint) {
  Strength set;
  set.fails = true;
  for (const double dt : {0.0, 1e-6}) {
    compare_lanes<3, JohnsonCook>(copper(set), CLEAVE_3D, dt);
    compare_lanes<2, JohnsonCook>(copper(set), CLEAVE_PLANE_STRAIN, dt);
    compare_lanes<2, JohnsonCook>(copper(set), CLEAVE_PLANE_STRESS, dt);
    compare_lanes<2, JohnsonCookEos>(copper_eos(set), CLEAVE_PLANE_STRESS, dt);
    compare_lanes<3, JohnsonCookEos>(copper_eos(set), CLEAVE_3D, dt);
    compare_lanes<3, MieGruneisen>(Shock{}.fluid(), CLEAVE_3D, dt);
  }
}

TEST(JohnsonCook, RefusesPropertiesThatDoNotFit) {
  const auto refused = [](auto change) {
    auto p = copper();
    change(p);
    const Point answer = [&] {
      double h[9] = {}, stress[9], history[11] = {}, energy = 0;
      Point out;
      out.status = cleave_material_stress(CLEAVE_MATERIAL_johnson_cook, CLEAVE_3D,
                                          static_cast<std::int64_t>(p.size()), p.data(), 0, 1, h,
                                          history, stress, &energy, nullptr);
      return out;
    }();
    EXPECT_EQ(answer.status, CLEAVE_BAD_ARGUMENT);
    return last_message();
  };
  EXPECT_NE(refused([](auto& p) { p[10] = 200; }).find("T_melt > T_room"), std::string::npos);
  EXPECT_NE(refused([](auto& p) { p[7] = 0; }).find("eps_dot_0"), std::string::npos);
  EXPECT_NE(refused([](auto& p) { p[15] = -3; }).find("D1 or D2"), std::string::npos);
  EXPECT_NE(refused([](auto& p) { p[5] = 1.5; }).find("'n'"), std::string::npos);
}

}  // namespace
}  // namespace cleave::test
