#include "solver/linear_solver.hpp"

#include <algorithm>
#include <cmath>

namespace cleave {

namespace {

// Of the entry on the diagonal: what is left of it where nothing resists is rounding, 1e-16 times the steps it took.
constexpr double kSmallestPivot = 1e-12;
// Right-hand sides that are solved for together, beside each other in memory.
constexpr int kTogether = 4;
using Few = Eigen::Matrix<double, Eigen::Dynamic, kTogether, Eigen::RowMajor>;
using Row = Eigen::Matrix<double, 1, kTogether>;

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

Vector DirectSolver::solve(const Vector& b) const {
  if (general_) return general_->solve(b);
  return symmetric_.solve(b);
}

void DirectSolver::solve(std::span<const SparseColumn> b, std::vector<Vector>& x) const {
  constexpr std::size_t kMost = kTogether;
  for (std::size_t first = 0; first < b.size(); first += kMost)
    solve_together(b.subspan(first, std::min(kMost, b.size() - first)), x);
}

// P^T L^-T D^-1 L^-1 P b
void DirectSolver::solve_together(std::span<const SparseColumn> b, std::vector<Vector>& x) const {
  const auto& lower = symmetric_.matrixL().nestedExpression();
  const auto* begin = lower.outerIndexPtr();
  const auto* row = lower.innerIndexPtr();
  const auto* value = lower.valuePtr();
  const auto& place = symmetric_.permutationP().indices();
  const Eigen::Index n = lower.cols();
  Few y = Few::Zero(n, kTogether);
  for (std::size_t c = 0; c < b.size(); ++c)
    for (const auto& [equation, entry] : b[c])
      y(place[equation], static_cast<Eigen::Index>(c)) += entry;
  for (Eigen::Index j = 0; j < n; ++j) {
    const Row known = y.row(j);
    if ((known.array() == 0).all()) continue;
    for (auto p = begin[j]; p < begin[j + 1]; ++p) y.row(row[p]) -= value[p] * known;
  }
  const Vector pivots = symmetric_.vectorD();
  for (Eigen::Index j = n; j-- > 0;) {
    Row sum = y.row(j) / pivots[j];
    for (auto p = begin[j]; p < begin[j + 1]; ++p) sum -= value[p] * y.row(row[p]);
    y.row(j) = sum;
  }
  for (std::size_t c = 0; c < b.size(); ++c) {
    Vector& solved = x.emplace_back(n);
    for (Eigen::Index e = 0; e < n; ++e) solved[e] = y(place[e], static_cast<Eigen::Index>(c));
  }
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
