// Breaking: which simplices go, what is recorded, and how much energy is released, by hand on a
// square of two triangles.
#include <gtest/gtest.h>

#include <cmath>

#include "support/model.hpp"

namespace cleave::test {
namespace {

constexpr double kSide = 0.01, kYoungs = 3.24e9;
constexpr Case kPlate{CLEAVE_FORMULATION_cbm, CLEAVE_MATERIAL_svk, CLEAVE_PLANE_STRAIN};

// Particles 0 (0,0), 1 (h,0), 2 (h,h), 3 (0,h); triangles (0,1,2) and (0,2,3).
// nu = 0: W = E/2 E:E.
struct Square {
  explicit Square(double critical_strain, double e, double f) {
    SimplexMesh mesh;
    mesh.X = {0, 0, 0, kSide, 0, 0, kSide, kSide, 0, 0, kSide, 0};
    mesh.simplices = {0, 1, 2, 0, 2, 3};
    model.add(kPlate, mesh, {{"fracture", "critical_strain", critical_strain}});
    ok(cleave_body_set_real(model, 0, "material", "nu", 0.0));
    model.setup();
    std::vector<double> u(12, 0.0);  // particle 1 alone moves, by (e h, f h)
    u[3] = e * kSide;
    u[4] = f * kSide;
    model.put("displacement", u);
    model.initialise();
    model.step(1e-7 * model.stable_step());  // next to no motion: only the criterion acts
  }
  std::vector<cleave_event> events() const {
    int64_t count = 0;
    ok(cleave_body_event_count(model, 0, &count));
    std::vector<cleave_event> out(static_cast<std::size_t>(count));
    for (int64_t k = 0; k < count; ++k) {
      out[static_cast<std::size_t>(k)].size = sizeof(cleave_event);
      ok(cleave_body_event_get(model, 0, k, &out[static_cast<std::size_t>(k)]));
    }
    return out;
  }
  Model model;
};

// Triangle (0,1,2) has g_1 = (1,-1)/h, so H = u_1 (x) g_1 = [e -e; f -f] there, zero in the other
// triangle, and half of it at the shared particles 0 and 2. Energy of H = [a -a; b -b] with nu = 0:
double energy_density(double a, double b) {
  const double c11 = (1 + a) * (1 + a) + b * b, c22 = a * a + (1 - b) * (1 - b),
               c12 = -(1 + a) * a + b * (1 - b);
  const double e11 = 0.5 * (c11 - 1), e22 = 0.5 * (c22 - 1), e12 = 0.5 * c12;
  return 0.5 * kYoungs * (e11 * e11 + e22 * e22 + 2 * e12 * e12);
}
// Losing triangle (0,1,2) sets H to zero everywhere: particle 1 had h^2/6, 0 and 2 have h^2/3.
double released(double a, double b) {
  return kSide * kSide * (energy_density(a, b) / 6 + 2 * energy_density(a / 2, b / 2) / 3);
}

TEST(FractureByHand, OneBondTakesItsTriangleAndItsEnergy) {
  const double e = 0.03;
  const Square square(0.02, e, 0);  // bond 0-1 at e, bond 1-2 at e^2/2, bond 0-2 at 0
  const auto events = square.events();
  ASSERT_EQ(events.size(), 1u);
  EXPECT_EQ(events[0].step, 1);
  EXPECT_EQ(events[0].first, 0);
  EXPECT_EQ(events[0].second, 1);
  EXPECT_NEAR(events[0].criterion, e, 1e-12);
  EXPECT_EQ(events[0].limit, 0.02);
  EXPECT_EQ(events[0].midpoint[0], kSide / 2);
  EXPECT_EQ(events[0].midpoint[1], 0);
  EXPECT_NEAR(events[0].released, released(e, 0), 1e-10 * released(e, 0));  // measured 2e-14
  EXPECT_NEAR(square.model.energies().fracture, events[0].released, 1e-12 * events[0].released);
  // What is left is undeformed but for the 1e-7 of a step.
  EXPECT_NEAR(square.model.energies().elastic, 0, 1e-20 * released(e, 0));
  EXPECT_EQ(square.model.integer("simplex_alive"), (std::vector<int64_t>{0, 1}));
  // Bonds 0-1, 0-2, 0-3, 1-2, 2-3: broken, intact, intact, inert, intact.
  EXPECT_EQ(square.model.integer("bond_status"), (std::vector<int64_t>{1, 0, 0, 2, 0}));
  EXPECT_EQ(square.model.counts().broken, 1);
  EXPECT_EQ(square.model.counts().inert, 1);
  EXPECT_EQ(square.model.counts().isolated, 1);
  const auto damage = square.model.real("damage");
  const double expected[4] = {0.5, 1, 0.5, 0};
  for (std::size_t i = 0; i < 4; ++i) EXPECT_NEAR(damage[i], expected[i], 1e-15);
}

TEST(FractureByHand, TwoBondsOfOneTriangleShareItsEnergy) {
  const double e = 0.03;
  const Square square(0.02, e, -e);  // bonds 0-1 and 1-2 both at e
  const auto events = square.events();
  ASSERT_EQ(events.size(), 2u);
  EXPECT_EQ(events[0].first, 0);
  EXPECT_EQ(events[0].second, 1);
  EXPECT_EQ(events[1].first, 1);
  EXPECT_EQ(events[1].second, 2);
  const double half = 0.5 * released(e, -e);
  for (const auto& event : events) EXPECT_NEAR(event.released, half, 1e-10 * half);
  EXPECT_NEAR(square.model.energies().fracture, 2 * half, 1e-10 * half);
  EXPECT_EQ(square.model.integer("bond_status"), (std::vector<int64_t>{1, 0, 0, 1, 0}));
}

TEST(FractureByHand, CriterionCountsElongationOnly) {
  const Square pushed(0.02, -0.05, 0);  // compressed, and stretched by 1e-3 only
  EXPECT_TRUE(pushed.events().empty());
  EXPECT_EQ(pushed.model.counts().broken, 0);
  const Square below(0.0301, 0.03, 0);
  EXPECT_TRUE(below.events().empty());
}

TEST(FractureByHand, EventsStayUntilCleared) {
  const Square square(0.02, 0.03, 0);
  ASSERT_EQ(square.events().size(), 1u);
  ok(cleave_body_clear_events(square.model, 0));
  EXPECT_TRUE(square.events().empty());
  EXPECT_EQ(square.model.counts().broken, 1);
}

TEST(Precrack, CutsWithoutEventAndEnergyWhateverTheOrderOfEnds) {
  for (const bool swapped : {false, true}) {
    Model model;
    model.add(kPlate, patch(2, 6, kSide, 0.2, 3));
    model.setup();
    // The diagonal of the first square: both of its triangles go.
    std::vector<int64_t> pair = {0, 8};
    if (swapped) std::swap(pair[0], pair[1]);
    ok(cleave_body_precrack(model, 0, 1, pair.data()));
    model.initialise();
    const auto alive = model.integer("simplex_alive");
    EXPECT_EQ(std::count(alive.begin(), alive.end(), 0), 2);
    EXPECT_EQ(model.counts().broken, 0);
    EXPECT_EQ(model.counts().inert, 3);  // the diagonal, 0-1 and 0-7; 1-8 and 7-8 live on
    EXPECT_EQ(model.counts().isolated, 1);
    EXPECT_EQ(model.energies().fracture, 0);
    int64_t count = -1;
    ok(cleave_body_event_count(model, 0, &count));
    EXPECT_EQ(count, 0);
  }
}

TEST(Precrack, RefusedListChangesNothing) {
  Model model;
  model.add(kPlate, patch(2, 6, kSide, 0.2, 3));
  model.setup();
  const auto zeta = model.real("bond_vector");
  const std::vector<int64_t> pairs = {0, 8, 0, 40};  // the second pair is far apart
  EXPECT_EQ(cleave_body_precrack(model, 0, 2, pairs.data()), CLEAVE_BAD_ARGUMENT);
  EXPECT_NE(last_message().find("0 and 40 are not bonded"), std::string::npos) << last_message();
  const std::vector<int64_t> good = {47, 48};
  ok(cleave_body_precrack(model, 0, 1, good.data()));
  const auto alive = model.integer("simplex_alive");
  EXPECT_EQ(std::count(alive.begin(), alive.end(), 0), 1);  // nothing of the refused list
}

}  // namespace
}  // namespace cleave::test
