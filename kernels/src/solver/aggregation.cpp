#include "solver/aggregation.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace cleave {

namespace {

constexpr std::int32_t kNone = -1;

// The nodes as a graph: neighbours with a coupling that matters.
class Graph {
 public:
  Graph(const SparseMatrix& k, const Nodes& nodes) {
    const auto count = static_cast<std::size_t>(nodes.count());
    std::vector<std::int32_t> node(static_cast<std::size_t>(k.rows()));
    for (std::size_t a = 0; a < count; ++a)
      for (auto c = nodes.begin[a]; c < nodes.begin[a + 1]; ++c)
        node[static_cast<std::size_t>(c)] = static_cast<std::int32_t>(a);
    std::vector<double> own(count, 0.0);  // trace of the block on the diagonal over its size
    for (std::size_t a = 0; a < count; ++a) {
      for (auto c = nodes.begin[a]; c < nodes.begin[a + 1]; ++c) own[a] += std::fabs(k.coeff(c, c));
      own[a] /= std::max(1, nodes.begin[a + 1] - nodes.begin[a]);
    }
    begin_.reserve(count + 1);
    begin_.push_back(0);
    std::vector<double> weight(count, 0.0);  // squared norm of the block of a neighbour
    std::vector<std::int32_t> met;
    for (std::size_t a = 0; a < count; ++a) {
      met.clear();
      for (auto c = nodes.begin[a]; c < nodes.begin[a + 1]; ++c)
        for (SparseMatrix::InnerIterator entry(k, c); entry; ++entry) {
          const std::int32_t b = node[static_cast<std::size_t>(entry.row())];
          double& sum = weight[static_cast<std::size_t>(b)];
          if (sum == 0 && entry.value() != 0) met.push_back(b);
          sum += entry.value() * entry.value();
        }
      std::sort(met.begin(), met.end());
      for (const std::int32_t b : met) {
        double& sum = weight[static_cast<std::size_t>(b)];
        if (b != static_cast<std::int32_t>(a) &&
            sum > kStrong * kStrong * own[a] * own[static_cast<std::size_t>(b)]) {
          neighbour_.push_back(b);
          strength_.push_back(sum);
        }
        sum = 0;
      }
      begin_.push_back(neighbour_.size());
    }
  }
  // f(neighbour, strength)
  template <class F>
  void for_neighbours(std::size_t a, const F& f) const {
    for (std::size_t b = begin_[a]; b < begin_[a + 1]; ++b)
      f(static_cast<std::size_t>(neighbour_[b]), strength_[b]);
  }

 private:
  static constexpr double kStrong = 0.08;
  std::vector<std::size_t> begin_;
  std::vector<std::int32_t> neighbour_;
  std::vector<double> strength_;
};

}  // namespace

Nodes particles_of(const Equations& equations, const Body& body) {
  const double* X = body.point.X;
  const int dimension = body.dimension();
  constexpr std::size_t kVectorSize = 3;
  Nodes out;
  std::vector<std::pair<std::size_t, int>> dof;
  for (std::size_t c = 0; c < equations.of.size(); ++c) {
    if (equations.of[c] < 0) continue;
    if (dof.empty() || dof.back().first != c / kVectorSize)
      out.begin.push_back(static_cast<std::int32_t>(dof.size()));
    dof.emplace_back(c / kVectorSize, static_cast<int>(c % kVectorSize));
  }
  out.begin.push_back(static_cast<std::int32_t>(dof.size()));
  double centre[3] = {}, reach = 0;
  for (const auto& [i, k] : dof)
    for (std::size_t j = 0; j < kVectorSize; ++j)
      centre[j] += X[kVectorSize * i + j] / static_cast<double>(dof.size());
  for (const auto& [i, k] : dof)
    for (std::size_t j = 0; j < kVectorSize; ++j)
      reach = std::fmax(reach, std::fabs(X[kVectorSize * i + j] - centre[j]));
  out.modes.setZero(std::ssize(dof), dimension == 2 ? 3 : 6);
  for (std::size_t row = 0; row < dof.size(); ++row) {
    const auto [i, k] = dof[row];
    const auto r = static_cast<Eigen::Index>(row);
    out.modes(r, k) = 1;
    const auto arm = [&](int axis) {
      return (X[kVectorSize * i + static_cast<std::size_t>(axis)] - centre[axis]) /
             (reach > 0 ? reach : 1.0);
    };
    // Rotation about axis `a`: component a+1 moves with -x_(a+2), component a+2 with x_(a+1).
    for (int a = 0; a < 3; ++a) {
      const int column = dimension == 2 ? 2 : 3 + a;
      if (dimension == 2 && a != 2) continue;
      if (k == (a + 1) % 3) out.modes(r, column) = -arm((a + 2) % 3);
      if (k == (a + 2) % 3) out.modes(r, column) = arm((a + 1) % 3);
    }
  }
  return out;
}

