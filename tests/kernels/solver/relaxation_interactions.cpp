// Dynamic relaxation of peridynamic bodies: against the linear system of stiffnesses taken from the forces
// one displacement at a time, and with a bond that breaks.
#include <gtest/gtest.h>

#include <Eigen/Dense>

#include "formulation/peridynamics/clouds.hpp"

namespace cleave::test {
namespace {

constexpr double kSpacing = 0.5, kHorizon = 2.015 * kSpacing;
constexpr int kLength = 6;  // points in x
constexpr double kMiddle = 0.5 * kLength * kSpacing;

// The first layer is held, the last is pulled in x.
struct Pulled {
  // stiffer: Young's modulus of the half to the right over that of the left.
  explicit Pulled(std::int32_t formulation, const std::vector<Setting>& more = {},
                  double stiffer = 1) {
    std::vector<Setting> settings = {{"peridynamics", "horizon", kHorizon}};
    settings.insert(settings.end(), more.begin(), more.end());
    cleave_body_spec spec;
    ok(cleave_body_spec_init(&spec));
    spec.formulation = formulation;
    spec.kinematics = CLEAVE_3D;
    spec.material = CLEAVE_MATERIAL_linear_elastic;
    spec.particles = static_cast<std::int64_t>(cloud.size());
    spec.X = cloud.X.data()->data();
    std::int64_t body = 0;
    ok(cleave_body_add(model, &spec, &body));
    ok(cleave_body_volumes(model, body, spec.particles, cloud.volume.data()));
    model.set(body,
              {{"material", "E", 2.1e5}, {"material", "nu", 0.25}, {"material", "rho", 7.8e-9}});
    model.set(body, settings);
    if (stiffer != 1) {
      std::vector<std::int64_t> half;
      for (std::size_t i = 0; i < cloud.size(); ++i)
        if (cloud.X[i][0] > kMiddle) half.push_back(static_cast<std::int64_t>(i));
      const double properties[3] = {7.8e-9, stiffer * 2.1e5, 0.25};
      ok(cleave_body_region(model, 0, std::ssize(half), half.data(), spec.material, 3, properties,
                            0, 0));
    }
    std::vector<std::int64_t> particle;
    std::vector<std::int32_t> direction;
    for (std::size_t i = 0; i < cloud.size(); ++i) {
      const double x = cloud.X[i][0];
      if (x > kSpacing && x < (kLength - 1) * kSpacing) continue;
      for (int k = 0; k < 3; ++k) {
        particle.push_back(static_cast<std::int64_t>(i));
        direction.push_back(k);
        pulled.push_back(k == 0 && x > kSpacing ? 1.0 : 0.0);
        held[3 * i + static_cast<std::size_t>(k)] = true;
      }
    }
    const std::vector<std::int32_t> motion(particle.size(), CLEAVE_MOTION_EXACT);
    ok(cleave_body_prescribe(model, 0, std::ssize(particle), particle.data(), direction.data(),
                             motion.data()));
    model.setup();
    model.initialise();
    ok(cleave_relaxation_options_init(&options));
  }
  cleave_relaxation_report relax(double displacement) {
    std::vector<double> u = pulled;
    for (double& value : u) value *= displacement;
    ok(cleave_body_motion(model, 0, std::ssize(u), u.data(), nullptr));
    cleave_relaxation_report report{};
    report.size = sizeof report;
    ok(cleave_model_relax(model, 1.0, &options, &report));
    return report;
  }
  // Of the first layer, or of the last.
  Point reaction(bool last) {
    std::vector<std::int64_t> layer;
    for (std::size_t i = 0; i < cloud.size(); ++i)
      if (held[3 * i] && (cloud.X[i][0] > kMiddle) == last)
        layer.push_back(static_cast<std::int64_t>(i));
    Point force{};
    ok(cleave_body_reaction(model, 0, std::ssize(layer), layer.data(), force.data()));
    return force;
  }
  cleave_event first_event() {
    cleave_event event{};
    event.size = sizeof event;
    ok(cleave_body_event_get(model, 0, 0, &event));
    return event;
  }

