#include "solver/static_solver.hpp"

#include <Eigen/SparseCholesky>
#include <Eigen/SparseLU>
#include <algorithm>
#include <cmath>
#include <memory>
#include <string_view>
#include <vector>

#include "model/resident.hpp"
#include "solver/stiffness.hpp"

namespace cleave {

namespace {

using Vector = Eigen::VectorXd;

// What a trial may change, kept to come back to.
class Committed {
 public:
  explicit Committed(Body& body) {
    for (auto& field : body.fields.all()) {
      if (field.spec.lifetime == CLEAVE_LIFETIME_STATE && field.spec.type == CLEAVE_REAL)
        kept_.push_back({&field, field.real});
    }
    history_ = body.history;
    for (std::size_t k = 0; k < kMaxHistory; ++k) {
      for (auto& [field, values] : kept_) {
        if (history_.base[k] != nullptr && history_.base[k] == field->real.data())
          history_.base[k] = values.data();
      }
    }
  }
  Committed(const Committed&) = delete;
  Committed& operator=(const Committed&) = delete;
  void restore() const {
    for (const auto& [field, values] : kept_) field->real = values;
  }
  const HistoryArrays& history() const { return history_; }
  const std::vector<double>& values(const char* name) const {
    for (const auto& [field, values] : kept_) {
      if (std::string_view(name) == field->spec.name) return values;
    }
    throw Error(CLEAVE_INTERNAL, text("no state field ", name));
  }

 private:
  struct Kept {
    Field* field;
    std::vector<double> values;
  };
  std::vector<Kept> kept_;
  HistoryArrays history_;
};

Error no_convergence(const Body& body, const std::string& why) {
  return Error(CLEAVE_NO_CONVERGENCE,
               text(body.label(), ": no equilibrium: ", why, "; use a smaller load increment"));
}

class Newton {
 public:
  Newton(Body& body, const Clock& clock, ThreadTeam& team, const StaticOptions& options)
      : body_(body),
        clock_(clock),
        team_(team),
        options_(options),
        g_(*body.formulation->gradient_operator(team)),
        committed_(body),
        equations_(body, g_),
        displacement_(committed_.values("displacement")),
        external_(committed_.values("external_force")) {}

  void solve() {
    unbalanced_ = 0;
    prescribe_change();
    evaluate(displacement_);
    Vector r = residual();
    double norm = r.norm();
    bool first = true;
    for (iterations = 0;; ++iterations) {
      const double scale = force_scale();
      relative = scale > 0 && norm > kRounding * unbalanced_ ? norm / scale : 0.0;
      if (!first && relative <= options_.tolerance) break;
      if (iterations == options_.max_iterations) {
        throw no_convergence(body_, text("residual ", relative, " of the forces after ", iterations,
                                         " iterations, wanted ", options_.tolerance));
      }
      const Vector change = direction(r, first);
      norm = search(change, norm, first);
      r = residual();
      first = false;
    }
    book_works();
  }

  const Committed& committed() const { return committed_; }
  std::int64_t unknowns() const { return equations_.count; }
  std::int64_t iterations = 0;
  double relative = 0;

 private:
  // (3,n) jump of the prescribed displacements, taken with the first correction.
  void prescribe_change() {
    jump_.assign(displacement_.size(), 0.0);
    for (const auto& dof : body_.prescribed) {
      const auto c = static_cast<std::size_t>(kVector * dof.particle + dof.direction);
      jump_[c] = dof.displacement - displacement_[c];
    }
  }

