// Bodies of several materials: what bonds and sets between them do, when they fail, and what is refused.
#include <functional>

#include "formulation/peridynamics/ordered_sums.hpp"

namespace cleave::test {
namespace {

constexpr double kHorizon = 0.47;  // 1.9 cells of random_cloud with four cells a side
constexpr double kPi = 3.14159265358979323846;

struct Elastic {
  double E, nu, rho;
  double bulk() const { return E / (3 * (1 - 2 * nu)); }
  double mu() const { return E / (2 * (1 + nu)); }
  double C1(double h) const { return 30 * mu() / (kPi * std::pow(h, 4)); }
  double C3(double h) const {
    const double lambda = bulk() - 2.0 / 3 * mu();
    return 32 * (lambda - mu()) / (std::pow(kPi, 4) * std::pow(h, 12));
  }
};
const Elastic kSoft{2e5, 0.3, 8e-9}, kStiff{9e5, 0.4, 3e-9};
const Elastic kSoftBonds{2e5, 0.25, 8e-9}, kStiffBonds{9e5, 0.25, 3e-9};

bool stiff(const Point& X) { return X[0] > 0.45; }

// `soft` with the points of the right half of a unit box, or of `chosen`, of another material.
struct TwoMaterials {
  TwoMaterials(int32_t formulation, int32_t kinematics, const Cloud& cloud,
               const std::vector<Setting>& settings, const Elastic& soft, const Elastic& other,
               double critical_strain = 0, double Gf = 0,
               const std::function<bool(const Point&)>& chosen = stiff)
      : body(formulation, kinematics, cloud, settings, {soft.E, soft.nu, soft.rho},
             [&](Model& model) {
               for (std::size_t i = 0; i < cloud.size(); ++i)
                 if (chosen(cloud.X[i])) points.push_back(static_cast<int64_t>(i));
               const double properties[3] = {other.rho, other.E, other.nu};
               status = cleave_body_region(model, 0, std::ssize(points), points.data(),
                                           CLEAVE_MATERIAL_linear_elastic, 3, properties,
                                           critical_strain, Gf);
               if (status != CLEAVE_OK) said = last_message();
             }) {}
  std::vector<int64_t> points;
  int32_t status = 0;
  std::string said;
  CloudBody body;
};

void expect_no_resultant(const std::vector<double>& f) {
  Point sum{};
  for (std::size_t i = 0; i < f.size() / 3; ++i)
    sum = sum + Point{f[3 * i], f[3 * i + 1], f[3 * i + 2]};
  EXPECT_LT(norm(sum), 1e-12 * largest(f));  // measured 1e-14
}

TEST(PeridynamicRegions, BondsBetweenMaterialsAreSpringsInSeriesOrTheirMean) {
  for (const unsigned seed : {1u, 4u})
    for (const std::string rule : {"series", "mean"}) {
      const Cloud cloud = random_cloud(3, 4, seed);
      TwoMaterials two(
          CLEAVE_FORMULATION_bond_pd, CLEAVE_3D, cloud,
          {{"peridynamics", "horizon", kHorizon}, {"peridynamics", "interface", 0, rule}},
          kSoftBonds, kStiffBonds);
      two.body.damage(7, seed);
      const auto f = two.body.forces(random_field(cloud, 0.1, seed));
      const auto c = [&](std::size_t i, std::size_t j) {
        const auto own = [&](std::size_t k) {
          return (stiff(cloud.X[k]) ? kStiffBonds : kSoftBonds).C1(kHorizon);
        };
        return rule == "mean" ? 0.5 * (own(i) + own(j)) : 2 / (1 / own(i) + 1 / own(j));
      };
      EXPECT_LT(difference(f, OrderedSums(cloud, kHorizon, two.body.model).bonds(c)),
                1e-12);  // measured 2e-14
      expect_no_resultant(f);
    }
}

TEST(PeridynamicRegions, StatesAreThoseOfTheMaterialOfThePoint) {
  const Cloud cloud = random_cloud(3, 4, 2);
  TwoMaterials two(CLEAVE_FORMULATION_lps, CLEAVE_3D, cloud,
                   {{"peridynamics", "horizon", kHorizon}}, kSoft, kStiff);
  const auto f = two.body.forces(random_field(cloud, 0.1, 3));
  const auto moduli = [&](std::size_t i) {
    const Elastic& e = stiff(cloud.X[i]) ? kStiff : kSoft;
    return std::array{e.bulk(), e.mu()};
  };
  EXPECT_LT(difference(f, OrderedSums(cloud, kHorizon, two.body.model).state_based(moduli)),
            1e-12);  // measured 2e-14
  expect_no_resultant(f);
}

TEST(PeridynamicRegions, SetsOfSeveralMaterialsHaveTheMeanOfTheirWeights) {
  for (const unsigned seed : {1u, 5u}) {
    const Cloud cloud = random_cloud(3, 4, seed);
    TwoMaterials two(CLEAVE_FORMULATION_cpd, CLEAVE_3D, cloud,
                     {{"peridynamics", "horizon", kHorizon}, {"cpd", "weights", 0, "conservative"}},
                     kSoft, kStiff);
    two.body.damage(7, seed);
    const auto f = two.body.forces(random_field(cloud, 0.1, seed));
    std::vector<double> C1, C3;
    for (const Point& X : cloud.X) {
      C1.push_back((stiff(X) ? kStiff : kSoft).C1(kHorizon));
      C3.push_back((stiff(X) ? kStiff : kSoft).C3(kHorizon));
    }
    const auto expected = OrderedSums(cloud, kHorizon, two.body.model).conservative(C1, C3, false);
    EXPECT_LT(difference(f, expected), 1e-12);  // measured 3e-14
    expect_no_resultant(f);
  }
}

// In both plane conditions, with broken bonds and sets of several materials.
TEST(PeridynamicRegions, PlaneForcesAreGradientsOfTheEnergy) {
  for (const int32_t formulation :
       {CLEAVE_FORMULATION_bond_pd, CLEAVE_FORMULATION_cpd, CLEAVE_FORMULATION_lps})
    for (const int32_t kinematics : {CLEAVE_PLANE_STRAIN, CLEAVE_PLANE_STRESS}) {
      const Cloud cloud = random_cloud(2, 6, 5);
      std::vector<Setting> settings = {{"peridynamics", "horizon", 0.4},
                                       {"peridynamics", "modulus", 0, "bulk"}};
      if (formulation == CLEAVE_FORMULATION_cpd) {
        settings.push_back({"cpd", "weights", 0, "conservative"});
        settings.push_back({"cpd", "negative_constants", 0, "allow"});
      }
      const auto at = [&](const std::vector<double>& u) {
        auto two =
            std::make_unique<TwoMaterials>(formulation, kinematics, cloud, settings, kSoft, kStiff);
        two->body.damage(9, 2);
        two->body.forces(u);
        return two;
      };
      const auto u = random_field(cloud, 0.02, 6);
      const auto f = at(u)->body.model.real("internal_force");
      const double step = 1e-6;
      for (std::size_t k = 0; k < u.size(); k += 7) {
        if (k % 3 == 2) continue;
        auto plus = u, minus = u;
        plus[k] += step;
        minus[k] -= step;
        const double slope =
            (at(plus)->body.model.energies().elastic - at(minus)->body.model.energies().elastic) /
            (2 * step);
        EXPECT_NEAR(f[k], -slope, 1e-7 * largest(f)) << formulation << ' ' << kinematics;
      }
      expect_no_resultant(f);
    }
}

TEST(PeridynamicRegions, OneMaterialInTwoRegionsIsOneMaterial) {
  for (const int32_t formulation :
       {CLEAVE_FORMULATION_bond_pd, CLEAVE_FORMULATION_cpd, CLEAVE_FORMULATION_lps}) {
    const Cloud cloud = random_cloud(2, 8, 3);
    std::vector<Setting> settings = {{"peridynamics", "horizon", 0.33}};
    if (formulation == CLEAVE_FORMULATION_cpd)
      settings.push_back({"cpd", "weights", 0, "conservative"});
    const auto u = random_field(cloud, 0.01, 9);
    TwoMaterials two(formulation, CLEAVE_PLANE_STRAIN, cloud, settings, kSoftBonds, kSoftBonds);
    CloudBody one(formulation, CLEAVE_PLANE_STRAIN, cloud, settings, kSoftBonds.E, kSoftBonds.nu,
                  kSoftBonds.rho);
    EXPECT_LT(difference(two.body.forces(u), one.forces(u)), 1e-13);  // measured 1e-15
    EXPECT_NEAR(two.body.model.stable_step() / one.model.stable_step(), 1, 1e-13);
    const auto region = two.body.model.integer("region");
    for (std::size_t i = 0; i < cloud.size(); ++i) EXPECT_EQ(region[i], stiff(cloud.X[i]) ? 1 : 0);
  }
}

TEST(PeridynamicRegions, MassesAndThicknessAreThoseOfTheRegion) {
  const Cloud cloud = lattice_cloud(8, 6, 0, 0.1);
  TwoMaterials two(CLEAVE_FORMULATION_lps, CLEAVE_PLANE_STRESS, cloud,
                   {{"peridynamics", "horizon", 0.25}}, kSoft, kStiff);
  std::vector<double> u;
  for (const Point& X : cloud.X) u.insert(u.end(), {1e-3 * X[0], 1e-3 * X[1], 0});
  two.body.forces(u);
  const auto mass = two.body.model.real("mass");
  two.body.model.real("cauchy_stress");
  const auto F = two.body.model.real("deformation_gradient");
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    const Elastic& e = stiff(cloud.X[i]) ? kStiff : kSoft;
    EXPECT_NEAR(mass[i] / (e.rho * 0.01), 1, 1e-14);
    EXPECT_NEAR((F[9 * i + 8] - 1) / (-e.nu / (1 - e.nu) * 2e-3), 1, 1e-9);
  }
  double speed = 0;
  ok(cleave_body_wave_speed(two.body.model, 0, &speed));
  EXPECT_NEAR(speed / std::sqrt(kStiff.E / ((1 - 0.16) * kStiff.rho)), 1, 1e-12);
}

// Limits of the bonds that break when all are pulled, by the materials of their ends: both soft, mixed, both stiff.
std::array<double, 3> limits(const std::vector<Setting>& more, double critical_strain, double Gf) {
  const Cloud cloud = lattice_cloud(10, 5, 0, 0.1);
  std::vector<Setting> settings = {{"peridynamics", "horizon", 0.22}};
  settings.insert(settings.end(), more.begin(), more.end());
  TwoMaterials two(CLEAVE_FORMULATION_bond_pd, CLEAVE_PLANE_STRAIN, cloud, settings, kSoftBonds,
                   kStiffBonds, critical_strain, Gf);
  std::vector<double> v;
  const double dt = 1e-12;
  for (const Point& X : cloud.X) v.insert(v.end(), {0.5 / dt * X[0], 0.5 / dt * X[1], 0});
  two.body.model.put("velocity", v);
  two.body.model.initialise();
  two.body.model.step(dt);
  std::array<double, 3> limit{};
  int64_t count = 0;
  ok(cleave_body_event_count(two.body.model, 0, &count));
  for (int64_t k = 0; k < count; ++k) {
    cleave_event e{};
    e.size = sizeof e;
    ok(cleave_body_event_get(two.body.model, 0, k, &e));
    const std::size_t kind = (stiff(cloud.X[static_cast<std::size_t>(e.first)]) ? 1u : 0u) +
                             (stiff(cloud.X[static_cast<std::size_t>(e.second)]) ? 1u : 0u);
    EXPECT_TRUE(limit[kind] == 0 || limit[kind] == e.limit) << e.limit;
    limit[kind] = e.limit;
    EXPECT_GT(e.criterion, e.limit);
  }
  return limit;
}

TEST(PeridynamicRegions, BondsBetweenMaterialsFailAsTheWeakerOrAsTheInterfaceSays) {
  const Setting common{"fracture", "critical_strain", 0.01};
  EXPECT_EQ(limits({common}, 0, 0), (std::array{0.01, 0.01, 0.01}));
  EXPECT_EQ(limits({common}, 0.002, 0), (std::array{0.01, 0.002, 0.002}));
  EXPECT_EQ(limits({common}, 0.02, 0), (std::array{0.01, 0.01, 0.02}));
  EXPECT_EQ(limits({common, {"peridynamics", "interface_strain", 0.001}}, 0.02, 0),
            (std::array{0.01, 0.001, 0.02}));
  // Only the region breaks, and what hangs on it; only the interface.
  EXPECT_EQ(limits({}, 0.02, 0), (std::array{0.0, 0.02, 0.02}));
  EXPECT_EQ(limits({{"peridynamics", "interface_strain", 0.004}}, 0, 0),
            (std::array{0.0, 0.004, 0.0}));
  // One fracture energy, two moduli; another energy for the region.
  const auto griffith = [](double Gf, double mu) { return std::sqrt(kPi * Gf / (6 * mu * 0.22)); };
  const double soft = griffith(3, kSoftBonds.mu()), hard = griffith(3, kStiffBonds.mu());
  const auto same = limits({{"fracture", "Gf", 3}}, 0, 0),
             own = limits({{"fracture", "Gf", 3}}, 0, 5);
  EXPECT_NEAR(same[0] / soft, 1, 1e-12);
  EXPECT_NEAR(same[1] / hard, 1, 1e-12);
  EXPECT_NEAR(same[2] / hard, 1, 1e-12);
  EXPECT_NEAR(own[2] / griffith(5, kStiffBonds.mu()), 1, 1e-12);
}

TEST(PeridynamicRegions, StepIsStableWhereMaterialsMeet) {
  const Elastic light{4e5, 0.3, 1e-9}, heavy{2e4, 0.3, 9e-9};
  const auto growth = [&](int32_t formulation, double factor) {
    const Cloud cloud = random_cloud(3, 5, 2);
    std::vector<Setting> settings = {{"peridynamics", "horizon", 0.44},
                                     {"peridynamics", "modulus", 0, "shear"}};
    if (formulation == CLEAVE_FORMULATION_cpd)
      settings.push_back({"cpd", "weights", 0, "conservative"});
    TwoMaterials two(formulation, CLEAVE_3D, cloud, settings, heavy, light);
    Model& model = two.body.model;
    model.put("velocity", random_field(cloud, 1e-3, 7));
    model.initialise();
    const double start = model.energies().kinetic, dt = factor * model.stable_step();
    for (int n = 1; n <= 200; ++n) {
      ok(cleave_model_advance(model, dt, n * dt));
      if (cleave_model_update(model) != CLEAVE_OK) return 1e300;  // not finite
    }
    return (model.energies().kinetic + model.energies().elastic) / start;
  };
  for (const int32_t formulation :
       {CLEAVE_FORMULATION_bond_pd, CLEAVE_FORMULATION_cpd, CLEAVE_FORMULATION_lps}) {
    EXPECT_LT(growth(formulation, 1.0), 3) << formulation;
    EXPECT_GT(growth(formulation, 2.5), 1e6) << formulation;
  }
}

TEST(PeridynamicRegions, WhatCannotBeIsRefusedWithTheRemedy) {
  const Cloud cloud = lattice_cloud(6, 5, 4, 0.2);
  const std::vector<Setting> usual = {{"peridynamics", "horizon", 0.45}};
  const auto says = [](const std::string& text, const std::string& part) {
    EXPECT_NE(text.find(part), std::string::npos) << part << ": " << text;
  };
  const auto with = [&](std::vector<Setting> more) {
    more.insert(more.end(), usual.begin(), usual.end());
    return more;
  };
  TwoMaterials paper(CLEAVE_FORMULATION_cpd, CLEAVE_3D, cloud, usual, kSoft, kStiff);
  says(paper.body.refusal,
       "the weights of the paper do not keep momentum where they meet; set weights = "
       "'conservative'");
  TwoMaterials given(CLEAVE_FORMULATION_cpd, CLEAVE_3D, cloud,
                     with({{"cpd", "weights", 0, "conservative"}, {"cpd", "C3", 1}}), kSoft,
                     kStiff);
  says(given.body.refusal, "gives C3, but there are several materials");
  TwoMaterials ratio(CLEAVE_FORMULATION_bond_pd, CLEAVE_3D, cloud, usual, kSoftBonds, kStiff);
  says(ratio.body.refusal,
       "body 0 'cloud', region 1: nu = 0.4, but bond-based peridynamics has nu = 0.25");
  TwoMaterials negative(CLEAVE_FORMULATION_cpd, CLEAVE_3D, cloud,
                        with({{"cpd", "weights", 0, "conservative"}}), kSoft, {1, 0.1, 1});
  says(negative.body.refusal, "region 1: nu = 0.1 makes C3 = -");
  TwoMaterials both(CLEAVE_FORMULATION_lps, CLEAVE_3D, cloud, usual, kSoft, kStiff, 0.1, 2);
  EXPECT_EQ(both.status, CLEAVE_BAD_ARGUMENT);
  says(both.said, "critical_strain is 0.1, Gf is 2; allowed: one of them > 0");
  TwoMaterials bad(CLEAVE_FORMULATION_lps, CLEAVE_3D, cloud, usual, kSoft, {1, 0.6, 1});
  EXPECT_EQ(bad.status, CLEAVE_BAD_ARGUMENT);
  says(bad.said, "nu");
  Model model;
  model.add({CLEAVE_FORMULATION_cbm, CLEAVE_MATERIAL_svk, CLEAVE_3D}, patch(3, 2, 1.0, 0.1, 6));
  const int64_t first = 0;
  const double properties[3] = {1, 1, 0.2};
  EXPECT_EQ(cleave_body_region(model, 0, 1, &first, CLEAVE_MATERIAL_svk, 3, properties, 0, 0),
            CLEAVE_UNSUPPORTED);
  says(last_message(), "has one material in a body; use bond_pd, cpd or lps, or two bodies");
}

}  // namespace
}  // namespace cleave::test
