// A deck after checking: every group with every key's value, given or default, and where it stands.
//
// Group and key names, types, ranges and defaults come from the key table (key_table.hpp); asking
// for a key that is not in the table, or as another type, is a programming error.
#pragma once

#include <cstdint>
#include <stdexcept>
#include <string>
#include <variant>
#include <vector>

#include "io/namelist.hpp"

namespace cleave::driver {

// Bad input: exit code 2.
struct DeckError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

using KeyValue = std::variant<double, std::int64_t, bool, std::string, std::vector<double>,
                              std::vector<std::string>>;

struct DeckKey {
  std::string name;
  KeyValue value;
  bool given = false;           // false: the default
  bool parameter = false;       // of a law or parameter group: handed to the kernels by its name
  io::namelist::Place place{};  // of the key if given, else of the group
};

class DeckGroup {
 public:
  std::string name;
  io::namelist::Place place;
  std::vector<DeckKey> keys;  // all keys of the group in table order

  double real(const char* key) const;
  std::int64_t integer(const char* key) const;
  bool logical(const char* key) const;
  const std::string& text(const char* key) const;  // text and choice
  const std::vector<double>& reals(const char* key) const;
  const std::vector<std::string>& texts(const char* key) const;
  bool given(const char* key) const;
  const DeckKey& key(const char* key) const;
};

class Deck {
 public:
  io::namelist::File source;
  std::vector<DeckGroup>
      groups;  // as in the file; groups of kind "once" that are missing are added with defaults

  const DeckGroup& one(const char* group) const;
  std::vector<const DeckGroup*> all(const char* group) const;

  // The set that it names; empty in a deck that has none yet.
  std::string units() const;
  // A message with its units, in brackets, those of the deck.
  std::string in_units(const std::string& message) const;

  // "deck.nml:14:3: message" with the line shown; for errors found after reading.
  [[noreturn]] void fail(const DeckGroup& group, const char* key, const std::string& message) const;
  [[noreturn]] void fail(const DeckGroup& group, const std::string& message) const;

  // Namelist text with every key, that reproduces the run. It is to be kept in `directory`: paths
  // relative to this deck are rewritten to start there; empty: beside the deck, they stay as they
  // are.
  std::string resolved(const std::string& directory = "") const;
};

// Throws DeckError with place, what is allowed and the nearest known name; several mistakes are
// reported together. `path` is where the text comes from: for messages, the default of the run's
// name, and paths relative to the deck.
Deck read_deck(const std::string& path);
Deck parse_deck(std::string text, const std::string& path);

}  // namespace cleave::driver
