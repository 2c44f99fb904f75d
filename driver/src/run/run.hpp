// What the command line asks of a deck: run it, check it, continue it from a checkpoint.
//
// Every function returns the exit code of the program: 0 done, 3 stopped on request with a
// checkpoint written. They throw DeckError or io::Error for bad input (2) and RunError for a failed
// run (1).
#pragma once

#include <optional>
#include <stdexcept>
#include <string>

#include "deck/deck.hpp"

namespace cleave::driver {

// The run failed after its input was accepted: not finite, disk full.
struct RunError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

struct RunOptions {
  int threads = 0;  // 0: as the deck says
  bool quiet = false;
  // Seconds, 0: none; instead of what the deck says.
  std::optional<double> wall_limit = {};
};

int run_deck(const Deck& deck, const RunOptions& options);
int check_deck(const Deck& deck, const RunOptions& options);
// An empty deck path: the deck is taken from the checkpoint.
int restart_run(const std::string& checkpoint_or_directory, const std::string& deck_path,
                const RunOptions& options);

}  // namespace cleave::driver
