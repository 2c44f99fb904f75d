#include "solver/static_solver.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <vector>

#include "model/resident.hpp"
#include "solver/increment.hpp"
#include "solver/newton.hpp"

namespace cleave {

namespace {

// A bond this much beyond its limit is at it: forces are known that well.
constexpr double kAtLimit = 1e-6;
// Where the loads are moved to, so that rounding does not leave the bond below.
constexpr double kBeyond = 1e-9;

void check_options(const StaticOptions& options) {
  if (options.tolerance > 0 && options.max_iterations >= 1) return;
  throw Error(CLEAVE_BAD_ARGUMENT, text("tolerance is ", options.tolerance, ", max_iterations ",
                                        options.max_iterations, "; allowed: > 0 and >= 1"));
}

void check_body(Body& body, const StaticOptions& options) {
  take_fields(body);
  if (!body.formulation->has_gradient_operator() && body.formulation->stiffness() == nullptr) {
    throw Error(CLEAVE_UNSUPPORTED, text(body.label(), ": formulation ", body.formulation->name(),
                                         " has no stiffness matrix to solve with; use relaxation"));
  }
  std::string obstacle = body.formulation->static_obstacle(body);
  if (obstacle.empty() && (options.stop_at_limit || options.breaking != Breaking::all))
    obstacle = body.formulation->one_bond_obstacle(body);
  if (obstacle.empty()) return;
  throw Error(CLEAVE_UNSUPPORTED,
              text(body.label(), ": the static solver cannot be used: ", obstacle));
}

KeptStiffness& kept_of(cleave_model& model, std::size_t body) {
  model.stiffness.resize(model.bodies.size());
  auto& kept = model.stiffness[body];
  if (kept == nullptr) kept = std::make_unique<KeptStiffness>();
  return *kept;
}

// Bonds of the bodies that are beyond their limits.
class CriticalBonds {
 public:
  explicit CriticalBonds(cleave_model& model) : found_(model.bodies.size()) {
    for (std::size_t b = 0; b < found_.size(); ++b) {
      Body& body = *model.bodies[b];
      body.formulation->find_critical(body, model.team, found_[b]);
      for (const CriticalBond& bond : found_[b]) largest_ = std::fmax(largest_, bond.ratio);
      count_ += std::ssize(found_[b]);
    }
  }
  std::int64_t count() const { return count_; }
  bool beyond_tolerance() const { return largest_ > 1 + kAtLimit; }
  // Of the way, in the state before.
  double fraction(const cleave_model& model) const {
    double least = 1;
    for (std::size_t b = 0; b < found_.size(); ++b) {
      const Body& body = *model.bodies[b];
      for (const CriticalBond& bond : found_[b]) {
        const double before = body.formulation->critical_ratio(body, bond.bond);
        least = std::fmin(least, (1 + kBeyond - before) / (bond.ratio - before));
      }
    }
    return std::fmax(least, 0.0);
  }

 private:
  std::vector<std::vector<CriticalBond>> found_;
  std::int64_t count_ = 0;
  double largest_ = 0;
};

// The state of all bodies before a call, to come back to.
class Before {
 public:
  explicit Before(cleave_model& model) : model_(model) {
    for (auto& body : model.bodies) states_.push_back(std::make_unique<Committed>(*body));
  }
  void restore() const {
    for (const auto& state : states_) state->restore_all(model_.team);
  }

 private:
  cleave_model& model_;
  std::vector<std::unique_ptr<Committed>> states_;
};

void add(StaticReport& report, const Newton& newton) {
  report.iterations = std::max(report.iterations, newton.iterations());
  report.residual = std::fmax(report.residual, newton.residual());
  report.unknowns += newton.unknowns();
}

// True: the body is another one now, with bonds that broke or only soften.
bool break_in(Body& body, const Clock& clock, ThreadTeam& team, Breaking breaking) {
  const std::size_t before = body.events.size();
  bool changed = false;
  if (breaking == Breaking::all) {
    changed = body.formulation->break_bonds(body, clock, team);
  } else if (!body.formulation->break_most_critical(body, clock, team, breaking)) {
    throw Error(CLEAVE_UNSUPPORTED, text(body.label(), ": formulation ", body.formulation->name(),
                                         " cannot break one bond at a time; break all that fail"));
  }
  if (body.events.size() == before) return changed;
  body.formulation->release_loose(body, clock, team);
  return true;
}

template <class Solve>
StaticReport attempt(cleave_model& model, const StaticOptions& options, const Solve& solve) {
  check_options(options);
  for (auto& body : model.bodies) check_body(*body, options);
  const Before before(model);
  try {
    return solve(before);
  } catch (...) {
    before.restore();
    model.stiffness.clear();  // it may have followed bonds that are whole again
    throw;
  }
}

}  // namespace

StaticReport solve_static(cleave_model& model, double time_new, const StaticOptions& options) {
  return attempt(model, options, [&](const Before& before) {
    const Clock clock{model.clock.step + 1, time_new, 0};
    StaticReport report;
    for (std::size_t b = 0; b < model.bodies.size(); ++b) {
      start_ledger(*model.bodies[b]);
      Newton newton(*model.bodies[b], clock, model.team, options, kept_of(model, b));
      newton.load();
      add(report, newton);
    }
    const CriticalBonds bonds(model);
    report.critical = bonds.count();
    if (options.stop_at_limit && bonds.beyond_tolerance()) {
      before.restore();
      report.fraction = bonds.fraction(model);
      return report;
    }
    model.clock = clock;
    return report;
  });
}

StaticReport break_static(cleave_model& model, const StaticOptions& options) {
  return attempt(model, options, [&](const Before&) {
    const Clock clock{model.clock.step + 1, model.clock.time, 0};
    StaticReport report;
    for (std::size_t b = 0; b < model.bodies.size(); ++b) {
      Body& body = *model.bodies[b];
      const std::size_t before = body.events.size();
      if (!break_in(body, clock, model.team, options.breaking)) continue;
      report.changed = true;
      report.broken += static_cast<std::int64_t>(body.events.size() - before);
      Newton newton(body, clock, model.team, options, kept_of(model, b));
      newton.settle();
      add(report, newton);
    }
    if (report.changed) model.clock = clock;
    report.critical = CriticalBonds(model).count();
    return report;
  });
}

}  // namespace cleave
