// Whatever bytes come in, the answer is a file or an io::Error that points into it; never a crash,
// never much memory or time. Most telling with the sanitizers on.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <random>

#include "io/error.hpp"
#include "io/namelist.hpp"

namespace nml = cleave::io::namelist;

namespace {

// Reads `text`; true if it is accepted. Otherwise checks that the error points into the text.
bool survives(const std::string& text) {
  try {
    nml::to_json(nml::parse(text, "f"));
    return true;
  } catch (const cleave::io::Error& error) {
    const std::string message = error.what();
    int line = 0;
    int column = 0;
    EXPECT_EQ(std::sscanf(message.c_str(), "f:%d:%d: ", &line, &column), 2) << message;
    const auto lines = 1 + std::count(text.begin(), text.end(), '\n');
    EXPECT_TRUE(line >= 1 && line <= lines) << message;
    EXPECT_TRUE(column >= 1 && column <= static_cast<int>(text.size()) + 1) << message;
    return false;
  }
}

const std::string kDeck =
    "! a deck\n&run title = 'it''s', t_end=1.5d-3 v(2:3)=2*7,,\n 3*, 1.0+5 ! note\n"
    " a%b(1,::2)%c(2)(1:3) = \"x\ny\" z = (1, -2.5e3), inf nan(1) /\r\n"
    "text & more\n$body l = T, .false. t = f\n$end\n&load n=1;2\n/\n";

TEST(NamelistGarbage, RandomBytes) {
  std::mt19937 random(20240501);
  int accepted = 0;
  for (int n = 0; n < 2000; ++n) {
    std::string text(random() % 200, ' ');
    for (char& c : text) c = static_cast<char>(random() % 256);
    accepted += survives(text);
  }
  EXPECT_GT(accepted, 0);
  EXPECT_LT(accepted, 2000);
}

TEST(NamelistGarbage, RandomTokens) {
  const char* const tokens[] = {
      "&",  "$",  "&g ",  "/",    "\n",  " ",     ",",     ";",    "!",   "=",    "(",
      ")",  ":",  "%",    "'",    "\"",  "*",     "3*",    "t",    ".f.", "nan",  "nan(",
      "-",  "+",  ".",    "1",    "1.5", "e5",    "99999", "name", "inf", "&end", "\r\n",
      "\t", "\\", "\xC3", "\xA9", "x=",  "v(1)=", "2*(",   "0"};
  std::mt19937 random(20240502);
  int accepted = 0;
  for (int n = 0; n < 4000; ++n) {
    std::string text = "&g ";
    for (std::size_t k = random() % 30; k > 0; --k) text += tokens[random() % std::size(tokens)];
    accepted += survives(text + (random() % 2 == 0 ? " /" : ""));
  }
  EXPECT_GT(accepted, 0);
  EXPECT_LT(accepted, 4000);
}

TEST(NamelistGarbage, MutatedDecks) {
  ASSERT_TRUE(survives(kDeck));
  std::mt19937 random(20240503);
  int accepted = 0;
  for (int n = 0; n < 4000; ++n) {
    std::string text = kDeck;
    for (std::size_t k = 1 + random() % 4; k > 0; --k) {
      const std::size_t at = random() % text.size();
      switch (random() % 4) {
        case 0:
          text[at] = static_cast<char>(random() % 256);
          break;
        case 1:
          text.erase(at, 1 + random() % 5);
          break;
        case 2:
          text.insert(at, text.substr(random() % text.size(), random() % 8));
          break;
        default:
          std::swap(text[at], text[random() % text.size()]);
      }
      if (text.empty()) text = " ";
    }
    accepted += survives(text);
  }
  EXPECT_GT(accepted, 0);
  EXPECT_LT(accepted, 4000);
}

TEST(NamelistGarbage, EveryPrefixOfADeck) {
  for (std::size_t length = 0; length <= kDeck.size(); ++length) survives(kDeck.substr(0, length));
}

// Long runs of one thing: what would be quadratic or deeply nested shows as a time-out here.
TEST(NamelistGarbage, LongRuns) {
  const char* const pieces[] = {
      "(",   "a%",   "nan(", "t ", "t\n", ",!\n", "1,",   "&",  "$x ",        "'",
      "3*,", "a(1,", "\xA9", "x=", "!\n", "/",    "1*1 ", "- ", "1111111111", "\n"};
  for (const char* piece : pieces) {
    std::string text = "&g v = ";
    while (text.size() < 50000) text += piece;
    survives(text);
    survives(text + " /");
  }
}

TEST(NamelistGarbage, RepeatedLongTextsAreLimited) {
  const std::string text = "&g s = 100000*'" + std::string(100000, 'x') + "' /";
  EXPECT_FALSE(survives(text));
}

}  // namespace
