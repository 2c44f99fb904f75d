// `cleave restart --deck`: whether the run of a checkpoint may go on with another deck, and as which
// deck it goes on. restart_keys.def says what may change; the state always comes from the checkpoint.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "run/checkpoint.hpp"
#include "run/file_names.hpp"

namespace cleave::driver {

struct RestartDeck {
  Deck deck;
  std::vector<std::string> changes;  // "&run t_end: 30 -> 40", in the order of the key table
};

// Without another deck, or with one that differs in nothing: the deck of the checkpoint. Throws DeckError that
// names every key that differs and must not.
RestartDeck restart_deck(const CheckpointHeader& header, std::optional<Deck> other);

// Writes the deck that a run goes on with over NAME.resolved.nml, with the changes at its top; those of
// earlier restarts stay there. Nothing without changes. Throws io::Error.
void write_changes(const RestartDeck& restart, const FileNames& names, std::int64_t step);

}  // namespace cleave::driver
