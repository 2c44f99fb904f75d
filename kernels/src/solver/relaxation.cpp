#include "solver/relaxation.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "model/resident.hpp"
#include "solver/kept_stiffness.hpp"

namespace cleave {

namespace {

// Strain of the wave that the moving boundary sends out: a sudden jump would turn cells at the boundary
// inside out.
constexpr double kFrontStrain = 0.03;
// Forces of this share of the largest met on the way are no force: a piece that nothing holds comes to
// rest without any.
constexpr double kNoForce = 1e-3;
// Central differences are stable below 4 (Rayleigh quotient of a step).
constexpr double kStable = 3.9;

double largest_jump(const Body& body, const std::vector<double>& from) {
  double most = 0;
  for (const auto& dof : body.prescribed) {
    const auto c = static_cast<std::size_t>(kVector * dof.particle + dof.direction);
    most = std::fmax(most, std::fabs(dof.displacement - from[c]));
  }
  return most;
}

// A wave passes at most the shortest length of the body in a step.
std::int64_t ramp_steps(const Body& body, double jump) {
  if (!(jump > 0)) return 0;
  const double length = body.wave_speed() * body.formulation->stable_step(body);
  return static_cast<std::int64_t>(std::ceil(std::fmin(1e6, jump / (kFrontStrain * length))));
}

}  // namespace

BodyRelaxation::BodyRelaxation(Body& body, const Clock& clock, ThreadTeam& team,
                               const RelaxationOptions& options)
    : body_(body),
      clock_(clock),
      team_(team),
      options_(options),
      committed_(body),
      from_(committed_.values("displacement")),
      motion_(body) {
  for (auto& field : body.fields.all()) {
    bool path = std::string_view(field.spec.name) == "ledger";
    for (std::size_t k = 0; k < body.law->history.size(); ++k)
      path = path || body.history.base[k] == field.real.data();
    if (path && field.spec.type == CLEAVE_REAL) path_.push_back({&field, field.real});
  }
}

void BodyRelaxation::begin() {
  const PointArrays& pt = body_.point;
  double square = 0;
  for (std::int64_t c = 0; c < kVector * body_.particles; ++c) {
    pt.v[c] = pt.a[c] = 0;
    pt.x[c] = pt.X[c] + pt.u[c];
    square += pt.internal[c] * pt.internal[c];
  }
  forces_before_ = std::sqrt(square);
  ramp_ = ramp_steps(body_, largest_jump(body_, from_));
  start_round();
}

void BodyRelaxation::start_round() {
  for (auto& [field, values] : path_) values = field->real;
  evaluate();
  motion_.start(body_, team_);  // by the gradients of the same rows that a restart has
  step_ = 0;
  work_ = external_work_ = 0;
}

// Stress and force at the present displacements, from the history at the start of the round.
void BodyRelaxation::evaluate() {
  for (const auto& [field, values] : path_) {
    const double* from = values.data();
    double* to = field->real.data();
    for_blocks(team_, std::ssize(values), [&](std::int64_t, std::int64_t first, std::int64_t last) {
      std::copy(from + first, from + last, to + first);
    });
  }
  ++iterations_;
  try {
    body_.formulation->deform(body_, clock_, team_);
  } catch (const Error& e) {
    if (e.status != CLEAVE_BAD_JACOBIAN) throw;
    throw no_convergence(e.what());
  }
  body_.formulation->forces(body_, team_);
}

Error BodyRelaxation::no_convergence(const std::string& why) const {
  return Error(CLEAVE_NO_CONVERGENCE,
               text(body_.label(), ": no equilibrium: ", why,
                    broken_ > 0 ? text("; ", broken_, " bonds broke in this increment") : "",
                    "; use a smaller load increment, allow more iterations, or hold what can move "
                    "without resistance"));
}

void BodyRelaxation::judge(const DampedMotion::Balance& balance) {
  if (!std::isfinite(balance.residual) || !std::isfinite(balance.quotient))
    throw no_convergence("the forces are not finite");
  largest_ = std::fmax(largest_, balance.internal);
  const double scale = std::fmax(std::fmax(forces_before_, balance.internal),
                                 std::fmax(balance.external, kNoForce * largest_));
  relative_ = scale > 0 ? balance.residual / scale : 0.0;
  work_ += balance.work;
  external_work_ += balance.external_work;
}

bool BodyRelaxation::go_on(std::int64_t most) {
  if (iterations_ == 0) begin();
  for (std::int64_t done = 0;;) {
    const DampedMotion::Balance balance = motion_.look(body_, from_, team_);
    judge(balance);
    if (in_equilibrium()) {
      forces_before_ = std::fmax(forces_before_, balance.internal);
      book();
      if (!break_bonds()) return true;
      start_round();
      continue;
    }
    if (step_ == options_.max_iterations + ramp_) {
      throw no_convergence(text("residual ", relative_, " of the forces after ", step_,
                                " iterations, wanted ", options_.tolerance));
    }
    if (balance.quotient > kStable) motion_.slow_down(1.5 * balance.quotient / 4);
    ++step_;
    const double part =
        step_ < ramp_ ? static_cast<double>(step_) / static_cast<double>(ramp_) : 1.0;
    motion_.step(body_, from_, part, balance, team_);
    evaluate();
    if (++done == most) return false;
  }
}

// The first relaxation of an increment stands for a slow change of the loads and takes the trapezoid
// between the equilibria. Those after a breakage are sudden under constant loads: what the forces do
// beyond what is stored is lost in damping.
void BodyRelaxation::book() {
  if (rounds_ == 0) {
    book_works(body_, committed_, [this](std::size_t c) { return motion_.is_free(c); });
    return;
  }
  const PointArrays& pt = body_.point;
  pt.ledger[ledger::kInternal] -= work_ - external_work_;
  pt.ledger[ledger::kExternal] += external_work_;
  pt.ledger[ledger::kViscous] += work_;
}

bool BodyRelaxation::break_bonds() {
  ramp_ = 0;
  const std::size_t before = body_.events.size();
  bool changed = false;
  if (options_.breaking == Breaking::all) {
    changed = body_.formulation->break_bonds(body_, clock_, team_);
  } else if (!body_.formulation->break_most_critical(body_, clock_, team_, options_.breaking)) {
    throw Error(CLEAVE_UNSUPPORTED, text(body_.label(), ": formulation ", body_.formulation->name(),
                                         " cannot break one bond at a time; break all that fail"));
  }
  const auto failed = static_cast<std::int64_t>(body_.events.size() - before);
  changed = changed || failed > 0;
  broken_ += failed;
  rounds_ += changed ? 1 : 0;
  return changed;
}

void BodyRelaxation::add_to(RelaxationReport& report) const {
  report.iterations += iterations_;
  report.rounds += rounds_;
  report.broken += broken_;
  report.unknowns += motion_.unknowns();
  report.residual = std::fmax(report.residual, relative_);
}

std::int64_t BodyRelaxation::bytes() const {
  std::size_t path = 0;
  for (const auto& kept : path_) path += kept.values.size() * sizeof(double);
  return motion_.bytes() + committed_.bytes() + static_cast<std::int64_t>(path);
}

Relaxation::Relaxation(cleave_model& model, double time_new, const RelaxationOptions& options)
    : model_(model), clock_{model.clock.step + 1, time_new, 0}, options_(options) {
  if (!(options.tolerance > 0) || options.max_iterations < 1 || options.slice < 0) {
    throw Error(CLEAVE_BAD_ARGUMENT, text("tolerance is ", options.tolerance, ", max_iterations ",
                                          options.max_iterations, ", slice ", options.slice,
                                          "; allowed: > 0, >= 1 and >= 0"));
  }
  for (auto& body : model.bodies) {
    take_fields(*body);
    body->formulation->gradient_operator(model.team);  // forces by rows
    std::string obstacle = body->formulation->relaxation_obstacle(*body);
    if (obstacle.empty() && options.breaking != Breaking::all)
      obstacle = body->formulation->one_bond_obstacle(*body);
    if (!obstacle.empty()) {
      throw Error(CLEAVE_UNSUPPORTED,
                  text(body->label(), ": dynamic relaxation cannot be used: ", obstacle));
    }
  }
}

// Bodies have no forces on each other: one after the other.
RelaxationReport Relaxation::go_on(std::int64_t most) {
  RelaxationReport report;
  try {
    for (bool finished = true;;) {
      if (!bodies_.empty()) finished = bodies_.back()->go_on(most);
      if (!finished) break;
      if (bodies_.size() == model_.bodies.size()) {
        report.finished = true;
        break;
      }
      Body& next = *model_.bodies[bodies_.size()];
      start_ledger(next);
      bodies_.push_back(std::make_unique<BodyRelaxation>(next, clock_, model_.team, options_));
    }
  } catch (...) {
    cancel();
    throw;
  }
  for (const auto& body : bodies_) body->add_to(report);
  if (report.finished) model_.clock = clock_;
  return report;
}

void Relaxation::cancel() {
  for (const auto& body : bodies_) body->committed().restore_all(model_.team);
}

std::int64_t Relaxation::bytes() const {
  std::int64_t sum = 0;
  for (const auto& body : bodies_) sum += body->bytes();
  return sum;
}

RelaxationReport relax(cleave_model& model, double time_new, const RelaxationOptions& options) {
  using Phase = cleave_model::Phase;
  if (model.phase == Phase::stepping) {
    model.relaxation = std::make_unique<Relaxation>(model, time_new, options);
    model.phase = Phase::relaxing;
  }
  const auto end = [&model] {
    model.relaxation.reset();
    model.stiffness.clear();
    model.phase = Phase::stepping;
  };
  try {
    const std::int64_t most =
        options.slice > 0 ? options.slice : std::numeric_limits<std::int64_t>::max();
    const RelaxationReport report = model.relaxation->go_on(most);
    if (report.finished) end();
    return report;
  } catch (...) {
    end();
    throw;
  }
}

void cancel_relaxation(cleave_model& model) {
  model.relaxation->cancel();
  model.relaxation.reset();
  model.stiffness.clear();
  model.phase = cleave_model::Phase::stepping;
}

}  // namespace cleave

// Here, where the relaxation is a complete type.
cleave_model::cleave_model() = default;
cleave_model::~cleave_model() = default;
