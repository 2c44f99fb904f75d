// One bad file per mistake: the place, and the words that say what to do.
#include <gtest/gtest.h>

#include <filesystem>
#include <string>

#include "io/error.hpp"
#include "io/namelist.hpp"

namespace nml = cleave::io::namelist;

namespace {

std::string message(const std::string& text) {
  try {
    nml::parse(text, "deck.nml");
  } catch (const cleave::io::Error& error) {
    return error.what();
  }
  return "accepted";
}

struct Mistake {
  const char* name;
  std::string text;
  const char* place;  // line:column
  std::vector<const char*> words;
};

void PrintTo(const Mistake& mistake, std::ostream* stream) { *stream << mistake.name; }

class NamelistMistake : public testing::TestWithParam<Mistake> {};

TEST_P(NamelistMistake, IsAnswered) {
  const Mistake& mistake = GetParam();
  const std::string text = message(mistake.text);
  EXPECT_EQ(text.find(std::string("deck.nml:") + mistake.place + ": "), 0U) << text;
  for (const char* word : mistake.words) {
    EXPECT_NE(text.find(word), std::string::npos) << "no \"" << word << "\" in\n" << text;
  }
  EXPECT_TRUE(text.ends_with("^")) << text;
}

const Mistake kMistakes[] = {
    {"unterminated_text", "&g\n s = 'abc\n/\n", "2:6", {"no closing '", "put one at its end"}},
    {"missing_quote_ends_at_next",
     "&g\n s = 'abc\n t = 'def'\n/\n",
     "2:6",
     {"goes on to line 3", "is its closing quote missing?"}},
    {"quote_inside_text", "&g s = 'it's' /", "1:12", {"blank or a comma is missing", "''"}},
    {"unterminated_group", "! x\n&g\n i = 1\n", "2:1", {"group g has no end", "put '/'"}},
    {"unterminated_empty_group", "&g", "1:1", {"group g has no end"}},
    {"next_group_begins",
     "&g\n i = 1\n&h\n j = 2\n/\n",
     "3:1",
     {"'&h' inside group g (begun in line 1)", "put '/'"}},
    {"misspelt_end", "&g i = 1 &en", "1:10", {"'&en' inside group g"}},
    {"slash_in_comment", "&g i = 1 ! /", "1:1", {"group g has no end"}},
    {"missing_equals", "&g\n  foo 1.5\n/", "2:3", {"'=' is missing after \"foo\"", "foo = value"}},
    {"missing_equals_at_end", "&g foo", "1:4", {"'=' is missing after \"foo\""}},
    {"missing_equals_subscript", "&g foo(2) 1.5 /", "1:4", {"'=' is missing after \"foo(2)\""}},
    {"missing_name", "&g = 1 /", "1:4", {"a key must stand here", "\"=\""}},
    {"name_with_digit", "&g 2d = 1 /", "1:4", {"keys begin with a letter"}},
    {"two_equals", "&g i == 1 /", "1:7", {"no value can begin with \"=\""}},
    {"unquoted_text", "&g units = SI /", "1:12", {"\"SI\" is neither", "'SI'"}},
    {"unquoted_path", "&g\n\tfile = mesh/plate.msh\n/", "2:9", {"'mesh/plate.msh'"}},
    {"unquoted_in_list", "&g v = 1, seven, 3 /", "1:11", {"\"seven\"", "'=' after the name"}},
    {"number_with_unit", "&g l = 1.5mm /", "1:8", {"\"1.5mm\" is not a number", "1.5e3"}},
    {"number_two_points", "&g l = 1.2.3 /", "1:8", {"\"1.2.3\" is not a number"}},
    {"number_sign_only", "&g l = - 3 /", "1:8", {"\"-\" is not a number"}},
    {"number_no_digits", "&g l = . /", "1:8", {"\".\" is not a number"}},
    {"number_open_exponent", "&g l = 1e+ /", "1:8", {"\"1e+\" is not a number"}},
    {"number_kind", "&g l = 1.0_8 /", "1:8", {"leave out a kind"}},
    {"number_then_name", "&g i = 1j = 2 /", "1:8", {"\"1j\" is not a number"}},
    {"number_joined_name", "&g i = 1j=2 /", "1:8", {"before the name of the next key"}},
    {"number_joined_end", "&g i = 1&end", "1:8", {"\"1&end\"", "put a blank before the end"}},
    {"number_hexadecimal", "&g i = 0x1F /", "1:8", {"\"0x1F\" is not a number"}},
    {"repeat_zero", "&g i = 2, 0*1 /", "1:11", {"repeat count 0"}},
    {"repeat_huge",
     "&g i = 1000000000*1 /",
     "1:8",
     {"repeat count too large", "is this count meant?"}},
    {"repeat_beyond_integers",
     "&g i = 99999999999999999999999*1 /",
     "1:8",
     {"repeat count too large"}},
    {"repeat_huge_null", "&g i = 1000000000*, 2 /", "1:8", {"repeat count too large"}},
    {"repeat_huge_in_sum", "&g i = 900000*1, 900000*1 /", "1:18", {"repeat count too large"}},
    {"repeat_twice", "&g i = 2*3*1 /", "1:10", {"\"3*1\" is not a number", "3*1.5"}},
    {"repeat_signed", "&g i = -2*1 /", "1:8", {"without sign"}},
    {"repeat_blank", "&g i = 2 *1 /", "1:10", {"no value can begin with \"*\""}},
    {"complex_open", "&g z = (1, 2 /", "1:14", {"')' is missing"}},
    {"complex_one_part", "&g z = (1) /", "1:10", {"',' is missing"}},
    {"complex_empty_part", "&g z = (1,) /", "1:8", {"empty part"}},
    {"complex_three_parts", "&g z = (1,2,3) /", "1:12", {"')' is missing"}},
    {"complex_text", "&g z = (a,2) /", "1:9", {"\"a\" is not a number"}},
    {"subscript_word", "&g v(n) = 1 /", "1:6", {"a subscript is missing"}},
    {"subscript_empty", "&g v() = 1 /", "1:6", {"a subscript is missing"}},
    {"subscript_open", "&g v(1 = 1 /", "1:8", {"with ')' at the end"}},
    {"subscript_real", "&g v(1.5) = 1 /", "1:7", {"whole numbers"}},
    {"subscript_huge", "&g v(99999999999999999999) = 1 /", "1:6", {"is no subscript"}},
    {"subscript_sign_only", "&g v(-) = 1 /", "1:6", {"is no subscript"}},
    {"stride_zero", "&g v(1:5:0) = 1 /", "1:10", {"a stride is a whole number other than 0"}},
    {"substring_single", "&g s(1)(2) = 'x' /", "1:8", {"one range of characters"}},
    {"component_missing", "&g a%=1 /", "1:6", {"must follow '%'"}},
    {"curly_quotes", "&g s = \xE2\x80\x9Ctext\xE2\x80\x9D /", "1:8", {"straight quotes"}},
    {"stray_ampersand", "&\ni = 1\n/", "1:1", {"write the name directly after '&'"}},
    {"ampersand_blank", "text\n  & g i = 1 /", "2:3", {"write the name directly after '&'"}},
    {"group_name_joined", "&g=1 /", "1:1", {"a blank or a line end after the name"}},
    {"stray_end", "i = 1\n&end", "2:1", {"this ends no group", "none has begun"}},
    {"second_end", "&g i = 1/2\n j = 3\n&end", "3:1", {"ended in line 1", "needs quotes"}},
    {"second_slash", "&g i = 1/2\n j = 3\n /", "3:2", {"ended in line 1", "needs quotes"}},
    {"nul_character", std::string("&g\n i\0 = 1 /", 11), "2:3", {"NUL character", "plain text"}},
    {"control_character", "&g i = 1\x01 /", "1:8", {"\"1?\" is not a number"}},
    {"other_character", "&g i = @ /", "1:8", {"no value can begin with \"@\""}},
    {"carriage_returns",
     "&g\r\n\ti = 1,\r\n\tj = x\r\n/\r\n",
     "3:6",
     {"\"x\" is neither", "\n   \tj = x\n   \t    ^"}},
};

INSTANTIATE_TEST_SUITE_P(Namelist, NamelistMistake, testing::ValuesIn(kMistakes),
                         [](const auto& instance) { return instance.param.name; });

TEST(NamelistErrors, ShapeOfAMessage) {
  EXPECT_EQ(message("&g\n\ta = 1,\tb = alpha ! \xC3\xA9\n/"),
            "deck.nml:2:13: \"alpha\" is neither a number nor a logical: put quotes around text, "
            "'alpha', or "
            "'=' after the name of a key\n"
            "   \ta = 1,\tb = alpha ! \xC3\xA9\n"
            "   \t      \t    ^");
}

TEST(NamelistErrors, CaretStandsUnderItsCharacterAfterUtf8) {
  const nml::File file = nml::parse("s '\xC3\xA9\xE2\x82\xAC' x", "deck.nml");
  EXPECT_EQ(nml::located(file, {1, 8}, "m"),
            "deck.nml:1:8: m\n   s '\xC3\xA9\xE2\x82\xAC' x\n          ^");
}

TEST(NamelistErrors, LongLinesAreCutAndBytesMadePrintable) {
  const std::string text = message("&g v = " + std::string(5000, '1') +
                                   "\x1B[31m\xFF, 2 = " + std::string(5000, '3') + " /");
  EXPECT_LT(text.size(), 600U);
  EXPECT_EQ(text.find('\x1B'), std::string::npos);
  EXPECT_EQ(text.find('\xFF'), std::string::npos);
  const std::string line = text.substr(text.find('\n') + 1);
  const std::string source = line.substr(0, line.find('\n'));
  const std::string pointer = line.substr(line.find('\n') + 1);
  EXPECT_LT(pointer.size(), source.size());

  const nml::File file =
      nml::parse(std::string(300, 'a') + "b" + std::string(300, 'c'), "deck.nml");
  const std::string cut = nml::located(file, {1, 301}, "m");
  const std::size_t second = cut.find('\n') + 1;
  const std::size_t third = cut.find('\n', second) + 1;
  EXPECT_EQ(cut[second + (cut.find('^') - third)], 'b') << cut;
}

TEST(NamelistErrors, PlaceBeyondTheTextIsShownAllTheSame) {
  const nml::File file = nml::parse("ab", "deck.nml");
  EXPECT_EQ(nml::located(file, {1, 5}, "m"), "deck.nml:1:5: m\n   ab\n       ^");
  EXPECT_EQ(nml::located(file, {9, 1}, "m"), "deck.nml:9:1: m\n   \n   ^");
  EXPECT_EQ(nml::located(file, {}, "m"), "deck.nml:0:0: m\n   \n   ^");
}

TEST(NamelistErrors, FilesThatCannotBeRead) {
  const auto complaint = [](const std::string& path) -> std::string {
    try {
      nml::read(path);
    } catch (const cleave::io::Error& error) {
      return error.what();
    }
    return "read";
  };
  EXPECT_NE(complaint("no/such/deck.nml").find("no/such/deck.nml: cannot be opened"),
            std::string::npos);
  const std::string folder = std::filesystem::temp_directory_path().string();
  EXPECT_NE(complaint(folder).find("this is a directory"), std::string::npos);
}

}  // namespace
