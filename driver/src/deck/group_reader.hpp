// One group of a deck: assignments as written -> values of all its keys, checked against the table.
#pragma once

#include "deck/deck.hpp"
#include "deck/key_table.hpp"
#include "deck/mistakes.hpp"

namespace cleave::driver {

// Keys with a mistake keep their default (or an empty value if they are required).
DeckGroup read_group(const io::namelist::Group& group, const GroupSpec& spec, Mistakes& mistakes);

// A group that is not in the deck; required keys are a mistake.
DeckGroup default_group(const GroupSpec& spec, Mistakes& mistakes);

}  // namespace cleave::driver
