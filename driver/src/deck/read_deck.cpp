// Deck text -> Deck: finds the groups in the key table, fills in the missing ones, checks names.
#include <filesystem>
#include <map>

#include "deck/deck.hpp"
#include "deck/deck_references.hpp"
#include "deck/group_reader.hpp"
#include "deck/key_table.hpp"
#include "deck/mistakes.hpp"
#include "deck/nearest_name.hpp"
#include "io/error.hpp"

namespace cleave::driver {
namespace {

namespace namelist = io::namelist;

void report_unknown_group(const namelist::Group& group, Mistakes& mistakes) {
  const std::vector<std::string> known = key_table().group_names();
  mistakes.add(group.place, "group &" + group.name + " is unknown" +
                                did_you_mean(group.name, known, "&", "") +
                                " Known groups: " + listed(known, "&") + ".");
}

void read_groups(Deck& deck, Mistakes& mistakes) {
  std::map<std::string, int> first_line;
  for (const namelist::Group& group : deck.source.groups) {
    const GroupSpec* spec = key_table().find(group.name);
    if (!spec) {
      report_unknown_group(group, mistakes);
      continue;
    }
    const auto [first, is_new] = first_line.emplace(spec->name, group.place.line);
    if (spec->once && !is_new)
      mistakes.add(group.place, "group &" + spec->name +
                                    " may stand in a deck once; the first is on line " +
                                    std::to_string(first->second) + ". Put its keys there.");
    deck.groups.push_back(read_group(group, *spec, mistakes));
  }
}

void add_missing_groups(Deck& deck, Mistakes& mistakes) {
  for (const GroupSpec& spec : key_table().groups()) {
    if (!deck.all(spec.name.c_str()).empty()) continue;
    if (spec.once)
      deck.groups.push_back(default_group(spec, mistakes));
    else if (spec.required)
      mistakes.add_missing("the deck has no &" + spec.name + ": " + spec.description +
                           ". At least one is wanted.");
  }
}

// The default of run.name: files are called after the deck.
void name_run_after_deck(Deck& deck) {
  for (DeckGroup& group : deck.groups)
    for (DeckKey& key : group.keys)
      if (group.name == "run" && key.name == "name" && key.value == KeyValue(std::string()))
        key.value = std::filesystem::path(deck.source.path).stem().string();
}

Deck interpret(namelist::File file) {
  Deck deck;
  deck.source = std::move(file);
  Mistakes mistakes(deck);
  read_groups(deck, mistakes);
  add_missing_groups(deck, mistakes);
  check_names(deck, mistakes);
  check_once_per_body(deck, mistakes);
  mistakes.throw_if_any();
  name_run_after_deck(deck);
  return deck;
}

}  // namespace

Deck parse_deck(std::string text, const std::string& path) {
  try {
    return interpret(namelist::parse(std::move(text), path));
  } catch (const io::Error& error) {
    throw DeckError(error.what());
  }
}

Deck read_deck(const std::string& path) {
  try {
    return interpret(namelist::read(path));
  } catch (const io::Error& error) {
    throw DeckError(error.what());
  }
}

}  // namespace cleave::driver
