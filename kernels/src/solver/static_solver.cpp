#include "solver/static_solver.hpp"

#include <Eigen/SparseCholesky>
#include <Eigen/SparseLU>
#include <algorithm>
#include <cmath>
#include <memory>
#include <vector>

#include "model/resident.hpp"
#include "solver/increment.hpp"
#include "solver/stiffness.hpp"

namespace cleave {

namespace {

using Vector = Eigen::VectorXd;

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
        g_(body.formulation->gradient_operator(team)),
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
      const double scale = force_scale(body_, committed_);
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
    book_works(body_, committed_, [this](std::size_t c) { return equations_.of[c] >= 0; });
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

  Body& body_;
  Clock clock_;
  ThreadTeam& team_;
  StaticOptions options_;
  const GradientOperator* g_;  // NULL: the formulation gives its stiffness itself
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

}  // namespace

StaticReport solve_static(cleave_model& model, double time_new, const StaticOptions& options) {
  if (!(options.tolerance > 0) || options.max_iterations < 1) {
    throw Error(CLEAVE_BAD_ARGUMENT, text("tolerance is ", options.tolerance, ", max_iterations ",
                                          options.max_iterations, "; allowed: > 0 and >= 1"));
  }
  for (auto& body : model.bodies) {
    take_fields(*body);
    if (!body->formulation->has_gradient_operator() && !body->formulation->has_stiffness()) {
      throw Error(CLEAVE_UNSUPPORTED,
                  text(body->label(), ": formulation ", body->formulation->name(),
                       " has no stiffness matrix to solve with; use relaxation"));
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
    for (const auto& newton : done) newton->committed().restore_all(model.team);
    throw;
  }
  model.clock = clock;
  return report;
}

}  // namespace cleave
