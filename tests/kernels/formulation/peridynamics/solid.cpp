// Constants, stress, failure and step of peridynamic bodies.
#include "formulation/peridynamics/clouds.hpp"

namespace cleave::test {
namespace {

constexpr std::array kFormulations = {CLEAVE_FORMULATION_bond_pd, CLEAVE_FORMULATION_cpd,
                                      CLEAVE_FORMULATION_lps};

std::vector<Setting> settings_of(int32_t formulation, double horizon) {
  std::vector<Setting> settings = {{"peridynamics", "horizon", horizon}};
  if (formulation == CLEAVE_FORMULATION_cpd)
    settings.push_back({"cpd", "weights", 0, "conservative"});
  return settings;
}
double ratio_of(int32_t formulation) {
  return formulation == CLEAVE_FORMULATION_bond_pd ? 0.25 : 0.3;
}

// The published numbers: mm, N.
TEST(PeridynamicSolid, ConstantsAreThoseOfThePaper) {
  struct Published {
    double E, nu, horizon, C1, C3;
  };
  for (const auto& p : {Published{210000, 0.25, 0.0675, 3.863986e10, 0},
                        Published{190000, 0.3, 3.391875, 5.272205e3, 5.176339e-3}}) {
    const Cloud cloud = lattice_cloud(6, 6, 6, p.horizon / 2.7);
    const auto u = random_field(cloud, 0.1 * p.horizon, 2);
    CloudBody own(CLEAVE_FORMULATION_cpd, CLEAVE_3D, cloud,
                  {{"peridynamics", "horizon", p.horizon}}, p.E, p.nu);
    CloudBody given(
        CLEAVE_FORMULATION_cpd, CLEAVE_3D, cloud,
        {{"peridynamics", "horizon", p.horizon}, {"cpd", "C1", p.C1}, {"cpd", "C3", p.C3}}, 1.0,
        0.4);
    EXPECT_LT(difference(own.forces(u), given.forces(u)), 2e-7);  // seven digits are printed
    EXPECT_EQ(own.model.real("interactions")[2] > 0, p.C3 != 0);
  }
}

// The factor that makes the volumetric energy of a full neighbourhood that of the solid: measured by the
// energy density of a hydrostatic strain inside.
TEST(PeridynamicSolid, CalibratedEnergyIsThatOfTheMaterial) {
  const double E = 2.1e5, nu = 0.35, K = E / (3 * (1 - 2 * nu)), strain = 1e-6;
  const auto bulk = [&](double reach, const std::string& calibration, const std::string& volume) {
    const int n = 2 * static_cast<int>(reach) + 5;
    const Cloud cloud = lattice_cloud(n, n, n, 1.0);
    CloudBody body(CLEAVE_FORMULATION_cpd, CLEAVE_3D, cloud,
                   {{"peridynamics", "horizon", reach},
                    {"cpd", "hood_volume", 0, volume},
                    {"cpd", "c3_calibration", 0, calibration}},
                   E, nu);
    std::vector<double> u;
    for (const Point& X : cloud.X)
      for (const double x : X) u.push_back(strain * x);
    body.forces(u);
    return body.model.real("strain_energy_density")[cloud.size() / 2] / (4.5 * K * strain * strain);
  };
  // What the published constants deliver: lambda - mu is 0.81 to 1.0 of the intended one.
  EXPECT_NEAR(bulk(3.015, "paper", "sphere"), 0.94, 0.03);
  // Left is the error of the bonds on the lattice, -2.5 to 7.7 % of their part.
  EXPECT_NEAR(bulk(2.7, "energy", "sphere"), 1, 0.02);
  EXPECT_NEAR(bulk(3.015, "energy", "sphere"), 1, 0.04);
  EXPECT_NEAR(bulk(3.015, "energy", "sum"), 1, 0.06);
}

// For any formulation: sum v_i P_i : dH is the change of the energy with an affine deformation.
TEST(PeridynamicSolid, StressIsTheDerivativeOfTheEnergyByTheDeformation) {
  for (const int32_t formulation : kFormulations)
    for (const int dimension : {2, 3}) {
      const Cloud cloud = random_cloud(dimension, dimension == 2 ? 8 : 5, 3);
      const double h = dimension == 2 ? 0.33 : 0.4;
      const int32_t kinematics = dimension == 2 ? CLEAVE_PLANE_STRAIN : CLEAVE_3D;
      const auto at = [&](double t) {
        std::vector<double> u;
        for (const Point& X : cloud.X) {
          u.push_back((0.03 + 0.7 * t) * X[0] + (0.02 - 0.4 * t) * X[1]);
          u.push_back(0.01 * X[0] + (0.3 * t - 0.05) * X[1]);
          u.push_back(dimension == 2 ? 0.0 : 0.2 * t * X[0] + (0.04 + 0.5 * t) * X[2]);
        }
        auto body =
            std::make_unique<CloudBody>(formulation, kinematics, cloud, settings_of(formulation, h),
                                        2.1e5, ratio_of(formulation));
        body->damage(6, 4);
        body->forces(u);
        return body;
      };
      const auto body = at(0);
      EXPECT_EQ(largest(body->model.real("first_piola_kirchhoff_stress")),
                0);  // until it is asked for
      body->model.real("cauchy_stress");
      const auto P = body->model.real("first_piola_kirchhoff_stress");
      const double rate[9] = {0.7, 0, dimension == 2 ? 0.0 : 0.2, -0.4, 0.3, 0,
                              0,   0, dimension == 2 ? 0.0 : 0.5};
      double power = 0;
      for (std::size_t i = 0; i < cloud.size(); ++i)
        for (std::size_t c = 0; c < 9; ++c) power += cloud.volume[i] * P[9 * i + c] * rate[c];
      const double step = 1e-5;
      EXPECT_NEAR(
          power,
          (at(step)->model.energies().elastic - at(-step)->model.energies().elastic) / (2 * step),
          1e-7 * std::fabs(power))
          << formulation << ' ' << dimension;  // measured 1e-9
    }
}

TEST(PeridynamicSolid, HydrostaticStressInsideIsThatOfTheMaterial) {
  const double E = 2.1e5, nu = 0.3, strain = 1e-4;
  const Cloud cloud = lattice_cloud(9, 9, 9, 1.0);
  CloudBody body(CLEAVE_FORMULATION_lps, CLEAVE_3D, cloud, {{"peridynamics", "horizon", 3.015}}, E,
                 nu);
  std::vector<double> u;
  for (const Point& X : cloud.X)
    for (const double x : X) u.push_back(strain * x);
  body.forces(u);
  const auto pressure = body.model.real("pressure");
  const double K = E / (3 * (1 - 2 * nu)), F = 1 + strain;
  EXPECT_NEAR(pressure[cloud.size() / 2], -3 * K * strain / (F * F), 1e-9 * K * strain);
  EXPECT_NEAR(body.model.real("equivalent_stress")[cloud.size() / 2], 0, 1e-9 * K * strain);
  EXPECT_NEAR(body.model.real("green_lagrange_strain")[0], strain + 0.5 * strain * strain, 1e-13);
}

// Stretches a row of the cloud by its velocity and returns the events.
std::vector<cleave_event> pulled_apart(CloudBody& body, const Cloud& cloud, double rate,
                                       int steps) {
  std::vector<double> v;
  for (const Point& X : cloud.X) v.insert(v.end(), {rate * X[0], 0, 0});
  body.model.put("velocity", v);
  body.model.initialise();
  const double dt = 0.5 * body.model.stable_step();
  for (int n = 0; n < steps; ++n) body.model.step(dt);
  int64_t count = 0;
  ok(cleave_body_event_count(body.model, 0, &count));
  std::vector<cleave_event> events(static_cast<std::size_t>(count));
  for (int64_t k = 0; k < count; ++k) {
    auto& e = events[static_cast<std::size_t>(k)];
    e.size = sizeof e;
    ok(cleave_body_event_get(body.model, 0, k, &e));
  }
  return events;
}

double limit_of(int32_t kinematics, const std::string& relation, double nu = 0.25) {
  const double E = 210000, horizon = 0.0675;
  const Cloud cloud = lattice_cloud(12, 6, kinematics == CLEAVE_3D ? 4 : 0, 0.025);
  std::vector<Setting> settings = {{"peridynamics", "horizon", horizon},
                                   {"fracture", "Gf", 2.7},
                                   {"fracture", "relation", 0, relation}};
  CloudBody body(CLEAVE_FORMULATION_bond_pd, kinematics, cloud, settings, E, nu);
  const auto events = pulled_apart(body, cloud, 3e6, 40);
  EXPECT_GT(events.size(), 0u);
  for (const auto& e : events) {
    EXPECT_GT(e.criterion, e.limit);
    EXPECT_EQ(e.limit, events.front().limit);
  }
  return events.empty() ? 0 : events.front().limit;
}

TEST(PeridynamicSolid, CriticalStretchFollowsFromTheFractureEnergy) {
  const double E = 210000, d = 0.0675, G = 2.7, pi = 3.14159265358979323846;
  EXPECT_NEAR(limit_of(CLEAVE_3D, "dimension"), 0.012599,
              1e-6);  // printed digits of the theory page
  EXPECT_NEAR(limit_of(CLEAVE_3D, "paper1d"), 0.016903, 1e-6);
  EXPECT_NEAR(limit_of(CLEAVE_PLANE_STRAIN, "dimension"), std::sqrt(pi * G / (6 * E / 2.5 * d)),
              1e-12);
  EXPECT_NEAR(limit_of(CLEAVE_PLANE_STRESS, "dimension", 1.0 / 3),
              std::sqrt(4 * pi * G / (9 * E * d)), 1e-12);
}

// The energy of all bonds across a unit of a plane is Gf, up to the lattice: factor 0.956 at 2.7 spacings when
// 80 neighbours share the volume of the ball; here each has its own.
TEST(PeridynamicSolid, BondsAcrossAPlaneTakeTheFractureEnergy) {
  const double E = 2.1e5, dx = 1, h = 2.7, critical = 0.01;
  const int n = 10;
  const Cloud cloud = lattice_cloud(n, n, n, dx);
  CloudBody body(CLEAVE_FORMULATION_bond_pd, CLEAVE_3D, cloud, {{"peridynamics", "horizon", h}}, E,
                 0.25);
  // Energy of a bond at the critical stretch, for those through a column in the middle.
  const double pi = 3.14159265358979323846, c = 18 * (E / 1.5) / (pi * h * h * h * h);
  double sum = 0;
  const auto ends = body.model.integer("bond_ends");
  for (std::size_t b = 0; b < ends.size() / 2; ++b) {
    const Point& X = cloud.X[static_cast<std::size_t>(ends[2 * b])];
    const Point& Y = cloud.X[static_cast<std::size_t>(ends[2 * b + 1])];
    if ((X[0] > 5) == (Y[0] > 5)) continue;
    const double share =
        (X[1] == 4.5 && X[2] == 4.5 ? 0.5 : 0) + (Y[1] == 4.5 && Y[2] == 4.5 ? 0.5 : 0);
    sum += share * 0.5 * c * critical * critical * norm(Y - X);
  }
  const double Gf = 9.0 / 5 * (E / 1.5) * h * critical * critical;
  EXPECT_NEAR(sum / Gf, 0.956 * 80 / (4 * pi / 3 * h * h * h), 0.001);
}

TEST(PeridynamicSolid, ZonesAndDrivenPointsDoNotFail) {
  const Cloud cloud = lattice_cloud(14, 6, 0, 1.0);
  for (const int32_t formulation : kFormulations) {
    CloudBody free(formulation, CLEAVE_PLANE_STRAIN, cloud,
                   {{"peridynamics", "horizon", 2.2}, {"fracture", "critical_strain", 0.01}}, 1.0,
                   ratio_of(formulation), 1.0);
    EXPECT_GT(pulled_apart(free, cloud, 0.02, 40).size(), 50u);
  }
  Model model;
  cleave_body_spec spec;
  ok(cleave_body_spec_init(&spec));
  spec.formulation = CLEAVE_FORMULATION_bond_pd;
  spec.kinematics = CLEAVE_PLANE_STRAIN;
  spec.material = CLEAVE_MATERIAL_linear_elastic;
  spec.particles = static_cast<int64_t>(cloud.size());
  spec.X = cloud.X.data()->data();
  int64_t body = 0;
  ok(cleave_body_add(model, &spec, &body));
  ok(cleave_body_volumes(model, 0, spec.particles, cloud.volume.data()));
  model.set(0, {{"material", "E", 1},
                {"material", "nu", 0.25},
                {"material", "rho", 1},
                {"peridynamics", "horizon", 2.2},
                {"fracture", "critical_strain", 0.01}});
  std::vector<int64_t> zone, driven;
  std::vector<int32_t> directions, motions;
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    if (cloud.X[i][0] > 9) zone.push_back(static_cast<int64_t>(i));
    if (cloud.X[i][0] > 3) continue;
    for (const int32_t k : {0, 1}) {
      driven.push_back(static_cast<int64_t>(i));
      directions.push_back(k);
      motions.push_back(CLEAVE_MOTION_ACCELERATION);
    }
  }
  ok(cleave_body_exempt(model, 0, static_cast<int64_t>(zone.size()), zone.data()));
  ok(cleave_body_prescribe(model, 0, static_cast<int64_t>(driven.size()), driven.data(),
                           directions.data(), motions.data()));
  model.setup();
  std::vector<double> v;
  for (const Point& X : cloud.X) v.insert(v.end(), {0.02 * X[0], 0, 0});
  model.put("velocity", v);
  model.initialise();
  const double dt = 0.5 * model.stable_step();
  for (int n = 0; n < 40; ++n) model.step(dt);
  const auto ends = model.integer("bond_ends"), status = model.integer("bond_status");
  int outside = 0;
  for (std::size_t b = 0; b < status.size(); ++b) {
    const double x = cloud.X[static_cast<std::size_t>(ends[2 * b])][0],
                 y = cloud.X[static_cast<std::size_t>(ends[2 * b + 1])][0];
    const bool safe = std::max(x, y) > 9 || std::max(x, y) < 3;
    EXPECT_FALSE(safe && status[b] == 1) << x << ' ' << y;
    outside += !safe && status[b] == 1;
  }
  EXPECT_GT(outside, 20);
}

TEST(PeridynamicSolid, BadCloudsAreRefusedWithNumbersAndRemedy) {
  const Cloud good = lattice_cloud(6, 5, 4, 0.1);
  const auto answer = [](const Cloud& cloud, const std::vector<Setting>& settings, double nu) {
    std::string refusal;
    CloudBody(CLEAVE_FORMULATION_cpd, CLEAVE_3D, cloud, settings, nu, refusal);
    return refusal;
  };
  const auto says = [&](const std::string& text, const std::string& part) {
    EXPECT_NE(text.find(part), std::string::npos) << part << ": " << text;
  };
  const std::vector<Setting> usual = {{"peridynamics", "horizon", 0.25}};
  EXPECT_EQ(answer(good, usual, 0.3), "");
  Cloud twice = good;
  twice.X[7] = twice.X[8];
  says(answer(twice, usual, 0.3),
       "particle 7 (at X = 0.25, 0.15, 0.05) and particle 8 are at the same place");
  Cloud shifted = good;
  shifted.X[7][0] += 0.01;
  says(answer(shifted, {usual[0], {"cpd", "hood_volume", 0, "sphere"}}, 0.3),
       "are not on one; use 'sum'");
  says(answer(good, usual, 0.2), "nu = 0.2 makes C3 = -");
  says(answer(good, {usual[0], {"cpd", "C1", -3.0}}, 0.3), "C1 is -3; allowed: > 0");
  says(answer(good, {{"peridynamics", "horizon", 0.14}}, 0.3),
       "is 1.4 spacings of the particles (0.1 [m])");
  says(answer(good, {{"peridynamics", "horizon", 0.6}}, 0.3),
       "larger than the body, whose longest side is 0.5");
  says(answer(good, {usual[0], {"fracture", "Gf", 1}, {"fracture", "length", 1}}, 0.3),
       "leave length");
  says(answer(good, {usual[0], {"fracture", "criterion", 0, "bond_strain"}}, 0.3),
       "needs critical_strain > 0");
  says(answer(good, {usual[0], {"peridynamics", "section", 1}}, 0.3), "makes it a bar");

  Model model;
  const SimplexMesh mesh = patch(3, 2, 1.0, 0.1, 6);
  model.add({CLEAVE_FORMULATION_lps, CLEAVE_MATERIAL_svk, CLEAVE_3D}, mesh);
  std::vector<double> volume(27, 1.0);
  EXPECT_EQ(cleave_body_volumes(model, 0, 26, volume.data()), CLEAVE_BAD_ARGUMENT);
  says(last_message(), "count is 26; body 0 'patch' has 27 particles");
  volume[3] = 0;
  EXPECT_EQ(cleave_body_volumes(model, 0, 27, volume.data()), CLEAVE_BAD_ARGUMENT);
  says(last_message(), "the volume of particle 3 is 0; allowed: > 0 and finite");
}

// Largest energy over the first of a body whose points start with random velocities.
double growth(int32_t formulation, const Cloud& cloud, double horizon, double factor,
              const std::vector<Setting>& more) {
  auto settings = settings_of(formulation, horizon);
  settings.insert(settings.end(), more.begin(), more.end());
  CloudBody body(formulation, cloud.dimension == 2 ? CLEAVE_PLANE_STRAIN : CLEAVE_3D, cloud,
                 settings, 1.0, ratio_of(formulation), 1.0);
  body.model.put("velocity", random_field(cloud, 1e-6, 7));
  body.model.initialise();
  const double start = body.model.energies().kinetic, dt = factor * body.model.stable_step();
  for (int n = 1; n <= 120; ++n) {
    ok(cleave_model_advance(body.model, dt, n * dt));
    if (cleave_model_update(body.model) != CLEAVE_OK) return 1e300;  // not finite
  }
  const cleave_energies e = body.model.energies();
  return (e.kinetic + e.elastic) / start;
}

// Measured limit over the stable step: 1.5 to 1.9.
TEST(PeridynamicSolid, StableStepIsBelowTheLimit) {
  for (const int32_t formulation : kFormulations)
    for (const Cloud& cloud : {lattice_cloud(7, 6, 5, 1.0), random_cloud(3, 5, 2),
                               lattice_cloud(12, 9, 0, 1.0), random_cloud(2, 9, 4)}) {
      const double spacing = cloud.X.size() == 210 || cloud.X.size() == 108 ? 1.0
                             : cloud.dimension == 3                         ? 0.2
                                                                            : 1.0 / 9;
      EXPECT_LT(growth(formulation, cloud, 2.2 * spacing, 1.0, {}), 3)
          << formulation << ' ' << cloud.size();
      EXPECT_GT(growth(formulation, cloud, 2.2 * spacing, 2.3, {}), 1e6)
          << formulation << ' ' << cloud.size();
    }
}

}  // namespace
}  // namespace cleave::test
