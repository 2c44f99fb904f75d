// Quasi-static equilibrium: Newton's method with the consistent tangent on the gradient operator, for
// every formulation whose forces come from it alone. One call is one load increment; cutting it back is
// the caller's business, to whom a failed call gives the state before it.              [FEM equilibrium]
#pragma once

#include <cstdint>

#include "model/model.hpp"

namespace cleave {

struct StaticOptions {
  double tolerance = 1e-9;  // on the norm of the residual over that of all forces
  int max_iterations = 25;
};

struct StaticReport {
  std::int64_t iterations = 0;  // the largest of the bodies
  std::int64_t unknowns = 0;    // of all bodies
  double residual = 0;          // relative, the largest of the bodies
};

// From the present equilibrium to the one with the displacements of cleave_body_motion and the present
// external forces. On success the clock stands at time_new, velocities are zero. Throws NO_CONVERGENCE
// with the state as before; UNSUPPORTED for bodies with other forces than the operator's.
StaticReport solve_static(cleave_model& model, double time_new, const StaticOptions& options);

}  // namespace cleave
