// A checkpoint that cannot be written: the older ones stay, and the run goes on or stops.
#include "run/checkpoint_writer.hpp"

#include "run/checkpoint_files.hpp"
#include "support.hpp"

namespace cleave::driver::testing {
namespace {

namespace fs = std::filesystem;

// Twenty steps with a checkpoint at every fifth; something is in the way of that at step 10.
class FailingCheckpoint : public RunDirectory {
 protected:
  static std::string groups(const std::string& keys) {
    return std::string(kUnitPlate) + kUnitMaterial +
           "&load kind='velocity' set='ymax' directions='y' value=0.01 /\n"
           "&checkpoint every_steps=5 keep=9 " +
           keys + " /\n";
  }
  // A folder where the temporary file would be: no user may write over it.
  std::string obstacle() const { return path("cut/case.10.checkpoint.nc.part"); }
  int run_cut(const std::string& keys) {
    fs::create_directories(obstacle() + "/inside");
    return run(kKeys, groups(keys), "cut");
  }
  std::vector<std::int64_t> steps() const {
    std::vector<std::int64_t> found;
    for (const CheckpointFile& file : checkpoint_files(path("cut"))) found.push_back(file.step);
    return found;
  }
  void expect_same_files() {
    run(kKeys, groups(""), "whole");
    for (const char* file : {"case.exo", "case.history.nc", "case.history.csv", "case.events.nc"}) {
      EXPECT_EQ(file_bytes(path("cut/") + file), file_bytes(path("whole/") + file)) << file;
    }
  }
  static constexpr const char* kKeys = "t_end=10 time_step=0.5";
};

TEST_F(FailingCheckpoint, RunGoesOnAndTriesTheNextOne) {
  ::testing::internal::CaptureStderr();
  EXPECT_EQ(run_cut(""), 0);
  const std::string said = ::testing::internal::GetCapturedStderr();
  EXPECT_TRUE(has(said, "cleave: warning: no checkpoint after step 10: " + obstacle()));
  EXPECT_EQ(steps(), (std::vector<std::int64_t>{5, 15, 20}));
  expect_same_files();
}

// Due at the last step and at the end: one checkpoint, and the results are complete without it.
TEST_F(FailingCheckpoint, LastOneIsTriedOnce) {
  fs::create_directories(obstacle() + "/inside");
  ::testing::internal::CaptureStderr();
  EXPECT_EQ(run("t_end=5 time_step=0.5", groups(""), "cut"), 0);
  const std::string said = ::testing::internal::GetCapturedStderr();
  EXPECT_TRUE(has(said, "no checkpoint after step 10"));
  EXPECT_EQ(said.find("warning"), said.rfind("warning"));
}

TEST_F(FailingCheckpoint, RunStopsIfTheDeckSaysSo) {
  const std::string said = message_of<RunError>([&] { run_cut("on_failure='stop'"); });
  EXPECT_TRUE(has(said, "no checkpoint after step 10: "));
  EXPECT_TRUE(has(said, "as on_failure = 'stop' of &checkpoint asks"));
  EXPECT_TRUE(has(said, "cleave restart " + path("cut/case.5.checkpoint.nc")));
  EXPECT_EQ(steps(), (std::vector<std::int64_t>{5}));
  fs::remove_all(obstacle());
  EXPECT_EQ(restart_run(path("cut"), "", quiet), 0);
  expect_same_files();
}

TEST_F(FailingCheckpoint, WithoutAnOlderOneThereIsNoneToName) {
  FileNames names;
  names.directory = directory;
  names.base = "case";
  EXPECT_EQ(CheckpointWriter::advice(names), "There is no older checkpoint to continue from");
}

TEST_F(FailingCheckpoint, HalfWrittenOnesOfAKilledRunAreRemoved) {
  fs::create_directories(path("cut"));
  const auto put = [&](const std::string& name) { std::ofstream(path("cut/" + name)) << "half"; };
  for (const char* name : {"case.3.checkpoint.nc.part", "other.3.checkpoint.nc.part",
                           "case.x.checkpoint.nc.part", "case.part"}) {
    put(name);
  }
  run(kKeys, groups(""), "cut");
  EXPECT_FALSE(fs::exists(path("cut/case.3.checkpoint.nc.part")));
  EXPECT_TRUE(fs::exists(path("cut/other.3.checkpoint.nc.part")));
  EXPECT_TRUE(fs::exists(path("cut/case.x.checkpoint.nc.part")));
  EXPECT_TRUE(fs::exists(path("cut/case.part")));
  put("case.3.checkpoint.nc.part");
  restart_run(path("cut/case.10.checkpoint.nc"), "", quiet);
  EXPECT_FALSE(fs::exists(path("cut/case.3.checkpoint.nc.part")));
}

}  // namespace
}  // namespace cleave::driver::testing
