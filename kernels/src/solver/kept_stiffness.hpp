// The stiffness of a body that depends on nothing but on which bonds carry: factorised once, and corrected for every bond
// that breaks (Woodbury), until a new factorisation is cheaper. What was corrected follows from the state alone, so
// that a restart goes on with the same bits.                                           [ST update]
#pragma once

#include <Eigen/Dense>
#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

#include "model/body.hpp"
#include "solver/linear_solver.hpp"
#include "solver/stiffness.hpp"

namespace cleave {

class KeptStiffness {
 public:
  // Follows the body to the bonds that carry now. Throws NO_CONVERGENCE where it has a part that can move
  // without resistance.
  void follow(Body& body);
  // x with K x = r for the bonds of the last call of `follow`.
  Vector solve(const Vector& r) const;
  // Of the factorisation: particles that were free then.
  const Equations& equations() const { return equations_; }
  // Pieces can move without resistance.
  bool has_hinges() const { return hinges_; }
  std::int64_t factorisations() const { return factorisations_; }
  std::int64_t bytes() const;

 private:
  using Column = std::vector<std::pair<std::int64_t, double>>;  // equation, value
  void factorise(const Body& body, std::int64_t broken);
  void add_change(const Body& body, std::int64_t event);
  bool hold_hinges(SparseMatrix& k);
  bool finish();
  // The most bonds to correct for.
  double worthwhile() const;
  double product(const Column& column, Eigen::Index of) const;

  Equations equations_;
  std::unique_ptr<DirectSolver> base_;
  std::int64_t factored_ = -1;  // bonds broken in the factor
  bool hinges_ = false;
  std::int64_t added_ = 0;  // bonds corrected for
  std::int64_t factorisations_ = 0;
  std::vector<Column> columns_;                 // V
  std::vector<Vector> solved_;                  // K^-1 V
  std::vector<std::vector<double>> weights_;    // W, block by block, rows beside each other
  Eigen::MatrixXd cross_;                       // V^T K^-1 V
  Eigen::MatrixXd weight_;                      // W
  Eigen::PartialPivLU<Eigen::MatrixXd> small_;  // I + W V^T K^-1 V
};

}  // namespace cleave
