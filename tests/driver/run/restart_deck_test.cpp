// What a restart with another deck may change: every key of the tables is changed once.
#include "run/restart_deck.hpp"

#include <cmath>

#include "deck/key_table.hpp"
#include "deck/restart_keys.hpp"
#include "io/archive.hpp"
#include "support.hpp"

namespace cleave::driver::testing {
namespace {

namespace fs = std::filesystem;
using RestartDecks = RunDirectory;

// One of every group of keys.def; read, never run.
const std::string kEveryGroup =
    "&run units='other' name='case' t_end=10 /\n"
    "&mesh name='read' file='plate.msh' /\n"
    "&lattice type='square' spacing=1 size=4,3,0 /\n"
    "&points name='cloud' file='cloud.csv' /\n&notch lower=3,2 /\n"
    "&region set='left' material='unit' /\n"
    "&body name='plate' kinematics='plane_stress' material='unit' /\n"
    "&material name='unit' law='svk' E=1 nu=0.25 rho=1 /\n"
    "&material name='hard' law='svk' E=2 nu=0.25 rho=1 /\n"
    "&zone name='left' lower=0,0 upper=1,3 /\n&zone name='right' lower=3,0 upper=4,3 /\n&exempt "
    "set='left' /\n&precrack points=0,1,2,1 /\n"
    "&initial velocity=1,0,0 /\n&load kind='velocity' set='left' directions='x' value=1 /\n"
    "&wall normal=1,0,0 /\n&section name='cut' /\n&probe name='tip' field='velocity' point=1,1 /\n";

std::string with_parameter_groups() {
  std::string text = kEveryGroup;
  for (const GroupSpec& group : key_table().groups())
    if (group.parameter_group) text += "&" + group.name + " /\n";
  return text;
}

CheckpointHeader header_for(const Deck& deck) {
  CheckpointHeader header;
  header.deck_text = deck.source.text;
  header.deck_path = deck.source.path;
  header.resolved_deck = deck.resolved();
  header.step = 40;
  header.steps = 100;
  header.dt = 0.1;
  return header;
}

// Another value of the type, in the range as far as the range can say.
struct Changed {
  const KeySpec& spec;
  KeyValue operator()(double v) const { return std::isnan(v) || v == 0 ? 1e6 : 1.5 * v; }
  KeyValue operator()(std::int64_t v) const { return v + 1; }
  KeyValue operator()(bool v) const { return !v; }
  KeyValue operator()(const std::string& v) const {
    for (const std::string& choice : spec.allowed.choices)
      if (choice != v) return choice;
    return v + "other";
  }
  template <class T>
  KeyValue operator()(std::vector<T> values) const {
    if (values.empty()) return std::vector<T>(1);
    values.pop_back();
    return values;
  }
};

DeckKey& key_of(Deck& deck, const std::string& group, const std::string& key) {
  for (DeckGroup& g : deck.groups) {
    if (g.name != group) continue;
    for (DeckKey& k : g.keys)
      if (k.name == key) return k;
  }
  throw std::logic_error("no &" + group + " with " + key);
}

TEST(RestartDeck, EveryKeyIsAllowedOrRefusedByName) {
  const Deck deck = parse_deck(with_parameter_groups(), "case.nml");
  const CheckpointHeader header = header_for(deck);
  int refused = 0, allowed = 0;
  for (const GroupSpec& group : key_table().groups()) {
    ASSERT_FALSE(deck.all(group.name.c_str()).empty()) << group.name;
    const auto specs = key_specs(*deck.all(group.name.c_str()).front());
    for (const KeySpec* spec : specs) {
      const RestartRule rule = restart_rule(group.name, spec->name);
      if (rule == RestartRule::later) continue;  // below
      Deck other = deck;
      KeyValue& value = key_of(other, group.name, spec->name).value;
      value = std::visit(Changed{*spec}, value);
      const std::string name = group.name + "." + spec->name;
      std::size_t changes = 0;
      const std::string message =
          message_of<DeckError>([&] { changes = restart_deck(header, other).changes.size(); });
      if (rule == RestartRule::always) {
        EXPECT_EQ(message, "") << name;
        EXPECT_EQ(changes, 1u) << name;
        ++allowed;
        continue;
      }
      EXPECT_TRUE(has(message, "&" + group.name)) << name;
      if (!spec->allowed.names.empty() && group.name != "body" && group.name != "wall" &&
          group.name != "load" && group.name != "section" && group.name != "probe")
        continue;  // found by name: one is left out, one is new
      if (group.parameter_group && spec->name == "body") continue;
      EXPECT_TRUE(has(message, "key " + spec->name + ": the checkpoint has ")) << name;
      EXPECT_TRUE(has(message, "case.nml:")) << name;
      EXPECT_TRUE(has(message, "may change only run.title, ")) << name;
      ++refused;
    }
  }
  EXPECT_GT(refused, 90);
  EXPECT_GT(allowed, 12);
}

TEST(RestartDeck, TableNamesKeysOfDecks) {
  for (const RestartKey& entry : restart_keys()) {
    const GroupSpec* group = key_table().find(entry.group);
    ASSERT_NE(group, nullptr) << entry.group;
    EXPECT_TRUE(entry.key == "*" || group->find(entry.key) != nullptr) << entry.key;
  }
}

TEST(RestartDeck, WhatIsOnlyWrittenDifferentlyIsNoDifference) {
  const Deck deck = parse_deck(with_parameter_groups(), "case.nml");
  const CheckpointHeader header = header_for(deck);
  EXPECT_TRUE(restart_deck(header, parse_deck(deck.resolved(), "here.nml")).changes.empty());
  // another order, no name, a default written down, a comment
  std::string text = "! again\n" + with_parameter_groups();
  for (const std::string group : {"&zone name='right' lower=3,0 upper=4,3 /\n",
                                  "&material name='hard' law='svk' E=2 nu=0.25 rho=1 /\n"}) {
    ASSERT_NE(text.find(group), std::string::npos);
    text.erase(text.find(group), group.size());
    text = group + text;
  }
  text += "&checkpoint keep=2 /\n";
  text.replace(text.find("name='case'"), 11, "directory='.'");
  const RestartDeck same = restart_deck(header, parse_deck(text, "there.nml"));
  EXPECT_TRUE(same.changes.empty());
  EXPECT_EQ(same.deck.source.text, deck.source.text);
  EXPECT_EQ(same.deck.source.path, "case.nml");
}

TEST(RestartDeck, GroupsAreNeitherAddedNorDropped) {
  const Deck deck = parse_deck(with_parameter_groups(), "case.nml");
  const CheckpointHeader header = header_for(deck);
  const auto message = [&](const std::string& text) {
    return message_of<DeckError>([&] { restart_deck(header, parse_deck(text, "new.nml")); });
  };
  const std::string probe = "&probe name='more' field='velocity' point=2,2 /\n";
  EXPECT_TRUE(has(message(with_parameter_groups() + probe),
                  "&probe 'more', is not in the deck of the checkpoint; a restart adds no groups, "
                  "because the history keeps its columns"));
  std::string without = with_parameter_groups();
  without.erase(without.find("&precrack"), without.find("&initial") - without.find("&precrack"));
  EXPECT_TRUE(has(message(without), "new.nml: &precrack, of the checkpoint's deck is left out"));
}

TEST(RestartDeck, EndAndSwitchesHaveADirection) {
  const std::string text = kEveryGroup + "&history csv=.false. /\n";
  const Deck deck = parse_deck(text, "case.nml");
  const CheckpointHeader header = header_for(deck);
  Deck other = deck;
  key_of(other, "history", "csv").value = true;
  EXPECT_EQ(restart_deck(header, other).changes,
            std::vector<std::string>{"&history csv: .false. -> .true."});
  EXPECT_TRUE(has(message_of<DeckError>([&] { restart_deck(header_for(other), deck); }),
                  "it can be switched on at a restart, not off"));
  other = deck;
  key_of(other, "run", "t_end").value = 4.0;  // the time of the checkpoint
  EXPECT_TRUE(has(message_of<DeckError>([&] { restart_deck(header, other); }),
                  "the run is at time 4 (step 40) in this checkpoint; give a later t_end"));
}

// Defaults may differ in the version that continues: the values of the run count.
TEST(RestartDeck, ValuesOfTheCheckpointAreThoseOfItsResolvedDeck) {
  const Deck deck = parse_deck(kEveryGroup, "case.nml");
  CheckpointHeader header = header_for(deck);
  const std::string factor = "step_factor = 0.9";
  header.resolved_deck.replace(header.resolved_deck.find(factor), factor.size(),
                               "step_factor = 0.5");
  EXPECT_EQ(deck_of(header).one("run").real("step_factor"), 0.5);
  EXPECT_TRUE(has(message_of<DeckError>([&] { restart_deck(header, deck); }),
                  "&run, key step_factor: the checkpoint has 0.5, this deck 0.9"));
}

// ---- runs --------------------------------------------------------------------------------------

const std::string kRun = "t_end=10 time_step=0.5";
const std::string kPlate =
    std::string(kUnitPlate) + kUnitMaterial +
    "&load name='late' kind='force' set='xmax' directions='x' value=0.1 curve='linear' ramp=2 "
    "begin=100 /\n"
    "&load name='table' kind='force' set='xmax' directions='y' value=0.1 curve='table' begin=100 "
    "times=0,2,3 factors=0,1,2 /\n"
    "&history every_steps=1 csv=.false. /\n&output every_steps=5 /\n&checkpoint every_steps=10 /\n";
const char* const kFiles[] = {"case.exo", "case.history.nc", "case.events.nc",
                              "case.20.checkpoint.nc"};

// The run as it was when it was killed after the checkpoint of step 10.
void cut(const fs::path& whole, const fs::path& to) {
  fs::remove_all(to);
  fs::copy(whole, to);
  fs::remove(to / "case.20.checkpoint.nc");
}

TEST_F(RestartDecks, EveryAllowedKeyContinuesAndFinishes) {
  ASSERT_EQ(run(kRun, kPlate, "whole"), 0);
  const Deck deck = RestartDecks::deck(kRun, kPlate, "whole");
  int tried = 0;
  for (const GroupSpec& group : key_table().groups()) {
    for (const KeySpec& spec : group.keys) {
      if (restart_rule(group.name, spec.name) == RestartRule::never) continue;
      Deck other = deck;
      const bool list = spec.name == "times" || spec.name == "factors";
      const auto last = std::find_if(other.groups.rbegin(), other.groups.rend(),
                                     [&](const DeckGroup& g) { return g.name == group.name; });
      KeyValue& value = list ? std::find_if(last->keys.begin(), last->keys.end(),
                                            [&](const DeckKey& k) { return k.name == spec.name; })
                                   ->value
                             : key_of(other, group.name, spec.name).value;
      if (list) {
        std::get<std::vector<double>>(value).back() += 1;
      } else if (spec.name == "curve") {
        value = std::string("smooth");
      } else {
        value = std::visit(Changed{spec}, value);
      }
      cut(path("whole"), path("cut"));
      std::ofstream(path("cut/new.nml")) << other.resolved();
      SCOPED_TRACE(group.name + "." + spec.name);
      EXPECT_EQ(restart_run(path("cut"), path("cut/new.nml"), quiet), 0);
      EXPECT_TRUE(has(file_bytes(path("cut/case.resolved.nml")),
                      "! Restarted after step 10: &" + group.name));
      ++tried;
    }
  }
  EXPECT_GE(tried, 20);
}

TEST_F(RestartDecks, UnchangedDeckGivesTheSameBytes) {
  ASSERT_EQ(run(kRun, kPlate, "whole"), 0);
  std::ofstream(path("again.nml")) << deck(kRun, kPlate, "whole").resolved();
  cut(path("whole"), path("cut"));
  EXPECT_EQ(restart_run(path("cut"), path("again.nml"), quiet), 0);
  for (const char* file : kFiles)
    EXPECT_EQ(file_bytes(path("cut") + "/" + file), file_bytes(path("whole") + "/" + file)) << file;
  EXPECT_FALSE(has(file_bytes(path("cut/case.resolved.nml")), "! Restarted"));  // it did not change
}

// A run that is told later to go on longer is the run that was told so at once.
TEST_F(RestartDecks, LaterEndKeepsTheGridOfTimes) {
  ASSERT_EQ(run("t_end=10 time_step=0.5", kPlate, "short"), 0);
  ASSERT_EQ(run("t_end=15 time_step=0.5", kPlate, "long"), 0);
  std::ofstream(path("long.nml")) << deck("t_end=15 time_step=0.5", kPlate, "long").resolved();
  EXPECT_EQ(restart_run(path("short"), path("long.nml"), quiet), 0);
  for (const char* file : {"case.exo", "case.history.nc", "case.events.nc"})
    EXPECT_EQ(file_bytes(path("short") + "/" + file), file_bytes(path("long") + "/" + file))
        << file;
  // the same deck again, and none: the run is done
  EXPECT_EQ(restart_run(path("short"), path("long.nml"), quiet), 0);
  EXPECT_EQ(restart_run(path("short"), "", quiet), 0);
}

// Masses are of the set-up: they are not made again, whether a deck is given or not.
TEST_F(RestartDecks, SetUpFieldsComeFromTheCheckpoint) {
  ASSERT_EQ(run(kRun, kPlate + "&initial velocity=1,0,0 /\n", "whole"), 0);
  cut(path("whole"), path("with"));
  cut(path("whole"), path("without"));
  io::Archive archive = io::read_archive(path("with/case.10.checkpoint.nc"));
  for (io::NamedArray& array : archive.arrays)
    if (array.name == "plate/mass")
      for (double& mass : std::get<std::vector<double>>(array.data)) mass *= 2;
  for (const char* folder : {"with", "without"})
    io::write_archive(path(folder) + "/case.10.checkpoint.nc", archive);
  Deck other = deck(kRun, kPlate + "&initial velocity=1,0,0 /\n", "whole");
  key_of(other, "run", "threads").value = std::int64_t{2};
  std::ofstream(path("new.nml")) << other.resolved();
  ASSERT_EQ(restart_run(path("with"), path("new.nml"), quiet), 0);
  ASSERT_EQ(restart_run(path("without"), "", quiet), 0);
  EXPECT_EQ(file_bytes(path("with/case.history.nc")), file_bytes(path("without/case.history.nc")));
  EXPECT_NE(file_bytes(path("with/case.history.nc")), file_bytes(path("whole/case.history.nc")));
}

TEST_F(RestartDecks, OtherFormatsAreRefusedWithTheirVersion) {
  ASSERT_EQ(run(kRun, kPlate), 0);
  const std::string file = path("case.20.checkpoint.nc");
  for (const std::int64_t format : {1, 99}) {
    io::Archive archive = io::read_archive(file);
    for (io::Attribute& attribute : archive.attributes) {
      if (attribute.first == "format") attribute.second = format;
      if (attribute.first == "cleave_version") attribute.second = std::string("0.0.7");
    }
    io::write_archive(file, archive);
    const std::string message = message_of<DeckError>([&] { restart_run(file, "", quiet); });
    EXPECT_TRUE(has(message, "it has checkpoint format " + std::to_string(format) +
                                 ", written by cleave 0.0.7"));
    EXPECT_TRUE(has(message, "Continue it with cleave 0.0.7, or start the run again"));
  }
}

}  // namespace
}  // namespace cleave::driver::testing
