// Equilibrium of one body by Newton's method: with the consistent tangent, assembled and factorised in every iteration,
// or with the stiffness that is kept where it is constant. Which increment to take is the caller's business.
//                                                                                [FEM equilibrium]
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "model/body.hpp"
#include "solver/increment.hpp"
#include "solver/kept_stiffness.hpp"
#include "solver/static_solver.hpp"
#include "solver/stiffness.hpp"

namespace cleave {

class Newton {
 public:
  // From the state that the fields hold; `kept` for a formulation with a constant stiffness.
  Newton(Body& body, const Clock& clock, ThreadTeam& team, const StaticOptions& options,
         KeptStiffness& kept);
  // To the prescribed displacements and forces. Throws NO_CONVERGENCE.
  void load();
  // After bonds broke: the boundary stays, the forces too. What is set free beyond what is stored is lost.
  void settle();

  const Committed& committed() const { return committed_; }
  std::int64_t unknowns() const { return equations().count; }
  std::int64_t iterations() const { return iterations_; }
  double residual() const { return relative_; }

 private:
  const Equations& equations() const { return constant_ ? kept_.equations() : equations_; }
  bool is_free(std::size_t c) const;
  void check_loads() const;
  void find(bool loading);
  void evaluate(const std::vector<double>& u);
  Vector unbalanced_forces() const;
  void move_boundary();
  Vector direction(Vector r, bool with_jump);
  Vector kept_direction(Vector r);
  Vector iterate(SparseMatrix& k, const Vector& r);
  double search(const Vector& change, double norm, bool with_jump);

  Body& body_;
  Clock clock_;
  ThreadTeam& team_;
  StaticOptions options_;
  const GradientOperator* g_;  // NULL: the formulation gives its stiffness itself
  bool constant_;
  KeptStiffness& kept_;
  Committed committed_;
  Equations equations_;               // unless it is constant
  std::vector<double> displacement_;  // (3,n) of the last accepted trial
  std::vector<double> external_;      // (3,n)
  std::vector<double> jump_;          // (3,n) of the prescribed displacements
  // What the increment would leave unbalanced if only the prescribed particles moved [N]. A body that is
  // moved without strain has no other force; its residual is rounding of this one.
  static constexpr double kRounding = 1e-13;
  double boundary_force_ = 0;
  std::int64_t iterations_ = 0;
  double relative_ = 0;
  DirectSolver solver_;
};

}  // namespace cleave
