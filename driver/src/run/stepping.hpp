// How the model gets from one step to the next: explicit steps, divided where the deformation asks for
// it, or static load increments, cut back where they do not converge. A step always ends at its own
// time, so schedules and restarts know nothing of this.
#pragma once

#include <cstdint>

#include "run/schedule.hpp"
#include "scene/scene.hpp"

namespace cleave::driver {

class Stepping {
 public:
  // Throws DeckError: groups that have no meaning in this mode.
  explicit Stepping(const Deck& deck);

  bool is_static() const { return static_; }
  // Puts initial velocities, prescribed values and forces at time 0 and initialises the model.
  void start(Scene& scene, double dt) const;
  // From step to step + 1. Throws KernelError.
  void step(Scene& scene, const Clock& clock, std::int64_t step) const;

 private:
  static void refuse_dynamics(const Deck& deck);
  void explicit_step(Scene& scene, const Clock& clock, std::int64_t step) const;
  void load_increment(Scene& scene, double from, double to) const;

  bool static_, adapt_;
  double tolerance_;
  std::int64_t max_iterations_, cut_backs_;
};

}  // namespace cleave::driver
