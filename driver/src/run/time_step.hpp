// The constant time step of a run and the number of steps.
#pragma once

#include <string>
#include <vector>

#include "run/schedule.hpp"
#include "scene/scene.hpp"

namespace cleave::driver {

struct TimeStep {
  Clock clock;
  double stable = 0;        // largest step that the kernels call stable [s]
  std::string governed_by;  // the body with the smallest bond length over wave speed
  std::vector<std::string> warnings;
};

// time_step given: used as it is, ceil(t_end/dt) steps (the last may pass t_end by less than a
// step). Automatic: step_factor * stable, reduced so that a whole number of steps ends at t_end.
// Statics: the load increments.
// A step above the stable one is refused, or warned of, as step_check says. Throws DeckError.
TimeStep choose_time_step(const Scene& scene);

// For a run that goes on with the step it had: the number of steps to t_end.
std::int64_t steps_to_end(double t_end, double dt);

}  // namespace cleave::driver
