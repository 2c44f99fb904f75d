// Smooth ramps [CBM 26] and [CBM 30], and what velocity Verlet makes of their accelerations.
#include "core/ramp.hpp"

#include <cmath>

#include "support/model.hpp"

namespace cleave {
namespace {

constexpr double kValue = 2.5, kTau = 0.8;

using Ramp = Motion (*)(double, double, double);

TEST(Ramp, VelocityAndAccelerationAreTheDerivatives) {
  for (const Ramp ramp : {Ramp{displacement_ramp}, Ramp{velocity_ramp}}) {
    for (const double s : {0.05, 0.3, 0.5, 0.71, 0.95}) {
      const double t = s * kTau, dt = 1e-5 * kTau;
      const Motion m = ramp(kValue, kTau, t), before = ramp(kValue, kTau, t - dt),
                   after = ramp(kValue, kTau, t + dt);
      // Central differences: error dt^2/6 of a third derivative of size 60 u/tau^3.
      EXPECT_NEAR((after.displacement - before.displacement) / (2 * dt), m.velocity,
                  5e-9 * kValue / kTau);  // measured 7e-10
      EXPECT_NEAR((after.velocity - before.velocity) / (2 * dt), m.acceleration,
                  5e-8 * kValue / (kTau * kTau));  // measured 5e-9
    }
  }
}

TEST(Ramp, DisplacementRampIsAtRestAtBothEnds) {
  for (const double t : {-1.0, 0.0}) {
    const Motion m = displacement_ramp(kValue, kTau, t);
    EXPECT_EQ(m.displacement, 0);
    EXPECT_EQ(m.velocity, 0);
    EXPECT_EQ(m.acceleration, 0);
  }
  for (const double t : {kTau, 2 * kTau}) {
    const Motion m = displacement_ramp(kValue, kTau, t);
    EXPECT_EQ(m.displacement, kValue);
    EXPECT_EQ(m.velocity, 0);
    EXPECT_EQ(m.acceleration, 0);
  }
  // The polynomials themselves arrive there: just before tau.
  const Motion last = displacement_ramp(kValue, kTau, kTau * (1 - 1e-9));
  EXPECT_NEAR(last.displacement, kValue, 1e-14 * kValue);
  EXPECT_NEAR(last.velocity, 0, 1e-14 * kValue / kTau);
  EXPECT_NEAR(last.acceleration, 0, 1e-6 * kValue / (kTau * kTau));  // 60e-9
  const Motion middle = displacement_ramp(kValue, kTau, 0.5 * kTau);
  EXPECT_NEAR(middle.displacement, 0.5 * kValue, 1e-15 * kValue);
  EXPECT_NEAR(middle.velocity, 15 * kValue / (8 * kTau), 1e-14 * kValue / kTau);
}

TEST(Ramp, VelocityRampKeepsItsVelocity) {
  const Motion end = velocity_ramp(kValue, kTau, kTau);
  EXPECT_NEAR(end.displacement, 0.5 * kValue * kTau, 1e-15);
  EXPECT_EQ(end.velocity, kValue);
  EXPECT_EQ(end.acceleration, 0);
  const Motion last = velocity_ramp(kValue, kTau, kTau * (1 - 1e-9));
  EXPECT_NEAR(last.displacement, end.displacement, 2e-9 * kValue * kTau);
  EXPECT_NEAR(last.velocity, kValue, 1e-14 * kValue);
  EXPECT_NEAR(last.acceleration, 0, 1e-8 * kValue / kTau);
  const Motion middle = velocity_ramp(kValue, kTau, 0.5 * kTau);
  EXPECT_NEAR(middle.velocity, 0.5 * kValue, 1e-15 * kValue);
  EXPECT_NEAR(middle.acceleration, 1.5 * kValue / kTau, 1e-14 * kValue / kTau);
  const Motion later = velocity_ramp(kValue, kTau, 3 * kTau);
  EXPECT_NEAR(later.displacement, 2.5 * kValue * kTau, 1e-14);
  EXPECT_EQ(later.velocity, kValue);
}

TEST(Ramp, NoTimeIsAJump) {
  EXPECT_EQ(displacement_ramp(kValue, 0, 0).displacement, 0);
  EXPECT_EQ(displacement_ramp(kValue, 0, 1e-300).displacement, kValue);
  EXPECT_EQ(velocity_ramp(kValue, 0, 2).displacement, 2 * kValue);
  EXPECT_EQ(velocity_ramp(kValue, 0, 2).velocity, kValue);
}

// One driven particle of a triangle at the end of the ramp.
struct End {
  double displacement, velocity;
};
End driven(Ramp ramp, int steps, int32_t motion) {
  test::SimplexMesh triangle;
  triangle.X = {0, 0, 0, 1, 0, 0, 0, 1, 0};
  triangle.simplices = {0, 1, 2};
  test::Model model;
  model.add({CLEAVE_FORMULATION_cbm, CLEAVE_MATERIAL_svk, CLEAVE_PLANE_STRAIN}, triangle);
  const int64_t particle = 1;
  const int32_t direction = 0;
  test::ok(cleave_body_prescribe(model, 0, 1, &particle, &direction, &motion));
  model.setup();
  // Small and slow, so that the triangle does not matter: the motion is prescribed.
  const double value = 1e-3, dt = 0.1 * model.stable_step(), tau = steps * dt;
  const auto give = [&](double t_displacement, double t_acceleration) {
    const double u = ramp(value, tau, t_displacement).displacement,
                 a = ramp(value, tau, t_acceleration).acceleration;
    test::ok(cleave_body_motion(model, 0, 1, &u, &a));
  };
  give(0, 0);
  model.initialise();
  for (int n = 0; n < steps; ++n) {
    give((n + 1) * dt, n * dt);
    test::ok(cleave_model_advance(model, dt, (n + 1) * dt));
    give((n + 1) * dt, (n + 1) * dt);
    test::ok(cleave_model_update(model));
  }
  return {model.real("displacement")[3] / value, model.real("velocity")[3] / value};
}

TEST(Ramp, AccelerationsThroughVerletLoseTheKnownAmount) {
  // benchmarks F: 0.99950004 and 0.99990000 with 100 steps a ramp, -5.0e-6 and -1.0e-6 with 1000.
  EXPECT_NEAR(driven(displacement_ramp, 100, CLEAVE_MOTION_ACCELERATION).displacement, 0.99950004,
              1e-8);
  EXPECT_NEAR(driven(velocity_ramp, 100, CLEAVE_MOTION_ACCELERATION).velocity, 0.99990000, 1e-8);
  EXPECT_NEAR(driven(displacement_ramp, 1000, CLEAVE_MOTION_ACCELERATION).displacement - 1, -5e-6,
              1e-8);
  EXPECT_NEAR(driven(velocity_ramp, 1000, CLEAVE_MOTION_ACCELERATION).velocity - 1, -1e-6, 1e-8);
}

TEST(Ramp, ExactMotionLosesNothing) {
  EXPECT_EQ(driven(displacement_ramp, 100, CLEAVE_MOTION_EXACT).displacement, 1.0);
}

}  // namespace
}  // namespace cleave
