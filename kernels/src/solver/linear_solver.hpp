// Linear systems of the static solver, K x = b with a sparse K: factorised by a library, and what a failure
// says about the body. What K stands for is not known here.
#pragma once

#include <Eigen/SparseCholesky>
#include <Eigen/SparseCore>
#include <Eigen/SparseLU>
#include <cstdint>
#include <optional>
#include <span>
#include <utility>
#include <vector>

namespace cleave {

using Vector = Eigen::VectorXd;
using SparseMatrix = Eigen::SparseMatrix<double, Eigen::ColMajor, std::int32_t>;
// Entries of a vector of few: equation, value.
using SparseColumn = std::vector<std::pair<std::int64_t, double>>;

// No equation of a singular system is known to be at fault.
inline constexpr std::int64_t kNoEquation = -1;

class DirectSolver {
 public:
  // False: K is singular; weakest() then is an equation that nothing resists. The entries stand where they
  // stood in the call before.
  bool factor(const SparseMatrix& k, bool symmetric);
  // The result depends on nothing else.
  Vector solve(const Vector& b) const;
  // With several sparse right-hand sides together, of the symmetric factor: the factor is read once for
  // some of them, and only as far as entries reach. Appends to `x`.
  void solve(std::span<const SparseColumn> b, std::vector<Vector>& x) const;
  std::int64_t weakest() const { return weakest_; }
  // Of the symmetric factor: multiplications that it took, and its entries.
  double operations() const { return operations_; }
  double entries() const { return entries_; }
  std::int64_t bytes() const { return static_cast<std::int64_t>(entries_ * 12); }

 private:
  bool well_conditioned(const Vector& diagonal);
  void solve_together(std::span<const SparseColumn> b, std::vector<Vector>& x) const;

  Eigen::SimplicialLDLT<SparseMatrix> symmetric_;
  std::optional<Eigen::SparseLU<SparseMatrix>> general_;
  bool analysed_ = false;
  std::int64_t weakest_ = kNoEquation;
  double operations_ = 0, entries_ = 0;
};

}  // namespace cleave
