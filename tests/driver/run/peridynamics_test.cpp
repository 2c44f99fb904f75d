// Peridynamic bodies in decks: where their points are, notches, pre-cracks, restart and files.
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>

#include "run/run.hpp"
#include "scene/scene.hpp"
#include "support.hpp"

namespace cleave::driver::testing {
namespace {

namespace fs = std::filesystem;

class Peridynamics : public RunDirectory {
 protected:
  void write(const std::string& name, const std::string& text) const {
    std::ofstream(path(name)) << text;
  }
  // The points file of a deck is found beside it, and decks here are texts without a place.
  std::string points(const std::string& text) const {
    write("cloud.csv", text);
    return "&points file='" + path("cloud.csv") + "' /\n";
  }
  Scene scene(const std::string& groups) {
    return Scene::from_deck(*(kept_ = std::make_unique<Deck>(deck("t_end=1", groups))), 1);
  }
  std::string refused(const std::string& groups) {
    return message_of<DeckError>([&] { scene(groups); });
  }
  std::unique_ptr<Deck> kept_;
};

const std::string kMaterial = "&material name='unit' law='linear_elastic' E=1 nu=0.25 rho=1 /\n";
const std::string kHorizon = "&peridynamics horizon=2.2 /\n";
const std::string kBond = "material='unit' formulation='bond_pd'";

TEST_F(Peridynamics, PointsStandInTheCellsOfALattice) {
  const Scene made = scene(
      "&lattice type='cubic' spacing=1 origin=1,2,3 size=4,3,2 points='centres' /\n"
      "&body kinematics='3d' " +
      kBond + " /\n" + kMaterial + kHorizon.substr(0, 14) + "horizon=1.8 /\n");
  const BodyGeometry& body = made.bodies().front();
  ASSERT_EQ(body.particles(), 24);
  EXPECT_EQ(body.X[0], 1.5);
  EXPECT_EQ(body.X[1], 2.5);
  EXPECT_EQ(body.X[2], 3.5);
  EXPECT_EQ(bounding_box(body).upper[0], 4.5);
  for (const double mass : made.model().reals(0, "mass")) EXPECT_EQ(mass, 1);
  EXPECT_GT(body.simplex_count(), 0);  // they connect the points for pictures
}

TEST_F(Peridynamics, PointsStandInTheCellsOfAMesh) {
  const Scene made = scene(
      "&lattice type='square' spacing=1 size=6,4,0 /\n"
      "&body kinematics='plane_strain' particles='cells' " +
      kBond + " /\n" + kMaterial + kHorizon);
  const BodyGeometry& body = made.bodies().front();
  ASSERT_EQ(body.particles(), 48);
  double sum = 0;
  for (const double mass : made.model().reals(0, "mass")) sum += mass;
  EXPECT_NEAR(sum, 24, 1e-13);
  EXPECT_NE(body.find_group("all"), nullptr);
  EXPECT_EQ(body.find_group("xmin"), nullptr);  // no cell lies in a face
}

TEST_F(Peridynamics, PointsComeFromAFile) {
  std::string cloud = "X [mm], volume, Y\n";
  for (int i = 0; i < 40; ++i)
    cloud += std::to_string(i % 8) + ", 1.5, " + std::to_string(i / 8) + "\n";
  const std::string rest = "&body kinematics='plane_strain' translate=0,0.5,0 " + kBond + " /\n" +
                           kMaterial + "&peridynamics horizon=6 /\n";
  std::string scaled = points(cloud);
  scaled.replace(scaled.find(" /"), 2, " scale=2 /");
  const Scene made = scene(scaled + rest);
  const BodyGeometry& body = made.bodies().front();
  ASSERT_EQ(body.particles(), 40);
  EXPECT_EQ(body.X[3 * 39], 14);
  EXPECT_EQ(body.X[3 * 39 + 1], 8.5);
  EXPECT_EQ(made.model().reals(0, "mass").front(), 6);
  EXPECT_TRUE(has(refused(points("X,Y\n1,2\n") + rest), "there is no column volume"));
  EXPECT_TRUE(has(refused(points("X,Y,volume\n1,2,0\n") + rest),
                  "cloud.csv:2: the volume of a point is 0"));
  EXPECT_TRUE(has(refused(points(cloud) + rest +
                          "&zone name='all' /\n&load kind='pressure' set='all' value=1 /\n"),
                  "cloud of points"));
}

TEST_F(Peridynamics, NotchesTakeParticlesOut) {
  for (const std::string formulation : {"bond_pd", "cbm"}) {
    const bool points = formulation == "bond_pd";
    const std::string plate = "&lattice type='square' spacing=1 size=8,6,0 points='" +
                              std::string(points ? "centres" : "corners") +
                              "' /\n&body kinematics='plane_strain' material='unit' formulation='" +
                              formulation + "' /\n" + kMaterial + (points ? kHorizon : "");
    const Scene whole = scene(plate);
    const std::int64_t before = whole.bodies().front().particles();
    const Scene cut = scene(plate + "&notch lower=-1,2.1 upper=3.1,3.1 /\n");
    const BodyGeometry& body = cut.bodies().front();
    // Row 3 of the corners from x = 0 to 3; of the middles y = 2.5, x = 0.5 to 2.5.
    EXPECT_EQ(before - body.particles(), points ? 3 : 4) << formulation;
    for (std::int64_t i = 0; i < body.particles(); ++i) {
      const double x = body.X[static_cast<std::size_t>(3 * i)],
                   y = body.X[static_cast<std::size_t>(3 * i + 1)];
      EXPECT_FALSE(x <= 3.1 && y >= 2.1 && y <= 3.1);
    }
    for (const std::int32_t i : body.simplices) ASSERT_LT(i, body.particles());
    EXPECT_LT(body.simplex_count(), whole.bodies().front().simplex_count());
    EXPECT_TRUE(has(refused(plate + "&notch lower=20,20 upper=21,21 /\n"), "holds no particle"));
    EXPECT_TRUE(has(refused(plate + "&notch lower=-1,-1 /\n"), "takes all particles"));
  }
}

TEST_F(Peridynamics, BodiesOfSeveralMethodsAndMaterialsRunTogether) {
  std::string deck = "&lattice type='square' spacing=1 size=8,6,0 points='centres' /\n" +
                     kMaterial +
                     "&material name='stiff' law='linear_elastic' E=5 nu=0.3 rho=2 /\n"
                     "&lattice name='mesh of triangles' type='square' spacing=1 size=8,6,0 /\n"
                     "&body name='triangles' mesh='mesh of triangles' translate=0,20,0 "
                     "kinematics='plane_strain' material='unit' /\n&initial velocity=0.01,0,0 /\n";
  for (const std::string method : {"bond_pd", "cpd", "lps"}) {
    deck += "&body name='" + method + "' formulation='" + method +
            "' kinematics='plane_strain' material='" + (method == "bond_pd" ? "unit" : "stiff") +
            "' /\n&peridynamics body='" + method + "' horizon=2.2 /\n";
  }
  ASSERT_EQ(run("t_end=3", deck), 0);
  const auto h = read_history(path("case.history.csv"));
  // Masses 48 + 2 x 96 + 48 move on as they are.
  EXPECT_NEAR(h.at("momentum_x").back(), 0.01 * (48 + 96 + 96 + 48), 1e-12);
  EXPECT_NEAR(h.at("elastic").back(), 0, 1e-20);
}

// Bonds, crossing ones included, as printed in the paper; crossing ones from an independent count.
TEST_F(Peridynamics, PlaneCutsTheBondsThatCrossIt) {
  const Scene made = scene(
      "&lattice type='cubic' spacing=0.025 size=1,1,0.1 points='centres' /\n"
      "&body kinematics='3d' " +
      kBond + " /\n" + kMaterial +
      "&peridynamics horizon=0.0675 /\n&precrack shape='plane' "
      "points=-0.1,0.5,-1, 0.5,0.5,-1, -0.1,0.5,2 /\n");
  const cleave_counts counts = made.model().counts(0);
  EXPECT_EQ(2 * counts.bonds, 367896);
  EXPECT_EQ(2 * (counts.bonds - counts.inert), 363096);
  EXPECT_EQ(counts.broken, 0);
}

// A bar of two halves, the right one four times as stiff, between grips: its stiffness between two points 19.5 from
// where the materials meet, over that of a bar of the soft one. Springs in series: 2/(1 + 1/4).
TEST_F(Peridynamics, TwoMaterialsInARowAreSpringsInSeries) {
  std::string row = "X,Y,volume\n";
  for (int i = 0; i < 80; ++i) row += std::to_string(i + 0.5) + ",0.5,1\n";
  const auto stiffness = [&](const std::string& method, const std::string& options, bool two) {
    const bool bar = method != "lps";
    const std::string folder = method + (two ? "two" : "one");
    run("mode='static' t_end=1",
        (bar ? points(row) : "&lattice type='square' spacing=1 size=80,6,0 points='centres' /\n") +
            "&body kinematics='plane_stress' material='soft' formulation='" + method +
            "' /\n&material name='soft' law='linear_elastic' E=1 nu=0.25 rho=1 /\n"
            "&material name='stiff' law='svk' E=4 nu=0.25 rho=2 /\n"
            "&zone name='left' upper=3.1,9 /\n&zone name='right' lower=76.9,-1 /\n"
            "&zone name='half' lower=40,-1 /\n&peridynamics horizon=3.015 " +
            (bar ? "section=1 " : "") + options +
            " /\n"
            "&static increments=1 method='relaxation' tolerance=1e-7 /\n"
            "&load name='foot' kind='displacement' set='left' directions='x' /\n"
            "&load name='head' kind='displacement' set='right' directions='x' value=0.04 /\n"
            "&probe name='a' field='displacement' point=20.5,0.5 /\n"
            "&probe name='b' field='displacement' point=59.5,0.5 /\n" +
            (method == "cpd" ? "&cpd weights='conservative' /\n" : "") +
            (two ? "&region set='half' material='stiff' /\n" : ""),
        folder);
    const auto h = read_history(path(folder + "/case.history.csv"));
    return h.at("reaction_head_x").back() / (h.at("b_x").back() - h.at("a_x").back());
  };
  struct Case {
    const char *method, *options;
    double joint;  // how much stiffer than springs in series
  };
  // measured 0.4 %, 2.8 %, 2.8 %, 2.7 %
  for (const Case& c :
       {Case{"bond_pd", "interface='series'", 0.004}, Case{"bond_pd", "interface='mean'", 0.028},
        Case{"cpd", "", 0.028}, Case{"lps", "", 0.027}}) {
    const double ratio =
        stiffness(c.method, c.options, true) / stiffness(c.method, c.options, false);
    EXPECT_NEAR(ratio / 1.6, 1 + c.joint, 0.002) << c.method << c.options;
  }
}

TEST_F(Peridynamics, RegionsAreSetsWithAMaterial) {
  const std::string plate =
      "&lattice type='square' spacing=1 size=8,6,0 points='centres' /\n"
      "&body kinematics='plane_strain' " +
      kBond + " /\n" + kMaterial + kHorizon +
      "&material name='stiff' law='svk' E=4 nu=0.25 rho=3 /\n&zone name='half' lower=4,-1 /\n";
  const Scene made = scene(plate + "&region set='half' material='stiff' /\n");
  double sum = 0;
  for (const double mass : made.model().reals(0, "mass")) sum += mass;
  EXPECT_EQ(sum, 24 + 3 * 24);
  ASSERT_EQ(
      run("t_end=1 time_step=0.5",
          plate + "&region set='half' material='stiff' /\n&load name='pull' kind='body_force' "
                  "value=0.5 directions='x' /\n"),
      0);
  EXPECT_NEAR(read_history(path("case.history.csv")).at("force_pull_x").back(), 0.5 * 48, 1e-12);
  EXPECT_TRUE(has(refused(plate + "&region set='hlf' material='stiff' /\n"), "did you mean"));
  EXPECT_TRUE(has(refused(plate + "&region set='half' material='stif' /\n"), "stif"));
  EXPECT_TRUE(has(refused(plate + "&region set='half' material='stiff' Gf=1 critical_strain=1 /\n"),
                  "case.nml:8:"));
}

TEST_F(Peridynamics, RestartIsBitwise) {
  const std::string cloud = [] {
    std::string text = "X,Y,volume\n";
    for (int i = 0; i < 96; ++i)
      text += std::to_string(i % 12 + 0.2 * std::sin(i)) + "," +
              std::to_string(i / 12 + 0.2 * std::cos(3 * i)) + ",1\n";
    return text;
  }();
  const std::string square =
      "&lattice type='square' spacing=1 size=12,8,0 points='centres' /\n"
      "&body kinematics='plane_strain' ";
  const std::string cubic =
      "&lattice type='cubic' spacing=1 size=10,6,3 points='centres' /\n"
      "&body kinematics='3d' ";
  const std::map<std::string, std::string> bodies = {
      {"bonds", square + kBond + " /\n"},
      {"state", points(cloud) +
                    "&body kinematics='plane_strain' material='unit' formulation='lps' /\n"
                    "&material name='stiff' law='linear_elastic' E=3 nu=0.3 rho=2 /\n"
                    "&zone name='middle' lower=4,-1 upper=8,5 /\n"
                    "&region set='middle' material='stiff' critical_strain=0.015 /\n"},
      {"triangles",
       square + "material='unit' formulation='cpd' /\n&cpd C2=0.01 weights='conservative' /\n"},
      {"lattice", cubic + "material='unit' formulation='cpd' /\n&cpd C3=1e-4 /\n"},
      {"weighed", cubic + "material='unit' formulation='cpd' /\n"
                          "&cpd C3=1e-4 weights='conservative' /\n"}};
  const std::string pull =
      kMaterial + kHorizon + "&fracture critical_strain=0.02 /\n" +
      "&notch lower=5.2,-1 upper=6.2,2.2 /\n&zone name='low' upper=1.2,20 /\n&zone name='high' "
      "lower=10.8,-1 /\n"
      "&zone name='end' lower=8.8,-1 /\n&exempt set='high' /\n"
      "&load name='low' kind='velocity' set='low' directions='x' value=-0.04 curve='smooth' "
      "ramp=12 /\n"
      "&load name='end' kind='velocity' set='end' directions='x' value=0.04 curve='smooth' ramp=12 "
      "/\n"
      "&output every_steps=7 fields='velocity','damage','equivalent_stress','largest_stretch' /\n"
      "&section name='end' set='end' /\n&section name='waist' point=4.3,0,0 normal=1,0,0 /\n"
      "&history every_steps=3 /\n&checkpoint every_steps=9 keep=50 /\n";
  for (const auto& [whole, body] : bodies) {
    const std::string cut = whole + "cut";
    std::string load = pull;
    if (whole == "lattice" || whole == "weighed") load.replace(load.find("10.8"), 4, " 9.2");
    ASSERT_EQ(run("t_end=30", body + load, whole), 0) << whole;
    const auto h = read_history(path(whole + "/case.history.csv"));
    EXPECT_GT(h.at("broken").back(), 5) << whole;
    EXPECT_LT(h.at("broken")[2], h.at("broken").back()) << whole;
    EXPECT_NE(h.at("reaction_end_x").back(), 0) << whole;
    EXPECT_NE(h.at("section_waist_force_x").back(), 0) << whole;
    fs::create_directories(path(cut));
    const char* const files[] = {"case.exo", "case.history.nc", "case.history.csv",
                                 "case.events.nc"};
    for (const char* file : files) fs::copy(path(whole) + "/" + file, path(cut));
    fs::copy(path(whole + "/case.18.checkpoint.nc"), path(cut));
    RunOptions options = quiet;
    options.threads = 2;
    ASSERT_EQ(restart_run(path(cut), "", options), 0) << whole;
    for (const char* file : files) {
      EXPECT_EQ(file_bytes(path(cut) + "/" + file), file_bytes(path(whole) + "/" + file))
          << whole << ' ' << file;
    }
  }
}

}  // namespace
}  // namespace cleave::driver::testing
