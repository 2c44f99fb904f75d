// Plane conditions and what a law sees of its history.
#pragma once

#include <array>

#include "cleave/cleave.h"

namespace cleave {

using Kinematics = cleave_kinematics;

constexpr int dimension_of(Kinematics k) { return k == CLEAVE_3D ? 3 : 2; }

// Pointers to the history variables of one point, in the order of the law's kHistory. The same law
// serves separate fields (the model) and packed arrays (array calls).
inline constexpr int kMaxHistory = 8;
struct History {
  std::array<double*, kMaxHistory> variable{};
};

// What a law returns. stress_33: out-of-plane component of P in plane strain.
template <class M>
struct Response {
  M stress;
  double stress_33 = 0;
  double energy = 0;  // stored, per reference volume
  bool valid = true;
};

}  // namespace cleave
