#include "solver/linear_solver.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

namespace cleave {

namespace {

// Of the entry on the diagonal: what is left of it where nothing resists is rounding, 1e-16 times the steps it took.
constexpr double kSmallestPivot = 1e-12;

// Sum of the columns, each times its factor, in the order of the equations.
SparseColumn combined(std::span<const SparseColumn> columns, const Vector& factors) {
  SparseColumn all, sum;
  for (std::size_t c = 0; c < columns.size(); ++c)
    for (const auto& [equation, entry] : columns[c])
      all.emplace_back(equation, factors[static_cast<Eigen::Index>(c)] * entry);
  std::stable_sort(all.begin(), all.end(),
                   [](const auto& a, const auto& b) { return a.first < b.first; });
  for (const auto& [equation, entry] : all) {
    if (sum.empty() || sum.back().first != equation) sum.emplace_back(equation, 0.0);
    sum.back().second += entry;
  }
  return sum;
}

}  // namespace

bool DirectSolver::factor(const SparseMatrix& k, bool symmetric) {
  general_.reset();
  weakest_ = kNoEquation;
  if (symmetric && symmetric_.factor(k)) {
    diagonal_ = k.diagonal();
    return well_conditioned(false);
  }
  general_.emplace(k);
  return general_->info() == Eigen::Success;
}

Vector DirectSolver::solve(const Vector& b) const {
  if (general_) return general_->solve(b);
  return symmetric_.solve(b);
}

void DirectSolver::solve(std::span<const SparseColumn> b, std::vector<Vector>& x) const {
  if (!general_) return symmetric_.solve(b, x);
  for (const SparseColumn& column : b) {
    Vector dense = Vector::Zero(general_->rows());
    for (const auto& [equation, entry] : column) dense[equation] += entry;
    x.push_back(general_->solve(dense));
  }
}

// W = Q L Q^T: the columns of V Q, times the roots of L, are added where L > 0 and subtracted where L < 0, in this
// order, which keeps it positive definite on the way.
bool DirectSolver::follow(std::span<const SparseColumn> v, std::span<const double> w) {
  constexpr double kNothing = 1e-15;  // of the largest
  const auto size = static_cast<Eigen::Index>(v.size());
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> parts(
      Eigen::Map<const Eigen::MatrixXd>(w.data(), size, size));
  const double largest = parts.eigenvalues().cwiseAbs().maxCoeff();
  std::vector<SparseColumn> added, subtracted;
  for (Eigen::Index k = 0; k < size; ++k) {
    const double value = parts.eigenvalues()[k];
    if (!(std::fabs(value) > kNothing * largest)) continue;
    const Vector factors = std::sqrt(std::fabs(value)) * parts.eigenvectors().col(k);
    SparseColumn& column = (value > 0 ? added : subtracted).emplace_back(combined(v, factors));
    for (const auto& [equation, entry] : column)
      diagonal_[equation] += value > 0 ? entry * entry : -entry * entry;
  }
  return symmetric_.add(added) && symmetric_.subtract(subtracted) && well_conditioned(true);
}

bool DirectSolver::well_conditioned(bool positive) {
  const SymmetricFactor::Pivots pivots = symmetric_.pivots();
  operations_ = entries_ = 0;
  for (std::size_t c = 0; c < pivots.entries.size(); ++c) {
    const auto count = static_cast<double>(pivots.entries[c]);
    operations_ += count * count;
    entries_ += count;
    const std::int64_t equation = pivots.equations[c];
    const double pivot = pivots.values[static_cast<Eigen::Index>(c)];
    if (weakest_ == kNoEquation &&
        !((positive ? pivot : std::fabs(pivot)) > kSmallestPivot * std::fabs(diagonal_[equation])))
      weakest_ = equation;
  }
  return weakest_ == kNoEquation;
}

}  // namespace cleave
