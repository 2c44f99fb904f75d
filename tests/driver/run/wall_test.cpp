// Rigid walls: an elastic bar bounces with its energy and the impulse that the history shows; stiff
// walls shorten the step; restart; what is refused.
#include <algorithm>
#include <cmath>
#include <numeric>

#include "run/stepping.hpp"
#include "run/time_step.hpp"
#include "support.hpp"

namespace cleave::driver::testing {
namespace {

namespace fs = std::filesystem;
using WallRun = RunDirectory;

// 2 x 20, mass 40, no lateral contraction: a rod with c = 1. It starts at the wall y = 0.
std::string rod(const std::string& formulation) {
  return "&lattice type='square' spacing=0.5 size=2,20,0 /\n"
         "&body name='rod' kinematics='plane_stress' material='rod' formulation='" +
         formulation +
         "' /\n"
         "&material name='rod' law='svk' E=1 nu=0 rho=1 /\n&initial velocity=0,-0.001,0 /\n"
         "&history every_steps=1 /\n";
}
const char* const kWall = "&wall name='anvil' point=0,0,0 normal=0,2,0 /\n";

double largest(const std::vector<double>& values) {
  double most = 0;
  for (const double value : values) most = std::max(most, std::fabs(value));
  return most;
}

TEST_F(WallRun, ElasticRodBounces) {
  for (const char* formulation : {"cbm", "fem"}) {
    run("t_end=60 step_factor=0.3", rod(formulation) + kWall, formulation);
    const auto h = read_history(path(std::string(formulation) + "/case.history.csv"));
    const auto& force = h.at("force_anvil_y");
    const auto& time = h.at("time");
    const double kinetic = h.at("kinetic").front();
    EXPECT_NEAR(kinetic, 0.5 * 40 * 1e-6, 1e-18);
    // what the ledger keeps: the penalty's energy is work of external forces, all of it given back
    EXPECT_LT(largest(h.at("balance")), 4e-4 * kinetic);  // measured 9e-5
    EXPECT_LT(largest(h.at("identity")), 1e-13 * kinetic);
    EXPECT_LT(std::fabs(h.at("external").back()), 4e-4 * kinetic);  // measured 4e-5
    // the force is that of the integrator: its impulse is the change of momentum, to rounding
    double impulse = 0;
    for (std::size_t k = 1; k < force.size(); ++k)
      impulse += 0.5 * (time[k] - time[k - 1]) * (force[k] + force[k - 1]);
    EXPECT_NEAR(h.at("momentum_y").back() - h.at("momentum_y").front(), impulse, 1e-12 * 0.04);
    // rod theory: it leaves after 2 L/c = 40 with the reversed velocity; rho c v A = 0.002 in between
    EXPECT_NEAR(h.at("momentum_y").back(), 0.04, 0.04 * 0.03);  // measured 1 %
    const double between =
        std::accumulate(force.begin(), force.end(), 0.0,
                        [k = std::size_t{0}, &time](double sum, double f) mutable {
                          const double t = time[k++];
                          return sum + (t > 5 && t < 35 ? f : 0.0);
                        }) /
        static_cast<double>(
            std::count_if(time.begin(), time.end(), [](double t) { return t > 5 && t < 35; }));
    EXPECT_NEAR(between, 0.002, 0.002 * 0.01);  // measured 0.08 %
    EXPECT_EQ(force.back(), 0.0);
    for (const double f : force) EXPECT_GE(f, 0.0);
  }
}

// Pressed in as a whole by 0.1: k = stiffness c0^2 m / dx^2 of the lowest row, which has the mass 0.5.
TEST_F(WallRun, PenaltyIsThatOfTheMaterial) {
  std::string pressed = rod("fem");
  pressed.erase(pressed.find("&initial"), pressed.find("&history") - pressed.find("&initial"));
  run("t_end=10", pressed +
                      "&wall name='anvil' normal=0,2,0 stiffness=3 /\n&zone name='everything' /\n"
                      "&load kind='displacement' set='everything' directions='y' value=-0.1 "
                      "curve='smooth' ramp=10 /\n");
  const auto h = read_history(path("case.history.csv"));
  const double square_of_spacing = 40.0 / 205;  // volume over particles
  EXPECT_NEAR(h.at("force_anvil_y").back(), 3 * 0.5 / square_of_spacing * 0.1, 1e-12);
}

TEST_F(WallRun, StiffWallShortensTheStep) {
  run("t_end=50", rod("fem") + kWall, "soft");
  run("t_end=50", rod("fem") + "&wall normal=0,1,0 stiffness=400 /\n", "stiff");
  const auto soft = read_history(path("soft/case.history.csv"));
  const auto stiff = read_history(path("stiff/case.history.csv"));
  EXPECT_GT(stiff.at("time").size(), 5 * soft.at("time").size());
  EXPECT_LT(largest(stiff.at("balance")), 4e-3 * stiff.at("kinetic").front());  // measured 1.2e-3
  // stable: the far end never moves faster than a rod can
  EXPECT_LT(largest(stiff.at("momentum_y")), 1.05 * 0.04);
}

TEST_F(WallRun, RestartIsBitwise) {
  const std::string deck = rod("cbm") +
                           "&wall name='anvil' normal=0,1,0 set='ymin' radius=0 /\n"
                           "&checkpoint every_steps=40 keep=20 /\n&output every_time=5 /\n";
  ASSERT_EQ(run("t_end=30", deck, "whole"), 0);
  fs::create_directories(path("cut"));
  const char* const files[] = {"case.exo", "case.history.nc", "case.history.csv"};
  for (const char* file : {"case.exo", "case.history.nc", "case.history.csv", "case.events.nc"})
    fs::copy(path("whole") + "/" + file, path("cut"));
  fs::copy(path("whole/case.40.checkpoint.nc"), path("cut"));
  ASSERT_EQ(restart_run(path("cut"), "", quiet), 0);
  for (const char* file : files)
    EXPECT_EQ(file_bytes(path("cut") + "/" + file), file_bytes(path("whole") + "/" + file)) << file;
}

TEST_F(WallRun, RefusesWallsThatCannotBeMeant) {
  const auto refused = [&](const std::string& wall) {
    return message_of<DeckError>([&] { run("t_end=1", rod("cbm") + wall); });
  };
  EXPECT_TRUE(has(refused("&wall normal=0,0,0 /\n"), "the normal has no length"));
  EXPECT_TRUE(has(refused("&wall normal=0,1,1 /\n"), "is plane; the normal has no z component"));
  EXPECT_TRUE(has(refused("&wall normal=0,1,0 radius=0.25 /\n"), "begins 0.25 deep in the wall"));
  EXPECT_TRUE(has(refused("&wall normal=0,-1,0 /\n"), "turn the normal round"));
  EXPECT_TRUE(has(refused("&wall name='a b' normal=0,1,0 /\n"), "names a column"));
  EXPECT_TRUE(has(refused("&wall normal=0,1,0 set='nobody' /\n"), "nobody"));
  EXPECT_TRUE(has(refused(std::string(kWall) + kWall), "anvil"));
}

const std::string kCrush =
    "&lattice type='square' spacing=1 size=6,10,0 /\n"
    "&body name='bar' kinematics='plane_strain' material='soft' /\n"
    "&material name='soft' law='j2' E=1 nu=0.3 rho=1 tau_y0=1e-3 tau_inf=1e-3 /\n";

// A stretch of 0.4 asks for 0.9/0.4 steps in place of one: the next power of two is 4.
TEST_F(WallRun, StepsAreDividedWhereTheDeformationAsksForIt) {
  for (const bool adapt : {true, false}) {
    const Deck deck = this->deck(adapt ? "t_end=12" : "t_end=12 adapt=F", kCrush);
    Scene scene = Scene::from_deck(deck, 1);
    const TimeStep step = choose_time_step(scene);
    auto u = scene.model().reals(0, "displacement");
    for (std::size_t i = 1; i < u.size(); i += 3) u[i] = -0.6 * scene.bodies()[0].X[i];
    scene.model().put(0, "displacement", u);
    const Stepping stepping(deck);
    stepping.start(scene, step.clock.dt);
    stepping.step(scene, step.clock, 0);
    std::int64_t done = 0;
    double time = 0;
    check(cleave_model_clock(scene.model().handle(), &done, &time));
    EXPECT_EQ(done, adapt ? 4 : 1);
    EXPECT_EQ(time, step.clock.time(1));
  }
}

// The integrator's identity knows of steps that change.
TEST_F(WallRun, CrushedBarKeepsTheLedger) {
  run("t_end=12", kCrush +
                      "&viscosity beta=0.3 length=1 /\n&initial velocity=0,-0.25,0 /\n"
                      "&wall name='anvil' normal=0,1,0 /\n&history every_steps=1 /\n");
  const auto h = read_history(path("case.history.csv"));
  EXPECT_LT(largest(h.at("identity")), 1e-13 * h.at("kinetic").front());
  EXPECT_LT(largest(h.at("balance")), 0.01 * h.at("kinetic").front());  // measured 1.4e-3
}

}  // namespace
}  // namespace cleave::driver::testing
