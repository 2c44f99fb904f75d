// What a key allows: range of a number, choices, number of entries, names.
#pragma once

#include <cstdint>
#include <limits>
#include <string>
#include <string_view>
#include <vector>

namespace cleave::driver {

enum class KeyType { real, integer, logical, text, choice, reals, texts };

// "real number", "list of texts", ...: as messages and manuals call it.
const char* type_text(KeyType type);
bool is_list(KeyType type);

struct Allowed {
  double minimum = -std::numeric_limits<double>::infinity();
  double maximum = std::numeric_limits<double>::infinity();
  bool minimum_excluded = false, maximum_excluded = false;
  std::vector<std::string> choices;
  std::vector<std::int64_t> counts;  // allowed numbers of entries of a list; empty: any
  std::string names;                 // the key gives a name of this kind
  std::string refers;                // the key holds a name of this kind
  bool is_file = false;              // a path relative to the deck

  bool contains(double value) const;
  // A list may have no more entries than this; 0: no limit.
  std::int64_t largest_count() const { return counts.empty() ? 0 : counts.back(); }
};

// From the range column of keys.def, without the choices that come from a table ("@materials").
// Throws std::logic_error: the table is part of the program.
Allowed parse_allowed(KeyType type, std::string_view range);

// "> 0", "> -1 and < 0.5", "'a', 'b', 'c'", "2 or 3 entries"; empty if anything is allowed.
std::string allowed_text(const Allowed& allowed);

// Parts of "a|b|c"; none if the text is empty.
std::vector<std::string> split(std::string_view text, char separator);

}  // namespace cleave::driver
