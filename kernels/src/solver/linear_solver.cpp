#include "solver/linear_solver.hpp"

#include <cmath>

namespace cleave {

namespace {

// Of the entry on the diagonal: what is left of it where nothing resists is rounding, 1e-16 times the steps it took.
constexpr double kSmallestPivot = 1e-12;

}  // namespace

bool DirectSolver::factor(const SparseMatrix& k, bool symmetric) {
  general_.reset();
  weakest_ = kNoEquation;
  if (symmetric) {
    if (!analysed_) symmetric_.analyzePattern(k);
    analysed_ = true;
    symmetric_.factorize(k);
    if (symmetric_.info() == Eigen::Success) return well_conditioned(k.diagonal().cwiseAbs());
  }
  general_.emplace(k);
  return general_->info() == Eigen::Success;
}

bool DirectSolver::well_conditioned(const Vector& diagonal) {
  const Vector pivots = symmetric_.vectorD().cwiseAbs();
  const auto* begin = symmetric_.matrixL().nestedExpression().outerIndexPtr();
  operations_ = entries_ = 0;
  for (Eigen::Index c = 0; c < pivots.size(); ++c) {
    const double count = 1 + begin[c + 1] - begin[c];
    operations_ += count * count;
    entries_ += count;
  }
  const auto& equation = symmetric_.permutationPinv().indices();
  for (Eigen::Index c = 0; c < pivots.size() && weakest_ == kNoEquation; ++c)
    if (!(pivots[c] > kSmallestPivot * diagonal[equation[c]])) weakest_ = equation[c];
  return weakest_ == kNoEquation;
}

}  // namespace cleave
