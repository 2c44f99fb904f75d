// Critical bond strain, given or from the fracture energy [CBM 32], and who is exempt.
#include <gtest/gtest.h>

#include <cmath>

#include "support/model.hpp"

namespace cleave::test {
namespace {

constexpr Case kPlate{CLEAVE_FORMULATION_cbm, CLEAVE_MATERIAL_svk, CLEAVE_PLANE_STRESS};

std::vector<double> critical(const SimplexMesh& mesh, const std::vector<Setting>& settings) {
  Model model;
  model.add(kPlate, mesh, settings);
  model.setup();
  return model.real("critical_strain");
}

// PMMA with E = 3.24 GPa: the values of benchmarks B and C.
TEST(CriticalStrain, FromFractureEnergyIsThatOfTheBenchmarkTable) {
  const SimplexMesh mesh = patch(2, 2, 1e-3, 0.1, 1);
  const struct {
    double per_mm, Gf, strain;
  } table[] = {{4, 100, 0.01571}, {5, 100, 0.01757}, {6, 100, 0.01925}, {7, 100, 0.02079},
               {8, 100, 0.02222}, {6, 250, 0.03043}, {6, 500, 0.04303}};
  for (const auto& t : table) {
    const auto strain =
        critical(mesh, {{"fracture", "Gf", t.Gf}, {"fracture", "length", 1e-3 / t.per_mm}});
    for (const double s : strain) EXPECT_NEAR(s, t.strain, 6e-6);  // printed with four digits
  }
}

TEST(CriticalStrain, LocalLengthIsThatOfTheBond) {
  const SimplexMesh mesh = patch(2, 3, 1e-3, 0.2, 2);
  Model model;
  model.add(kPlate, mesh, {{"fracture", "Gf", 100}, {"fracture", "length_mode", 0, "local"}});
  model.setup();
  const auto strain = model.real("critical_strain"), length = model.real("bond_length");
  for (std::size_t b = 0; b < strain.size(); ++b)
    EXPECT_NEAR(strain[b] * strain[b] * 3.24e9 * length[b], 200, 1e-11);
}

TEST(CriticalStrain, IsInfiniteWithoutFractureAndGivenWhereGiven) {
  const SimplexMesh mesh = patch(2, 2, 1e-3, 0.1, 1);
  for (const double s : critical(mesh, {})) EXPECT_TRUE(std::isinf(s));
  for (const double s :
       critical(mesh, {{"fracture", "criterion", 0, "none"}, {"fracture", "Gf", 1}}))
    EXPECT_TRUE(std::isinf(s));
  for (const double s : critical(mesh, {{"fracture", "critical_strain", 0.031}}))
    EXPECT_EQ(s, 0.031);
}

TEST(CriticalStrain, ContradictionsAreRefused) {
  const struct {
    std::vector<Setting> settings;
    int32_t status;
    const char* part;
  } table[] = {
      {{{"fracture", "criterion", 0, "bond_strain"}}, CLEAVE_MISSING_PARAMETER, "critical_strain"},
      {{{"fracture", "Gf", 100}}, CLEAVE_MISSING_PARAMETER, "length"},
      {{{"fracture", "Gf", 100}, {"fracture", "critical_strain", 0.1}}, CLEAVE_BAD_ARGUMENT, "one"},
  };
  for (const auto& t : table) {
    Model model;
    model.add(kPlate, patch(2, 2, 1e-3, 0.1, 1), t.settings);
    EXPECT_EQ(cleave_model_setup(model), t.status);
    EXPECT_NE(last_message().find(t.part), std::string::npos) << last_message();
    EXPECT_NE(last_message().find("body 0 'patch'"), std::string::npos) << last_message();
  }
}

// A bond is exempt if both ends are in a zone, or both are driven in every direction; one end, or
// one direction, is not enough.
TEST(CriticalStrain, BothEndsMustBeProtectedInTheSameWay) {
  SimplexMesh square;
  square.X = {0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0};
  square.simplices = {0, 1, 2, 0, 2, 3};
  Model model;
  model.add(kPlate, square, {{"fracture", "critical_strain", 0.02}});
  const std::vector<int64_t> zone = {0, 1};
  ok(cleave_body_exempt(model, 0, 2, zone.data()));
  // 2 and 3 driven in both directions, 0 in x only.
  const std::vector<int64_t> particle = {2, 2, 3, 3, 0};
  const std::vector<int32_t> direction = {0, 1, 0, 1, 0};
  const std::vector<int32_t> motion(5, CLEAVE_MOTION_EXACT);
  ok(cleave_body_prescribe(model, 0, 5, particle.data(), direction.data(), motion.data()));
  model.setup();
  const auto strain = model.real("critical_strain");
  const auto ends = model.integer("bond_ends");
  for (std::size_t b = 0; b < strain.size(); ++b) {
    const bool exempt =
        (ends[2 * b] == 0 && ends[2 * b + 1] == 1) || (ends[2 * b] == 2 && ends[2 * b + 1] == 3);
    EXPECT_EQ(std::isinf(strain[b]), exempt) << ends[2 * b] << '-' << ends[2 * b + 1];
  }
}

}  // namespace
}  // namespace cleave::test
