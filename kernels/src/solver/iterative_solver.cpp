#include "solver/iterative_solver.hpp"

#include <cmath>
#include <utility>

#include "core/error.hpp"

namespace cleave {

Multigrid::Kind IterativeSolver::set_up(SparseMatrix& k, Nodes nodes) {
  k_.swap(k);
  return preconditioner_.set_up(k_, std::move(nodes));
}

IterativeSolver::End IterativeSolver::solve(const Vector& b, double tolerance, const Change& change,
                                            Vector& x) {
  const std::int64_t n = b.size();
  const auto product = [&](const Vector& u, const Vector& v) {
    return sum_rows(team_, n, [&](std::int64_t i) { return u[i] * v[i]; });
  };
  const auto failed = [](double value) { return std::isnan(value) ? End::slow : End::indefinite; };
  x.setZero(n);
  iterations_ = 0;
  residual_ = 0;
  const double given = product(b, b);
  if (given == 0) return End::converged;
  Vector r = b, z(n), p = Vector::Zero(n), q(n);
  double previous = 1;
  for (residual_ = 1; residual_ > tolerance; ++iterations_) {
    if (iterations_ == kMost) return End::slow;
    preconditioner_.apply(r, z);
    const double rz = product(r, z);
    if (!(rz > 0)) return failed(rz);
    const double keep = rz / previous;
    previous = rz;
    for_rows(team_, n, [&](std::int64_t i) { p[i] = z[i] + keep * p[i]; });
    for_rows(team_, n, [&](std::int64_t i) { q[i] = row_times(k_, p, i); });
    if (change) change(p, q);
    const double pq = product(p, q);
    if (!(pq > 0)) return failed(pq);
    const double step = rz / pq;
    for_rows(team_, n, [&](std::int64_t i) {
      x[i] += step * p[i];
      r[i] -= step * q[i];
    });
    residual_ = std::sqrt(product(r, r) / given);
    if (!std::isfinite(residual_)) return End::slow;
  }
  return End::converged;
}

std::string IterativeSolver::why(End end, double tolerance) const {
  if (end == End::indefinite) return kIndefinite;
  return text("the conjugate gradients have a residual of ", residual_, " of the forces after ",
              iterations_, " iterations, wanted ", tolerance, "; use solver = 'direct'");
}

std::int64_t IterativeSolver::bytes() const {
  constexpr std::int64_t kEntry = sizeof(double) + sizeof(std::int32_t);
  return k_.nonZeros() * kEntry + preconditioner_.bytes();
}

}  // namespace cleave
