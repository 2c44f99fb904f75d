// Forces against the ordered sums as printed, on random clouds with random damage and inverted sets.
#include "formulation/peridynamics/ordered_sums.hpp"

namespace cleave::test {
namespace {

constexpr double kHorizon = 0.47;  // 1.9 cells of random_cloud with four cells a side
constexpr double kPi = 3.14159265358979323846;

struct Situation {
  unsigned seed;
  int damaged;      // one bond in so many is cut; 0: none
  double movement;  // of points, over a cell
};
constexpr Situation kSituations[] = {{1, 0, 0.05}, {2, 0, 0.8}, {3, 7, 0.05},
                                     {4, 3, 0.8},  {5, 2, 2.0}, {6, 20, 0.3}};

std::vector<double> moved(const Cloud& cloud, const Situation& s) {
  return random_field(cloud, s.movement / 4, 100 + s.seed);
}

TEST(PeridynamicForces, ThreeDimensionalCpdIsTheOrderedSum) {
  for (const auto& s : kSituations)
    for (const std::string form : {"paper", "signed"}) {
      const Cloud cloud = random_cloud(3, 4, s.seed);
      const double C1 = 3e7, C2 = -2e9, C3 = 4e11;
      CloudBody body(CLEAVE_FORMULATION_cpd, CLEAVE_3D, cloud,
                     {{"peridynamics", "horizon", kHorizon},
                      {"cpd", "C1", C1},
                      {"cpd", "C2", C2},
                      {"cpd", "C3", C3},
                      {"cpd", "negative_constants", 0, "allow"},
                      {"cpd", "three_nbr", 0, form}});
      if (s.damaged > 0) body.damage(s.damaged, s.seed);
      const auto f = body.forces(moved(cloud, s));
      const OrderedSums sums(cloud, kHorizon, body.model);
      const auto three = sums.three(C3, form == "signed");
      EXPECT_GT(largest(three), 0.01 * largest(f));
      EXPECT_LT(difference(f, plus(plus(sums.one(C1), sums.two(C2)), three)), 1e-12)
          << form << s.seed;  // measured 3e-14
    }
}

TEST(PeridynamicForces, PlaneCpdIsTheOrderedSum) {
  const double E = 2.1e5, nu = 0.3, mu = E / (2 * (1 + nu));
  for (const auto& s : kSituations)
    for (const bool stress : {false, true}) {
      const Cloud cloud = random_cloud(2, 6, s.seed);
      const double h = 0.4;
      CloudBody body(
          CLEAVE_FORMULATION_cpd, stress ? CLEAVE_PLANE_STRESS : CLEAVE_PLANE_STRAIN, cloud,
          {{"peridynamics", "horizon", h}, {"cpd", "negative_constants", 0, "allow"}}, E, nu);
      if (s.damaged > 0) body.damage(s.damaged, s.seed);
      const auto f = body.forces(moved(cloud, s));
      const double lambda = stress ? E * nu / (1 - nu * nu) : E * nu / ((1 + nu) * (1 - 2 * nu));
      const OrderedSums sums(cloud, h, body.model);
      const auto two = sums.two(27 * (lambda - mu) / (8 * kPi * std::pow(h, 6)));
      EXPECT_GT(largest(two), 1e-3 * largest(f));
      EXPECT_LT(difference(f, plus(sums.one(24 * mu / (kPi * std::pow(h, 3))), two)),
                1e-12);  // measured 3e-14
    }
}

TEST(PeridynamicForces, BondBasedIsTheSumOfItsBonds) {
  const double E = 2.1e5;
  for (const auto& s : kSituations) {
    const Cloud cloud = random_cloud(3, 4, s.seed);
    CloudBody body(CLEAVE_FORMULATION_bond_pd, CLEAVE_3D, cloud,
                   {{"peridynamics", "horizon", kHorizon}}, E, 0.25);
    if (s.damaged > 0) body.damage(s.damaged, s.seed);
    const auto f = body.forces(moved(cloud, s));
    const OrderedSums sums(cloud, kHorizon, body.model);
    const double K = E / 1.5;
    EXPECT_LT(difference(f, sums.bonds(18 * K / (kPi * std::pow(kHorizon, 4)))),
              1e-12);  // measured 2e-14
  }
}

TEST(PeridynamicForces, StateBasedSolidIsThatOfItsPaper) {
  const double E = 2.1e5, nu = 0.2;
  const double K = E / (3 * (1 - 2 * nu)), mu = E / (2 * (1 + nu));
  for (const auto& s : kSituations) {
    const Cloud cloud = random_cloud(3, 4, s.seed);
    CloudBody body(CLEAVE_FORMULATION_lps, CLEAVE_3D, cloud,
                   {{"peridynamics", "horizon", kHorizon}}, E, nu);
    if (s.damaged > 0) body.damage(s.damaged, s.seed);
    const auto f = body.forces(moved(cloud, s));
    const OrderedSums sums(cloud, kHorizon, body.model);
    const double energy = sums.state_based_energy(K, mu);
    EXPECT_NEAR(body.model.energies().elastic, energy, 1e-12 * energy);  // measured 1e-15
    if (s.damaged > 0) continue;
    EXPECT_LT(difference(f, sums.state_based(K, mu)), 1e-12);  // measured 2e-14
  }
}

// The smallest bar: three points in a row.
TEST(PeridynamicForces, BarHasTheOneDimensionalConstant) {
  const double E = 2.1e5, A = 0.3, h = 1.6;
  Cloud bar{2, {}, {}};
  for (int i = 0; i < 9; ++i) {
    bar.X.push_back({1.0 * i, 0, 0});
    bar.volume.push_back(A);
  }
  for (const int32_t formulation : {CLEAVE_FORMULATION_bond_pd, CLEAVE_FORMULATION_cpd}) {
    CloudBody body(formulation, CLEAVE_PLANE_STRESS, bar,
                   {{"peridynamics", "horizon", h}, {"peridynamics", "section", A}}, E, 0.3);
    std::vector<double> u(27, 0.0);
    u[12] = 0.01;
    const auto f = body.forces(u);
    const double c = 2 * E / (A * h * h);
    // cpd: V_H/N1 = 3 A/2 inside instead of A
    const double volume = formulation == CLEAVE_FORMULATION_cpd ? 1.5 * A : A;
    EXPECT_NEAR(f[12], -2 * c * A * volume * 0.01, 1e-12 * std::fabs(f[12]));
    EXPECT_NEAR(f[9], c * A * volume * 0.01, 1e-12 * f[9]);
    EXPECT_EQ(f[13], 0.0);
  }
}

// Away from the bounds of exactness the conservative forms stay gradients of their energy.
TEST(PeridynamicForces, AreGradientsOfTheEnergyWithDamageAndInversion) {
  for (const auto& s : kSituations)
    for (const int32_t formulation :
         {CLEAVE_FORMULATION_bond_pd, CLEAVE_FORMULATION_cpd, CLEAVE_FORMULATION_lps})
      for (const int dimension : {2, 3}) {
        const Cloud cloud = random_cloud(dimension, dimension == 2 ? 6 : 4, s.seed);
        const auto body = [&](CloudBody& made, const std::vector<double>& u) {
          if (s.damaged > 0) made.damage(s.damaged, s.seed);
          return made.forces(u);
        };
        const double h = dimension == 2 ? 0.4 : kHorizon;
        std::vector<Setting> settings = {{"peridynamics", "horizon", h}};
        if (formulation == CLEAVE_FORMULATION_cpd)
          settings.push_back({"cpd", "weights", 0, "conservative"});
        const double nu = formulation == CLEAVE_FORMULATION_bond_pd ? 0.25 : 0.3;
        const int32_t kinematics = dimension == 2 ? CLEAVE_PLANE_STRAIN : CLEAVE_3D;
        const auto u = moved(cloud, s);
        CloudBody at(formulation, kinematics, cloud, settings, 2.1e5, nu);
        const auto f = body(at, u);
        const auto energy = [&](const std::vector<double>& v) {
          CloudBody there(formulation, kinematics, cloud, settings, 2.1e5, nu);
          body(there, v);
          return there.model.energies().elastic;
        };
        const double step = 1e-6;
        for (std::size_t k = 0; k < u.size(); k += 17) {
          if (static_cast<int>(k % 3) >= dimension) continue;
          auto plus = u, minus = u;
          plus[k] += step;
          minus[k] -= step;
          EXPECT_NEAR(f[k], -(energy(plus) - energy(minus)) / (2 * step), 1e-7 * largest(f))
              << formulation << ' ' << dimension << ' ' << s.seed;  // measured 3e-9
        }
        Point sum{}, torque{};
        const auto x = at.model.real("position");
        for (std::size_t i = 0; i < cloud.size(); ++i) {
          const Point force{f[3 * i], f[3 * i + 1], f[3 * i + 2]};
          sum = sum + force;
          torque = torque + cross({x[3 * i], x[3 * i + 1], x[3 * i + 2]}, force);
        }
        EXPECT_LT(norm(sum), 1e-12 * largest(f));     // measured 1e-14
        EXPECT_LT(norm(torque), 1e-12 * largest(f));  // measured 1e-14
      }
}

}  // namespace
}  // namespace cleave::test
