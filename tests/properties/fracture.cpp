// Breaking: irreversible, exact patch afterwards, energy of events, isolated particles, ledger
// closure.
#include <cmath>

#include "support/model.hpp"

namespace cleave::test {
namespace {

constexpr double kSpacing = 0.01;

class Fracture : public testing::TestWithParam<Case> {
 protected:
  SimplexMesh mesh() const {
    const int d = dimension_of(GetParam());
    return solid(GetParam(), d == 2 ? 10 : 7, kSpacing, 0.15, 11);
  }
  // Pulled apart along x by its initial velocity.
  void pull(Model& model, double speed) const {
    const SimplexMesh m = mesh();
    std::vector<double> v(m.X.size(), 0.0);
    for (std::size_t i = 0; i < v.size() / 3; ++i) v[3 * i] = speed * m.X[3 * i] / kSpacing;
    model.put("velocity", v);
    model.initialise();
  }
};

TEST_P(Fracture, IsIrreversibleAndEventsTellTheSameStory) {
  Model model;
  model.add(GetParam(), mesh(), {{"fracture", "critical_strain", breaking_strain(GetParam())}});
  model.setup();
  pull(model, 12.0);
  const double dt = 0.3 * model.stable_step();
  const bool simplices =
      cleave_field_find(model, 0, "simplex_alive", nullptr) != CLEAVE_UNKNOWN_NAME;
  const auto living = [&] {
    return simplices ? model.integer("simplex_alive") : std::vector<int64_t>();
  };
  auto alive = living();
  auto status = model.integer("bond_status");
  for (int n = 0; n < 300; ++n) {
    model.step(dt);
    const auto alive_now = living();
    const auto status_now = model.integer("bond_status");
    for (std::size_t k = 0; k < alive.size(); ++k) ASSERT_LE(alive_now[k], alive[k]);
    for (std::size_t k = 0; k < status.size(); ++k) {
      ASSERT_TRUE(status[k] == 0 || status_now[k] == status[k]);
    }
    alive = alive_now;
    status = status_now;
  }
  int64_t events = 0;
  ok(cleave_body_event_count(model, 0, &events));
  ASSERT_GT(events, 20);
  EXPECT_EQ(events, model.counts().broken);
  double released = 0;
  int64_t last_step = 0;
  for (int64_t k = 0; k < events; ++k) {
    cleave_event e{};
    e.size = sizeof e;
    ok(cleave_body_event_get(model, 0, k, &e));
    EXPECT_GE(e.criterion, e.limit * (1 - 1e-12));
    EXPECT_LT(e.first, e.second);
    EXPECT_GE(e.step, last_step);
    EXPECT_DOUBLE_EQ(e.time, static_cast<double>(e.step) * dt);
    last_step = e.step;
    released += e.released;
  }
  const cleave_energies energies = model.energies();
  EXPECT_NEAR(released, energies.fracture, 1e-10 * std::fabs(energies.fracture));  // measured 1e-15
  EXPECT_GT(energies.fracture, 0);
}

// The closure error of a run with deletions falls with the square of the step; with the step where the
// law flows plastically, because the return mapping is a backward Euler step.
TEST_P(Fracture, LedgerClosesWithDeletionsViscosityAndStabilisation) {
  for (const std::string form : {"none", "deviation", "blend"}) {
    if (form == "blend" && remembers(GetParam())) continue;               // refused
    if (form != "none" && !takes(GetParam(), "stabilisation")) continue;  // a fluid
    const auto closure = [&](double fraction) {
      Model model;
      model.add(GetParam(), mesh(),
                accepted(GetParam(), {{"fracture", "critical_strain", breaking_strain(GetParam())},
                                      {"viscosity", "beta", 0.5},
                                      {"viscosity", "length", kSpacing},
                                      {"stabilisation", "form", 0, form},
                                      {"stabilisation", "alpha", 0.05}}));
      model.setup();
      pull(model, 16.0);
      const double dt = fraction * model.stable_step();
      for (int n = 0; n < static_cast<int>(40 / fraction); ++n) model.step(dt);
      EXPECT_GT(model.counts().broken, 10);
      const cleave_energies e = model.energies();
      return std::fabs(e.balance) / (e.kinetic + e.fracture + e.viscous);
    };
    const double coarse = closure(0.2), fine = closure(0.1);
    if (remembers(GetParam())) {
      EXPECT_LT(fine, 2e-3) << form;
      EXPECT_GT(coarse / fine, 1.5) << form;
      continue;
    }
    // Measured 3e-7 to 5e-7; interactions, which have no viscosity, 5e-6 to 1.3e-5.
    EXPECT_LT(fine, interacts(GetParam().formulation) ? 2e-5 : 2e-6) << form;
    EXPECT_GT(coarse / fine, 2.5) << form;  // second order: measured 2.9 to 4.0
  }
}

TEST_P(Fracture, PatchIsExactAfterDeletionsAndIsolatedParticlesStayFinite) {
  const SimplexMesh m = mesh();
  Model model;
  model.add(GetParam(), m, {{"fracture", "critical_strain", breaking_strain(GetParam())}});
  model.setup();
  // Every bond of particle 0 cut: it has no simplex left.
  const auto ends = model.integer("bond_ends");
  std::vector<int64_t> pairs;
  for (std::size_t b = 0; b < ends.size() / 2; ++b) {
    if (ends[2 * b] == 0 || b % 9 == 0) {
      pairs.push_back(ends[2 * b]);
      pairs.push_back(ends[2 * b + 1]);
    }
  }
  ok(cleave_body_precrack(model, 0, static_cast<int64_t>(pairs.size()) / 2, pairs.data()));
  const double g = 0.01;  // below the critical strain
  std::vector<double> u(m.X.size(), 0.0);
  for (std::size_t i = 0; i < u.size() / 3; ++i) {
    u[3 * i] = g * m.X[3 * i] + 0.5 * g * m.X[3 * i + 1];
    u[3 * i + 1] = -g * m.X[3 * i + 1];
  }
  model.put("displacement", u);
  model.initialise();
  EXPECT_GE(model.counts().isolated, 1);
  EXPECT_EQ(model.counts().broken, 0);
  const auto h = model.real("displacement_gradient"), damage = model.real("damage");
  for (std::size_t i = 0; i < damage.size(); ++i) {
    if (damage[i] == 1) continue;
    EXPECT_NEAR(h[9 * i], g, 1e-13);
    EXPECT_NEAR(h[9 * i + 3], 0.5 * g, 1e-13);
    EXPECT_NEAR(h[9 * i + 4], -g, 1e-13);
  }
  EXPECT_EQ(damage[0], 1);
  const double dt = 0.3 * model.stable_step();
  const auto v0 = model.real("velocity");
  for (int n = 0; n < 20; ++n) model.step(dt);
  const auto v = model.real("velocity");
  for (std::size_t k = 0; k < 3; ++k) EXPECT_EQ(v[k], v0[k]);  // ballistic
}

TEST_P(Fracture, ExemptAndDrivenBondsNeverBreak) {
  const SimplexMesh m = mesh();
  Model model;
  model.add(GetParam(), m, {{"fracture", "critical_strain", breaking_strain(GetParam())}});
  std::vector<int64_t> zone;
  for (int64_t i = 0; i < m.particles(); ++i) {
    if (m.X[static_cast<std::size_t>(3 * i)] > 5 * kSpacing * 0.5) zone.push_back(i);
  }
  ok(cleave_body_exempt(model, 0, static_cast<int64_t>(zone.size()), zone.data()));
  model.setup();
  pull(model, 12.0);
  const double dt = 0.3 * model.stable_step();
  for (int n = 0; n < 200; ++n) model.step(dt);
  const auto ends = model.integer("bond_ends"), status = model.integer("bond_status");
  int64_t broken = 0;
  for (std::size_t b = 0; b < status.size(); ++b) {
    const bool inside = m.X[static_cast<std::size_t>(3 * ends[2 * b])] > 5 * kSpacing * 0.5 &&
                        m.X[static_cast<std::size_t>(3 * ends[2 * b + 1])] > 5 * kSpacing * 0.5;
    if (inside) {
      ASSERT_NE(status[b], 1);
    }
    broken += status[b] == 1;
  }
  EXPECT_GT(broken, 5);
}

INSTANTIATE_TEST_SUITE_P(Tables, Fracture, testing::ValuesIn(cases_that_take("fracture")),
                         case_name);

}  // namespace
}  // namespace cleave::test
