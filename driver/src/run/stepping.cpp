#include "run/stepping.hpp"

#include <algorithm>
#include <chrono>
#include <limits>

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

std::int32_t breaking_of(const std::string& name) {
  if (name == "one") return CLEAVE_BREAKING_ONE;
  return name == "ties" ? CLEAVE_BREAKING_TIES : CLEAVE_BREAKING_ALL;
}

// The part of an increment that is tried: halved where it does not converge, doubled again after two parts
// that did.
class CutBack {
 public:
  explicit CutBack(std::int64_t most)
      : finest_(1.0 / static_cast<double>(std::int64_t{1} << most)) {}
  double size() const { return size_; }
  void converged() {
    if (++converged_ >= 2) size_ = std::min(1.0, 2 * size_);
  }
  // Throws KernelError if the status is of another kind, or the part cannot be made smaller.
  void failed(std::int32_t status) {
    const bool may_cut = status == CLEAVE_NO_CONVERGENCE || status == CLEAVE_BAD_JACOBIAN;
    if (!may_cut || size_ / 2 < finest_) check(status);
    size_ /= 2;
    converged_ = 0;
  }
  void begin_anew() {
    size_ = 1;
    converged_ = 0;
  }

 private:
  double finest_, size_ = 1;
  int converged_ = 0;
};

}  // namespace

Stepping::Stepping(const Deck& deck)
    : static_(deck.one("run").text("mode") == "static"),
      adapt_(deck.one("run").logical("adapt") && deck.one("run").real("time_step") == 0),
      relaxes_(deck.one("static").text("method") == "relaxation"),
      by_events_(deck.one("static").text("loading") == "events"),
      breaking_(breaking_of(deck.one("static").text("breaking"))),
      solver_(deck.one("static").text("solver") == "iterative" ? CLEAVE_SOLVER_ITERATIVE
                                                               : CLEAVE_SOLVER_DIRECT),
      tolerance_(deck.one("static").real("tolerance")),
      max_iterations_(deck.one("static").integer("max_iterations")),
      cut_backs_(deck.one("static").integer("cut_backs")),
      corrections_(static_cast<std::int32_t>(std::min<std::int64_t>(
          deck.one("static").integer("corrections"), std::numeric_limits<std::int32_t>::max()))) {
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
  const double from = clock.time(step), to = clock.time(step + 1);
  if (static_ && relaxes_) return relax_increment(scene, from, to, watch);
  if (static_) return solve_increment(scene, from, to, watch);
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

cleave_static_options Stepping::static_options() const {
  cleave_static_options options{};
  check(cleave_static_options_init(&options));
  if (tolerance_ > 0) options.tolerance = tolerance_;
  if (max_iterations_ > 0) options.max_iterations = static_cast<std::int32_t>(max_iterations_);
  options.breaking = breaking_;
  options.solver = solver_;
  options.stop_at_limit = by_events_ ? 1 : 0;
  options.corrections = corrections_;
  return options;
}

std::int32_t Stepping::relax(Model& model, double time, const StepWatch& watch,
                             StepReport& report) const {
  using WallClock = std::chrono::steady_clock;
  cleave_relaxation_options options{};
  check(cleave_relaxation_options_init(&options));
  if (tolerance_ > 0) options.tolerance = tolerance_;
  if (max_iterations_ > 0) options.max_iterations = max_iterations_;
  options.breaking = breaking_;
  Slice slice;
  while (true) {
    if (watch.relaxing) options.slice = slice.iterations();
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
    if (!watch.relaxing(so_far)) {
      report.finished = false;
      return cleave_model_relax_cancel(model.handle());
    }
  }
}

void Stepping::put_loads(Scene& scene, double time) const {
  scene.motions().before_advance(scene.model(), time);
  scene.forces().apply(scene.model(), time);
}

StepReport Stepping::relax_increment(Scene& scene, double from, double to,
                                     const StepWatch& watch) const {
  StepReport report;
  CutBack part(cut_backs_);
  double done = 0;
  while (done < 1) {
    const double target = std::min(1.0, done + part.size());
    const double time = target == 1.0 ? to : from + target * (to - from);
    put_loads(scene, time);
    const std::int32_t status = relax(scene.model(), time, watch, report);
    if (!report.finished) {
      check(status);
      return report;
    }
    if (status == CLEAVE_OK) {
      done = target;
      part.converged();
    } else {
      part.failed(status);
    }
  }
  return report;
}

// In every state that `watch.event` is told of, what follows is found from the state alone, so that a restart
// goes the same way.                                                                   [ST events]
StepReport Stepping::solve_increment(Scene& scene, double from, double to,
                                     const StepWatch& watch) const {
  constexpr double kLeast = 1e-12;  // of the increment: so much the loads move at least
  constexpr int kTries = 60;
  Model& model = scene.model();
  const cleave_static_options options = static_options();
  StepReport report;
  CutBack part(cut_backs_);
  double now = std::max(from, model.time()), target = now;
  int tries = 0;         // to find where the first bond reaches its limit
  bool critical = true;  // or not known
  const auto take = [&](const cleave_static_report& done) {
    report.iterations += done.iterations;
    report.residual = std::max(report.residual, done.residual);
    report.broken += done.broken;
    report.rounds += done.broken > 0 ? 1 : 0;
    critical = done.critical > 0;
  };
  const auto tell = [&] {
    part.begin_anew();
    report.finished = !watch.event || watch.event(now, report);
    return report.finished;
  };
  while (true) {
    cleave_static_report done{};
    done.size = sizeof done;
    if (critical) {
      put_loads(scene, now);
      check(cleave_model_break_static(model.handle(), &options, &done));
      take(done);
      if (done.broken > 0 && !tell()) return report;
      continue;
    }
    if (now == to) return report;
    if (target <= now) target = std::min(to, now + part.size() * (to - from));
    put_loads(scene, target);
    const std::int32_t status = cleave_model_solve_static(model.handle(), target, &options, &done);
    if (status != CLEAVE_OK) {
      part.failed(status);
      target = now;
      continue;
    }
    if (done.fraction < 1) {
      if (++tries > kTries) {
        throw KernelError(
            "the loads at which the first bond reaches its limit are not found between times " +
                number(now, 17) + " and " + number(target, 17),
            CLEAVE_NO_CONVERGENCE);
      }
      target = now + std::max(kLeast * (to - from), done.fraction * (target - now));
      continue;
    }
    take(done);
    part.converged();
    tries = 0;
    now = target;
    if (critical && !tell()) return report;
  }
}

}  // namespace cleave::driver
