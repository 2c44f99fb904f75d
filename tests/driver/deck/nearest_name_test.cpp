#include "deck/nearest_name.hpp"

#include <gtest/gtest.h>

namespace cleave::driver {
namespace {

TEST(NearestName, CountsEdits) {
  EXPECT_EQ(edit_distance("", ""), 0u);
  EXPECT_EQ(edit_distance("", "abc"), 3u);
  EXPECT_EQ(edit_distance("kitten", "sitting"), 3u);
  EXPECT_EQ(edit_distance("t_ned", "t_end"), 1u);  // neighbours swapped
  EXPECT_EQ(edit_distance("GF", "gf"), 0u);
}

TEST(NearestName, FindsMisspeltNames) {
  const std::vector<std::string> known = {"title", "t_end", "time_step", "step_factor"};
  EXPECT_EQ(nearest_name("t_ned", known), "t_end");
  EXPECT_EQ(nearest_name("timestep", known), "time_step");
  EXPECT_EQ(nearest_name("step_fac", known), "step_factor");
  EXPECT_EQ(nearest_name("TITLE", known), "title");
}

TEST(NearestName, IsSilentWhenNothingIsNear) {
  EXPECT_EQ(nearest_name("gravity", {"title", "t_end"}), "");
  EXPECT_EQ(nearest_name("q", {"E", "nu"}), "");
  EXPECT_EQ(nearest_name("x", {}), "");
  EXPECT_EQ(did_you_mean("gravity", {"title"}), ".");
}

TEST(NearestName, TakesTheFirstOfEquallyNear) {
  EXPECT_EQ(nearest_name("boda", {"bodb", "bodc"}), "bodb");
  EXPECT_EQ(did_you_mean("boda", {"body"}, "&", ""), "; did you mean &body?");
}

}  // namespace
}  // namespace cleave::driver
