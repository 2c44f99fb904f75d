// The static solver against closed forms, against the explicit run that has come to rest, and in
// failure.
#include <gtest/gtest.h>

#include <cmath>

#include "support/model.hpp"

namespace cleave::test {
namespace {

constexpr double kSpacing = 0.01;

class Static : public testing::TestWithParam<Case> {
 protected:
  int dimension() const { return dimension_of(GetParam()); }
  double side() const { return (dimension() == 2 ? 5 : 3) * kSpacing; }
  SimplexMesh mesh() const {
    return patch(dimension(), dimension() == 2 ? 5 : 3, kSpacing, 0.15, 3);
  }

  // Holds every particle of the outline in all directions; returns them.
  void hold_outline(Model& model, const SimplexMesh& m) {
    particles_.clear();
    directions_.clear();
    for (std::int64_t i = 0; i < m.particles(); ++i) {
      bool outside = false;
      for (int k = 0; k < dimension(); ++k) {
        const double x = m.X[static_cast<std::size_t>(3 * i + k)];
        outside = outside || x < 0.3 * kSpacing || x > side() - 0.3 * kSpacing;
      }
      for (int k = 0; k < dimension() && outside; ++k) {
        particles_.push_back(i);
        directions_.push_back(k);
      }
    }
    const std::vector<std::int32_t> motion(particles_.size(), CLEAVE_MOTION_EXACT);
    ok(cleave_body_prescribe(model, 0, static_cast<std::int64_t>(particles_.size()),
                             particles_.data(), directions_.data(), motion.data()));
  }
  std::vector<std::int64_t> particles_;
  std::vector<std::int32_t> directions_;
};

constexpr double kGradient[3][3] = {{0.03, 0.02, 0.01}, {-0.01, 0.05, -0.02}, {0.02, 0.01, -0.04}};

TEST_P(Static, AffineOutlineGivesAffineInterior) {
  const SimplexMesh m = mesh();
  Model model;
  model.add(GetParam(), m);
  hold_outline(model, m);
  model.setup();
  model.initialise();
  const auto affine = [&](std::int64_t i, int k) {
    double u = 0;
    for (int c = 0; c < dimension(); ++c)
      u += kGradient[k][c] * m.X[static_cast<std::size_t>(3 * i + c)];
    return u;
  };
  std::vector<double> given(particles_.size());
  for (std::size_t c = 0; c < given.size(); ++c) given[c] = affine(particles_[c], directions_[c]);
  ok(cleave_body_motion(model, 0, static_cast<std::int64_t>(given.size()), given.data(), nullptr));
  cleave_static_report report{};
  report.size = sizeof report;
  ok(cleave_model_solve_static(model, 1.0, nullptr, &report));
  EXPECT_LE(report.iterations, 6);  // measured 4: quadratic
  EXPECT_LT(report.residual, 1e-9);
  const auto u = model.real("displacement");
  for (std::int64_t i = 0; i < m.particles(); ++i)
    for (int k = 0; k < dimension(); ++k) {
      // measured 1e-15: with tangents by differences the last correction is as exact
      EXPECT_NEAR(u[static_cast<std::size_t>(3 * i + k)], affine(i, k), 1e-11);
    }
}

TEST_P(Static, FailedIncrementLeavesTheStateAsItWas) {
  if (GetParam().material == CLEAVE_MATERIAL_linear_elastic)
    GTEST_SKIP() << "one iteration is enough";
  const SimplexMesh m = mesh();
  Model model;
  model.add(GetParam(), m);
  hold_outline(model, m);
  model.setup();
  model.initialise();
  std::vector<double> given(particles_.size());
  for (std::size_t c = 0; c < given.size(); ++c) {
    given[c] = 0.01 * m.X[static_cast<std::size_t>(3 * particles_[c] + directions_[c])];
  }
  const auto count = static_cast<std::int64_t>(given.size());
  ok(cleave_body_motion(model, 0, count, given.data(), nullptr));
  ok(cleave_model_solve_static(model, 1.0, nullptr, nullptr));
  const auto u = model.real("displacement"), p = model.real("first_piola_kirchhoff_stress"),
             h = model.real("displacement_gradient"), ledger = model.real("ledger");
  cleave_static_options options{};
  ok(cleave_static_options_init(&options));
  options.max_iterations = 1;
  for (std::size_t c = 0; c < given.size(); ++c) {
    const double x = m.X[static_cast<std::size_t>(3 * particles_[c] + (directions_[c] + 1) % 2)];
    given[c] += 0.1 * x * x / side();
  }
  ok(cleave_body_motion(model, 0, count, given.data(), nullptr));
  const std::int32_t status = cleave_model_solve_static(model, 2.0, &options, nullptr);
  EXPECT_EQ(status, CLEAVE_NO_CONVERGENCE) << last_message();
  EXPECT_NE(last_message().find("smaller load increment"), std::string::npos) << last_message();
  EXPECT_EQ(model.real("displacement"), u);
  EXPECT_EQ(model.real("first_piola_kirchhoff_stress"), p);
  EXPECT_EQ(model.real("displacement_gradient"), h);
  EXPECT_EQ(model.real("ledger"), ledger);
  ok(cleave_model_solve_static(model, 2.0, nullptr, nullptr));
}

TEST_P(Static, WorkOfAnIncrementIsTheStoredEnergy) {
  const SimplexMesh m = mesh();
  Model model;
  model.add(GetParam(), m);
  hold_outline(model, m);
  model.setup();
  model.initialise();
  std::vector<double> given(particles_.size());
  for (int step = 1; step <= 8; ++step) {
    for (std::size_t c = 0; c < given.size(); ++c) {
      const double x = m.X[static_cast<std::size_t>(3 * particles_[c] + (directions_[c] + 1) % 2)];
      given[c] = 0.001 * step * x * x / side();
    }
    ok(cleave_body_motion(model, 0, static_cast<std::int64_t>(given.size()), given.data(),
                          nullptr));
    ok(cleave_model_solve_static(model, step, nullptr, nullptr));
  }
  const cleave_energies e = model.energies();
  EXPECT_GT(e.reaction, 0.0);
  EXPECT_LT(std::fabs(e.balance), 1e-3 * e.reaction);
}

std::vector<Case> solvable() {
  std::vector<Case> out;
  for (const Case& c : all_cases()) {
    if (c.material == CLEAVE_MATERIAL_mie_gruneisen) continue;  // a fluid has many equilibria
    if (c.formulation == CLEAVE_FORMULATION_cbm || c.formulation == CLEAVE_FORMULATION_fem)
      out.push_back(c);
  }
  return out;
}
INSTANTIATE_TEST_SUITE_P(Tables, Static, testing::ValuesIn(solvable()), case_name);

TEST(StaticSolver, SaysThatNothingHoldsTheBody) {
  Model model;
  model.add({CLEAVE_FORMULATION_fem, CLEAVE_MATERIAL_svk, CLEAVE_PLANE_STRAIN},
            patch(2, 4, kSpacing, 0.1, 3));
  model.setup();
  model.initialise();
  auto f = model.real("external_force");
  f[0] = 1.0;
  model.put("external_force", f);
  EXPECT_EQ(cleave_model_solve_static(model, 1.0, nullptr, nullptr), CLEAVE_NO_CONVERGENCE);
  EXPECT_NE(last_message().find("prescribe displacements"), std::string::npos) << last_message();
}

TEST(StaticSolver, RefusesForcesThatAreNotTheOperators) {
  Model model;
  model.add({CLEAVE_FORMULATION_cbm, CLEAVE_MATERIAL_svk, CLEAVE_PLANE_STRAIN},
            patch(2, 4, kSpacing, 0.1, 3), {{"stabilisation", "alpha", 0.05}});
  model.setup();
  model.initialise();
  EXPECT_EQ(cleave_model_solve_static(model, 1.0, nullptr, nullptr), CLEAVE_UNSUPPORTED);
}

}  // namespace
}  // namespace cleave::test
