// Plane conditions, and what a law is given and gives: its history, the increment, the response.
#pragma once

#include <array>

#include "cleave/cleave.h"

namespace cleave {

using Kinematics = cleave_kinematics;

constexpr int dimension_of(Kinematics k) { return k == CLEAVE_3D ? 3 : 2; }

// Pointers to the history variables of one point, in the order of the law's kHistory. The same law
// serves separate fields (the model) and packed arrays (array calls).
inline constexpr int kMaxHistory = 12;
struct History {
  std::array<double*, kMaxHistory> variable{};
};

// What a law is told of the update besides the deformation.
struct Increment {
  double dt = 0;  // [s] size of the step; 0 in statics and at the first evaluation: no rates
  double length =
      0;  // [m] size of the particle in the reference configuration, for shock viscosity
};

// What a law returns. stress_33: out-of-plane component of P in plane strain. `plastic` and `viscous`
// are what this update dissipated by plastic flow and by the law's own viscosity.
template <class M>
struct Response {
  M stress;
  double stress_33 = 0;
  double energy = 0;   // stored, per reference volume [J m-3]
  double plastic = 0;  // [J m-3]
  double viscous = 0;  // [J m-3]
  bool valid = true;
};

}  // namespace cleave
