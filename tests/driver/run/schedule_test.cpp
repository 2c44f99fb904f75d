#include "run/schedule.hpp"

#include <gtest/gtest.h>

#include "run/time_step.hpp"

namespace cleave::driver {
namespace {

TEST(Schedule, EveryStepsCountsSteps) {
  const Schedule schedule(0.0, 3, 0.1);
  EXPECT_FALSE(schedule.due(2));
  EXPECT_TRUE(schedule.due(3));
  EXPECT_FALSE(schedule.due(4));
}

// 0.1 * 3 is 0.30000000000000004 and 0.1 * 7 is 0.7000000000000001: rounding must not shift a frame.
TEST(Schedule, EveryTimeHitsMultiplesInSpiteOfRounding) {
  for (const double dt : {0.1, 0.3, 1.0 / 3.0, 1e-9 / 7}) {
    const Schedule schedule(5 * dt, 0, dt);
    for (std::int64_t step = 1; step <= 10000; ++step) {
      ASSERT_EQ(schedule.due(step), step % 5 == 0) << dt << " " << step;
    }
  }
}

TEST(Schedule, EveryTimeTakesTheFirstStepThatReachesAMultiple) {
  const Schedule schedule(1.0, 0, 0.4);  // times 0.4 0.8 1.2 1.6 2.0
  EXPECT_FALSE(schedule.due(2));
  EXPECT_TRUE(schedule.due(3));
  EXPECT_FALSE(schedule.due(4));
  EXPECT_TRUE(schedule.due(5));
}

TEST(TimeStep, StepsToTheEndAreRoundedWhereTheRatioIsWhole) {
  EXPECT_EQ(steps_to_end(0.3, 0.1), 3);  // the quotient is 2.9999999999999996
  EXPECT_EQ(steps_to_end(1.0, 0.3), 4);
  EXPECT_EQ(steps_to_end(0.1, 1.0), 1);
}

}  // namespace
}  // namespace cleave::driver
