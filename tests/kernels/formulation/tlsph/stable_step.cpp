// The stable step of the kernel methods: runs at it are stable, runs a quarter above 2/omega_max are not.
#include "formulation/tlsph/bodies.hpp"

namespace cleave::test {
namespace {

// Largest energies of a run over the first ones. At the step's limit only the staggered one stays what
// it was; far above only the kinetic one is sure to grow.
struct Growth {
  double staggered = 1, kinetic = 1;
};

// A body with small random velocities at `factor` times the model's step.
Growth growth(const SimplexMesh& mesh, const std::vector<Setting>& settings, double factor,
              int steps = 600) {
  Model model;
  model.add(kernel_case(CLEAVE_FORMULATION_tlsph, mesh.dimension), mesh, settings);
  model.setup();
  model.put("velocity", random_vectors(mesh, 1.0, 9));
  model.initialise();
  const double dt = factor * model.stable_step(), start = model.energies().kinetic;
  Growth most;
  for (int n = 0; n < steps; ++n) {
    if (cleave_model_advance(model, dt, (n + 1) * dt) != CLEAVE_OK ||
        cleave_model_update(model) != CLEAVE_OK)
      return {INFINITY, INFINITY};
    const cleave_energies e = model.energies();
    most.staggered =
        std::fmax(most.staggered, (e.kinetic_staggered + e.elastic + e.stabilisation) / start);
    most.kinetic = std::fmax(most.kinetic, e.kinetic / start);
  }
  return most;
}

std::vector<Setting> kernel(double radius) { return {{"kernel", "radius", radius}}; }
std::vector<Setting> viscosity(const char* form, double beta, double length) {
  return {
      {"viscosity", "form", 0, form}, {"viscosity", "beta", beta}, {"viscosity", "length", length}};
}

// Squares whose spacing along x grows by the ratio from end to end.
SimplexMesh graded(int cells, double ratio) {
  SimplexMesh mesh = patch(2, cells, 1.0, 0.1, 5);
  for (std::size_t i = 0; i < mesh.X.size(); i += 3)
    mesh.X[i] = (std::pow(ratio, mesh.X[i] / cells) - 1) * cells / (ratio - 1);
  return mesh;
}

TEST(KernelStableStep, IsJustBelowTheLimit) {
  for (const double jitter : {0.0, 0.3}) {
    for (const double r : {1.5, 3.0}) {
      const SimplexMesh mesh = triangular_lattice(14, 14, 1.0, jitter, 3);
      EXPECT_LT(growth(mesh, kernel(r), 1.0).staggered, 1.01) << r;
      EXPECT_GT(growth(mesh, kernel(r), 1.25).kinetic, 20) << r;  // 0.9 * 1.25 = 1.125 of the limit
    }
  }
}

// The table of the theory chapter: 2/omega_max in spacings over wave speed.
TEST(KernelStableStep, LimitsAreThoseOfTheTheoryChapter) {
  struct Row {
    double radius, none, projected, strongly_projected, conservative, strongly_conservative;
  };
  const double properties[] = {1190, 3.24e9, 0.35};
  double speed = 0;
  ok(cleave_material_wave_speed(CLEAVE_MATERIAL_svk, CLEAVE_PLANE_STRESS, 3, properties, &speed));
  const auto limit = [&](double jitter, const std::vector<Setting>& settings) {
    Model model;
    model.add(kernel_case(CLEAVE_FORMULATION_tlsph, 2), triangular_lattice(20, 20, 1.0, jitter, 1),
              settings);
    model.setup();
    return model.stable_step() * speed / 0.9;
  };
  for (const Row& row :
       {Row{1.5, 1.86, 1.85, 1.80, 1.85, 1.72}, Row{2, 2.43, 2.42, 2.34, 2.41, 2.25},
        Row{3, 3.57, 3.56, 3.41, 3.55, 3.30}, Row{4, 4.72, 4.70, 4.47, 4.69, 4.37}}) {
    const auto k = kernel(row.radius);
    EXPECT_NEAR(limit(0, k), row.none, 0.006);
    EXPECT_NEAR(limit(0, k + hourglass("projected", 0.1)), row.projected, 0.006);
    EXPECT_NEAR(limit(0, k + hourglass("projected", 1)), row.strongly_projected, 0.006);
    EXPECT_NEAR(limit(0, k + hourglass("conservative", 0.1)), row.conservative, 0.006);
    EXPECT_NEAR(limit(0, k + hourglass("conservative", 1)), row.strongly_conservative, 0.006);
  }
  EXPECT_NEAR(limit(0.3, kernel(2) + hourglass("projected", 1)), 1.94, 0.006);
  EXPECT_NEAR(limit(0.3, kernel(3) + hourglass("projected", 1)), 2.73, 0.006);
  EXPECT_NEAR(limit(0.3, kernel(4) + hourglass("projected", 1)), 3.44, 0.006);
}

TEST(KernelStableStep, KnowsThePenalty) {
  const SimplexMesh mesh = triangular_lattice(14, 14, 1.0, 0.3, 4);
  for (const char* form : {"projected", "conservative"}) {
    for (const double psi : {0.3, 1.0, 30.0}) {
      const auto settings = kernel(2.5) + hourglass(form, psi);
      EXPECT_LT(growth(mesh, settings, 1.0).staggered, 1.05) << form << psi;
      EXPECT_GT(growth(mesh, settings, 1.25).kinetic, 20) << form << psi;
    }
  }
}

TEST(KernelStableStep, KnowsGradedMeshesCubesAndThinStrips) {
  for (const SimplexMesh& mesh :
       {graded(12, 4.0), patch(3, 5, 1.0, 0.2, 6), triangular_lattice(24, 3, 1.0, 0.0, 1)}) {
    EXPECT_LT(growth(mesh, kernel(1.6), 1.0).staggered, 1.01);
    EXPECT_GT(growth(mesh, kernel(1.6), 1.25).kinetic, 20);
  }
}

TEST(KernelStableStep, KnowsTheViscosity) {
  const SimplexMesh mesh = triangular_lattice(14, 14, 1.0, 0.2, 5);
  for (const char* form : {"frozen", "central", "paper"}) {
    for (const double beta : {0.5, 2.0}) {
      for (const double length : {1.0, 10.0}) {
        const auto settings = kernel(2.0) + viscosity(form, beta, length);
        EXPECT_LT(growth(mesh, settings, 1.0).staggered, 1.01) << form << beta << ' ' << length;
        EXPECT_GT(growth(mesh, settings, 1.25).kinetic, 20) << form << beta << ' ' << length;
      }
    }
  }
}

}  // namespace
}  // namespace cleave::test
