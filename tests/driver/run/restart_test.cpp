// Restart is bitwise: every file of a run that was cut equals that of one that was not.
#include "io/archive.hpp"
#include "support.hpp"

namespace cleave::driver::testing {
namespace {

namespace fs = std::filesystem;
class Restart : public RunDirectory {
 protected:
  void expect_same_bytes_after_cuts(const std::string& torn);
};

// A notched plate that is torn, with deletions before, at and after the cut, a follower pressure, a
// force, and a load that is released.
const std::string kTorn =
    "&lattice type='hexagonal' spacing=1 size=16,12,0 /\n"
    "&body name='plate' kinematics='plane_stress' material='unit' /\n" +
    std::string(kUnitMaterial) +
    "&fracture critical_strain=0.04 /\n&viscosity beta=0.3 length=1 /\n"
    "&precrack points=0,6,4.2,6 /\n"
    "&load name='low' kind='displacement' set='ymin' directions='xy' /\n"
    "&load name='top' kind='velocity' set='ymax' directions='y' value=0.02 curve='table' "
    "times=0,10,30,60 factors=0,1,1,-1 /\n"
    "&zone name='side' lower=15.2,0 /\n&load name='right' kind='pressure' set='side' value=1e-3 /\n"
    "&load name='pull' kind='force' set='ymax' directions='x' value=1e-3 curve='smooth' ramp=20 /\n"
    "&probe name='tip' field='cauchy_stress' point=5,6 /\n"
    "&output every_time=7 /\n&history every_steps=3 /\n&checkpoint every_steps=50 keep=20 /\n";

const char* const kFiles[] = {"case.exo", "case.history.nc", "case.history.csv", "case.events.nc"};

std::int64_t last_step(const fs::path& directory) {
  std::int64_t last = 0;
  for (const auto& entry : fs::directory_iterator(directory)) {
    const std::string name = entry.path().filename().string();
    if (name.find(".checkpoint.nc") != std::string::npos) {
      last = std::max<std::int64_t>(last, std::stoll(name.substr(5)));
    }
  }
  return last;
}

std::int64_t events_at(const std::string& checkpoint) {
  const io::Archive archive = io::read_archive(checkpoint);
  return std::get<std::int64_t>(*archive.find_attribute("event_records"));
}

// Cuts at every checkpoint of `torn`; bonds break before and after the one in the middle.
void Restart::expect_same_bytes_after_cuts(const std::string& torn) {
  ASSERT_EQ(run("t_end=60", torn, "whole"), 0);
  const std::int64_t end = last_step(path("whole"));
  const std::string last = "case." + std::to_string(end) + ".checkpoint.nc";
  const std::int64_t cut = end / 100 * 50;
  const auto before = events_at(path("whole/case." + std::to_string(cut) + ".checkpoint.nc"));
  EXPECT_GT(before, 0);
  EXPECT_GT(events_at(path("whole/" + last)), before);
  for (std::int64_t step = 50; step < end; step += 50) {
    const std::string name = "case." + std::to_string(step) + ".checkpoint.nc";
    fs::remove_all(path("cut"));
    fs::create_directories(path("cut"));
    // the files as the killed run may have left them: longer than the checkpoint
    for (const char* file : kFiles) fs::copy(path("whole") + "/" + file, path("cut"));
    fs::copy(path("whole/" + name), path("cut"));
    RunOptions options = quiet;
    options.threads = step % 100 == 0 ? 2 : 1;
    ASSERT_EQ(restart_run(path("cut"), "", options), 0);
    for (const char* file : kFiles) {
      EXPECT_EQ(file_bytes(path("cut") + "/" + file), file_bytes(path("whole") + "/" + file))
          << file << " after a cut at step " << step;
    }
    EXPECT_EQ(file_bytes(path("cut/" + last)), file_bytes(path("whole/" + last)));
  }
}

TEST_F(Restart, EveryCutGivesTheSameBytes) { expect_same_bytes_after_cuts(kTorn); }

// Integrities of bonds are state.
TEST_F(Restart, EveryCutOfASofteningBodyGivesTheSameBytes) {
  std::string soft = kTorn;
  const auto replace = [&](const std::string& what, const std::string& with) {
    soft.replace(soft.find(what), what.size(), with);
  };
  replace("&body", "&body formulation='vcpm'");
  replace("&fracture critical_strain=0.04 /\n&viscosity beta=0.3 length=1 /\n",
          "&vcpm criterion='strain' limit=0.02 softening='linear' final_strain=0.06 /\n");
  expect_same_bytes_after_cuts(soft);
}

TEST_F(Restart, ThreadsDoNotChangeTheBytes) {
  run("t_end=30", kTorn, "one");
  RunOptions options = quiet;
  options.threads = 3;
  run_deck(deck("t_end=30", kTorn, "three"), options);
  for (const char* file : kFiles) {
    EXPECT_EQ(file_bytes(path("one") + "/" + file), file_bytes(path("three") + "/" + file)) << file;
  }
}

TEST_F(Restart, AnotherDeckMayGoOnLonger) {
  run("t_end=30", kTorn);
  const std::int64_t end = last_step(path(""));
  std::ofstream(path("longer.nml")) << "&run units='other' name='case' t_end=40 /\n" << kTorn;
  EXPECT_EQ(restart_run(path(""), path("longer.nml"), quiet), 0);
  EXPECT_GT(last_step(path("")), end);
  const auto h = read_history(path("case.history.csv"));
  EXPECT_GT(h.at("time").back(), 39.99);
}

TEST_F(Restart, AnotherDeckMustHaveTheSameBodies) {
  run("t_end=5", kTorn);
  std::string other = kTorn;
  other.replace(other.find("'plate'"), 7, "'sheet'");
  std::ofstream(path("other.nml")) << "&run units='other' name='case' t_end=40 /\n" << other;
  EXPECT_TRUE(has(message_of<DeckError>([&] { restart_run(path(""), path("other.nml"), quiet); }),
                  "&body 'plate', key name: the checkpoint has 'plate', this deck 'sheet'"));
}

TEST_F(Restart, FinishedRunHasNothingToDo) {
  run("t_end=5", kTorn);
  const std::string before = file_bytes(path("case.exo"));
  EXPECT_EQ(restart_run(path(""), "", quiet), 0);
  EXPECT_EQ(file_bytes(path("case.exo")), before);
}

}  // namespace
}  // namespace cleave::driver::testing
