#include "run/stepping.hpp"

#include <algorithm>
#include <chrono>

#include "scene/format.hpp"

namespace cleave::driver {
namespace {

// How many iterations of the relaxation take a fifth of a second: a result does not depend on it.
class Slice {
 public:
  std::int64_t iterations() const { return iterations_; }
  void took(double seconds) {
    const double fits = static_cast<double>(iterations_) * 0.2 / std::max(seconds, 1e-6);
    iterations_ =
        static_cast<std::int64_t>(std::clamp(fits, 1.0, 4.0 * static_cast<double>(iterations_)));
  }

 private:
  std::int64_t iterations_ = 4;
};

}  // namespace

Stepping::Stepping(const Deck& deck)
    : static_(deck.one("run").text("mode") == "static"),
      adapt_(deck.one("run").logical("adapt") && deck.one("run").real("time_step") == 0),
      relaxes_(deck.one("static").text("method") == "relaxation"),
      one_bond_(deck.one("static").text("breaking") == "one"),
      tolerance_(deck.one("static").real("tolerance")),
      max_iterations_(deck.one("static").integer("max_iterations")),
      cut_backs_(deck.one("static").integer("cut_backs")) {
  if (static_) refuse_dynamics(deck);
}

// What statics would leave out without a word.
void Stepping::refuse_dynamics(const Deck& deck) {
  for (const DeckGroup* wall : deck.all("wall"))
    deck.fail(*wall, "a wall needs inertia to push against; use mode = 'dynamic'");
  for (const DeckGroup* initial : deck.all("initial"))
    deck.fail(*initial, "there are no velocities in statics; remove it or use mode = 'dynamic'");
  for (const DeckGroup* load : deck.all("load")) {
    if (load->text("prescription") == "paper") {
      deck.fail(*load, "prescription",
                "statics prescribes displacements, not accelerations; use prescription = 'exact'");
    }
  }
}

void Stepping::start(Scene& scene, double dt) const {
  if (static_) {
    scene.motions().start_at_rest(scene.model());
    scene.forces().apply(scene.model(), 0.0);
    check(cleave_model_initialise(scene.model().handle(), 0.0));
    return;
  }
  scene.put_initial_velocities();
  scene.motions().start(scene.model(), dt);
  scene.forces().apply(scene.model(), 0.0);
  check(cleave_model_initialise(scene.model().handle(), 0.0));
}

StepReport Stepping::step(Scene& scene, const Clock& clock, std::int64_t step,
                          const StepWatch& watch) const {
  if (static_) return load_increment(scene, clock.time(step), clock.time(step + 1), watch);
  explicit_step(scene, clock, step);
  return {};
}

// The parts are a power of two and follow from the state at the start of the step alone, so that a
// restart divides as the uninterrupted run does.
void Stepping::explicit_step(Scene& scene, const Clock& clock, std::int64_t step) const {
  constexpr std::int64_t kMostParts = 1024;
  Model& model = scene.model();
  std::int64_t parts = 1;
  if (adapt_) {
    while (parts < kMostParts && !scene.is_stable(clock.dt / static_cast<double>(parts)))
      parts *= 2;
  }
  const double dt = clock.dt / static_cast<double>(parts);
  for (std::int64_t part = 1; part <= parts; ++part) {
    const auto time = [&](std::int64_t k) {
      return k == parts ? clock.time(step + 1) : clock.time(step) + static_cast<double>(k) * dt;
    };
    // After the last part the next step's size is not known yet; it is taken to be this one.
    const double after = parts == 1 ? clock.time(step + 2) : time(part) + dt;
    scene.motions().before_advance(model, time(part));
    check(cleave_model_advance(model.handle(), dt, time(part)));
    scene.forces().apply(model, time(part));
    scene.motions().before_update(model, time(part - 1), time(part), after, dt);
    check(cleave_model_update(model.handle()));
  }
}

std::int32_t Stepping::solve(Model& model, double time, StepReport& report) const {
  cleave_static_options options{};
  check(cleave_static_options_init(&options));
  if (tolerance_ > 0) options.tolerance = tolerance_;
  if (max_iterations_ > 0) options.max_iterations = static_cast<std::int32_t>(max_iterations_);
  cleave_static_report done{};
  done.size = sizeof done;
  const std::int32_t status = cleave_model_solve_static(model.handle(), time, &options, &done);
  report.iterations += done.iterations;
  report.residual = std::max(report.residual, done.residual);
  return status;
}

std::int32_t Stepping::relax(Model& model, double time, const StepWatch& watch,
                             StepReport& report) const {
  using WallClock = std::chrono::steady_clock;
  cleave_relaxation_options options{};
  check(cleave_relaxation_options_init(&options));
  if (tolerance_ > 0) options.tolerance = tolerance_;
  if (max_iterations_ > 0) options.max_iterations = max_iterations_;
  options.breaking = one_bond_ ? CLEAVE_BREAKING_ONE : CLEAVE_BREAKING_ALL;
  Slice slice;
  while (true) {
    if (watch) options.slice = slice.iterations();
    cleave_relaxation_report now{};
    now.size = sizeof now;
    const auto begin = WallClock::now();
    const std::int32_t status = cleave_model_relax(model.handle(), time, &options, &now);
    if (status != CLEAVE_OK) return status;
    slice.took(std::chrono::duration<double>(WallClock::now() - begin).count());
    const StepReport so_far{false, report.iterations + now.iterations, report.rounds + now.rounds,
                            report.broken + now.broken, std::max(report.residual, now.residual)};
    if (now.finished != 0) {
      report = so_far;
      report.finished = true;
      return CLEAVE_OK;
    }
    if (!watch(so_far)) {
      report.finished = false;
      return cleave_model_relax_cancel(model.handle());
    }
  }
}

// Halves the part of the increment that is tried until it converges; doubles it again after two
// that did.
StepReport Stepping::load_increment(Scene& scene, double from, double to,
                                    const StepWatch& watch) const {
  Model& model = scene.model();
  StepReport report;
  const double finest = 1.0 / static_cast<double>(std::int64_t{1} << cut_backs_);
  double done = 0, size = 1;
  int converged = 0;
  while (done < 1) {
    const double target = std::min(1.0, done + size);
    const double time = target == 1.0 ? to : from + target * (to - from);
    scene.motions().before_advance(model, time);
    scene.forces().apply(model, time);
    const std::int32_t status =
        relaxes_ ? relax(model, time, watch, report) : solve(model, time, report);
    if (!report.finished) {
      check(status);
      return report;
    }
    if (status == CLEAVE_OK) {
      done = target;
      if (++converged >= 2) size = std::min(1.0, 2 * size);
      continue;
    }
    const bool may_cut = status == CLEAVE_NO_CONVERGENCE || status == CLEAVE_BAD_JACOBIAN;
    if (!may_cut || size / 2 < finest) check(status);
    size /= 2;
    converged = 0;
  }
  return report;
}

}  // namespace cleave::driver
