#include "scene/unit_text.hpp"

#include <gtest/gtest.h>

namespace cleave::driver {
namespace {

TEST(UnitText, RewritesLabelsInTheUnitsOfTheDeck) {
  const UnitText text("mm-ms-g-MPa");
  EXPECT_EQ(text("kg m-3"), "g mm-3");
  EXPECT_EQ(text("m s-2"), "mm ms-2");
  EXPECT_EQ(text("Pa"), "MPa");
  EXPECT_EQ(text("J"), "mJ");
  EXPECT_EQ(text("m2"), "mm2");
  EXPECT_EQ(text("1"), "1");
}

TEST(UnitText, LeavesSiAndUnnamedSetsAsTheyAre) {
  EXPECT_EQ(UnitText("SI")("J m-3"), "J m-3");
  EXPECT_EQ(UnitText("other")("kg m s-1"), "kg m s-1");
}

}  // namespace
}  // namespace cleave::driver
