// What the reader makes of each form: names, types, places. Values against gfortran's own READ are
// compared by compare_with_fortran.py; here is what that cannot see.
#include <gtest/gtest.h>

#include <cmath>

#include "io/error.hpp"
#include "io/namelist.hpp"

namespace nml = cleave::io::namelist;

namespace {

nml::File parse(const std::string& text) { return nml::parse(text, "deck.nml"); }

// The values of the only assignment of the only group.
std::vector<nml::Value> values(const std::string& list) {
  const nml::File file = parse("&g v = " + list + " /");
  EXPECT_EQ(file.groups.size(), 1U);
  EXPECT_EQ(file.groups.front().assignments.size(), 1U);
  return file.groups.front().assignments.front().values;
}

nml::Scalar value(const std::string& text) {
  const std::vector<nml::Value> all = values(text);
  EXPECT_EQ(all.size(), 1U) << text;
  return all.empty() ? nml::Scalar() : all.front().scalar;
}

nml::Scalar text(const char* characters) { return std::string(characters); }

std::vector<nml::Scalar> scalars(const std::string& list) {
  std::vector<nml::Scalar> result;
  for (const nml::Value& v : values(list)) result.push_back(v.scalar);
  return result;
}

void expect_place(nml::Place place, int line, int column) {
  EXPECT_EQ(place.line, line);
  EXPECT_EQ(place.column, column);
}

TEST(NamelistSyntax, TypesAreAsWritten) {
  EXPECT_EQ(value("12"), nml::Scalar(std::int64_t{12}));
  EXPECT_EQ(value("-9223372036854775808"), nml::Scalar(INT64_MIN));
  EXPECT_EQ(value("9223372036854775808"), nml::Scalar(9223372036854775808.0));
  EXPECT_EQ(value("12."), nml::Scalar(12.0));
  EXPECT_EQ(value("1d3"), nml::Scalar(1000.0));
  EXPECT_EQ(value("1.5-3"), nml::Scalar(1.5e-3));
  EXPECT_EQ(value("T"), nml::Scalar(true));
  EXPECT_EQ(value(".false."), nml::Scalar(false));
  EXPECT_EQ(value("'12'"), text("12"));
  EXPECT_EQ(value("(1,-2.5)"), nml::Scalar(nml::Complex{1, -2.5}));
  EXPECT_EQ(value("-inf"), nml::Scalar(-HUGE_VAL));
  EXPECT_TRUE(std::isnan(std::get<double>(value("nan(7)"))));
}

TEST(NamelistSyntax, AWordIsANameIfAnEqualsSignFollows) {
  const nml::File file =
      parse("&g t = t f\n= .false. inf(2) = 1 nan%x = 2 nan(3)=4 lv = t, f (1,2) t (3)=f/");
  const std::vector<nml::Assignment>& a = file.groups.front().assignments;
  ASSERT_EQ(a.size(), 7U);
  const char* const names[] = {"t", "f", "inf(2)", "nan%x", "nan(3)", "lv", "t(3)"};
  for (std::size_t k = 0; k < a.size(); ++k) EXPECT_EQ(a[k].full_name(), names[k]);
  EXPECT_EQ(a[0].values.front().scalar, nml::Scalar(true));
  EXPECT_EQ(a[5].values.size(), 3U);
}

TEST(NamelistSyntax, NamesAreLowerCaseWithSubscriptsAndComponents) {
  const nml::File file = parse("&Run A % B (2,-1:+3) %c(:)(2:)=1 v(1::2)=1 w(::-1)=1 x(:4:2)=1 /");
  EXPECT_EQ(file.groups.front().name, "run");
  const std::vector<nml::Assignment>& a = file.groups.front().assignments;
  ASSERT_EQ(a.size(), 4U);
  EXPECT_EQ(a[0].full_name(), "a%b(2,-1:3)%c(:)(2:)");
  EXPECT_EQ(a[1].full_name(), "v(1::2)");
  EXPECT_EQ(a[2].full_name(), "w(::-1)");
  EXPECT_EQ(a[3].full_name(), "x(:4:2)");
  const nml::Subscript& s = a[0].name[1].subscripts[1];
  EXPECT_TRUE(s.is_range && s.has_first && s.has_last);
  EXPECT_EQ(s.first, -1);
  EXPECT_EQ(s.last, 3);
  EXPECT_EQ(s.stride, 1);
}

TEST(NamelistSyntax, EmptyValues) {
  const nml::Scalar one = std::int64_t{1};
  const nml::Scalar null;
  EXPECT_EQ(scalars("1,,1"), (std::vector<nml::Scalar>{one, null, one}));
  EXPECT_EQ(scalars("2*, 1"), (std::vector<nml::Scalar>{null, null, one}));
  EXPECT_EQ(scalars("2* 1"), (std::vector<nml::Scalar>{null, null, one}));
  EXPECT_EQ(scalars("1,"), (std::vector<nml::Scalar>{one}));
  EXPECT_EQ(scalars("1,,"), (std::vector<nml::Scalar>{one, null}));
  EXPECT_EQ(scalars(""), (std::vector<nml::Scalar>{}));
}

TEST(NamelistSyntax, HiddenEmptyValuesAreMarked) {
  const std::vector<nml::Value> comment = values("1, ! x\n 2, ! y\n");
  ASSERT_EQ(comment.size(), 3U);
  EXPECT_TRUE(comment[1].hidden);
  EXPECT_EQ(comment[1].scalar, nml::Scalar());
  expect_place(comment[1].place, 1, 11);
  EXPECT_FALSE(comment[2].hidden);

  const std::vector<nml::Value> line = values("1\n , 2\n , \n");
  ASSERT_EQ(line.size(), 3U);
  EXPECT_TRUE(line[1].hidden);

  for (const nml::Value& v : values("1,,2, 3* 4, ! c\n , 5")) EXPECT_FALSE(v.hidden);
  EXPECT_EQ(scalars("'a', ! x\n 2*'b'"),
            (std::vector<nml::Scalar>{text("a"), text("b"), text("b")}));
}

TEST(NamelistSyntax, ValueKeepsItsTextAndPlace) {
  const std::vector<nml::Value> all = values("1.50, 2*.TRUE.\n\t'it''s' (1 , 2)");
  ASSERT_EQ(all.size(), 5U);
  EXPECT_EQ(all[0].text, "1.50");
  expect_place(all[0].place, 1, 8);
  EXPECT_EQ(all[1].text, ".TRUE.");
  expect_place(all[1].place, 1, 16);
  expect_place(all[2].place, 1, 16);
  EXPECT_EQ(all[3].text, "'it''s'");
  EXPECT_EQ(all[3].scalar, text("it's"));
  expect_place(all[3].place, 2, 2);
  EXPECT_EQ(all[4].text, "(1 , 2)");
}

TEST(NamelistSyntax, PlacesWithTabsCarriageReturnsAndUtf8) {
  const nml::File file =
      parse("\xEF\xBB\xBF! \xC3\xA9\r\n\t&g\r\n s = '\xC3\xA9', 7\r\n/\r\n  $h\n/");
  ASSERT_EQ(file.groups.size(), 2U);
  expect_place(file.groups[0].place, 2, 2);
  const nml::Assignment& a = file.groups[0].assignments.front();
  expect_place(a.place, 3, 2);
  expect_place(a.values[0].place, 3, 6);
  expect_place(a.values[1].place, 3, 11);
  expect_place(file.groups[1].place, 5, 3);
  EXPECT_EQ(file.source_line(3), " s = '\xC3\xA9', 7");
  EXPECT_EQ(file.source_line(6), "/");
  EXPECT_EQ(file.source_line(7), "");
}

TEST(NamelistSyntax, GroupsRepeatAndKeepTheirOrder) {
  const nml::File file = parse("&body n=1/ &load n=2/ text\n$body n=3 n=4 $end");
  ASSERT_EQ(file.groups.size(), 3U);
  EXPECT_EQ(file.groups[0].name, "body");
  EXPECT_EQ(file.groups[1].name, "load");
  EXPECT_EQ(file.groups[2].name, "body");
  EXPECT_EQ(file.groups[2].assignments.size(), 2U);
}

TEST(NamelistSyntax, TextWithoutGroupsIsAccepted) {
  for (const char* none :
       {"", "\n", "! only &g a comment /", "a letter & some $ signs, x = 3\n/ b"}) {
    EXPECT_TRUE(parse(none).groups.empty()) << none;
  }
}

TEST(NamelistSyntax, ANumberForARealKeepsTheSignOfZero) {
  double real = 1;
  EXPECT_TRUE(nml::as_real(values("-0").front(), real));
  EXPECT_TRUE(real == 0 && std::signbit(real));
  EXPECT_TRUE(nml::as_real(values("7").front(), real));
  EXPECT_EQ(real, 7);
  EXPECT_FALSE(nml::as_real(values("'7'").front(), real));
  EXPECT_FALSE(nml::as_real(values("T").front(), real));
}

}  // namespace
