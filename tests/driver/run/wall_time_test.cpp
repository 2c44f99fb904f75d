#include "run/wall_time.hpp"

#include <gtest/gtest.h>

#include "run/progress.hpp"

namespace cleave::driver {
namespace {

TEST(WallTime, SecondsOrHoursMinutesSeconds) {
  EXPECT_EQ(parse_wall_time("0"), 0);
  EXPECT_EQ(parse_wall_time("86000"), 86000);
  EXPECT_EQ(parse_wall_time("0.5"), 0.5);
  EXPECT_EQ(parse_wall_time("2:05"), 125);
  EXPECT_EQ(parse_wall_time("90:00"), 5400);
  EXPECT_EQ(parse_wall_time("23:50:00"), 85800);
  EXPECT_EQ(parse_wall_time("100:00:30.5"), 360030.5);
  EXPECT_EQ(parse_wall_time(duration_text(85800)), 85800);
}

TEST(WallTime, AnythingElseIsRefused) {
  for (const char* text : {"", ":", "1:", ":30", "1:75", "1:60:00", "1:2:3:4", "-1", "1:-5", "-0",
                           "+1", "1h", "1 ", " 1", "0,5", "nan", "inf", "1e999", "tomorrow"}) {
    EXPECT_FALSE(parse_wall_time(text)) << text;
  }
}

TEST(WallTime, CountsFromTheStartOfTheProgram) {
  const double first = seconds_since_start();
  EXPECT_GE(first, 0);
  EXPECT_LT(first, 3600);
  EXPECT_GE(seconds_since_start(), first);
}

}  // namespace
}  // namespace cleave::driver
