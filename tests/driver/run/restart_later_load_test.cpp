// Loads that begin after a checkpoint may change: the run is then, byte for byte, the one that had the
// new load from its start.
#include "scene/curve.hpp"
#include "support.hpp"

namespace cleave::driver::testing {
namespace {

namespace fs = std::filesystem;
using RestartLoads = RunDirectory;

const char* const kFiles[] = {"case.exo", "case.history.nc", "case.history.csv", "case.events.nc"};

std::string plate(const std::string& push, const std::string& move) {
  return std::string(kUnitPlate) + kUnitMaterial + "&initial velocity=0.01,0,0 set='xmax' /\n" +
         "&load name='push' kind='force' set='ymax' directions='y' " + push + " /\n" +
         "&load name='move' kind='velocity' set='xmin' directions='xy' " + move + " /\n" +
         "&history every_steps=1 /\n&output every_steps=5 /\n&checkpoint every_steps=10 keep=9 /\n";
}

void expect_same(const std::string& a, const std::string& b) {
  for (const char* file : kFiles) EXPECT_EQ(file_bytes(a + file), file_bytes(b + file)) << file;
}

TEST_F(RestartLoads, ChangeWhileTheyAreZero) {
  const std::string run_keys = "t_end=15 time_step=0.5";
  // step 10 is at time 5; the first time at which anything may act is after 5.5
  const std::string old_loads = plate("value=0", "value=0.1 begin=6");
  const std::string new_loads =
      plate("value=0.2 curve='linear' ramp=3 begin=5.6", "value=0.3 curve='smooth' ramp=2 begin=7");
  ASSERT_EQ(run(run_keys, old_loads, "old"), 0);
  ASSERT_EQ(run(run_keys, new_loads, "new"), 0);
  ASSERT_NE(file_bytes(path("old/case.exo")), file_bytes(path("new/case.exo")));
  std::ofstream(path("new.nml")) << deck(run_keys, new_loads, "new").resolved();
  EXPECT_EQ(restart_run(path("old/case.10.checkpoint.nc"), path("new.nml"), quiet), 0);
  expect_same(path("old/"), path("new/"));
}

TEST_F(RestartLoads, OneThatActsIsRefused) {
  const std::string run_keys = "t_end=15 time_step=0.5";
  const std::string loads = plate("value=0.1 begin=5.5", "value=0");
  ASSERT_EQ(run(run_keys, loads), 0);
  const auto message = [&](const std::string& groups) {
    std::ofstream(path("new.nml")) << deck(run_keys, groups).resolved();
    return message_of<DeckError>(
        [&] { restart_run(path("case.10.checkpoint.nc"), path("new.nml"), quiet); });
  };
  const std::string before = file_bytes(path("case.exo"));
  EXPECT_TRUE(
      has(message(plate("value=0.2 begin=5.5", "value=0")),
          "&load 'push', key value: the checkpoint has 0.1, this deck 0.2; a load may change "
          "at a restart only while it is zero, and that of the checkpoint acts by the end of "
          "the next step (time 5.5)"));
  EXPECT_TRUE(
      has(message(plate("value=0.1 begin=5.5", "value=0.2 curve='smooth' ramp=1")),
          "&load 'move', key value: the checkpoint has 0.0, this deck 0.2; a load may change "
          "at a restart only while it is zero, and this one acts"));
  EXPECT_EQ(file_bytes(path("case.exo")), before);
}

TEST(CurveIsZero, AgreesWithItsValues) {
  const auto curve = [](const std::string& keys) {
    const Deck deck =
        parse_deck("&run units='other' t_end=1 /\n" + std::string(kUnitPlate) + kUnitMaterial +
                       "&load kind='force' set='xmin' directions='x' " + keys + " /\n",
                   "case.nml");
    return Curve::of_load(deck, *deck.all("load").front());
  };
  const Curve table = curve("curve='table' times=0,2,3 factors=0,0,1 begin=1");
  EXPECT_TRUE(table.is_zero_until(0.5));
  EXPECT_TRUE(table.is_zero_until(2.9));
  EXPECT_FALSE(table.is_zero_until(3.0));  // its slope
  EXPECT_FALSE(table.is_zero_until(9.0));
  EXPECT_FALSE(curve("curve='table' times=0,2,3 factors=1,0,0").is_zero_until(2.5));
  EXPECT_TRUE(curve("curve='table' times=0,2 factors=0,0").is_zero_until(99.0));
  EXPECT_TRUE(curve("curve='smooth' ramp=1 begin=2").is_zero_until(1.999));
  EXPECT_FALSE(curve("curve='smooth' ramp=1 begin=2").is_zero_until(2.0));
  EXPECT_FALSE(curve("curve='constant'").is_zero_until(0.0));
}

}  // namespace
}  // namespace cleave::driver::testing