std::int32_t aggregate(const SparseMatrix& k, const Nodes& nodes,
                       std::vector<std::int32_t>& group) {
  const Graph graph(k, nodes);
  const auto count = static_cast<std::size_t>(nodes.count());
  group.assign(count, kNone);
  std::int32_t groups = 0;
  // A node and all its neighbours, while none of them has a group.
  for (std::size_t a = 0; a < count; ++a) {
    bool free = group[a] == kNone;
    std::size_t number = 0;
    graph.for_neighbours(a, [&](std::size_t b, double) {
      free = free && group[b] == kNone;
      ++number;
    });
    if (!free || number == 0) continue;
    group[a] = groups;
    graph.for_neighbours(a, [&](std::size_t b, double) { group[b] = groups; });
    ++groups;
  }
  // Those between go to the group of the neighbour that holds them most.
  const std::vector<std::int32_t> first = group;
  for (std::size_t a = 0; a < count; ++a) {
    if (first[a] != kNone) continue;
    double most = 0;
    graph.for_neighbours(a, [&](std::size_t b, double strength) {
      if (first[b] == kNone || strength <= most) return;
      most = strength;
      group[a] = first[b];
    });
  }
  for (std::size_t a = 0; a < count; ++a) {
    if (group[a] != kNone) continue;
    group[a] = groups;
    graph.for_neighbours(a, [&](std::size_t b, double) {
      if (group[b] == kNone) group[b] = groups;
    });
    ++groups;
  }
  return groups;
}

SparseRows tentative_prolongation(const Nodes& nodes, const std::vector<std::int32_t>& group,
                                  std::int32_t groups, Nodes& coarse) {
  const Eigen::Index unknowns = nodes.modes.rows(), number = nodes.modes.cols();
  // Members of every group, in order.
  std::vector<std::int32_t> begin(static_cast<std::size_t>(groups) + 1, 0), member(group.size());
  for (const std::int32_t g : group) ++begin[static_cast<std::size_t>(g) + 1];
  for (std::size_t g = 1; g < begin.size(); ++g) begin[g] += begin[g - 1];
  std::vector<std::int32_t> next = begin;
  for (std::size_t a = 0; a < group.size(); ++a)
    member[static_cast<std::size_t>(next[static_cast<std::size_t>(group[a])]++)] =
        static_cast<std::int32_t>(a);

  coarse.begin.assign(1, 0);
  Eigen::MatrixXd coarse_modes(static_cast<Eigen::Index>(groups) * number, number);
  std::vector<Eigen::Triplet<double, std::int32_t>> entries;
  entries.reserve(static_cast<std::size_t>(unknowns * number));
  std::vector<std::int32_t> row;
  for (std::size_t g = 0; g + 1 < begin.size(); ++g) {
    row.clear();
    for (auto m = begin[g]; m < begin[g + 1]; ++m) {
      const auto a = static_cast<std::size_t>(member[static_cast<std::size_t>(m)]);
      for (auto c = nodes.begin[a]; c < nodes.begin[a + 1]; ++c) row.push_back(c);
    }
    Eigen::MatrixXd modes(std::ssize(row), number), basis(std::ssize(row), number);
    for (std::size_t r = 0; r < row.size(); ++r)
      modes.row(static_cast<Eigen::Index>(r)) = nodes.modes.row(row[r]);
    Eigen::Index rank = 0;
    constexpr double kDependent = 1e-9;  // of a mode's norm: a few nodes have fewer motions
    for (Eigen::Index m = 0; m < number && rank < modes.rows(); ++m) {
      Vector v = modes.col(m);
      const double norm = v.norm();
      for (int pass = 0; pass < 2; ++pass)
        for (Eigen::Index q = 0; q < rank; ++q) v -= basis.col(q).dot(v) * basis.col(q);
      if (!(v.norm() > kDependent * norm)) continue;
      basis.col(rank++) = v / v.norm();
    }
    const std::int32_t column = coarse.begin.back();
    for (std::size_t r = 0; r < row.size(); ++r)
      for (Eigen::Index q = 0; q < rank; ++q)
        entries.emplace_back(row[r], column + static_cast<std::int32_t>(q),
                             basis(static_cast<Eigen::Index>(r), q));
    coarse_modes.middleRows(column, rank) = basis.leftCols(rank).transpose() * modes;
    coarse.begin.push_back(column + static_cast<std::int32_t>(rank));
  }
  coarse.modes = coarse_modes.topRows(coarse.begin.back());
  SparseRows out(unknowns, coarse.begin.back());
  out.setFromTriplets(entries.begin(), entries.end());
  return out;
}

}  // namespace cleave
