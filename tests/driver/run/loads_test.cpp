// Forces and initial velocities from end to end, against closed forms and balances.
#include <cmath>

#include "support.hpp"

namespace cleave::driver::testing {
namespace {

using Loads = RunDirectory;

const std::string kPlate = std::string(kUnitPlate) + kUnitMaterial;  // 4 x 3, mass 12
const std::string kBlock = std::string(kUnitBlock) + kUnitMaterial;  // 2 x 2 x 3, mass 12

TEST_F(Loads, GravityIsFreeFall) {
  run("t_end=2 time_step=0.1",
      kBlock + "&load name='g' kind='gravity' directions='z' value=-0.5 /\n");
  const auto h = read_history(path("case.history.csv"));
  EXPECT_NEAR(h.at("momentum_z").back(), -12 * 0.5 * 2, 1e-12);
  EXPECT_NEAR(h.at("external").back(), 12 * 0.5 * 0.5 * 2 * 2 * 0.5, 1e-12);  // m g^2 t^2/2
  EXPECT_NEAR(h.at("elastic").back(), 0.0, 1e-20);
  EXPECT_DOUBLE_EQ(h.at("force_g_z").back(), -6.0);
}

TEST_F(Loads, BodyForceIsPerVolumeAndForceIsATotal) {
  run("t_end=1 time_step=0.1",
      kBlock +
          "&load name='b' kind='body_force' directions='x' value=0.25 /\n"
          "&load name='f' kind='force' set='zmax' directions='xy' value=0.006 /\n");
  const auto h = read_history(path("case.history.csv"));
  EXPECT_NEAR(h.at("force_b_x").back(), 3.0, 1e-14);
  EXPECT_NEAR(h.at("force_f_x").back(), 0.006, 1e-16);
  EXPECT_NEAR(h.at("momentum_x").back(), 3.006, 1e-12);
  EXPECT_NEAR(h.at("momentum_y").back(), 0.006, 1e-12);
}

TEST_F(Loads, TractionIsPerReferenceArea) {
  run("t_end=1 time_step=0.1",
      kBlock +
          "&load name='t' kind='traction' set='zmax' directions='z' value=1e-3 "
          "curve='linear' ramp=1 /\n");
  const auto h = read_history(path("case.history.csv"));
  EXPECT_NEAR(h.at("force_t_z").back(), 4e-3, 1e-17);
  EXPECT_NEAR(h.at("momentum_z").back(), 2e-3, 1e-15);  // a ramp from 0 to 4e-3 in unit time
}

// Slow opposite tractions leave the bar in the state of uniaxial stress.
TEST_F(Loads, OppositeTractionsAreInEquilibrium) {
  run("t_end=400 time_step=0.2",
      kPlate +
          "&viscosity beta=0.5 length=1 /\n"
          "&load name='l' kind='traction' set='xmin' directions='x' value=-1e-4 "
          "curve='smooth' ramp=200 /\n"
          "&load name='r' kind='traction' set='xmax' directions='x' value=1e-4 "
          "curve='smooth' ramp=200 /\n"
          "&zone name='everything' /\n"
          "&probe name='P' field='first_piola_kirchhoff_stress' set='everything' /\n");
  const auto h = read_history(path("case.history.csv"));
  EXPECT_NEAR(h.at("force_l_x").back(), -3e-4, 1e-18);
  EXPECT_NEAR(h.at("P_xx").back(), 1e-4, 1e-6);
  EXPECT_NEAR(h.at("P_yy").back(), 0.0, 1e-6);
  EXPECT_NEAR(h.at("momentum_x").back(), 0.0, 1e-15);
}

TEST_F(Loads, PressureOnTheWholeSurfaceHasNoResultantAndCompresses) {
  run("t_end=400 time_step=0.2",
      kPlate +
          "&viscosity beta=0.5 length=1 /\n&zone name='everything' /\n"
          "&load name='p' kind='pressure' set='everything' value=1e-4 curve='smooth' ramp=200 /\n"
          "&probe name='P' field='first_piola_kirchhoff_stress' set='everything' /\n");
  const auto h = read_history(path("case.history.csv"));
  EXPECT_NEAR(h.at("force_p_x").back(), 0.0, 1e-18);
  EXPECT_NEAR(h.at("momentum_x").back(), 0.0, 1e-15);
  EXPECT_NEAR(h.at("momentum_y").back(), 0.0, 1e-15);
  EXPECT_NEAR(h.at("P_xx").back(), -1e-4, 1e-6);
  EXPECT_NEAR(h.at("P_yy").back(), -1e-4, 1e-6);
  EXPECT_NEAR(h.at("P_xy").back(), 0.0, 1e-8);
}

// A pressure turns with the surface it acts on; a traction does not.
TEST_F(Loads, PressureFollowsARotatingFace) {
  const std::string spin =
      "&lattice type='square' spacing=1 size=4,3,0 /\n"
      "&body name='plate' kinematics='plane_stress' material='stiff' /\n"
      "&material name='stiff' law='svk' E=1e4 nu=0.25 rho=1 /\n"
      "&initial angular_velocity=0,0,1.5707963267948966 centre=2,1.5,0 /\n";  // quarter turn
  run("t_end=1", spin +
                     "&load name='p' kind='pressure' set='ymin' value=1e-6 /\n"
                     "&load name='t' kind='traction' set='ymin' directions='y' value=1e-6 /\n");
  const auto h = read_history(path("case.history.csv"));
  EXPECT_NEAR(h.at("force_p_y").front(), 4e-6, 1e-18);
  // measured 0.3 % and 4 %: the plate stretches and swings a little under its spin
  EXPECT_NEAR(h.at("force_p_x").back(), -4e-6, 0.05 * 4e-6);
  EXPECT_NEAR(h.at("force_p_y").back(), 0.0, 0.1 * 4e-6);
  EXPECT_NEAR(h.at("force_t_y").back(), 4e-6, 1e-18);
}

TEST_F(Loads, RotatingFreeBodyKeepsMomentumAndEnergy) {
  run("t_end=50 time_step=0.1",
      kBlock + "&initial velocity=0.01,0,-0.02 angular_velocity=0.01,0.02,0.03 centre=1,1,1.5 /\n");
  const auto h = read_history(path("case.history.csv"));
  EXPECT_NEAR(h.at("momentum_x").back(), 0.12, 1e-13);
  EXPECT_NEAR(h.at("momentum_y").back(), 0.0, 1e-13);
  EXPECT_NEAR(h.at("momentum_z").back(), -0.24, 1e-13);
  const double kinetic = h.at("kinetic").front();
  EXPECT_NEAR(h.at("balance").back() / kinetic, 0.0, 1e-5);  // measured 1.5e-6, O(dt^2)
  EXPECT_NEAR(h.at("identity").back() / kinetic, 0.0, 1e-13);
}

TEST_F(Loads, TwoBodiesMoveOnTheirOwn) {
  run("t_end=1 time_step=0.1",
      kPlate +
          "&body name='other' kinematics='plane_strain' material='unit' translate=10,0,0 /\n"
          "&initial body='other' velocity=1,0,0 /\n"
          "&load name='g' kind='gravity' body='plate' directions='y' value=2 /\n"
          "&probe name='a' body='plate' field='displacement' point=0,0 /\n"
          "&probe name='b' body='other' field='displacement' point=10,0 /\n");
  const auto h = read_history(path("case.history.csv"));
  EXPECT_NEAR(h.at("a_x").back(), 0.0, 1e-14);
  EXPECT_NEAR(h.at("a_y").back(), 1.0, 1e-13);
  EXPECT_NEAR(h.at("b_x").back(), 1.0, 1e-13);
  EXPECT_NEAR(h.at("b_y").back(), 0.0, 1e-14);
}

}  // namespace
}  // namespace cleave::driver::testing
