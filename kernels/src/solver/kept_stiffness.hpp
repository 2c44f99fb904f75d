// The stiffness of a body that depends on nothing but on which bonds carry: factorised once, or given its multigrid, and
// corrected for every bond that breaks (Woodbury, or in the products), until a new one is cheaper. What was corrected
// follows from the state alone, so that a restart goes on with the same bits.           [ST update]
#pragma once

#include <Eigen/Dense>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "model/body.hpp"
#include "solver/iterative_solver.hpp"
#include "solver/linear_solver.hpp"
#include "solver/static_solver.hpp"
#include "solver/stiffness.hpp"

namespace cleave {

class KeptStiffness {
 public:
  // Follows the body to the bonds that carry now, with this many corrections at most (-1: while they pay). Throws NO_CONVERGENCE where it has a part that can move
  // without resistance.
  void follow(Body& body, Solver solver, std::int64_t corrections, ThreadTeam& team);
  // x with K x = r for the bonds of the last call of `follow`; iterative: to this tolerance. False: why() says it.
  bool solve(const Vector& r, double tolerance, Vector& x);
  const std::string& why() const { return why_; }
  // For the same bonds without corrections. False: there are none.
  bool renew(Body& body);
  // Of the factorisation: particles that were free then.
  const Equations& equations() const { return equations_; }
  // Pieces can move without resistance.
  bool has_hinges() const { return hinges_; }
  std::int64_t factorisations() const { return factorisations_; }
  std::int64_t bytes() const;

 private:
  void factorise(const Body& body, std::int64_t broken);
  bool factor(const Body& body, SparseMatrix& k);
  void add_change(const Body& body, std::int64_t event);
  // K^-1 V from this column on.
  void solve_columns(Eigen::Index before);
  void add_changes(const Vector& p, Vector& q) const;
  Vector pulled(const Vector& x) const;  // V^T x
  bool hold_hinges(const Body& body, SparseMatrix& k);
  // False: what was corrected has no inverse.
  bool finish();
  // The most bonds to correct for.
  double worthwhile() const;
  double product(const SparseColumn& column, Eigen::Index of) const;

  Equations equations_;
  Solver solver_ = Solver::direct;
  ThreadTeam* team_ = nullptr;
  std::unique_ptr<DirectSolver> base_;  // one of these
  std::unique_ptr<IterativeSolver> iterative_;
  std::int64_t weakest_ = kNoEquation;
  std::string why_;
  std::int64_t factored_ = -1;  // bonds broken in the factor
  bool hinges_ = false;
  std::int64_t added_ = 0;  // bonds corrected for
  bool lost_ = false;       // the factor could not follow
  std::int64_t factorisations_ = 0;
  std::vector<SparseColumn> columns_;           // V, of what the factor itself does not follow
  std::vector<Vector> solved_;                  // K^-1 V, direct
  std::vector<std::vector<double>> weights_;    // W, block by block, rows beside each other
  Eigen::MatrixXd cross_;                       // V^T K^-1 V
  Eigen::MatrixXd weight_;                      // W
  Eigen::PartialPivLU<Eigen::MatrixXd> small_;  // I + W V^T K^-1 V
};

}  // namespace cleave
