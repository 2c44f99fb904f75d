// Which of the bonds that are beyond their limits break together.
#pragma once

#include <algorithm>
#include <vector>

#include "model/formulation.hpp"

namespace cleave {

// Of the largest ratio: closer ones are equal but for rounding.
inline constexpr double kTie = 1e-9;

inline void keep_most_critical(std::vector<CriticalBond>& found, Breaking which) {
  if (which == Breaking::all || found.empty()) return;
  const auto largest = std::max_element(
      found.begin(), found.end(), [](const auto& a, const auto& b) { return a.ratio < b.ratio; });
  const double least = (1 - kTie) * largest->ratio;
  std::erase_if(found, [&](const CriticalBond& bond) { return bond.ratio < least; });
  if (which == Breaking::ties) return;
  // Of equals the lowest number: rounding does not choose.
  const auto first = std::min_element(found.begin(), found.end(),
                                      [](const auto& a, const auto& b) { return a.bond < b.bond; });
  found.assign(1, CriticalBond{*first});
}

}  // namespace cleave
