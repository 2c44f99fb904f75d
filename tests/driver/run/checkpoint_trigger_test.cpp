// When a checkpoint is due and when a run stops, with a clock of its own: no test waits.
#include "run/checkpoint_trigger.hpp"

#include <gtest/gtest.h>

#include <random>

namespace cleave::driver {
namespace {

using enum CheckpointAction;
const Schedule kNever(0.0, 0, 1.0);

// Of 50 MB: written in one second by the estimate, 1.5 s with its margin and 0.5 s on top.
CheckpointTrigger trigger(const WallKeys& wall, const Schedule& schedule = kNever) {
  CheckpointTrigger made(schedule, wall, 50'000'000);
  made.begin(0);
  return made;
}

TEST(CheckpointTrigger, NothingAskedForIsNeverDue) {
  CheckpointTrigger none = trigger({});
  for (std::int64_t step = 1; step < 100; ++step) {
    EXPECT_EQ(none.after_step(step, 1e6 * static_cast<double>(step), {}).action,
              CheckpointAction::none);
  }
}

TEST(CheckpointTrigger, StepsAreJudgedApartFromWallTime) {
  const Schedule schedule(0.0, 7, 0.5);
  for (const double every : {0.0, 3.0}) {
    CheckpointTrigger both = trigger({every, 0.0}, schedule);
    double wall = 0;
    for (std::int64_t step = 1; step < 200; ++step) {
      const CheckpointVerdict verdict = both.after_step(step, ++wall, {});
      const bool planned = schedule.due(step);
      EXPECT_TRUE(verdict.action == write || !planned) << step;
      EXPECT_TRUE(verdict.action == none || planned || every > 0) << step;
      EXPECT_TRUE(verdict.why.empty());
      if (verdict.action == write) both.attempted(wall, wall);
    }
  }
}

// Between the end of one and the beginning of the next: a slow disk leaves time to compute.
TEST(CheckpointTrigger, EveryWallCountsFromTheEndOfTheLastOne) {
  CheckpointTrigger clock = trigger({10.0, 0.0});
  clock.begin(100);
  EXPECT_EQ(clock.after_step(1, 109.9, {}).action, none);
  EXPECT_EQ(clock.after_step(2, 110.0, {}).action, write);
  clock.attempted(110, 114);
  EXPECT_EQ(clock.after_step(3, 123.9, {}).action, none);
  EXPECT_EQ(clock.after_step(4, 124.0, {}).action, write);
}

TEST(CheckpointTrigger, LimitLeavesTimeForAStepAndACheckpoint) {
  CheckpointTrigger clock = trigger({0.0, 100.0});
  // a step of 3 s and 2 s for the checkpoint: after 93 s there is time for one more, after 96 not
  for (std::int64_t step = 1; step <= 31; ++step) {
    EXPECT_EQ(clock.after_step(step, 3.0 * static_cast<double>(step), {}).action, none) << step;
  }
  const CheckpointVerdict verdict = clock.after_step(32, 96.0, {});
  EXPECT_EQ(verdict.action, stop);
  EXPECT_EQ(verdict.why, "stopped for the wall-time limit of 1:40");
}

// After 96.5 s there is time for a step of 1 s and a checkpoint, but not for two checkpoints.
TEST(CheckpointTrigger, OneThatIsDueShortlyBeforeTheLimitIsTheLast) {
  CheckpointTrigger clock = trigger({0.0, 100.0}, Schedule(0.0, 97, 1.0));
  for (std::int64_t step = 1; step <= 96; ++step) {
    EXPECT_EQ(clock.after_step(step, static_cast<double>(step), {}).action, none) << step;
  }
  EXPECT_EQ(clock.after_step(97, 96.5, {}).action, stop);
  CheckpointTrigger undue = trigger({0.0, 100.0});
  for (std::int64_t step = 1; step <= 97; ++step) {
    EXPECT_EQ(undue.after_step(step, static_cast<double>(step), {}).action, none) << step;
  }
}

TEST(CheckpointTrigger, LongestMeasuredCostReplacesTheEstimate) {
  CheckpointTrigger clock = trigger({0.0, 100.0});
  EXPECT_DOUBLE_EQ(clock.reserve(), 2.0);
  clock.attempted(10, 10.2);  // less than was estimated
  EXPECT_DOUBLE_EQ(clock.reserve(), 0.5 + 1.5 * (10.2 - 10));
  clock.attempted(20, 28);
  clock.attempted(40, 41);
  EXPECT_DOUBLE_EQ(clock.reserve(), 0.5 + 1.5 * 8);
}

// What was written is no part of the step after it.
TEST(CheckpointTrigger, SlowestStepIsOneOfComputing) {
  CheckpointTrigger clock = trigger({0.0, 1000.0});
  clock.after_step(1, 2, {});
  clock.attempted(2, 32);
  clock.after_step(2, 33, {});
  EXPECT_DOUBLE_EQ(clock.reserve(), 2 + 1.5 * 30 + 0.5);
}

TEST(CheckpointTrigger, SlowStepIsForgottenAfterOneToTwoThousand) {
  RecentSlowest slowest;
  slowest.add(60);
  for (int i = 1; i <= 1000; ++i) slowest.add(1);
  EXPECT_EQ(slowest.value(), 60);
  for (int i = 1; i <= 1000; ++i) slowest.add(1);
  EXPECT_EQ(slowest.value(), 1);
}

// For any steps and costs: it is done before the limit if the last checkpoint takes no more than
// 1.5 times the longest before, and it does not stop long before.
TEST(CheckpointTrigger, StopsBeforeTheLimitAndNotLongBefore) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> part(0, 1);
  for (int run = 0; run < 500; ++run) {
    const double limit = 50 + 1000 * part(random), slowest = 5 * part(random),
                 cost = 5 * part(random);
    CheckpointTrigger clock(kNever, {20.0, limit}, 0);
    double wall = 3 * part(random), longest = 0;
    clock.begin(wall);
    for (std::int64_t step = 1;; ++step) {
      wall += step == 1 ? slowest : slowest * part(random);
      const CheckpointVerdict verdict = clock.after_step(step, wall, {});
      if (verdict.action == stop) break;
      if (verdict.action == none) continue;
      const double takes = longest == 0 ? cost : cost * part(random);
      clock.attempted(wall, wall + takes);
      wall += takes;
      longest = std::max(longest, takes);
    }
    EXPECT_LE(wall + 1.5 * longest, limit);
    EXPECT_GT(wall + 2 * (slowest + 1.5 * cost + 0.5), limit);
  }
}

// A job that is started again and again with a limit shorter than its set-up makes a step each.
TEST(CheckpointTrigger, LimitThatHasPassedAllowsOneStep) {
  CheckpointTrigger late = trigger({0.0, 10.0});
  late.begin(50);
  EXPECT_EQ(late.after_step(1, 51, {}).action, stop);
}

TEST(CheckpointTrigger, RequestsComeFirst) {
  const Schedule always(0.0, 1, 1.0);
  CheckpointTrigger busy = trigger({0.0, 0.0}, always);
  EXPECT_EQ(busy.after_step(1, 1, {.write = true}).why, "checkpoint written on request");
  EXPECT_EQ(busy.after_step(2, 2, {.write = true}).action, write);
  CheckpointVerdict verdict = busy.after_step(3, 3, {.write = true, .stop = true});
  EXPECT_EQ(verdict.action, stop);
  EXPECT_EQ(verdict.why, "stopped on request");
  verdict = busy.after_step(4, 4, {.stop_file = true});
  EXPECT_EQ(verdict.action, stop);
  EXPECT_EQ(verdict.why, "stopped by the stop file");
}

}  // namespace
}  // namespace cleave::driver