  // Stress and force at displacement u from the committed history. Throws BAD_JACOBIAN.
  void evaluate(const std::vector<double>& u) {
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

  Vector residual() const {
    Vector r(equations_.count);
    for (std::size_t c = 0; c < equations_.of.size(); ++c) {
      if (equations_.of[c] >= 0) r[equations_.of[c]] = body_.point.internal[c] + external_[c];
    }
    return r;
  }

  // The forces before the increment count too: it may take them all away.
  double force_scale() const {
    const auto& before = committed_.values("internal_force");
    double internal = 0, external = 0, old = 0;
    for (std::size_t c = 0; c < external_.size(); ++c) {
      internal += body_.point.internal[c] * body_.point.internal[c];
      external += external_[c] * external_[c];
      old += before[c] * before[c];
    }
    return std::sqrt(std::fmax(old, std::fmax(internal, external)));
  }

  // K change = r - K_fixed jump.
  Vector direction(Vector r, bool with_jump) {
    Stiffness k;
    if (!assemble(body_, g_, committed_.history(), equations_, k))
      throw no_convergence(body_, "the law has no tangent");
    if (with_jump) {
      for (const auto& entry : k.fix)
        r[entry.row()] -= entry.value() * jump_[static_cast<std::size_t>(entry.col())];
      unbalanced_ = r.norm();
    }
    constexpr double kSymmetric = 1e-7;  // difference tangents are good to 1e-8
    if (k.asymmetry <= kSymmetric) {
      if (!analysed_) symmetric_.analyzePattern(k.free);
      analysed_ = true;
      symmetric_.factorize(k.free);
      if (symmetric_.info() == Eigen::Success && well_conditioned(symmetric_.vectorD()))
        return symmetric_.solve(r);
    }
    Eigen::SparseLU<SparseMatrix> general(k.free);
    if (general.info() != Eigen::Success) throw singular();
    return general.solve(r);
  }

  bool well_conditioned(const Vector& pivots) const {
    if (pivots.size() == 0) return true;
    const double most = pivots.cwiseAbs().maxCoeff();
    if (!(pivots.cwiseAbs().minCoeff() > 1e-14 * most)) throw singular();
    return true;
  }
  Error singular() const {
    return Error(CLEAVE_NO_CONVERGENCE,
                 text(body_.label(),
                      ": the stiffness is singular: the body, or a part of it, can move without "
                      "resistance; prescribe displacements that hold it"));
  }

  // Takes the change, halved until the law has an answer and the residual does not grow (the first
  // correction moves the boundary: it may). Returns the norm of the residual.
  double search(const Vector& change, double norm, bool with_jump) {
    constexpr int kHalvings = 6;
    double factor = 1;
    std::string why;
    for (int k = 0; k <= kHalvings; ++k, factor *= 0.5) {
      std::vector<double> u = displacement_;
      for (std::size_t c = 0; c < u.size(); ++c) {
        if (equations_.of[c] >= 0) u[c] += factor * change[equations_.of[c]];
        if (with_jump) u[c] += jump_[c];
      }
      try {
        evaluate(u);
      } catch (const Error& error) {
        why = error.what();
        if (with_jump) break;  // half of the way would not end where the loads ask for
        continue;
      }
      const double now = residual().norm();
      if (with_jump || now <= norm || k == kHalvings) {
        displacement_ = std::move(u);
        return now;
      }
    }
    throw no_convergence(body_, why.empty() ? "the line search found no smaller residual" : why);
  }

  // Works of the increment, by the trapezoid between the two equilibria.
  void book_works() {
    const auto& u_old = committed_.values("displacement");
    const auto& f_old = committed_.values("internal_force");
    const PointArrays& pt = body_.point;
    double internal = 0, external = 0, reaction = 0;
    for (std::size_t c = 0; c < u_old.size(); ++c) {
      const double change = pt.u[c] - u_old[c];
      internal += 0.5 * (f_old[c] + pt.internal[c]) * change;
      if (equations_.of[c] >= 0) {
        external += 0.5 * (external_[c] - f_old[c]) * change;  // in equilibrium f_ext = - f_int
      } else {  // held degrees of freedom feel what balances the other forces
        external += external_[c] * change;
        reaction -= (0.5 * (f_old[c] + pt.internal[c]) + external_[c]) * change;
      }
    }
    pt.ledger[ledger::kInternal] -= internal;
    pt.ledger[ledger::kExternal] += external;
    pt.ledger[ledger::kReaction] += reaction;
  }

  Body& body_;
  Clock clock_;
  ThreadTeam& team_;
  StaticOptions options_;
  const GradientOperator& g_;
  Committed committed_;
  Equations equations_;
  std::vector<double> displacement_;  // (3,n) of the last accepted trial
  std::vector<double> external_;      // (3,n)
  std::vector<double> jump_;
  // What the increment would leave unbalanced if only the prescribed particles moved [N]. A body that is
  // moved without strain has no other force; its residual is rounding of this one.
  static constexpr double kRounding = 1e-13;
  double unbalanced_ = 0;
  Eigen::SimplicialLDLT<SparseMatrix> symmetric_;
  bool analysed_ = false;
};

// The first increment fixes what the balance is measured from.
void start_ledger(Body& body) {
  const PointArrays& pt = body.point;
  if (pt.ledger[ledger::kStarted] > 0) return;
  const cleave_energies e = energies(body);
  pt.ledger[ledger::kStartTotal] = e.elastic + e.plastic + e.stabilisation;
  pt.ledger[ledger::kStarted] = 1;
}

}  // namespace

StaticReport solve_static(cleave_model& model, double time_new, const StaticOptions& options) {
  if (!(options.tolerance > 0) || options.max_iterations < 1) {
    throw Error(CLEAVE_BAD_ARGUMENT, text("tolerance is ", options.tolerance, ", max_iterations ",
                                          options.max_iterations, "; allowed: > 0 and >= 1"));
  }
  for (auto& body : model.bodies) {
    take_fields(*body);
    if (body->formulation->gradient_operator(model.team) == nullptr) {
      throw Error(CLEAVE_UNSUPPORTED,
                  text(body->label(), ": formulation ", body->formulation->name(),
                       " has no gradient operator to solve with"));
    }
    const std::string obstacle = body->formulation->static_obstacle(*body);
    if (!obstacle.empty()) {
      throw Error(CLEAVE_UNSUPPORTED,
                  text(body->label(), ": the static solver cannot be used: ", obstacle));
    }
  }
  const Clock clock{model.clock.step + 1, time_new, 0};
  StaticReport report;
  std::vector<std::unique_ptr<Newton>> done;
  try {
    for (auto& body : model.bodies) {
      start_ledger(*body);
      done.push_back(std::make_unique<Newton>(*body, clock, model.team, options));
      Newton& newton = *done.back();
      newton.solve();
      report.iterations = std::max(report.iterations, newton.iterations);
      report.residual = std::fmax(report.residual, newton.relative);
      report.unknowns += newton.unknowns();
    }
  } catch (...) {
    for (std::size_t k = 0; k < done.size(); ++k) {
      done[k]->committed().restore();
      Body& body = *model.bodies[k];
      for (std::int64_t c = 0; c < kVector * body.particles; ++c)
        body.point.x[c] = body.point.X[c] + body.point.u[c];
      body.formulation->rebuild(body, model.team);
    }
    throw;
  }
  model.clock = clock;
  return report;
}

}  // namespace cleave
