// Where assignments put their values; the same rules against gfortran: compare_with_fortran.py.
#include <gtest/gtest.h>

#include "io/error.hpp"
#include "io/namelist_section.hpp"

namespace nml = cleave::io::namelist;

namespace {

nml::Assignment assignment(const std::string& text) {
  return nml::parse("&g " + text + " /", "deck.nml").groups.front().assignments.front();
}

std::vector<std::int64_t> elements(const std::string& name,
                                   const std::vector<nml::Bounds>& bounds) {
  const nml::Section section(assignment(name + " = 1").name.back().subscripts, bounds);
  std::vector<std::int64_t> result;
  for (std::int64_t k = 0; k < section.size(); ++k) result.push_back(section.element(k));
  return result;
}

std::string complaint(const std::string& text, const std::vector<nml::Bounds>& bounds) {
  std::vector<nml::Scalar> values;
  try {
    nml::assign(assignment(text), bounds, values);
  } catch (const cleave::io::Error& error) {
    return error.what();
  }
  return "accepted";
}

using Indices = std::vector<std::int64_t>;
const std::vector<nml::Bounds> kSix = {{1, 6}};
const std::vector<nml::Bounds> kTwoByThree = {{1, 2}, {1, 3}};

TEST(NamelistSection, OneDimension) {
  EXPECT_EQ(elements("v", kSix), (Indices{0, 1, 2, 3, 4, 5}));
  EXPECT_EQ(elements("v(4)", kSix), (Indices{3, 4, 5}));
  EXPECT_EQ(elements("v(2:3)", kSix), (Indices{1, 2}));
  EXPECT_EQ(elements("v(:2)", kSix), (Indices{0, 1}));
  EXPECT_EQ(elements("v(5:)", kSix), (Indices{4, 5}));
  EXPECT_EQ(elements("v(1:6:2)", kSix), (Indices{0, 2, 4}));
  EXPECT_EQ(elements("v(6:1:-2)", kSix), (Indices{5, 3, 1}));
  EXPECT_EQ(elements("v(::-1)", kSix), (Indices{5, 4, 3, 2, 1, 0}));
  EXPECT_EQ(elements("v(2:6:9223372036854775807)", kSix), (Indices{1}));
  EXPECT_EQ(elements("v(-1:0)", {{-2, 5}}), (Indices{1, 2}));
}

TEST(NamelistSection, SeveralDimensions) {
  EXPECT_EQ(elements("m", kTwoByThree), (Indices{0, 1, 2, 3, 4, 5}));
  EXPECT_EQ(elements("m(2,:)", kTwoByThree), (Indices{1, 3, 5}));
  EXPECT_EQ(elements("m(:,2)", kTwoByThree), (Indices{2, 3}));
  EXPECT_EQ(elements("m(2:1:-1,3:2:-1)", kTwoByThree), (Indices{5, 4, 3, 2}));
  EXPECT_EQ(elements("m(2,2)", kTwoByThree), (Indices{3, 5}));  // m(2:,2:)
}

TEST(NamelistSection, ScalarsTakeOneValue) {
  EXPECT_EQ(elements("s", {}), (Indices{0}));
  EXPECT_NE(complaint("s(1) = 2", {}).find("1 subscripts are given where 0"), std::string::npos);
  EXPECT_NE(complaint("s = 1, 2", {}).find("2 values are given where there is room for 1"),
            std::string::npos);
}

TEST(NamelistSection, EmptyValuesLeaveWhatIsThere) {
  std::vector<nml::Scalar> values(3, nml::Scalar(0.5));
  nml::assign(assignment("v(2:) = , 7,,,"), kSix, values);
  EXPECT_EQ(values, (std::vector<nml::Scalar>{0.5, 0.5, std::int64_t{7}}));
  nml::assign(assignment("v(5) = .true."), kSix, values);
  EXPECT_EQ(values, (std::vector<nml::Scalar>{0.5, 0.5, std::int64_t{7}, nml::Null{}, true}));
}

TEST(NamelistSection, MistakesAreNamed) {
  EXPECT_NE(complaint("v(7) = 1", kSix).find("subscript 7 is outside 1:6"), std::string::npos);
  EXPECT_NE(complaint("v(0:3) = 1", kSix).find("subscript 0 is outside 1:6"), std::string::npos);
  EXPECT_NE(complaint("v(2:9223372036854775807) = 1", kSix).find("is outside 1:6"),
            std::string::npos);
  EXPECT_NE(complaint("v(3:2) = 1", kSix).find("the range 3:2 is empty"), std::string::npos);
  EXPECT_NE(complaint("v(2:3:-1) = 1", kSix).find("the range 2:3:-1 is empty"), std::string::npos);
  EXPECT_NE(complaint("v(2:3) = 1, 2, 3", kSix).find("room for 2"), std::string::npos);
  EXPECT_NE(complaint("m(2) = 1", kTwoByThree).find("1 subscripts are given where 2"),
            std::string::npos);
}

}  // namespace
