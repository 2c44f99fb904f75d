#include "run/checkpoint_files.hpp"

#include "support.hpp"

namespace cleave::driver::testing {
namespace {

namespace fs = std::filesystem;
using CheckpointFiles = RunDirectory;

const std::string kPlate = std::string(kUnitPlate) + kUnitMaterial;

TEST_F(CheckpointFiles, TheOldestAreRemoved) {
  run("t_end=10 time_step=0.5", kPlate + "&checkpoint every_steps=4 keep=3 /\n");
  const auto files = checkpoint_files(directory);
  ASSERT_EQ(files.size(), 3u);
  EXPECT_EQ(files[0].step, 12);
  EXPECT_EQ(files[1].step, 16);
  EXPECT_EQ(files[2].step, 20);
  EXPECT_EQ(files[2].base, "case");
}

TEST_F(CheckpointFiles, DamagedNewestIsSkipped) {
  run("t_end=10 time_step=0.5", kPlate + "&checkpoint every_steps=8 keep=3 /\n");
  fs::resize_file(path("case.20.checkpoint.nc"), 1000);
  const Loaded loaded = load_checkpoint(directory.string());
  EXPECT_EQ(loaded.path, path("case.16.checkpoint.nc"));
  ASSERT_EQ(loaded.skipped.size(), 1u);
  EXPECT_TRUE(has(loaded.skipped[0], "case.20.checkpoint.nc"));
}

TEST_F(CheckpointFiles, NothingToLoadIsSaid) {
  EXPECT_TRUE(has(message_of<DeckError>([&] { load_checkpoint(directory.string()); }),
                  "no checkpoint here (NAME.STEP.checkpoint.nc)"));
  std::ofstream(path("case.3.checkpoint.nc")) << "garbage";
  EXPECT_TRUE(has(message_of<DeckError>([&] { load_checkpoint(directory.string()); }),
                  "no checkpoint verifies"));
  std::ofstream(path("other.3.checkpoint.nc")) << "garbage";
  EXPECT_TRUE(has(message_of<DeckError>([&] { load_checkpoint(directory.string()); }),
                  "checkpoints of several runs are here (case, other)"));
}

TEST_F(CheckpointFiles, NewRunSetsThoseOfAnEarlierOneAside) {
  run("t_end=10 time_step=0.5", kPlate);
  run("t_end=5 time_step=0.5", kPlate);
  const auto files = checkpoint_files(directory);
  ASSERT_EQ(files.size(), 1u);
  EXPECT_EQ(files[0].step, 10);
  EXPECT_TRUE(fs::exists(path("case.20.checkpoint.nc.previous")));
  run("t_end=5 time_step=0.5", kPlate);
  EXPECT_FALSE(fs::exists(path("case.20.checkpoint.nc.previous")));
  EXPECT_TRUE(fs::exists(path("case.10.checkpoint.nc.previous")));
}

TEST_F(CheckpointFiles, AtEndCanBeSwitchedOff) {
  run("t_end=5 time_step=0.5", kPlate + "&checkpoint at_end=.false. /\n");
  EXPECT_TRUE(checkpoint_files(directory).empty());
}

}  // namespace
}  // namespace cleave::driver::testing
