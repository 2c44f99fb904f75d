// Reports of several mistakes; the single messages are in tests/driver/bad_decks.
#include <gtest/gtest.h>

#include "decks.hpp"

namespace cleave::driver {
namespace {

using testing::complete;
using testing::message_of;

TEST(Mistakes, AreReportedTogetherInTheOrderOfTheFile) {
  const std::string text =
      message_of(complete("&zone nam='z' /\n&laod /\n&zone name='z', radius=-1 /"));
  const std::size_t key = text.find("case.nml:5:7: key \"nam\""), group = text.find("case.nml:6:"),
                    range = text.find("-1 is out of range");
  ASSERT_NE(key, std::string::npos) << text;
  ASSERT_NE(group, std::string::npos) << text;
  ASSERT_NE(range, std::string::npos) << text;
  EXPECT_LT(key, group);
  EXPECT_LT(group, range);
  EXPECT_NE(text.find("case.nml: 4 mistakes"), std::string::npos)
      << text;  // the zone lacks its name, too
}

TEST(Mistakes, TenAreShown) {
  std::string zones;
  for (int i = 0; i < 25; ++i) zones += "&zone name='z" + std::to_string(i) + "', radius=-1 /\n";
  const std::string text = message_of(complete(zones));
  EXPECT_NE(text.find("25 mistakes; the first 10 are shown"), std::string::npos) << text;
  EXPECT_NE(text.find("case.nml:14:"), std::string::npos);
  EXPECT_EQ(text.find("case.nml:15:"), std::string::npos);
}

TEST(Mistakes, OneIsNotCounted) {
  const std::string text = message_of(complete("&zone name='z', radius=-1 /"));
  EXPECT_EQ(text.find("mistakes"), std::string::npos) << text;
  EXPECT_EQ(text.find("case.nml:5:24: key \"radius\" of &zone: -1 is out of range; wanted is a "
                      "real number [m] >= 0."),
            0u)
      << text;
}

TEST(Mistakes, UnitsAreThoseOfTheDeck) {
  const auto zone_in = [](const std::string& units) {
    return message_of("&zone name='z', radius=-1 /\n&run units = '" + units + "', t_end = 1 /\n");
  };
  EXPECT_NE(zone_in("mm-s-t-MPa").find("real number [mm] >= 0."), std::string::npos);
  EXPECT_NE(zone_in("other").find("real number [m] >= 0."), std::string::npos);
  EXPECT_NE(zone_in("furlong").find("real number [m] >= 0."), std::string::npos);
}

TEST(Mistakes, TheLineIsShown) {
  EXPECT_NE(message_of(complete("&zone name='z', radius=-1 /")).find("&zone name='z', radius=-1 /"),
            std::string::npos);
}

TEST(Mistakes, AnEmptyDeckIsRefused) {
  const std::string text = message_of("");
  EXPECT_NE(text.find("&run lacks the required key \"units\""), std::string::npos) << text;
  EXPECT_NE(text.find("the deck has no &body"), std::string::npos) << text;
}

}  // namespace
}  // namespace cleave::driver
