#include "solver/kept_stiffness.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <span>

#include "model/stiffness_source.hpp"

namespace cleave {

namespace {

// Reciprocal condition number below which the correction has no inverse.
constexpr double kSingular = 1e-10;
// Of the largest entry: far above rounding, far below any stiffness.
constexpr double kHinge = 1e-10;
// Of a bond, but for loose ends: its own and one of each end.
constexpr double kColumns = 3;
// Bonds that iterations correct for: multigrid of the matrix before serves as well that long.
constexpr double kIterated = 50;
// And those that a factor follows by itself: rounding gathers.
constexpr double kFollowed = 1000;

}  // namespace

void KeptStiffness::follow(Body& body, Solver solver, std::int64_t corrections, ThreadTeam& team) {
  std::int32_t& factored = body.fields.integer("factored_bonds")[0];
  const std::int64_t broken = body.formulation->stiffness()->broken_bonds();
  team_ = &team;
  if (solver_ != solver) factored_ = -1;
  solver_ = solver;
  if (factored_ != factored || factored_ + added_ > broken) factorise(body, factored);
  const double most = corrections < 0 ? worthwhile() : static_cast<double>(corrections);
  if (static_cast<double>(broken - factored_) <= most) {
    while (factored_ + added_ < broken) add_change(body, factored_ + added_ + 1);
    if (finish()) return;
  }
  factored = static_cast<std::int32_t>(broken);
  factorise(body, broken);
}

// Over a cycle of m corrections a solution costs F/m + b m/2 more than the factor's own, with F the operations to find it
// and b those of one more correction: least at m = sqrt(2 F/b). And the columns shall not need more memory than twice the factor.
double KeptStiffness::worthwhile() const {
  if (solver_ == Solver::iterative) return kIterated;
  if (base_->can_follow()) return kFollowed;
  const auto n = static_cast<double>(std::max<std::int64_t>(equations_.count, 1));
  const double cycle = std::sqrt(2 * base_->operations() / (2 * n * kColumns));
  const double memory = 2 * static_cast<double>(base_->bytes()) / (8 * n * kColumns);
  return std::fmin(cycle, memory);
}

void KeptStiffness::factorise(const Body& body, std::int64_t broken) {
  factored_ = broken;
  added_ = 0;
  lost_ = false;
  ++factorisations_;
  columns_.clear();
  solved_.clear();
  weights_.clear();
  hinges_ = false;
  cross_.resize(0, 0);
  equations_ = Equations(body, broken);
  Stiffness k;
  assemble_after(body, broken, equations_, k);
  if (factor(body, k.free)) return;
  const std::int64_t weakest = weakest_;
  if (broken > 0 && hold_hinges(body, k.free)) return;
  factored_ = -1;
  throw singular(body, equations_, weakest);
}

// False: it is singular.
bool KeptStiffness::factor(const Body& body, SparseMatrix& k) {
  base_.reset();
  iterative_.reset();
  if (solver_ == Solver::direct) {
    base_ = std::make_unique<DirectSolver>();
    const bool regular = base_->factor(k, true);
    weakest_ = base_->weakest();
    return regular;
  }
  iterative_ = std::make_unique<IterativeSolver>(*team_);
  const Multigrid::Kind kind = iterative_->set_up(k, particles_of(equations_, body));
  weakest_ = iterative_->weakest();
  if (kind == Multigrid::Kind::indefinite)
    throw Error(CLEAVE_NO_CONVERGENCE, text(body.label(), ": no equilibrium: ", kIndefinite));
  return kind == Multigrid::Kind::definite;
}

bool KeptStiffness::renew(Body& body) {
  if (added_ == 0) return false;
  const std::int64_t broken = factored_ + added_;
  body.fields.integer("factored_bonds")[0] = static_cast<std::int32_t>(broken);
  factorise(body, broken);
  return true;
}

// A piece that breaking has left on a hinge can turn without resistance: a little of it, which the forces do
// not know, so that the equilibrium is exact, and not found if the piece is loaded.    [ST hinge]
bool KeptStiffness::hold_hinges(const Body& body, SparseMatrix& k) {
  if (iterative_ != nullptr) k = iterative_->matrix();
  double largest = 0;
  for (Eigen::Index c = 0; c < k.rows(); ++c)
    largest = std::fmax(largest, std::fabs(k.coeff(c, c)));
  for (Eigen::Index c = 0; c < k.rows(); ++c) k.coeffRef(c, c) += kHinge * largest;
  hinges_ = factor(body, k);
  return hinges_;
}

double KeptStiffness::product(const SparseColumn& column, Eigen::Index of) const {
  double sum = 0;
  for (const auto& [equation, value] : column)
    sum += value * solved_[static_cast<std::size_t>(of)][equation];
  return sum;
}

void KeptStiffness::add_change(const Body& body, std::int64_t event) {
  StiffnessChange change;
  body.formulation->stiffness()->stiffness_change(body, event, change);
  const auto d = static_cast<std::size_t>(body.dimension());
  std::vector<SparseColumn> columns;
  for (const auto& column : change.columns) {
    SparseColumn entries;
    for (std::size_t c = 0; c < column.values.size(); ++c) {
      const auto dof =
          static_cast<std::size_t>(kVector) * static_cast<std::size_t>(column.particles[c / d]) +
          c % d;
      const std::int32_t equation = equations_.of[dof];
      if (equation >= 0) entries.emplace_back(equation, column.values[c]);
    }
    columns.push_back(std::move(entries));
  }
  ++added_;
  if (solver_ == Solver::direct && base_->can_follow()) {
    lost_ = lost_ || !base_->follow(columns, change.weight);
    return;
  }
  weights_.push_back(change.weight);
  const Eigen::Index before = std::ssize(columns_);
  std::move(columns.begin(), columns.end(), std::back_inserter(columns_));
  if (solver_ == Solver::direct) solve_columns(before);
}

void KeptStiffness::solve_columns(Eigen::Index before) {
  base_->solve(std::span(columns_).subspan(static_cast<std::size_t>(before)), solved_);
  const Eigen::Index now = std::ssize(columns_);
  cross_.conservativeResize(now, now);
  for (Eigen::Index r = 0; r < now; ++r)
    for (Eigen::Index c = r < before ? before : 0; c < now; ++c)
      cross_(r, c) = product(columns_[static_cast<std::size_t>(r)], c);
}

bool KeptStiffness::finish() {
  if (lost_) return false;
  const Eigen::Index size = std::ssize(columns_);
  weight_ = Eigen::MatrixXd::Zero(size, size);
  Eigen::Index place = 0;
  for (const std::vector<double>& block : weights_) {
    const auto width = static_cast<Eigen::Index>(std::lround(std::sqrt(block.size())));
    for (Eigen::Index r = 0; r < width; ++r)
      for (Eigen::Index c = 0; c < width; ++c)
        weight_(place + r, place + c) = block[static_cast<std::size_t>(width * r + c)];
    place += width;
  }
  if (size == 0 || solver_ == Solver::iterative) return true;
  const Eigen::MatrixXd whole = Eigen::MatrixXd::Identity(size, size) + weight_ * cross_;
  small_.compute(whole);
  return small_.rcond() > kSingular;
}

Vector KeptStiffness::pulled(const Vector& x) const {
  Vector sums = Vector::Zero(std::ssize(columns_));
  for (Eigen::Index c = 0; c < sums.size(); ++c)
    for (const auto& [equation, value] : columns_[static_cast<std::size_t>(c)])
      sums[c] += value * x[equation];
  return sums;
}

// q + V W V^T p
void KeptStiffness::add_changes(const Vector& p, Vector& q) const {
  if (columns_.empty()) return;
  const Vector share = weight_ * pulled(p);
  for (Eigen::Index c = 0; c < share.size(); ++c)
    for (const auto& [equation, value] : columns_[static_cast<std::size_t>(c)])
      q[equation] += share[c] * value;
}

bool KeptStiffness::solve(const Vector& r, double tolerance, Vector& x) {
  if (iterative_ != nullptr) {
    const auto end = iterative_->solve(
        r, tolerance, [this](const Vector& p, Vector& q) { add_changes(p, q); }, x);
    if (end == IterativeSolver::End::converged) return true;
    why_ = iterative_->why(end, tolerance);
    return false;
  }
  x = base_->solve(r);
  if (columns_.empty()) return true;
  const Vector share = small_.solve(weight_ * pulled(x));
  for (Eigen::Index c = 0; c < share.size(); ++c)
    x -= share[c] * solved_[static_cast<std::size_t>(c)];
  return true;
}

std::int64_t KeptStiffness::bytes() const {
  if (iterative_ != nullptr) return iterative_->bytes();
  if (base_ == nullptr) return 0;
  return base_->bytes() + std::ssize(solved_) * equations_.count * 8;
}

}  // namespace cleave
