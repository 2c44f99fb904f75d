// Dynamic relaxation against Newton's method and closed forms, with bodies that stiffen, and in failure; its
// bounds of the stiffness against the largest eigenvalue. Bonds that break: relaxation_fracture.cpp.
#include <gtest/gtest.h>

#include <cmath>

#include "model/model.hpp"
#include "solver/loaded_patch.hpp"
#include "support/allocations.hpp"

namespace cleave::test {
namespace {

double relative_difference(const std::vector<double>& a, const std::vector<double>& b) {
  double difference = 0, size = 0;
  for (std::size_t k = 0; k < a.size(); ++k) {
    difference += (a[k] - b[k]) * (a[k] - b[k]);
    size += b[k] * b[k];
  }
  return std::sqrt(difference / size);
}

class Relaxation : public testing::TestWithParam<Case> {
 protected:
  int dimension() const { return dimension_of(GetParam()); }
  int cells() const { return dimension() == 2 ? 10 : 5; }
  // Kernel methods without a penalty have soft modes, which forces hardly tell.
  bool soft() const {
    return GetParam().formulation == CLEAVE_FORMULATION_tlsph ||
           GetParam().formulation == CLEAVE_FORMULATION_nosb;
  }
};

TEST_P(Relaxation, FindsTheEquilibriumOfNewton) {
  for (const double strain : {1e-3, 0.1}) {
    LoadedPatch newton(GetParam(), cells()), relaxed(GetParam(), cells());
    newton.pull(strain);
    ok(cleave_model_solve_static(newton.model, 1.0, nullptr, nullptr));
    relaxed.options.tolerance = soft() ? 1e-8 : 1e-6;
    const cleave_relaxation_report report = relaxed.relaxed(strain);
    EXPECT_EQ(report.finished, 1);
    EXPECT_EQ(report.rounds, 0);
    EXPECT_LE(report.residual, relaxed.options.tolerance);
    const auto u = relaxed.model.real("displacement");
    // measured 2e-6 to 4e-6; with soft modes at most 1.2e-5
    EXPECT_LT(relative_difference(u, newton.model.real("displacement")), soft() ? 5e-5 : 1e-5);
    const cleave_energies e = relaxed.model.energies(), exact = newton.model.energies();
    // measured 6e-7
    EXPECT_NEAR(e.elastic, exact.elastic, 3e-6 * exact.elastic);
    EXPECT_NEAR(e.plastic, exact.plastic, 3e-6 * exact.elastic);
    EXPECT_NEAR(e.reaction, exact.reaction, 3e-6 * exact.reaction);
    EXPECT_EQ(e.viscous, 0);
    EXPECT_EQ(e.kinetic, 0);
  }
}

// The same path through history, increment by increment, and back.
TEST_P(Relaxation, FollowsAPathAsNewtonDoes) {
  if (soft()) GTEST_SKIP() << "soft modes add up";
  LoadedPatch newton(GetParam(), cells()), relaxed(GetParam(), cells());
  for (const double strain : {0.01, 0.03, 0.04, 0.02}) {
    newton.pull(strain);
    ok(cleave_model_solve_static(newton.model, 1.0, nullptr, nullptr));
    relaxed.relaxed(strain);
  }
  const cleave_energies e = relaxed.model.energies(), exact = newton.model.energies();
  // measured 4e-6
  EXPECT_LT(
      relative_difference(relaxed.model.real("displacement"), newton.model.real("displacement")),
      2e-5);
  EXPECT_NEAR(e.elastic, exact.elastic, 2e-5 * exact.elastic);
  EXPECT_NEAR(e.plastic, exact.plastic, 2e-5 * exact.elastic);
  EXPECT_NEAR(e.balance, exact.balance, 4e-4 * exact.elastic);  // measured 1.1e-4
}

// No eigenvalue of S^-1 K is above 1, by power iteration with the formulation's own forces.
TEST_P(Relaxation, StiffnessBoundHolds) {
  LoadedPatch patch(GetParam(), dimension() == 2 ? 6 : 4);
  patch.relaxed(0.0);  // the fields hold the state
  cleave_model& model = *patch.model;
  Body& body = *model.bodies[0];
  std::vector<double> bound(3 * static_cast<std::size_t>(body.particles));
  body.formulation->stiffness_bound(body, model.team, bound);
  std::vector<double> direction(bound.size());
  Random random(3);
  for (double& d : direction) d = random();
  double largest = 0;
  for (int k = 0; k < 300; ++k) {
    double norm = 0;
    for (std::size_t c = 0; c < bound.size(); ++c) norm += bound[c] * direction[c] * direction[c];
    constexpr double kSmall = 1e-7;  // of a spacing
    for (std::size_t c = 0; c < bound.size(); ++c) {
      direction[c] /= std::sqrt(norm);
      body.point.u[c] = bound[c] > 0 ? kSmall * LoadedPatch::kSpacing * direction[c] : 0.0;
    }
    double size = 0;
    for (const double d : direction) size = std::fmax(size, std::fabs(d));
    for (std::size_t c = 0; c < bound.size(); ++c) body.point.u[c] /= size;
    body.formulation->deform(body, model.clock, model.team);
    body.formulation->forces(body, model.team);
    largest = 0;
    for (std::size_t c = 0; c < bound.size(); ++c) {
      if (!(bound[c] > 0)) continue;
      const double pull = -body.point.internal[c] * size / (kSmall * LoadedPatch::kSpacing);
      largest += direction[c] * pull;
      direction[c] = pull / bound[c];
    }
  }
  EXPECT_LT(largest, 1.0);
  EXPECT_GT(largest, 0.2);  // measured 0.3 to 0.85: not far too heavy
}

std::vector<Case> solvable() {
  std::vector<Case> out;
  for (const Case& c : all_cases()) {
    const bool law = c.material == CLEAVE_MATERIAL_svk || c.material == CLEAVE_MATERIAL_j2 ||
                     c.material == CLEAVE_MATERIAL_johnson_cook;
    const bool rows = c.formulation == CLEAVE_FORMULATION_cbm ||
                      c.formulation == CLEAVE_FORMULATION_fem ||
                      c.kinematics == CLEAVE_PLANE_STRAIN;
    const bool known =
        c.formulation == CLEAVE_FORMULATION_cbm || c.formulation == CLEAVE_FORMULATION_fem ||
        c.formulation == CLEAVE_FORMULATION_tlsph || c.formulation == CLEAVE_FORMULATION_nosb;
    if (law && rows && known) out.push_back(c);
  }
  return out;
}
INSTANTIATE_TEST_SUITE_P(Tables, Relaxation, testing::ValuesIn(solvable()), case_name);

constexpr Case kFem{CLEAVE_FORMULATION_fem, CLEAVE_MATERIAL_svk, CLEAVE_PLANE_STRAIN};
constexpr Case kCbm{CLEAVE_FORMULATION_cbm, CLEAVE_MATERIAL_svk, CLEAVE_PLANE_STRAIN};

// Steps of a wave, not of a matrix: twice the cells along an edge take twice the iterations.
TEST(RelaxationCost, GrowsWithTheEdge) {
  LoadedPatch coarse(kCbm, 10), fine(kCbm, 40);
  const auto few = coarse.relaxed(1e-3).iterations, many = fine.relaxed(1e-3).iterations;
  EXPECT_LT(few, 160);       // measured 105
  EXPECT_LT(many, 4 * few);  // measured 294
}

TEST(RelaxationCost, IsNotRuledByTheSmallestCell) {
  const auto pull = [](double ratio) {
    SimplexMesh mesh = patch(2, 16, LoadedPatch::kSpacing, 0.0, 3);
    const double width = 16 * LoadedPatch::kSpacing;
    for (std::size_t c = 0; c < mesh.X.size(); c += 3) {  // cells from 1 to `ratio` across
      const double s = mesh.X[c] / width;
      mesh.X[c] = width * (std::pow(ratio, s) - 1) / (ratio - 1);
    }
    LoadedPatch graded(kFem, mesh);
    return graded.relaxed(1e-3).iterations;
  };
  EXPECT_LT(pull(20.0), 1.3 * pull(1.001));  // measured 157 and 195
}

TEST(RelaxationCost, AllocatesNothingWhileItIterates) {
  LoadedPatch patch(kCbm, 20);
  patch.pull(1e-3);
  patch.options.slice = 20;
  EXPECT_EQ(patch.relax().finished, 0);
  const long before = allocations();
  EXPECT_EQ(patch.relax().finished, 0);
  EXPECT_EQ(allocations(), before);
}

// SVK at a stretch of 2 is 5.5 times as stiff as at rest, where the bound was taken.
TEST(RelaxationStiffening, IsNoticed) {
  LoadedPatch newton(kFem, 6), relaxed(kFem, 6);
  for (const double strain : {0.25, 0.5, 0.75, 1.0}) {
    newton.pull(strain);
    ok(cleave_model_solve_static(newton.model, 1.0, nullptr, nullptr));
  }
  relaxed.relaxed(1.0);
  // measured 3e-6
  EXPECT_LT(
      relative_difference(relaxed.model.real("displacement"), newton.model.real("displacement")),
      1e-5);
}

TEST(RelaxationPenalties, HaveNoTangentAndNeedNone) {
  const auto residual = [](const Case& c, const std::vector<Setting>& settings) {
    LoadedPatch patch(c, 8, settings);
    const auto report = patch.relaxed(0.01);
    EXPECT_LT(report.iterations, 1500);  // measured 92, 103, 60
    const cleave_energies e = patch.model.energies();
    EXPECT_GT(e.stabilisation, 0);
    return std::fabs(e.balance) / e.reaction;
  };
  // One trapezoid for the increment: measured 6e-3, as for Newton without the penalty.
  EXPECT_LT(residual(kCbm, {{"stabilisation", "alpha", 0.05}}), 0.01);
  EXPECT_LT(
      residual(kCbm, {{"stabilisation", "form", 0, "blend"}, {"stabilisation", "alpha", 0.3}}),
      0.01);
  EXPECT_LT(residual({CLEAVE_FORMULATION_tlsph, CLEAVE_MATERIAL_svk, CLEAVE_PLANE_STRAIN},
                     {{"hourglass", "form", 0, "conservative"}, {"hourglass", "psi", 0.1}}),
            0.01);
}

TEST(RelaxationRefusals, APenaltyWithoutEnergy) {
  LoadedPatch patch({CLEAVE_FORMULATION_tlsph, CLEAVE_MATERIAL_svk, CLEAVE_PLANE_STRAIN}, 4,
                    {{"hourglass", "form", 0, "projected"}, {"hourglass", "psi", 0.1}});
  EXPECT_EQ(cleave_model_relax(patch.model, 1.0, nullptr, nullptr), CLEAVE_UNSUPPORTED);
  EXPECT_NE(last_message().find("'conservative'"), std::string::npos) << last_message();
}

TEST(RelaxationFailure, LeavesTheStateAsItWas) {
  const Case plastic{CLEAVE_FORMULATION_fem, CLEAVE_MATERIAL_j2, CLEAVE_PLANE_STRAIN};
  LoadedPatch patch(plastic, 8), other(plastic, 8);
  patch.relaxed(0.03);
  other.relaxed(0.03);
  const auto before = patch.state();
  patch.pull(0.05);
  patch.options.max_iterations = 20;
  EXPECT_EQ(patch.status(), CLEAVE_NO_CONVERGENCE);
  for (const char* part : {"body 0 'patch': no equilibrium: residual", "after", "wanted 1e-06",
                           "smaller load increment", "hold what can move"})
    EXPECT_NE(last_message().find(part), std::string::npos) << last_message();
  EXPECT_EQ(patch.state(), before);
  patch.options.max_iterations = 100000;
  patch.relaxed(0.05);
  other.relaxed(0.05);
  EXPECT_EQ(patch.state(), other.state());
}

TEST(RelaxationFailure, ABodyThatNothingHolds) {
  Model model;
  model.add(kFem, patch(2, 4, 0.01, 0.1, 3));
  model.setup();
  model.initialise();
  auto f = model.real("external_force");
  f[0] = 1.0;
  model.put("external_force", f);
  cleave_relaxation_options options{};
  ok(cleave_relaxation_options_init(&options));
  options.max_iterations = 2000;
  EXPECT_EQ(cleave_model_relax(model, 1.0, &options, nullptr), CLEAVE_NO_CONVERGENCE);
}

TEST(RelaxationOrder, NoLoadIsOneLook) {
  LoadedPatch patch(kFem, 4);
  EXPECT_EQ(patch.relaxed(0.0).iterations, 1);
  for (const double u : patch.model.real("displacement")) EXPECT_EQ(u, 0.0);
}

TEST(RelaxationOrder, SlicesAndThreadsChangeNothing) {
  const Case plastic{CLEAVE_FORMULATION_cbm, CLEAVE_MATERIAL_j2, CLEAVE_PLANE_STRAIN};
  LoadedPatch whole(plastic, 40), sliced(plastic, 40), cancelled(plastic, 40);
  for (LoadedPatch* patch : {&whole, &sliced, &cancelled}) patch->relaxed(0.01);
  const cleave_relaxation_report report = whole.relaxed(0.03);
  ok(cleave_model_set_threads(sliced.model, 3));
  sliced.options.slice = 17;
  sliced.pull(0.03);
  const auto before = sliced.state();
  cleave_relaxation_report now = sliced.relax();
  int calls = 1;
  for (; now.finished == 0; ++calls) now = sliced.relax();
  EXPECT_GT(calls, 10);
  EXPECT_EQ(now.iterations, report.iterations);
  EXPECT_EQ(now.residual, report.residual);
  EXPECT_EQ(sliced.state(), whole.state());

  cancelled.options.slice = 30;
  cancelled.pull(0.03);
  EXPECT_EQ(cancelled.relax().finished, 0);
  EXPECT_EQ(cleave_model_solve_static(cancelled.model, 1.0, nullptr, nullptr), CLEAVE_WRONG_ORDER);
  ok(cleave_model_relax_cancel(cancelled.model));
  EXPECT_EQ(cancelled.state(), before);
  EXPECT_EQ(cleave_model_relax_cancel(cancelled.model), CLEAVE_WRONG_ORDER);
  cancelled.options.slice = 0;
  cancelled.relaxed(0.03);
  EXPECT_EQ(cancelled.state(), whole.state());
}

}  // namespace
}  // namespace cleave::test
