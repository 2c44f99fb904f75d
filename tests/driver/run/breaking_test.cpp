// Static runs by Newton's method with bonds that break: one record for every equilibrium on the way, loads that stop
// where a bond fails, runs that stop between two events, and what is left of one that finds no equilibrium.
#include <algorithm>
#include <cmath>

#include "support.hpp"

namespace cleave::driver::testing {
namespace {

namespace fs = std::filesystem;
using Breaking = RunDirectory;

const char* const kFiles[] = {"case.exo", "case.history.nc", "case.history.csv", "case.events.nc"};
const char* const kRun = "mode='static' t_end=1";

// Notched at half height, pulled over its ends.
std::string strip(const std::string& statics, const std::string& more = "") {
  return "&lattice type='hexagonal' spacing=1 size=10,12,0 /\n"
         "&body name='strip' kinematics='plane_stress' material='unit' formulation='vcpm' /\n" +
         std::string(kUnitMaterial) +
         "&vcpm geometry='linear' criterion='strain' limit=0.01 /\n"
         "&precrack body='strip' shape='segment' points=-1,6.1,3.2,6.1 /\n"
         "&load name='foot' kind='displacement' set='ymin' directions='xy' /\n"
         "&load name='grip' kind='displacement' set='ymax' directions='x' /\n"
         "&load name='head' kind='displacement' set='ymax' directions='y' value=0.2 "
         "curve='linear' ramp=1 /\n&history every_steps=1 /\n&output every_steps=1 /\n"
         "&checkpoint every_steps=1 keep=20 /\n&static breaking='one' " +
         statics + " /\n" + more;
}

std::string by_events() { return strip("increments=2 loading='events'"); }

TEST_F(Breaking, EveryEquilibriumIsARecord) {
  ASSERT_EQ(run(kRun, by_events()), 0);
  const auto h = read_history(path("case.history.csv"));
  const auto& broken = h.at("broken");
  const auto& time = h.at("time");
  const auto& force = h.at("reaction_head_y");
  EXPECT_GT(broken.back(), 10);
  double top = 0;
  for (std::size_t n = 1; n < broken.size(); ++n) {
    EXPECT_LE(broken[n] - broken[n - 1], 3) << n;  // one, and loose ends
    EXPECT_GE(time[n], time[n - 1]);
    EXPECT_LT(std::fabs(h.at("balance")[n]), 1e-10 * h.at("reaction")[n]);  // measured 3e-12
    // Nothing broken: the load goes up on a line; broken: it falls where it is.
    if (broken[n] == broken[n - 1]) {
      EXPECT_NEAR(force[n] * time[n - 1], force[n - 1] * time[n], 1e-9 * top);
    } else {
      EXPECT_EQ(time[n], time[n - 1]);
      EXPECT_LT(force[n], force[n - 1]);
    }
    top = std::fmax(top, force[n]);
  }
  EXPECT_LT(force.back(), 0.01 * top);
}

// Increments hide what events show: the load at which the first bond fails.
TEST_F(Breaking, EventsDoNotDependOnIncrements) {
  std::vector<double> first, tops;
  for (const char* statics :
       {"increments=1 loading='events'", "increments=7 loading='events'", "increments=400"}) {
    ASSERT_EQ(run(kRun, strip(statics)), 0);
    const auto h = read_history(path("case.history.csv"));
    const auto& broken = h.at("broken");
    const auto at = std::find_if(broken.begin(), broken.end(), [](double b) { return b > 0; });
    first.push_back(h.at("time")[static_cast<std::size_t>(at - broken.begin())]);
    const auto& force = h.at("reaction_head_y");
    tops.push_back(*std::max_element(force.begin(), force.end()));
  }
  EXPECT_NEAR(first[1], first[0], 1e-9 * first[0]);
  EXPECT_NEAR(tops[1], tops[0], 1e-9 * tops[0]);
  EXPECT_GE(first[2], first[0]);
  EXPECT_LT(first[2], first[0] + 1.0 / 400);
}

// A limit that is over at once stops the run at every event.
TEST_F(Breaking, StopsBetweenEventsAndGoesOnWithTheSameBits) {
  ASSERT_EQ(run(kRun, by_events(), "whole"), 0);
  RunOptions hasty = quiet;
  hasty.wall_limit = 1e-6;
  ASSERT_EQ(run_deck(deck(kRun, by_events(), "cut"), hasty), 3);
  int stops = 1;
  for (int status = 3; status == 3; ++stops) {
    hasty.threads = 1 + stops % 2;
    status = restart_run(path("cut"), "", hasty);
    ASSERT_LT(stops, 200);
  }
  EXPECT_GT(stops, 15);
  for (const char* file : kFiles) {
    EXPECT_TRUE(file_bytes(path("cut") + "/" + file) == file_bytes(path("whole") + "/" + file))
        << file;
  }
}

// When the strip has torn, its head is loaded by a force and nothing holds it.
TEST_F(Breaking, WithoutEquilibriumTheLastOneIsKept) {
  const std::string pulled =
      "&lattice type='hexagonal' spacing=1 size=10,12,0 /\n"
      "&body name='strip' kinematics='plane_stress' material='unit' formulation='vcpm' /\n" +
      std::string(kUnitMaterial) +
      "&vcpm geometry='linear' criterion='strain' limit=0.01 /\n"
      "&precrack body='strip' shape='segment' points=-1,6.1,3.2,6.1 /\n"
      "&load name='foot' kind='displacement' set='ymin' directions='xy' /\n"
      "&load name='head' kind='force' set='ymax' directions='y' value=20 "
      "curve='linear' ramp=1 /\n&history every_steps=1 /\n"
      "&static breaking='one' increments=2 loading='events' /\n";
  const std::string said = message_of<RunError>([&] { run(kRun, pulled); });
  for (const char* part : {"no equilibrium", "nothing holds it any more", "The last good state"})
    EXPECT_TRUE(has(said, part)) << said;
  ASSERT_TRUE(fs::exists(said.substr(said.rfind(' ') + 1))) << said;
  EXPECT_GT(read_history(path("case.history.csv")).at("broken").back(), 10);
}

TEST_F(Breaking, ABodyWithoutSupportIsRefused) {
  std::string free = by_events();
  const auto foot = free.find("&load name='foot'");
  free.erase(foot, free.find('\n', foot) - foot);
  const std::string said = message_of<RunError>([&] { run(kRun, free, "free"); });
  EXPECT_EQ(said, "");  // the head holds it
  const auto grip = free.find("&load name='grip'");
  free.erase(grip, free.find('\n', grip) - grip);
  EXPECT_TRUE(has(message_of<RunError>([&] { run(kRun, free); }), "can move without resistance"));
}

}  // namespace
}  // namespace cleave::driver::testing
