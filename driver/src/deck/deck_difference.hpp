// Where two decks that were read differ: value by value, defaults filled in, not text by text. Whether
// a difference matters is not decided here.
#pragma once

#include <string>
#include <vector>

#include "deck/deck.hpp"

namespace cleave::driver {

struct DeckDifference {
  const DeckGroup* before = nullptr;  // nullptr: the group is not in this deck
  const DeckGroup* after = nullptr;
  std::string key;    // empty: the whole group
  std::string group;  // "&load 'top'"
  std::string old_value, new_value;
};

// In the order of the key table. Materials, meshes and zones are compared by name, parameter groups by
// body, others in the order in which they stand: there it sets the order of sums and columns. Two paths
// to one file are the same.
std::vector<DeckDifference> differences(const Deck& before, const Deck& after);

// "&load 'top' value: 0 -> 0.02"
std::string difference_line(const DeckDifference& difference);

}  // namespace cleave::driver
