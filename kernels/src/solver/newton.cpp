#include "solver/newton.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "model/stiffness_source.hpp"
#include "solver/iterative_solver.hpp"

namespace cleave {

namespace {

// Of conjugate gradients: part of the wanted residual that they may leave, and their tolerance at most and at least.
constexpr double kSlack = 0.1, kCoarsest = 0.1, kFinest = 1e-13;

Error no_convergence(const Body& body, const std::string& why,
                     const char* remedy = "use a smaller load increment") {
  return Error(CLEAVE_NO_CONVERGENCE, text(body.label(), ": no equilibrium: ", why, "; ", remedy));
}
bool has_constant_stiffness(const Formulation& formulation) {
  const StiffnessSource* source = formulation.stiffness();
  return source != nullptr && source->constant_stiffness();
}

// Breaking has set free what carries a load.
constexpr const char* kTorn =
    "the body is torn: end the run before, or prescribe displacements in place of the load";

}  // namespace

Newton::Newton(Body& body, const Clock& clock, ThreadTeam& team, const StaticOptions& options,
               KeptStiffness& kept)
    : body_(body),
      clock_(clock),
      team_(team),
      options_(options),
      g_(body.formulation->gradient_operator(team)),
      constant_(has_constant_stiffness(*body.formulation)),
      kept_(kept),
      committed_(body),
      displacement_(committed_.values("displacement")),
      external_(committed_.values("external_force")),
      jump_(displacement_.size(), 0.0) {
  if (constant_) {
    kept_.follow(body, options.solver, options.corrections, team);
    check_loads();
  } else {
    equations_ = Equations(body, g_);
  }
}

bool Newton::is_free(std::size_t c) const {
  return equations().of[c] >= 0 &&
         (!constant_ ||
          body_.formulation->stiffness()->holds(body_, static_cast<std::int64_t>(c) / kVector));
}

// What breaking cut off stays where it is, which a load does not allow.
void Newton::check_loads() const {
  std::vector<char> prescribed(external_.size(), 0);
  for (const auto& dof : body_.prescribed)
    prescribed[static_cast<std::size_t>(kVector * dof.particle + dof.direction)] = 1;
  for (std::size_t c = 0; c < external_.size(); ++c) {
    if (external_[c] == 0 || prescribed[c] != 0 || is_free(c)) continue;
    throw no_convergence(body_,
                         text(body_.particle_label(static_cast<std::int64_t>(c) / kVector),
                              " is loaded by ", external_[c], " [N] and nothing holds it any more"),
                         kTorn);
  }
}

void Newton::load() {
  for (const auto& dof : body_.prescribed) {
    const auto c = static_cast<std::size_t>(kVector * dof.particle + dof.direction);
    jump_[c] = dof.displacement - displacement_[c];
  }
  find(true);
  book_works(body_, committed_, [this](std::size_t c) { return is_free(c); });
}

// [ST loss]
void Newton::settle() {
  evaluate(displacement_);
  const StoredEnergy before = body_.formulation->stored_energy(body_);
  find(false);
  const double stored = body_.formulation->stored_energy(body_).elastic - before.elastic;
  const auto& u_old = committed_.values("displacement");
  double external = 0;
  for (std::size_t c = 0; c < u_old.size(); ++c)
    external += external_[c] * (body_.point.u[c] - u_old[c]);
  body_.point.ledger[ledger::kInternal] += stored;
  body_.point.ledger[ledger::kExternal] += external;
  body_.point.ledger[ledger::kViscous] += external - stored;
}

void Newton::find(bool loading) {
  evaluate(displacement_);
  if (loading && constant_) move_boundary();
  Vector r = unbalanced_forces();
  double norm = r.norm();
  if (loading && constant_) boundary_force_ = norm;
  bool with_jump = loading && !constant_;
  for (iterations_ = 0;; ++iterations_) {
    const double scale = force_scale(body_, committed_);
    relative_ = scale > 0 && norm > kRounding * boundary_force_ ? norm / scale : 0.0;
    if (!with_jump && relative_ <= options_.tolerance) return;
    if (iterations_ == options_.max_iterations) {
      const std::string what = text("residual ", relative_, " of the forces after ", iterations_,
                                    " iterations, wanted ", options_.tolerance);
      if (!constant_ || !kept_.has_hinges()) throw no_convergence(body_, what);
      throw no_convergence(body_, "a piece is loaded and nothing holds it any more, " + what,
                           kTorn);
    }
    norm = search(direction(r, with_jump), norm, with_jump);
    r = unbalanced_forces();
    with_jump = false;
  }
}

// Stress and force at displacement u from the committed history. Throws BAD_JACOBIAN.
void Newton::evaluate(const std::vector<double>& u) {
  committed_.restore();
  for (std::size_t c = 0; c < u.size(); ++c) {
    body_.point.u[c] = u[c];
    body_.point.x[c] = body_.point.X[c] + u[c];
    body_.point.v[c] = 0;
    body_.point.a[c] = 0;
  }
  body_.formulation->deform(body_, clock_, team_);
  body_.formulation->forces(body_, team_);
}

Vector Newton::unbalanced_forces() const {
  const Equations& e = equations();
  Vector r = Vector::Zero(e.count);
  for (std::size_t c = 0; c < e.of.size(); ++c)
    if (is_free(c)) r[e.of[c]] = body_.point.internal[c] + external_[c];
  return r;
}

void Newton::move_boundary() {
  for (std::size_t c = 0; c < jump_.size(); ++c) displacement_[c] += jump_[c];
  evaluate(displacement_);
}

// K change = r - K_fixed jump.
Vector Newton::direction(Vector r, bool with_jump) {
  if (constant_) return kept_direction(std::move(r));
  Stiffness k;
  if (!assemble(body_, g_, committed_.history(), equations_, k))
    throw no_convergence(body_, "the law has no tangent");
  if (with_jump) {
    for (const auto& entry : k.fix)
      r[entry.row()] -= entry.value() * jump_[static_cast<std::size_t>(entry.col())];
    boundary_force_ = r.norm();
  }
  constexpr double kSymmetric = 1e-7;  // difference tangents are good to 1e-8
  if (options_.solver == Solver::iterative) {
    if (k.asymmetry <= kSymmetric) return iterate(k.free, r);
    throw Error(
        CLEAVE_UNSUPPORTED,
        text(body_.label(), ": the stiffness of its law is not symmetric, by ", k.asymmetry,
             " of the largest entry, and conjugate gradients need that; use solver = 'direct'"));
  }
  if (!solver_.factor(k.free, k.asymmetry <= kSymmetric))
    throw singular(body_, equations_, solver_.weakest());
  return solver_.solve(r);
}

// Where the conjugate gradients fail that bonds were corrected for, the stiffness is made anew first.
Vector Newton::kept_direction(Vector r) {
  // What is wanted of the forces is a part of what is there now.
  const double tolerance = std::clamp(kSlack * options_.tolerance / relative_, kFinest, kCoarsest);
  Vector x;
  if (kept_.solve(r, tolerance, x)) return x;
  if (kept_.renew(body_)) {
    r = unbalanced_forces();
    if (kept_.solve(r, tolerance, x)) return x;
  }
  throw no_convergence(body_, kept_.why());
}

// The forces that the moved boundary calls up may be a thousand times those of equilibrium.
Vector Newton::iterate(SparseMatrix& k, const Vector& r) {
  constexpr double kOfBoundary = 1e-3;
  const double tolerance = std::fmax(kSlack * kOfBoundary * options_.tolerance, kFinest);
  IterativeSolver solver(team_);
  const Multigrid::Kind kind = solver.set_up(k, particles_of(equations_, body_));
  if (kind == Multigrid::Kind::singular) throw singular(body_, equations_, solver.weakest());
  if (kind == Multigrid::Kind::indefinite) throw no_convergence(body_, kIndefinite);
  Vector x;
  const IterativeSolver::End end = solver.solve(r, tolerance, {}, x);
  if (end != IterativeSolver::End::converged)
    throw no_convergence(body_, solver.why(end, tolerance));
  return x;
}

// Takes the change, halved until the law has an answer and the residual does not grow (the first
// correction moves the boundary: it may). Returns the norm of the residual.
double Newton::search(const Vector& change, double norm, bool with_jump) {
  constexpr int kHalvings = 6;
  double factor = 1;
  std::string why;
  for (int k = 0; k <= kHalvings; ++k, factor *= 0.5) {
    std::vector<double> u = displacement_;
    for (std::size_t c = 0; c < u.size(); ++c) {
      if (is_free(c)) u[c] += factor * change[equations().of[c]];
      if (with_jump) u[c] += jump_[c];
    }
    try {
      evaluate(u);
    } catch (const Error& error) {
      why = error.what();
      if (with_jump) break;  // half of the way would not end where the loads ask for
      continue;
    }
    const double now = unbalanced_forces().norm();
    if (with_jump || now <= norm || k == kHalvings) {
      displacement_ = std::move(u);
      return now;
    }
  }
  throw no_convergence(body_, why.empty() ? "the line search found no smaller residual" : why);
}

}  // namespace cleave