  Cloud cloud = lattice_cloud(kLength, 3, 3, kSpacing);
  std::vector<double> pulled;
  std::vector<bool> held = std::vector<bool>(3 * cloud.size(), false);
  Model model;
  cleave_relaxation_options options{};
};

class InteractionRelaxation : public testing::TestWithParam<std::int32_t> {};

TEST_P(InteractionRelaxation, FindsTheEquilibriumOfTheLinearSystem) {
  const double displacement = 2e-5 * kSpacing;  // 4e-6 strain: linear, and above rounding
  Pulled body(GetParam());
  body.options.tolerance = 1e-7;
  const auto report = body.relax(displacement);
  EXPECT_EQ(report.finished, 1);
  const auto relaxed = body.model.real("displacement");

  const auto forces = [&](const std::vector<double>& u) {
    CloudBody probe(GetParam(), CLEAVE_3D, body.cloud, {{"peridynamics", "horizon", kHorizon}},
                    2.1e5, 0.25);
    return probe.forces(u);
  };
  const auto n = static_cast<Eigen::Index>(relaxed.size());
  Eigen::MatrixXd K(n, n);
  const double h = 1e-6 * kSpacing;
  for (Eigen::Index c = 0; c < n; ++c) {
    std::vector<double> u(relaxed.size(), 0.0);
    u[static_cast<std::size_t>(c)] = h;
    const auto up = forces(u);
    u[static_cast<std::size_t>(c)] = -h;
    const auto down = forces(u);
    for (Eigen::Index r = 0; r < n; ++r)
      K(r, c) = (up[static_cast<std::size_t>(r)] - down[static_cast<std::size_t>(r)]) / (2 * h);
  }
  // Rows of held degrees of freedom: u is given.
  Eigen::VectorXd right = Eigen::VectorXd::Zero(n);
  for (Eigen::Index r = 0; r < n; ++r) {
    const auto c = static_cast<std::size_t>(r);
    if (!body.held[c]) continue;
    K.row(r).setZero();
    K(r, r) = 1;
    right(r) = relaxed[c];
  }
  const Eigen::VectorXd exact = K.fullPivLu().solve(right);
  double off = 0;
  for (Eigen::Index r = 0; r < n; ++r)
    off = std::fmax(off, std::fabs(exact(r) - relaxed[static_cast<std::size_t>(r)]));
  EXPECT_LT(off, 1e-6 * displacement);  // measured 1.8e-7
}

INSTANTIATE_TEST_SUITE_P(Tables, InteractionRelaxation,
                         testing::Values(CLEAVE_FORMULATION_bond_pd, CLEAVE_FORMULATION_cpd,
                                         CLEAVE_FORMULATION_lps));

// The force at the grips is that of all bonds that cross the middle.
TEST(InteractionRelaxation, ReactionsAreTheForceThroughTheBody) {
  for (const double stiffer : {1.0, 3.0})
    for (const std::int32_t formulation :
         {CLEAVE_FORMULATION_bond_pd, CLEAVE_FORMULATION_cpd, CLEAVE_FORMULATION_lps}) {
      std::vector<Setting> settings;
      if (formulation == CLEAVE_FORMULATION_cpd)
        settings.push_back({"cpd", "weights", 0, "conservative"});
      Pulled body(formulation, settings, stiffer);
      body.options.tolerance = 1e-8;
      body.relax(1e-3);
      const Point foot = body.reaction(false), head = body.reaction(true);
      EXPECT_LT(norm(foot + head), 1e-6 * norm(head)) << formulation;  // measured 3e-8
      if (formulation != CLEAVE_FORMULATION_bond_pd) continue;
      const auto u = body.model.real("displacement");
      const double own = 30 * (2.1e5 / 2.5) / (3.14159265358979323846 * std::pow(kHorizon, 4)),
                   volume = body.cloud.volume[0];
      Point sum{};
      for (std::size_t i = 0; i < body.cloud.size(); ++i)
        for (std::size_t j = 0; j < body.cloud.size(); ++j) {
          const Point X = body.cloud.X[j] - body.cloud.X[i];
          if (body.cloud.X[i][0] > kMiddle || body.cloud.X[j][0] < kMiddle) continue;
          if (norm(X) > kHorizon) continue;
          const Point x = X + Point{u[3 * j], u[3 * j + 1], u[3 * j + 2]} -
                          Point{u[3 * i], u[3 * i + 1], u[3 * i + 2]};
          const double c = 2 * own / (1 + 1 / stiffer), stretch = norm(x) / norm(X) - 1;
          sum = sum + (c * volume * volume * stretch / norm(x)) * x;
        }
      EXPECT_LT(norm(sum - head), 1e-6 * norm(head));  // measured 2e-8
      EXPECT_GT(norm(head), 0);
    }
}

// Each point has the bound of its own material: a stiff half takes no more iterations than a soft one.
TEST(InteractionRelaxation, StiffRegionsDoNotSlowTheOthers) {
  for (const std::int32_t formulation :
       {CLEAVE_FORMULATION_bond_pd, CLEAVE_FORMULATION_cpd, CLEAVE_FORMULATION_lps}) {
    std::vector<Setting> settings;
    if (formulation == CLEAVE_FORMULATION_cpd)
      settings.push_back({"cpd", "weights", 0, "conservative"});
    Pulled one(formulation, settings), two(formulation, settings, 400);
    const auto alone = one.relax(1e-3).iterations, both = two.relax(1e-3).iterations;
    EXPECT_LT(both, 2 * alone) << formulation << ' ' << alone;  // measured 1.0 to 1.5 times
  }
}

// One at a time: every round breaks a bond, the first the most stretched of all.
TEST(InteractionRelaxation, BreaksTheMostStretchedBondFirst) {
  const std::vector<Setting> fracture = {{"fracture", "critical_strain", 1e-3}};
  Pulled all(CLEAVE_FORMULATION_bond_pd, fracture), one(CLEAVE_FORMULATION_bond_pd, fracture);
  one.options.breaking = CLEAVE_BREAKING_ONE;
  const double displacement = 1.15e-3 * (kLength - 1) * kSpacing;
  const auto together = all.relax(displacement), singly = one.relax(displacement);
  EXPECT_EQ(together.finished, 1);
  EXPECT_EQ(singly.finished, 1);
  const auto broken = one.model.counts().broken;
  EXPECT_GT(broken, 0);
  EXPECT_EQ(singly.rounds, broken);
  EXPECT_LE(broken, all.model.counts().broken);
  // Both begin in the same equilibrium; there the first of all is not the most stretched.
  EXPECT_GT(one.first_event().criterion, all.first_event().criterion);
}

}  // namespace
}  // namespace cleave::test
