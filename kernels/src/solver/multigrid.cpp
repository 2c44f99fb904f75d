#include "solver/multigrid.hpp"

#include <algorithm>
#include <cmath>
#include <span>
#include <utility>

#include "core/lanczos.hpp"

namespace cleave {

namespace {

// A symmetric matrix by columns is its own by rows.
using RowView = Eigen::Map<const SparseRows>;

constexpr Eigen::Index kFactorised = 500;  // unknowns of the coarsest level, at most
constexpr int kSmoothings = 2;  // degree of the polynomial, before and after the coarse correction
constexpr int kLanczosSteps = 10;
constexpr double kMargin = 1.1;  // above what these find: it comes from below

// Largest eigenvalue of D^-1 K, from above: Chebyshev polynomials grow beyond it.
double highest_eigenvalue(const SparseMatrix& k, const Vector& diagonal, ThreadTeam& team) {
  double bound = 0;
  for (Eigen::Index i = 0; i < k.cols(); ++i) {
    double sum = 0;
    for (SparseMatrix::InnerIterator entry(k, i); entry; ++entry) sum += std::fabs(entry.value());
    bound = std::fmax(bound, sum / diagonal[i]);
  }
  const auto product = [&](std::span<const double> x, std::span<double> y) {
    for_rows(team, k.cols(), [&](std::int64_t i) {
      y[static_cast<std::size_t>(i)] = row_times(k, x, i) / diagonal[i];
    });
  };
  const std::span mass(diagonal.data(), static_cast<std::size_t>(diagonal.size()));
  return std::fmin(bound, kMargin * largest_eigenvalue(mass, product, kLanczosSteps));
}

}  // namespace

Multigrid::Kind Multigrid::add_level(const SparseMatrix& k, Nodes& nodes) {
  auto level = std::make_unique<Level>();
  level->inverse = k.diagonal();
  std::int64_t place = 0;
  const Kind kind = judge(level->inverse, place);
  if (kind == Kind::singular) name_weakest(place);
  if (kind != Kind::definite) return kind;
  level->highest = highest_eigenvalue(k, level->inverse, team_);
  for (double& d : level->inverse) d = 1 / d;
  std::vector<std::int32_t> group;
  const std::int32_t groups = aggregate(k, nodes, group);
  Nodes coarse;
  const SparseRows tentative = tentative_prolongation(nodes, group, groups, coarse);
  const RowView rows(k.rows(), k.cols(), k.nonZeros(), k.outerIndexPtr(), k.innerIndexPtr(),
                     k.valuePtr());
  // (1 - omega D^-1 K) tentative: less energy in the coarse motions.
  const double omega = 4.0 / (3.0 * level->highest);
  SparseRows correction = rows * tentative;
  for (Eigen::Index i = 0; i < correction.rows(); ++i)
    for (SparseRows::InnerIterator entry(correction, i); entry; ++entry)
      entry.valueRef() *= omega * level->inverse[i];
  level->up = tentative - correction;
  correction.resize(0, 0);
  level->down = level->up.transpose();
  const SparseRows product = rows * level->up;
  SparseMatrix next = level->down * product;
  for (Vector* v : {&level->r, &level->step, &level->product}) v->setZero(k.rows());
  if (&k == &last_) level->own.swap(last_);
  level->k = &k == &last_ ? &level->own : &k;
  last_.swap(next);
  nodes = std::move(coarse);
  levels_.push_back(std::move(level));
  return Kind::definite;
}

Multigrid::Kind Multigrid::set_up(const SparseMatrix& k, Nodes nodes) {
  levels_.clear();
  weakest_ = kNoEquation;
  if (k.rows() <= kFactorised) {
    last_ = k;
    return factorise_last();
  }
  Kind kind = add_level(k, nodes);
  while (kind == Kind::definite && last_.rows() > kFactorised) {
    if (3 * last_.rows() > 2 * levels_.back()->k->rows()) break;  // it no longer gets much smaller
    kind = add_level(last_, nodes);
  }
  return kind == Kind::definite ? factorise_last() : kind;
}

Multigrid::Kind Multigrid::factorise_last() {
  if (last_.rows() == 0) return Kind::definite;
  bottom_.compute(last_);
  if (bottom_.info() != Eigen::Success) return Kind::singular;
  std::int64_t place = 0;
  const Kind kind = judge(bottom_.vectorD(), place);
  if (kind == Kind::singular) name_weakest(bottom_.permutationPinv().indices()[place]);
  return kind;
}

// After a pivot that is rounding the next may be anything: small ones are looked for first.
Multigrid::Kind Multigrid::judge(const Vector& values, std::int64_t& place) const {
  // Of the largest. Measured: loose bodies 1e-16 to 1e-13, a strip 2500 times as long as wide 2.5e-9.
  constexpr double kNothing = 1e-11;
  const Vector sizes = values.cwiseAbs();
  Eigen::Index least = 0;
  const bool regular = sizes.minCoeff(&least) > kNothing * sizes.maxCoeff();
  place = least;
  if (!regular) return Kind::singular;
  return values.minCoeff() > 0 ? Kind::definite : Kind::indefinite;
}

// From the coarsest level there is to the first: where its motion is largest.
void Multigrid::name_weakest(std::int64_t unknown) {
  weakest_ = unknown;
  for (auto level = levels_.rbegin(); level != levels_.rend(); ++level) {
    double most = 0;
    std::int64_t above = 0;
    for (SparseRows::InnerIterator entry((*level)->down, weakest_); entry; ++entry)
      if (std::fabs(entry.value()) > most) {
        most = std::fabs(entry.value());
        above = entry.col();
      }
    weakest_ = above;
  }
}

// Chebyshev polynomials of the fourth kind: they need no lower end of the spectrum (J. Lottes,
// Numerical Linear Algebra with Applications 30 (2023) e2518).
void Multigrid::smooth(Level& level, const Vector& b, Vector& x, bool from_zero) {
  const std::int64_t n = b.size();
  const SparseMatrix& k = *level.k;
  const double first = 4.0 / (3.0 * level.highest);
  for_rows(team_, n, [&](std::int64_t i) {
    level.r[i] = from_zero ? b[i] : b[i] - row_times(k, x, i);
    level.step[i] = first * level.inverse[i] * level.r[i];
  });
  for_rows(team_, n,
           [&](std::int64_t i) { x[i] = from_zero ? level.step[i] : x[i] + level.step[i]; });
  for (int m = 2; m <= kSmoothings; ++m) {
    const double keep = (2.0 * m - 3) / (2.0 * m + 1),
                 add = (8.0 * m - 4) / ((2.0 * m + 1) * level.highest);
    for_rows(team_, n, [&](std::int64_t i) { level.product[i] = row_times(k, level.step, i); });
    for_rows(team_, n, [&](std::int64_t i) {
      level.r[i] -= level.product[i];
      level.step[i] = keep * level.step[i] + add * level.inverse[i] * level.r[i];
      x[i] += level.step[i];
    });
  }
}

void Multigrid::cycle(std::size_t depth, const Vector& b, Vector& x) {
  if (depth == levels_.size()) {
    x = bottom_.solve(b);
    return;
  }
  Level& level = *levels_[depth];
  const std::int64_t n = b.size();
  smooth(level, b, x, true);
  for_rows(team_, n, [&](std::int64_t i) { level.product[i] = b[i] - row_times(*level.k, x, i); });
  Vector restricted(level.down.rows()), correction(level.down.rows());
  for_rows(team_, level.down.rows(),
           [&](std::int64_t i) { restricted[i] = row_times(level.down, level.product, i); });
  cycle(depth + 1, restricted, correction);
  for_rows(team_, n, [&](std::int64_t i) { x[i] += row_times(level.up, correction, i); });
  smooth(level, b, x, false);
}

void Multigrid::apply(const Vector& r, Vector& z) {
  z.resize(r.size());
  cycle(0, r, z);
}

std::int64_t Multigrid::bytes() const {
  constexpr std::int64_t kEntry = sizeof(double) + sizeof(std::int32_t);
  std::int64_t sum = last_.nonZeros() * kEntry;
  for (const auto& level : levels_)
    sum += (level->own.nonZeros() + 2 * level->up.nonZeros()) * kEntry +
           5 * level->inverse.size() * static_cast<std::int64_t>(sizeof(double));
  return sum;
}

}  // namespace cleave
