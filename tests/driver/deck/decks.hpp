// Deck texts that the tests of the deck share.
#pragma once

#include <string>

#include "deck/deck.hpp"

namespace cleave::driver::testing {

inline const char* const kRun = "&run units = 'SI', t_end = 1e-4 /\n";
inline const char* const kMesh = "&mesh file = 'plate.msh' /\n";
inline const char* const kBody = "&body kinematics = 'plane_stress', material = 'pmma' /\n";
inline const char* const kMaterial =
    "&material name = 'pmma', law = 'svk', E = 3.24e9, nu = 0.35, rho = 1190 /\n";

// A complete deck with `more` behind it; the text begins on line 5.
inline std::string complete(const std::string& more = "") {
  return std::string(kRun) + kMesh + kBody + kMaterial + more;
}

inline Deck parse(const std::string& text) { return parse_deck(text, "case.nml"); }

// What is said about a deck; empty if it is accepted.
inline std::string message_of(const std::string& text) {
  try {
    parse(text);
  } catch (const DeckError& error) {
    return error.what();
  }
  return {};
}

}  // namespace cleave::driver::testing
