#include <gtest/gtest.h>

#include "decks.hpp"

namespace cleave::driver {
namespace {

using testing::complete;
using testing::parse;

const char* const kRich =
    "&fracture Gf = 1d2, length = 1.6666666666666666e-4 /\n"
    "&viscosity beta = 0.1, form = 'central' /\n"
    "&zone name = 'it''s top', lower(2) = 1, lower(1) = -1, normal(2:3) = 0.1, 1e-300 /\n"
    "&load kind = 'velocity', directions = 'y', times = 0, 1e-5, 3d0, factors = 3*.5 /\n"
    "&output fields = 'velocity', 'damage' /\n"
    "&history csv = F, every_steps = 7 /\n";

// Values of one deck against the other's, without places and what was given.
void expect_same_values(const Deck& a, const Deck& b) {
  ASSERT_EQ(a.groups.size(), b.groups.size());
  for (std::size_t g = 0; g < a.groups.size(); ++g) {
    EXPECT_EQ(a.groups[g].name, b.groups[g].name);
    ASSERT_EQ(a.groups[g].keys.size(), b.groups[g].keys.size()) << a.groups[g].name;
    for (std::size_t k = 0; k < a.groups[g].keys.size(); ++k) {
      EXPECT_EQ(a.groups[g].keys[k].name, b.groups[g].keys[k].name);
      EXPECT_EQ(a.groups[g].keys[k].value, b.groups[g].keys[k].value)
          << a.groups[g].name << '.' << a.groups[g].keys[k].name;
    }
  }
}

TEST(ResolvedDeck, ReadsBackToTheSameValues) {
  const Deck deck = parse(complete(kRich));
  expect_same_values(parse_deck(deck.resolved(), "case.resolved.nml"), deck);
}

TEST(ResolvedDeck, IsAFixedPoint) {
  const std::string once = parse(complete(kRich)).resolved();
  EXPECT_EQ(parse(once).resolved(), once);
  EXPECT_NE(once.find("lower = -1.0, 1.0"), std::string::npos) << once;
  EXPECT_NE(once.find("step_factor = 0.9"), std::string::npos) << once;
}

TEST(ResolvedDeck, KeepsTheNameOfTheRun) {
  const Deck deck = parse(complete());
  EXPECT_EQ(parse_deck(deck.resolved(), "elsewhere/other.nml").one("run").text("name"), "case");
}

TEST(ResolvedDeck, PathsStayTrueInAnotherDirectory) {
  const Deck deck = parse_deck(complete(), "/decks/plate/case.nml");
  const auto file_in = [&](const char* directory) {
    return parse_deck(deck.resolved(directory), "r.nml").one("mesh").text("file");
  };
  EXPECT_EQ(file_in(""), "plate.msh");
  EXPECT_EQ(file_in("/decks/plate"), "plate.msh");
  EXPECT_EQ(file_in("/decks/plate/out"), "../plate.msh");
  EXPECT_EQ(file_in("/results"), "../decks/plate/plate.msh");
}

}  // namespace
}  // namespace cleave::driver
