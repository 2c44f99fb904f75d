// The record of a bond that broke.
#pragma once

#include <cstdint>

#include "model/body.hpp"

namespace cleave {

// Of the bond between two particles, in the step being done; criterion, limit and released are left to the caller.
inline cleave_event bond_event(const Body& body, const Clock& clock, std::int64_t first,
                               std::int64_t second) {
  cleave_event e{};
  e.size = sizeof(cleave_event);
  e.step = clock.step;
  e.time = clock.time;
  e.first = first;
  e.second = second;
  for (int k = 0; k < 3; ++k)
    e.midpoint[k] = 0.5 * (body.point.X[kVector * first + k] + body.point.X[kVector * second + k]);
  return e;
}

}  // namespace cleave
