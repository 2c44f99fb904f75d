// Prescribed motion from end to end: what particles do against the closed forms.
#include "support.hpp"

namespace cleave::driver::testing {
namespace {

using Motion = RunDirectory;

const std::string kFixed =
    "&load name='bottom' kind='displacement' set='ymin' directions='xy' value=0 /\n";
const std::string kProbes =
    "&probe name='u' field='displacement' point=2,3 /\n"
    "&probe name='v' field='velocity' point=2,3 /\n";

std::string plate(const std::string& load) {
  return std::string(kUnitPlate) + kUnitMaterial + kFixed + load + kProbes +
         "&history every_steps=1 /\n";
}

TEST_F(Motion, ExactDisplacementFollowsTheCurveWithoutDrift) {
  ASSERT_EQ(
      run("t_end=12 time_step=0.1", plate("&load name='top' kind='displacement' set='ymax' "
                                          "directions='y' value=0.01 curve='smooth' ramp=10 /")),
      0);
  const auto h = read_history(path("case.history.csv"));
  ASSERT_EQ(h.at("time").size(), 121u);
  for (std::size_t n = 0; n <= 120; ++n) {
    const double s = std::min(h.at("time")[n] / 10, 1.0);
    const double u = 0.01 * s * s * s * (10 - 15 * s + 6 * s * s);
    EXPECT_NEAR(h.at("u_y")[n], u, 1e-16) << n;  // measured 3.5e-18
  }
  EXPECT_EQ(h.at("u_y").back(), 0.01);
  EXPECT_NEAR(h.at("v_y").back(), 0.0, 1e-17);
  // the audit closes: measured 2.6e-5 of the work with dt = 0.1 l/c
  const double work = h.at("reaction").back();
  EXPECT_GT(work, 0.0);
  EXPECT_LT(std::abs(h.at("balance").back()), 1e-4 * work);
  // what moves the top is kept by the bottom in the mean
  EXPECT_GT(h.at("reaction_top_y").back() * -h.at("reaction_bottom_y").back(), 0.0);
}

// Accelerations through velocity Verlet lose O((dt/tau)^2): known numbers for 100 steps a ramp.
TEST_F(Motion, PaperDisplacementEndsWhereVerletTakesIt) {
  run("t_end=10 time_step=0.1",
      plate("&load kind='displacement' set='ymax' directions='y' value=0.01 curve='smooth' ramp=10 "
            "prescription='paper' /"));
  const auto h = read_history(path("case.history.csv"));
  EXPECT_NEAR(h.at("u_y").back() / 0.01, 0.99950004, 1e-8);
}

TEST_F(Motion, PaperVelocityEndsWhereVerletTakesIt) {
  run("t_end=10 time_step=0.1",
      plate("&load kind='velocity' set='ymax' directions='y' value=0.002 curve='smooth' ramp=10 "
            "prescription='paper' /"));
  const auto h = read_history(path("case.history.csv"));
  EXPECT_NEAR(h.at("v_y").back() / 0.002, 0.99990000, 1e-8);
}

TEST_F(Motion, ExactVelocityAndAccelerationAreIntegrated) {
  run("t_end=10 time_step=0.1",
      plate("&load kind='velocity' set='ymax' directions='y' value=0.002 curve='table' times=0,10 "
            "factors=0,1 /\n"
            "&load kind='acceleration' set='ymax' directions='x' value=2e-4 /"));
  const auto h = read_history(path("case.history.csv"));
  EXPECT_NEAR(h.at("u_y").back(), 0.01, 1e-16);
  EXPECT_NEAR(h.at("u_x").back(), 0.01, 1e-16);
  EXPECT_NEAR(h.at("v_x").back(), 0.002, 1e-16);
}

TEST_F(Motion, ConstantVelocityStartsAtOnceWithoutAKick) {
  run("t_end=5 time_step=0.1",
      plate("&load name='top' kind='velocity' set='ymax' directions='y' value=0.001 /"));
  const auto h = read_history(path("case.history.csv"));
  EXPECT_EQ(h.at("v_y").front(), 0.001);
  EXPECT_NEAR(h.at("u_y")[1], 1e-4, 1e-18);
  EXPECT_NEAR(h.at("v_y")[1], 0.001, 1e-15);
  EXPECT_EQ(h.at("reaction_top_y").front(), 0.0);
}

TEST_F(Motion, HistoryHasOneRecordAStepAndTheEnd) {
  run("t_end=1 time_step=0.3", std::string(kUnitPlate) + kUnitMaterial);
  const auto h = read_history(path("case.history.csv"));
  ASSERT_EQ(h.at("step").size(), 5u);
  EXPECT_DOUBLE_EQ(h.at("time").back(), 1.2);  // a given step is kept: the last passes t_end
}

TEST_F(Motion, AutomaticStepEndsAtTheEndTime) {
  run("t_end=7", std::string(kUnitPlate) + kUnitMaterial);
  const auto h = read_history(path("case.history.csv"));
  EXPECT_NEAR(h.at("time").back(), 7.0, 1e-14);
}

TEST_F(Motion, PaperCannotFollowAJump) {
  const std::string said = message_of<DeckError>([&] {
    run("t_end=1", plate("&load kind='displacement' set='ymax' directions='y' value=1 "
                         "curve='linear' ramp=1 prescription='paper' /"));
  });
  EXPECT_TRUE(has(said, "velocity jumps at the kinks"));
  EXPECT_TRUE(has(said, "Use 'exact' or a smooth curve"));
}

}  // namespace
}  // namespace cleave::driver::testing
