// By Eigen's simplicial factorisation, with an ordering by approximate minimum degree.
#include <Eigen/SparseCholesky>
#include <algorithm>

#include "solver/symmetric_factor.hpp"

namespace cleave {

namespace {

// Right-hand sides that are solved for together, beside each other in memory.
constexpr int kTogether = 4;
using Few = Eigen::Matrix<double, Eigen::Dynamic, kTogether, Eigen::RowMajor>;
using Row = Eigen::Matrix<double, 1, kTogether>;

}  // namespace

struct SymmetricFactor::Library {
  Eigen::SimplicialLDLT<SparseMatrix> factor;
  bool analysed = false;

  void solve_together(std::span<const SparseColumn> b, std::vector<Vector>& x) const;
};

SymmetricFactor::SymmetricFactor() : library_(std::make_unique<Library>()) {}
SymmetricFactor::~SymmetricFactor() = default;

bool SymmetricFactor::factor(const SparseMatrix& k) {
  if (!library_->analysed) library_->factor.analyzePattern(k);
  library_->analysed = true;
  library_->factor.factorize(k);
  return library_->factor.info() == Eigen::Success;
}

SymmetricFactor::Pivots SymmetricFactor::pivots() const {
  Pivots found{library_->factor.vectorD(), {}, {}};
  const auto* begin = library_->factor.matrixL().nestedExpression().outerIndexPtr();
  const auto& equation = library_->factor.permutationPinv().indices();
  for (Eigen::Index c = 0; c < found.values.size(); ++c) {
    found.equations.push_back(equation[c]);
    found.entries.push_back(1 + begin[c + 1] - begin[c]);
  }
  return found;
}

Vector SymmetricFactor::solve(const Vector& b) const { return library_->factor.solve(b); }

// The factor is read once for some of them, and only as far as their entries reach.
void SymmetricFactor::solve(std::span<const SparseColumn> b, std::vector<Vector>& x) const {
  constexpr std::size_t kMost = kTogether;
  for (std::size_t first = 0; first < b.size(); first += kMost)
    library_->solve_together(b.subspan(first, std::min(kMost, b.size() - first)), x);
}

// P^T L^-T D^-1 L^-1 P b
void SymmetricFactor::Library::solve_together(std::span<const SparseColumn> b,
                                              std::vector<Vector>& x) const {
  const auto& lower = factor.matrixL().nestedExpression();
  const auto* begin = lower.outerIndexPtr();
  const auto* row = lower.innerIndexPtr();
  const auto* value = lower.valuePtr();
  const auto& place = factor.permutationP().indices();
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
  const Vector pivots = factor.vectorD();
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

bool SymmetricFactor::can_follow() { return false; }
bool SymmetricFactor::add(std::span<const SparseColumn>) { return false; }
bool SymmetricFactor::subtract(std::span<const SparseColumn>) { return false; }

}  // namespace cleave
