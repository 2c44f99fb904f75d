// Linear systems of the static solver, K x = b with a sparse K: factorised by a library, and what a failure
// says about the body. What K stands for is not known here.
#pragma once

#include <Eigen/SparseLU>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "solver/sparse_matrix.hpp"
#include "solver/symmetric_factor.hpp"

namespace cleave {

class DirectSolver {
 public:
  // False: K is singular; weakest() then is an equation that nothing resists. The entries stand where they
  // stood in the call before.
  bool factor(const SparseMatrix& k, bool symmetric);
  // The result depends on nothing else.
  Vector solve(const Vector& b) const;
  // With several sparse right-hand sides; appends to `x`.
  void solve(std::span<const SparseColumn> b, std::vector<Vector>& x) const;
  // Whether the factor itself can follow changes of K.
  bool can_follow() const { return !general_ && SymmetricFactor::can_follow(); }
  // From K to K + V W V^T, W symmetric with its rows beside each other. False: it is singular or not positive
  // definite, and the factor is lost.
  bool follow(std::span<const SparseColumn> v, std::span<const double> w);

  std::int64_t weakest() const { return weakest_; }
  // Of the symmetric factor: multiplications that it took, and its memory.
  double operations() const { return operations_; }
  std::int64_t bytes() const { return static_cast<std::int64_t>(entries_ * 12); }

 private:
  // Or, where it has to be, positive definite as well.
  bool well_conditioned(bool positive);

  SymmetricFactor symmetric_;
  std::optional<Eigen::SparseLU<SparseMatrix>> general_;
  Vector diagonal_;  // of K
  std::int64_t weakest_ = kNoEquation;
  double operations_ = 0, entries_ = 0;
};

}  // namespace cleave
