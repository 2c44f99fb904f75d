// Hosts that trap floating-point errors can run a whole fracture case: no invalid operation, no
// division by zero, no overflow, also with infinite critical strains and particles without simplex.
#include <cfenv>

#include "support/bonds.hpp"
#include "support/model.hpp"

namespace cleave::test {
namespace {

#if defined(__GLIBC__)
constexpr int kTraps = FE_INVALID | FE_DIVBYZERO | FE_OVERFLOW;

// Turns the traps on; a trapped operation ends the process, which is the failure of the test.
class Traps {
 public:
  Traps() {
    std::feclearexcept(FE_ALL_EXCEPT);
    feenableexcept(kTraps);
  }
  ~Traps() {
    std::feclearexcept(FE_ALL_EXCEPT);
    fedisableexcept(kTraps);
  }
};

class FloatingPoint : public testing::TestWithParam<Case> {};

TEST_P(FloatingPoint, NoTrapInAFractureRun) {
  const int d = dimension_of(GetParam());
  const SimplexMesh mesh = solid(GetParam(), d == 2 ? 10 : 5, 0.01, 0.15, 111);
  const Traps traps;
  for (const char* viscosity : {"frozen", "central", "paper"}) {
    for (const std::string stabilisation : {"deviation", "blend"}) {
      if (stabilisation == "blend" && remembers(GetParam())) continue;  // refused
      const bool bonds_only = interacts(GetParam().formulation);
      if (stabilisation == "deviation" && !bonds_only && !takes(GetParam(), "stabilisation"))
        continue;  // a fluid
      if (bonds_only && stabilisation == "blend") continue;
      Model model;
      model.add(GetParam(), mesh,
                accepted(GetParam(), {{"fracture", "critical_strain", breaking_strain(GetParam())},
                                      {"viscosity", "form", 0, viscosity},
                                      {"viscosity", "beta", 0.3},
                                      {"viscosity", "length", 0.01},
                                      {"stabilisation", "form", 0, stabilisation},
                                      {"stabilisation", "alpha", 0.03}}));
      // A zone without fracture: infinite critical strains.
      std::vector<int64_t> zone;
      for (int64_t i = mesh.particles() / 2; i < mesh.particles(); ++i) zone.push_back(i);
      ok(cleave_body_exempt(model, 0, static_cast<int64_t>(zone.size()), zone.data()));
      model.setup();
      // Particle 0 loses all its simplices before the start.
      const auto ends = model.integer("bond_ends");
      for (std::size_t b = 0; b < ends.size() / 2; ++b) {
        if (ends[2 * b] == 0) ok(cleave_body_precrack(model, 0, 1, &ends[2 * b]));
      }
      auto v = random_vectors(mesh, 8.0, 5);
      for (std::size_t i = 0; i < v.size() / 3; ++i) v[3 * i] += 3000 * mesh.X[3 * i];
      model.put("velocity", v);
      model.initialise();
      const double dt = 0.4 * model.stable_step();
      for (int n = 0; n < 80; ++n) model.step(dt);
      EXPECT_GT(model.counts().broken, 5);
      EXPECT_GE(model.counts().isolated, 1);
      for (const char* derived : {"damage", "cauchy_stress", "equivalent_stress"})
        EXPECT_FALSE(model.real(derived).empty());
      EXPECT_GE(model.energies().hourglass, 0);
    }
  }
  EXPECT_EQ(std::fetestexcept(kTraps), 0);
}

// Coinciding and overlapping particles: no direction, no trap.
class Coinciding : public testing::TestWithParam<Case> {};

TEST_P(Coinciding, NoTrapWhereParticlesCoincide) {
  const SimplexMesh mesh = solid(GetParam(), 3, 0.01, 0.1, 112);
  const Traps traps;
  for (const char* viscosity : {"frozen", "central", "paper"}) {
    Model model;
    model.add(GetParam(), mesh,
              accepted(GetParam(), {{"fracture", "critical_strain", 0.5},
                                    {"viscosity", "form", 0, viscosity},
                                    {"viscosity", "length", 0.01}}));
    model.setup();
    std::vector<double> u(mesh.X.size());
    for (std::size_t k = 0; k < u.size(); ++k) u[k] = -mesh.X[k];  // all at one point
    model.put("displacement", u);
    model.put("velocity", random_vectors(mesh, 1.0, 3));
    model.initialise();
    for (const double f : model.real("viscous_force")) EXPECT_EQ(f, 0);
  }
}

// Other laws, and plane stress, have no answer to F = 0.
std::vector<Case> with_answer_to_zero() {
  std::vector<Case> out;
  for (const Case& c : cases_that_take("fracture")) {
    if (c.material == CLEAVE_MATERIAL_svk && c.kinematics != CLEAVE_PLANE_STRESS) out.push_back(c);
  }
  return out;
}
INSTANTIATE_TEST_SUITE_P(Tables, Coinciding, testing::ValuesIn(with_answer_to_zero()), case_name);
INSTANTIATE_TEST_SUITE_P(Tables, FloatingPoint, testing::ValuesIn(cases_that_take("fracture")),
                         case_name);
#endif

}  // namespace
}  // namespace cleave::test
