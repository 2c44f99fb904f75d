// Section resultants: the force is the reaction, the moment that of beam theory. For peridynamic bodies: what
// a load-displacement curve is made of.
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

// A plate of peridynamic points between two grips of a horizon's width.
std::string gripped(const std::string& method, const std::string& more) {
  return "&lattice type='square' spacing=1 size=36,16,0 points='centres' /\n"
         "&body kinematics='plane_stress' material='unit' formulation='" +
         method +
         "' /\n&material name='unit' law='linear_elastic' E=1 nu=0.333333333333333333 rho=1 /\n"
         "&peridynamics horizon=3.015 /\n" +
         (method == "cpd" ? "&cpd weights='conservative' /\n" : "") +
         "&zone name='left' upper=3.1,99 /\n&zone name='right' lower=32.9,-1 /\n"
         "&section name='middle' point=18.2,0,0 normal=1,0,0 /\n"
         "&section name='grip' set='right' /\n"
         "&load name='foot' kind='displacement' set='left' directions='x' /\n"
         "&load name='head' kind='displacement' set='right' directions='x' value=0.03 "
         "curve='linear' ramp=8 /\n" +
         more;
}

// E A eps is met up to the lattice and the points at the two long sides, 6 of 16 rows: softer with bonds, stiffer
// with weights by the number of neighbours.
TEST_F(SectionRun, PeridynamicReactionIsThatOfTheBar) {
  for (const std::string method : {"bond_pd", "cpd", "lps"}) {
    run("mode='static' t_end=8",
        gripped(method,
                "&static increments=2 method='relaxation' tolerance=1e-7 /\n"
                "&probe name='strain' field='displacement_gradient' point=18,8 /\n"),
        method);
    const auto h = read_history(path(method + "/case.history.csv"));
    const double force = h.at("reaction_head_x").back();
    EXPECT_NEAR(h.at("reaction_foot_x").back() / force, -1, 1e-5) << method;
    EXPECT_NEAR(h.at("section_middle_force_x").back() / force, 1, 1e-5) << method;
    EXPECT_NEAR(h.at("section_grip_force_x").back() / force, -1, 1e-12) << method;
    EXPECT_NEAR(h.at("section_grip_force_y").back() / force, 0, 1e-5) << method;
    EXPECT_NEAR(h.at("reaction_head_x")[1] / force, 0.5, 1e-3) << method;
    // measured 1.007, 1.047, 1.094
    EXPECT_NEAR(force / (16 * h.at("strain_xx").back()), 1.05, 0.07) << method;
  }
}

// A load-displacement curve with bonds that break: the same bytes with two threads, and from the middle on.
TEST_F(SectionRun, PeridynamicLoadCurveSurvivesARestart) {
  namespace fs = std::filesystem;
  for (const std::string method : {"bond_pd", "cpd", "lps"}) {
    const std::string plate =
        gripped(method,
                "&static increments=3 method='relaxation' tolerance=1e-5 /\n"
                "&precrack points=18,-1,18,5.2 /\n&fracture critical_strain=0.0015 /\n"
                "&history every_steps=1 /\n&checkpoint every_steps=1 keep=20 /\n");
    const std::string whole = method, cut = method + "cut";
    ASSERT_EQ(run("mode='static' t_end=5", plate, whole), 0);
    const auto h = read_history(path(whole + "/case.history.csv"));
    EXPECT_GT(h.at("broken").back(), 10) << method;
    for (std::size_t n = 1; n < h.at("time").size(); ++n)
      EXPECT_NEAR(h.at("section_middle_force_x")[n] / h.at("reaction_head_x")[n], 1, 1e-3);
    fs::create_directories(path(cut));
    const char* const files[] = {"case.exo", "case.history.nc", "case.history.csv",
                                 "case.events.nc"};
    for (const char* file : files) fs::copy(path(whole) + "/" + file, path(cut));
    fs::copy(path(whole + "/case.1.checkpoint.nc"), path(cut));
    RunOptions options = quiet;
    options.threads = 2;
    ASSERT_EQ(restart_run(path(cut), "", options), 0);
    for (const char* file : files)
      EXPECT_EQ(file_bytes(path(cut) + "/" + file), file_bytes(path(whole) + "/" + file))
          << method << ' ' << file;
  }
}

// The reactions are what moves the body: m dv = (R_n + R_n+1) dt/2 of every step.
TEST_F(SectionRun, PeridynamicReactionsMoveTheBody) {
  for (const std::string method : {"bond_pd", "cpd", "lps"}) {
    run("t_end=20",
        gripped(method, "&history every_steps=1 /\n&initial set='right' velocity=0.00375,0,0 /\n"),
        method);
    const auto h = read_history(path(method + "/case.history.csv"));
    const auto& p = h.at("momentum_x");
    const auto& t = h.at("time");
    ASSERT_GT(p.size(), 20u);
    double largest = 0, off = 0;
    for (std::size_t n = 2; n < p.size(); ++n) {
      const auto total = [&](std::size_t k) {
        return h.at("reaction_head_x")[k] + h.at("reaction_foot_x")[k];
      };
      const double impulse = 0.5 * (t[n] - t[n - 1]) * (total(n) + total(n - 1));
      largest = std::max(largest, std::fabs(impulse));
      off = std::max(off, std::fabs(p[n] - p[n - 1] - impulse));
    }
    EXPECT_GT(largest, 1e-4);
    EXPECT_LT(off, 1e-11 * largest) << method;  // measured 2e-14
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
  EXPECT_TRUE(has(refused("&section name='s' set='ymx' /\n"), "no particle is in a set 'ymx'"));
  EXPECT_TRUE(has(refused("&section name='s' set='all' /\n"),
                  "which leaves nothing to act on it; name a part"));
}

}  // namespace
}  // namespace cleave::driver::testing
