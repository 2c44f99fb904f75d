// Static runs by dynamic relaxation: a notched plate that tears, restarts and stops in the middle of an
// increment, an increment that does not converge, and what the methods refuse.
#include <algorithm>
#include <cmath>

#include "support.hpp"

namespace cleave::driver::testing {
namespace {

namespace fs = std::filesystem;
using Relaxation = RunDirectory;

const char* const kFiles[] = {"case.exo", "case.history.nc", "case.history.csv", "case.events.nc"};

// Notched at half height, pulled over its ends.
std::string plate(const std::string& statics, const std::string& fracture =
                                                  "&fracture "
                                                  "critical_strain=0.01 /\n") {
  return "&lattice type='square' spacing=1 size=12,9,0 /\n"
         "&body name='plate' kinematics='plane_stress' material='unit' /\n" +
         std::string(kUnitMaterial) + fracture +
         "&precrack body='plate' shape='segment' points=-1,4.5,4.2,4.5 /\n"
         "&load name='foot' kind='displacement' set='ymin' directions='xy' /\n"
         "&load name='head' kind='displacement' set='ymax' directions='y' value=0.08 "
         "curve='linear' ramp=1 /\n&history every_steps=1 /\n&output every_steps=2 /\n"
         "&checkpoint every_steps=1 keep=20 /\n&static method='relaxation' increments=8 " +
         statics + " /\n";
}

TEST_F(Relaxation, PlateTearsAndTheRecordSaysHow) {
  ASSERT_EQ(run("mode='static' t_end=1", plate("")), 0);
  const auto h = read_history(path("case.history.csv"));
  const auto& force = h.at("reaction_head_y");
  ASSERT_EQ(force.size(), 9u);
  const auto peak = std::max_element(force.begin(), force.end());
  EXPECT_GT(peak - force.begin(), 2);
  EXPECT_LT(force.back(), 0.2 * *peak);
  EXPECT_GT(h.at("broken").back(), 5);
  double rounds = 0;
  for (std::size_t n = 1; n < force.size(); ++n) {
    EXPECT_GT(h.at("iterations")[n], 1);
    EXPECT_GT(h.at("residual")[n], 0);
    EXPECT_LE(h.at("residual")[n], 1e-6);
    EXPECT_EQ(h.at("kinetic")[n], 0);
    rounds += h.at("breaking_rounds")[n];
    // measured 3e-3 at worst: the trapezoid of an increment
    EXPECT_LT(std::fabs(h.at("balance")[n]), 0.01 * h.at("reaction")[n]) << n;
  }
  EXPECT_GT(rounds, 1);
  EXPECT_GT(h.at("viscous").back(), 0);
}

TEST_F(Relaxation, RestartIsBitwise) {
  const std::string deck = plate("breaking='one'");
  ASSERT_EQ(run("mode='static' t_end=1", deck, "whole"), 0);
  for (const char* step : {"2", "5", "7"}) {
    fs::remove_all(path("cut"));
    fs::create_directories(path("cut"));
    for (const char* file : kFiles) fs::copy(path("whole") + "/" + file, path("cut"));
    fs::copy(path("whole/case." + std::string(step) + ".checkpoint.nc"), path("cut"));
    RunOptions options = quiet;
    options.threads = 2;
    ASSERT_EQ(restart_run(path("cut"), "", options), 0);
    for (const char* file : kFiles) {
      EXPECT_EQ(file_bytes(path("cut") + "/" + file), file_bytes(path("whole") + "/" + file))
          << file << " after step " << step;
    }
    EXPECT_EQ(file_bytes(path("cut/case.8.checkpoint.nc")),
              file_bytes(path("whole/case.8.checkpoint.nc")));
  }
}

// A limit that is over at once stops the first increment half-way: the run goes on from its start.
TEST_F(Relaxation, StopsInTheMiddleOfAnIncrement) {
  ASSERT_EQ(run("mode='static' t_end=1", plate(""), "whole"), 0);
  RunOptions hasty = quiet;
  hasty.wall_limit = 1e-6;
  ASSERT_EQ(run_deck(deck("mode='static' t_end=1", plate(""), "cut"), hasty), 3);
  EXPECT_TRUE(fs::exists(path("cut/case.0.checkpoint.nc")));
  ASSERT_EQ(restart_run(path("cut"), "", quiet), 0);
  for (const char* file : kFiles)
    EXPECT_EQ(file_bytes(path("cut") + "/" + file), file_bytes(path("whole") + "/" + file)) << file;
}

// What is kept is the last increment that was asked for, also where parts of the next had converged.
TEST_F(Relaxation, FailedIncrementLeavesTheOneBeforeIt) {
  ASSERT_EQ(run("mode='static' t_end=1", plate(""), "whole"), 0);
  for (const char* cut_backs : {"0", "2"}) {
    fs::remove_all(path("cut"));
    const std::string said = message_of<RunError>([&] {
      run("mode='static' t_end=1", plate("max_iterations=170 cut_backs=" + std::string(cut_backs)),
          "cut");
    });
    for (const char* part : {"the run failed in step", "body 0 'plate': no equilibrium: residual",
                             "use a smaller load increment", "The last good state, after step"})
      EXPECT_TRUE(has(said, part));
    const std::string place = "failed in step ";
    ASSERT_TRUE(has(said, place));
    const int failed = std::stoi(said.substr(said.find(place) + place.size()));
    EXPECT_GT(failed, 1);  // 5
    EXPECT_TRUE(has(said, "after step " + std::to_string(failed - 1)));
    const std::string last = said.substr(said.rfind(' ') + 1);
    ASSERT_TRUE(fs::exists(last)) << said;
    std::ofstream(path("patient.nml")) << "&run units='other' name='case' mode='static' t_end=1 /\n"
                                       << plate("");
    ASSERT_EQ(restart_run(last, path("patient.nml"), quiet), 0);
    if (*cut_backs == '0') {
      EXPECT_EQ(file_bytes(path("cut/case.history.nc")), file_bytes(path("whole/case.history.nc")));
    }
  }
}

TEST_F(Relaxation, ServesBodiesThatNewtonRefuses) {
  const std::string said = message_of<RunError>([&] {
    std::string newton = plate("");
    newton.replace(newton.find("relaxation"), 10, "newton");
    run("mode='static' t_end=1", newton, "newton");
  });
  EXPECT_TRUE(has(said, "use relaxation"));
  // Two bodies, one that breaks and one that cannot; a penalty; check says what it can.
  const std::string two =
      plate("breaking='one' tolerance=1e-5", "&fracture critical_strain=0.01 body='plate' /\n") +
      "&lattice name='more' type='square' spacing=1 size=4,4,0 origin=20,0,0 /\n"
      "&body name='sphs' mesh='more' formulation='tlsph' kinematics='plane_stress' "
      "material='unit' /\n&kernel body='sphs' radius=3 /\n"
      "&hourglass body='sphs' form='conservative' psi=0.1 /\n";
  EXPECT_EQ(run("mode='static' t_end=1", two, "two"), 0);
  EXPECT_EQ(check_deck(deck("mode='static' t_end=1", two), quiet), 0);
}

}  // namespace
}  // namespace cleave::driver::testing
