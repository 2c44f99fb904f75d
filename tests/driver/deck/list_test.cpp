// Lists with subscripts. The values are those that the namelist READ of gfortran 12 gives for
// real :: v(3) with the same default (v(::2) is refused there, but not by the standard).
#include <gtest/gtest.h>

#include "decks.hpp"

namespace cleave::driver {
namespace {

using testing::complete;
using testing::message_of;
using testing::parse;
using Reals = std::vector<double>;

// A key of three entries, default 0, 0, 1.
Reals normal(const std::string& assignments) {
  return parse(complete("&zone name='z' " + assignments + " /")).one("zone").reals("normal");
}
// A list without default and limit.
Reals times(const std::string& assignments) {
  return parse(complete("&load kind='gravity' " + assignments + " /")).one("load").reals("times");
}
std::string refusal(const std::string& assignments) {
  return message_of(complete("&zone name='z' " + assignments + " /"));
}

TEST(List, WholeListsReplaceWhatTheyGive) {
  EXPECT_EQ(normal("normal = 1, 2, 3"), (Reals{1, 2, 3}));
  EXPECT_EQ(normal("normal = 1, 2"), (Reals{1, 2, 1}));
  EXPECT_EQ(normal("normal = 5"), (Reals{5, 0, 1}));
  EXPECT_EQ(normal("normal = 3*2.5"), (Reals{2.5, 2.5, 2.5}));
}

TEST(List, NullValuesKeepEntries) {
  EXPECT_EQ(normal("normal = , 2"), (Reals{0, 2, 1}));
  EXPECT_EQ(normal("normal = 1, , 3"), (Reals{1, 0, 3}));
  EXPECT_EQ(normal("normal = 2*, 7"), (Reals{0, 0, 7}));
  EXPECT_EQ(normal("normal ="), (Reals{0, 0, 1}));
}

TEST(List, SubscriptsSetEntriesAndWhatFollows) {
  EXPECT_EQ(normal("normal(2) = 4"), (Reals{0, 4, 1}));
  EXPECT_EQ(normal("normal(2) = 4, 5"), (Reals{0, 4, 5}));
  EXPECT_EQ(normal("normal(1) = 4, normal(3) = 6"), (Reals{4, 0, 6}));
}

TEST(List, SectionsSetTheirEntries) {
  EXPECT_EQ(normal("normal(2:3) = 4, 5"), (Reals{0, 4, 5}));
  EXPECT_EQ(normal("normal(3:1:-1) = 4, 5, 6"), (Reals{6, 5, 4}));
  EXPECT_EQ(normal("normal(:) = 7, 8"), (Reals{7, 8, 1}));
  EXPECT_EQ(normal("normal(2:) = 7"), (Reals{0, 7, 1}));
  EXPECT_EQ(normal("normal(:2) = 7, 8"), (Reals{7, 8, 1}));
  EXPECT_EQ(normal("normal(::2) = 7, 8"), (Reals{7, 0, 8}));
}

TEST(List, LaterSubscriptsOverrideEarlierValues) {
  EXPECT_EQ(normal("normal = 1, 2, 3  normal(2) = 9"), (Reals{1, 9, 3}));
}

TEST(List, ListsWithoutLimitGrow) {
  EXPECT_EQ(times("times = 1, 2, 3, 4, 5"), (Reals{1, 2, 3, 4, 5}));
  EXPECT_EQ(times("times(2) = 2, times(1) = 1"), (Reals{1, 2}));
  EXPECT_EQ(times("times = 1, 2, ,"), (Reals{1, 2}));
}

TEST(List, GapsAreRefused) {
  EXPECT_NE(refusal("lower(2) = 1").find("entry 1 has no value, but entry 2 has"),
            std::string::npos);
  EXPECT_NE(refusal("lower = 1,,3").find("entry 2 has no value, but entry 3 has"),
            std::string::npos);
}

TEST(List, WrongLengthsAreRefused) {
  EXPECT_NE(refusal("normal = 1,2,3,4").find("takes 3 entries, 4 are given"), std::string::npos);
  EXPECT_NE(refusal("normal(2) = 1,2,3").find("takes 3 entries, here entry 4 is set"),
            std::string::npos);
  EXPECT_NE(refusal("normal(1:2) = 1,2,3").find("takes at most 2 values, 3 are given"),
            std::string::npos);
  EXPECT_NE(refusal("lower = 1").find("takes 0, 2 or 3 entries, 1 is given"), std::string::npos);
}

TEST(List, BadSubscriptsAreRefused) {
  EXPECT_NE(refusal("normal(0) = 1").find("subscript 0 is outside 1 .. 3"), std::string::npos);
  EXPECT_NE(refusal("normal(4) = 1").find("subscript 4 is outside 1 .. 3"), std::string::npos);
  EXPECT_NE(refusal("normal(1,2) = 1").find("takes one subscript, 2 are given"), std::string::npos);
  EXPECT_NE(refusal("radius(1) = 1").find("takes no subscript"), std::string::npos);
  EXPECT_NE(refusal("normal(3:2) = 1").find("section 3:2 is empty"), std::string::npos);
  EXPECT_NE(refusal("normal%x = 1").find("has no components"), std::string::npos);
  // Must not cost memory.
  const std::string huge = message_of(complete("&load kind='gravity' times(9999999999) = 1 /"));
  EXPECT_NE(huge.find("subscript 9999999999 is outside 1 .. 1000000"), std::string::npos) << huge;
}

}  // namespace
}  // namespace cleave::driver
