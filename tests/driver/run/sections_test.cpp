// Section resultants: the force is the reaction, the moment that of beam theory.
#include <cmath>

#include "support.hpp"

namespace cleave::driver::testing {
namespace {

using SectionRun = RunDirectory;

TEST_F(SectionRun, ForceInTensionIsTheReaction) {
  struct Form {
    const char *formulation, *elements, *directory;
  };
  for (const Form& form : {Form{"fem", "linear", "t3"}, Form{"fem", "quadratic", "t6"},
                           Form{"cbm", "linear", "cbm"}}) {
    run("mode='static' t_end=1",
        "&lattice type='square' spacing=1 size=4,6,0 /\n"
        "&body name='plate' kinematics='plane_stress' material='unit' formulation='" +
            std::string(form.formulation) + "' elements='" + form.elements + "' /\n" +
            kUnitMaterial +
            "&load name='low' kind='displacement' set='ymin' directions='xy' /\n"
            "&load name='top' kind='displacement' set='ymax' directions='xy' value=0.3 "
            "curve='linear' ramp=1 /\n"
            "&section name='low' point=0,1.5,0 normal=0,1,0 /\n"
            "&section name='high' body='plate' point=2,4.2,0 normal=0,3,0 /\n"
            "&section name='turned' point=2,4.2,0 normal=0,-1,0 /\n",
        form.directory);
    const auto h = read_history(path(std::string(form.directory) + "/case.history.csv"));
    for (const std::string k : {"x", "y"}) {
      const double reaction = h.at("reaction_top_" + k).back();
      EXPECT_GT(std::fabs(reaction), 1e-3);
      EXPECT_NEAR(h.at("section_low_force_" + k).back() / reaction, 1.0, 1e-8);  // measured 1e-15
      EXPECT_NEAR(h.at("section_high_force_" + k).back() / reaction, 1.0, 1e-8);
      EXPECT_NEAR(h.at("section_turned_force_" + k).back() / reaction, -1.0, 1e-8);
    }
  }
}

// A cantilever of six-node triangles under an end load: two elements over the height.
TEST_F(SectionRun, CantileverAgreesWithBeamTheory) {
  const double length = 20, load = 1e-6, width = 2, young = 1, nu = 0.25;
  run("mode='static' t_end=1",
      "&lattice type='square' spacing=1 size=20,2,0 /\n"
      "&body name='beam' kinematics='plane_stress' material='unit' formulation='fem' "
      "elements='quadratic' /\n" +
          std::string(kUnitMaterial) +
          "&static increments=1 /\n"
          "&load name='clamp' kind='displacement' set='xmin' directions='xy' /\n"
          "&load name='end' kind='force' set='xmax' directions='y' value=1e-6 /\n"
          "&section name='root' point=0.5,1,0 normal=1,0,0 /\n"
          "&section name='middle' point=10.5,1,0 normal=1,0,0 /\n"
          "&probe name='tip' field='displacement' point=20,1 at='point' /\n"
          "&probe name='bending' field='cauchy_stress' point=10.25,1.75 at='point' /\n");
  const auto h = read_history(path("case.history.csv"));
  const double inertia = std::pow(width, 3) / 12, shear = young / (2 * (1 + nu)) * 5 / 6 * width;
  const double deflection =
      load * std::pow(length, 3) / (3 * young * inertia) + load * length / shear;
  EXPECT_NEAR(h.at("tip_y").back() / deflection, 1.0, 0.01);  // measured 0.2 %
  EXPECT_NEAR(h.at("section_root_force_y").back() / load, 1.0, 1e-7);
  EXPECT_NEAR(h.at("section_root_force_x").back() / load, 0.0, 1e-6);
  // statics of the free end, whatever the elements; measured 5e-8: lever arms of the deformed beam
  EXPECT_NEAR(h.at("section_root_moment_z").back() / (load * 19.5), 1.0, 1e-4);
  EXPECT_NEAR(h.at("section_middle_moment_z").back() / (load * 9.5), 1.0, 1e-4);
  const double bending = -load * (length - 10.25) * 0.75 / inertia;
  EXPECT_NEAR(h.at("bending_xx").back() / bending, 1.0, 0.01);  // measured 0.03 %
}

TEST_F(SectionRun, HasAllComponentsInThreeDimensions) {
  run("t_end=1",
      std::string(kUnitBlock) + kUnitMaterial + "&section name='s' point=0,0,1.5 normal=0,0,1 /\n");
  const auto h = read_history(path("case.history.csv"));
  for (const std::string k : {"x", "y", "z"}) {
    EXPECT_EQ(h.count("section_s_force_" + k), 1u);
    EXPECT_EQ(h.count("section_s_moment_" + k), 1u);
  }
}

TEST_F(SectionRun, RefusesPlanesThatCutNothing) {
  const auto refused = [&](const std::string& groups) {
    return message_of<DeckError>(
        [&] { run("t_end=1", std::string(kUnitPlate) + kUnitMaterial + groups); });
  };
  EXPECT_TRUE(has(refused("&section name='s' point=0,9,0 /\n"), "the plane does not cut body"));
  EXPECT_TRUE(has(refused("&section name='s' point=0,-1,0 /\n"), "which reaches from"));
  EXPECT_TRUE(has(refused("&section name='s' normal=0,0,1 /\n"), "the normal has no length"));
  EXPECT_TRUE(has(refused("&section name='a b' point=0,1.5,0 /\n"), "names columns"));
  EXPECT_TRUE(has(refused("&body name='other' kinematics='plane_stress' material='unit' /\n"
                          "&section name='s' point=0,1.5,0 /\n"),
                  "name the one that is cut"));
}

}  // namespace
}  // namespace cleave::driver::testing
