#include <gtest/gtest.h>

#include <fstream>

#include "decks.hpp"

namespace cleave::driver {
namespace {

using testing::complete;
using testing::parse;

TEST(ReadDeck, GivesValuesAndDefaults) {
  const Deck deck = parse(complete());
  EXPECT_EQ(deck.one("run").text("units"), "SI");
  EXPECT_EQ(deck.one("run").real("t_end"), 1e-4);
  EXPECT_EQ(deck.one("run").real("step_factor"), 0.9);
  EXPECT_TRUE(deck.one("run").given("t_end"));
  EXPECT_FALSE(deck.one("run").given("step_factor"));
  EXPECT_EQ(deck.one("run").integer("threads"), 1);
  EXPECT_TRUE(deck.one("history").logical("csv"));
  EXPECT_EQ(deck.one("body").reals("translate"), (std::vector<double>{0, 0, 0}));
  EXPECT_TRUE(deck.one("output").texts("fields").empty());
}

TEST(ReadDeck, MaterialHasThePropertiesOfItsLaw) {
  const DeckGroup material = parse(complete()).one("material");
  EXPECT_EQ(material.real("E"), 3.24e9);
  EXPECT_EQ(material.real("rho"), 1190);  // an integer where a real is wanted
  EXPECT_TRUE(material.key("nu").parameter);
  EXPECT_FALSE(material.key("law").parameter);
}

TEST(ReadDeck, AddsGroupsOfKindOnce) {
  const Deck deck = parse(complete());
  for (const char* group : {"run", "output", "history", "checkpoint"})
    EXPECT_EQ(deck.all(group).size(), 1u) << group;
  EXPECT_TRUE(deck.all("load").empty());
  EXPECT_TRUE(deck.all("fracture").empty());
  EXPECT_THROW(deck.one("load"), std::logic_error);
}

TEST(ReadDeck, KeepsRepeatedGroupsInOrder) {
  const Deck deck =
      parse(complete("&zone name='top', lower=0,1 /\n&load kind='gravity' /\n&zone name='b' /"));
  ASSERT_EQ(deck.all("zone").size(), 2u);
  EXPECT_EQ(deck.all("zone")[0]->text("name"), "top");
  EXPECT_EQ(deck.all("zone")[1]->text("name"), "b");
  EXPECT_EQ(deck.all("zone")[1]->place.line, 7);
}

TEST(ReadDeck, NamesOfGroupsAndKeysAreInAnyCase) {
  const Deck deck = parse("&RUN UNITS='SI', T_End=2 /\n" + std::string(testing::kMesh) +
                          testing::kBody + "&Material NAME='pmma' LAW='svk' e=1 NU=0 Rho=1 /");
  EXPECT_EQ(deck.one("run").real("t_end"), 2);
  EXPECT_EQ(deck.one("material").real("E"), 1);
}

TEST(ReadDeck, NullValuesKeepTheDefault) {
  const Deck deck = parse("&run units='SI', t_end=1, step_factor=, status_every= /\n" +
                          std::string(testing::kMesh) + testing::kBody + testing::kMaterial);
  EXPECT_EQ(deck.one("run").real("step_factor"), 0.9);
  EXPECT_FALSE(deck.one("run").given("step_factor"));
}

TEST(ReadDeck, TrailingBlanksOfTextsMeanNothing) {
  const Deck deck = parse(complete("&zone name = 'top   ', body='body ', shape='box ' /"));
  EXPECT_EQ(deck.one("zone").text("name"), "top");
  EXPECT_EQ(deck.one("zone").text("shape"), "box");
}

TEST(ReadDeck, TheRunIsCalledAfterTheDeck) {
  EXPECT_EQ(parse_deck(complete(), "some/where/branch.nml").one("run").text("name"), "branch");
}

TEST(ReadDeck, EmptyReferencesMeanAllBodies) {
  const Deck deck = parse(complete("&fracture Gf = 100, length = 1 /"));
  EXPECT_EQ(deck.one("fracture").text("body"), "");
  EXPECT_EQ(deck.one("fracture").real("Gf"), 100);
  EXPECT_TRUE(deck.one("fracture").key("Gf").parameter);
}

TEST(ReadDeck, LaterErrorsShowThePlaceOfTheKey) {
  const Deck deck = parse(complete("&zone name='top'\n  lower=0,1 /"));
  try {
    deck.fail(deck.one("zone"), "lower", "the set is empty");
    FAIL() << "fail() returned";
  } catch (const DeckError& error) {
    EXPECT_EQ(std::string(error.what()).find("case.nml:6:3: the set is empty"), 0u) << error.what();
  }
  try {
    deck.fail(deck.one("output"), "no such field");  // a group that is not in the file
    FAIL() << "fail() returned";
  } catch (const DeckError& error) {
    EXPECT_STREQ(error.what(), "case.nml: no such field");
  }
}

TEST(ReadDeck, AskingForAnUnknownKeyIsAProgrammingError) {
  const Deck deck = parse(complete());
  EXPECT_THROW(deck.one("run").real("t_start"), std::logic_error);
  EXPECT_THROW(deck.one("run").integer("t_end"), std::logic_error);
}

TEST(ReadDeck, ReadsFiles) {
  const std::string path = ::testing::TempDir() + "read_deck_test.nml";
  std::ofstream(path) << complete();
  EXPECT_EQ(read_deck(path).one("run").text("name"), "read_deck_test");
  EXPECT_THROW(read_deck(path + ".missing"), DeckError);
}

}  // namespace
}  // namespace cleave::driver
