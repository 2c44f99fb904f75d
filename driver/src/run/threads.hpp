// How many threads a run uses, and a word if this machine has fewer cores for them.
#pragma once

#include "run/run.hpp"

namespace cleave::driver {

// --threads, else the deck's key. More threads than cores are allowed, since a run may move to another
// machine, but printed, unless quiet.
int threads_of(const Deck& deck, const RunOptions& options);

}  // namespace cleave::driver
