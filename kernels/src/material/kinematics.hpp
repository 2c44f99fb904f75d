// Plane conditions, and what a law answers.
#pragma once

#include "cleave/cleave.h"
#include "material/stress_arrays.hpp"

namespace cleave {

using Kinematics = cleave_kinematics;

constexpr int dimension_of(Kinematics k) { return k == CLEAVE_3D ? 3 : 2; }

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
