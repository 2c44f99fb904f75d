// Names by which groups of a deck refer to each other: given once, and known where they are used.
#pragma once

#include "deck/deck.hpp"
#include "deck/mistakes.hpp"

namespace cleave::driver {

void check_names(const Deck& deck, Mistakes& mistakes);

// A parameter group (&fracture, &viscosity, ...) may apply to a body once.
void check_once_per_body(const Deck& deck, Mistakes& mistakes);

}  // namespace cleave::driver
