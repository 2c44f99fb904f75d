// Which of the bonds that are beyond their limits break together.
#pragma once

#include <cmath>
#include <vector>

#include "model/formulation.hpp"

namespace cleave {

// Of the largest ratio: closer ones are equal but for rounding.
inline constexpr double kTie = 1e-9;

inline void keep_most_critical(std::vector<CriticalBond>& found, Breaking which) {
  if (which == Breaking::all || found.empty()) return;
  CriticalBond most = found.front();
  for (const CriticalBond& bond : found)
    if (bond.ratio > most.ratio) most = bond;
  if (which == Breaking::one) {
    found.assign(1, most);
  } else {
    std::erase_if(found,
                  [&](const CriticalBond& bond) { return bond.ratio < (1 - kTie) * most.ratio; });
  }
}

}  // namespace cleave
