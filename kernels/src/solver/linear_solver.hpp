// Linear systems of the static solver, K x = b with a sparse K: factorised by a library, and what a failure
// says about the body. What K stands for is not known here.
#pragma once

#include <Eigen/SparseCholesky>
#include <Eigen/SparseCore>
#include <Eigen/SparseLU>
#include <cstdint>
#include <optional>

namespace cleave {

using Vector = Eigen::VectorXd;
using SparseMatrix = Eigen::SparseMatrix<double, Eigen::ColMajor, std::int32_t>;

// No equation of a singular system is known to be at fault.
inline constexpr std::int64_t kNoEquation = -1;

class DirectSolver {
 public:
  // False: K is singular; weakest() then is an equation that nothing resists. The entries stand where they
  // stood in the call before.
  bool factor(const SparseMatrix& k, bool symmetric);
  // With one right-hand side or several. The result depends on nothing else.
  template <class B>
  B solve(const B& b) const {
    if (general_) return general_->solve(b);
    return symmetric_.solve(b);
  }
  std::int64_t weakest() const { return weakest_; }
  // Of the symmetric factor: multiplications that it took, and its entries.
  double operations() const { return operations_; }
  double entries() const { return entries_; }
  std::int64_t bytes() const { return static_cast<std::int64_t>(entries_ * 12); }

 private:
  bool well_conditioned(const Vector& diagonal);

  Eigen::SimplicialLDLT<SparseMatrix> symmetric_;
  std::optional<Eigen::SparseLU<SparseMatrix>> general_;
  bool analysed_ = false;
  std::int64_t weakest_ = kNoEquation;
  double operations_ = 0, entries_ = 0;
};

}  // namespace cleave
