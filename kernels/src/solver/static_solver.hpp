// Quasi-static equilibrium by Newton's method, for every formulation whose forces come from its gradient operator
// alone or that gives a stiffness itself; and bonds that break there, round by round. One call is one load
// increment, or one round; cutting increments back is the caller's business, to whom a failed call gives the state
// before it.                                                                          [FEM equilibrium]
#pragma once

#include <cstdint>

#include "model/model.hpp"

namespace cleave {

// Of the linear systems.
enum class Solver { direct, iterative };

struct StaticOptions {
  double tolerance = 1e-9;  // on the norm of the residual over that of all forces
  int max_iterations = 25;
  bool stop_at_limit = false;
  Breaking breaking = Breaking::all;
  Solver solver = Solver::direct;
  std::int64_t corrections = -1;  // broken bonds for one factor at most; -1: while it pays
};

struct StaticReport {
  std::int64_t iterations = 0;  // the largest of the bodies
  std::int64_t unknowns = 0;    // of all bodies
  double residual = 0;          // relative, the largest of the bodies
  double fraction = 1;          // below 1: of the way to where a first bond reaches its limit
  std::int64_t broken = 0;      // bonds
  bool changed = false;         // bonds broke or softened
  std::int64_t critical = 0;    // bonds that are beyond their limits now
};

// From the present equilibrium to the one with the displacements of cleave_body_motion and the present
// external forces. On success the clock stands at time_new, velocities are zero. With stop_at_limit and a bond
// that would be beyond its limit the state is as before. Throws NO_CONVERGENCE with the state as before;
// UNSUPPORTED for bodies that Newton's method cannot serve.
StaticReport solve_static(cleave_model& model, double time_new, const StaticOptions& options);

// Breaks bonds that are beyond their limits and finds the equilibrium under the loads as they are. Nothing
// happens where none is. Throws as above.                                               [ST breaking]
StaticReport break_static(cleave_model& model, const StaticOptions& options);

}  // namespace cleave
