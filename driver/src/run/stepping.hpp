// How the model gets from one step to the next: explicit steps, divided where the deformation asks for
// it, or static load increments, cut back where they do not converge. A step always ends at its own
// time, so schedules and restarts know nothing of this.
#pragma once

#include <cstdint>
#include <functional>

#include "run/schedule.hpp"
#include "scene/scene.hpp"

namespace cleave::driver {

// What a static increment took, over the parts that it was cut into.
struct StepReport {
  bool finished = true;  // false: whoever watches has stopped it
  std::int64_t iterations = 0;
  std::int64_t rounds = 0, broken = 0;  // how often bonds broke, and how many
  double residual = 0;                  // relative, the largest of the parts
};

// Who is told what happens within an increment, and may stop it by answering false.
struct StepWatch {
  // Several times a second while an increment relaxes.
  std::function<bool(const StepReport& so_far)> relaxing;
  // Newton's method: an equilibrium in which a bond fails, or after one has; the run can go on from there.
  std::function<bool(double time, const StepReport& so_far)> event;
};

class Stepping {
 public:
  // Throws DeckError: groups that have no meaning in this mode.
  explicit Stepping(const Deck& deck);

  bool is_static() const { return static_; }
  bool relaxes() const { return static_ && relaxes_; }
  // Puts initial velocities, prescribed values and forces at time 0 and initialises the model.
  void start(Scene& scene, double dt) const;
  // From step to step + 1. Throws KernelError.
  StepReport step(Scene& scene, const Clock& clock, std::int64_t step,
                  const StepWatch& watch = {}) const;

 private:
  static void refuse_dynamics(const Deck& deck);
  void explicit_step(Scene& scene, const Clock& clock, std::int64_t step) const;
  void put_loads(Scene& scene, double time) const;
  StepReport relax_increment(Scene& scene, double from, double to, const StepWatch& watch) const;
  StepReport solve_increment(Scene& scene, double from, double to, const StepWatch& watch) const;
  cleave_static_options static_options() const;
  // The status of the kernels; adds to the report.
  std::int32_t relax(Model& model, double time, const StepWatch& watch, StepReport& report) const;

  bool static_, adapt_, relaxes_, by_events_;
  std::int32_t breaking_, solver_;
  double tolerance_;
  std::int64_t max_iterations_, cut_backs_;
  std::int32_t corrections_;
};

}  // namespace cleave::driver
