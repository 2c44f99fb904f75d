#include "deck/unit_text.hpp"

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

TEST(UnitText, RewritesWhatStandsInBracketsInAMessage) {
  EXPECT_EQ(
      UnitText("mm-ms-g-MPa").in_message("horizon 3 [m] of 'a [1] b' [m2], [J m-2] [zone] [Pa]"),
      "horizon 3 [mm] of 'a [1] b' [mm2], [mJ mm-2] [zone] [MPa]");
  EXPECT_EQ(UnitText("SI").in_message("3 [m] and [N m-1]"), "3 [m] and [N m-1]");
  EXPECT_EQ(UnitText("mm-ms-g-MPa").in_message("nothing"), "nothing");
}

}  // namespace
}  // namespace cleave::driver
