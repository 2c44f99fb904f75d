#include "solver/linear_solver.hpp"

#include <cmath>

namespace cleave {

namespace {

// Of the largest pivot: rounding of an entry that cancels is 1e-16 of what it was.
constexpr double kSmallestPivot = 1e-14;

}  // namespace

bool DirectSolver::factor(const SparseMatrix& k, bool symmetric) {
  general_.reset();
  weakest_ = kNoEquation;
  if (symmetric) {
    if (!analysed_) symmetric_.analyzePattern(k);
    analysed_ = true;
    symmetric_.factorize(k);
    if (symmetric_.info() == Eigen::Success) return well_conditioned();
  }
  general_.emplace(k);
  return general_->info() == Eigen::Success;
}

bool DirectSolver::well_conditioned() {
  const Vector pivots = symmetric_.vectorD().cwiseAbs();
  const auto* begin = symmetric_.matrixL().nestedExpression().outerIndexPtr();
  operations_ = entries_ = 0;
  for (Eigen::Index c = 0; c < pivots.size(); ++c) {
    const double count = 1 + begin[c + 1] - begin[c];
    operations_ += count * count;
    entries_ += count;
  }
  if (pivots.size() == 0) return true;
  Eigen::Index place = 0;
  const double least = pivots.minCoeff(&place);
  if (least > kSmallestPivot * pivots.maxCoeff()) return true;
  weakest_ = symmetric_.permutationPinv().indices()[place];
  return false;
}

}  // namespace cleave
