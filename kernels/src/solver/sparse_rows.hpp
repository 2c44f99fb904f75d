// Sparse matrices by rows and what the iterative solver does with them and with vectors: products and sums by the threads of a
// team, with the same bits for any number of them. How a matrix comes about is not decided here.
#pragma once

#include <Eigen/SparseCore>
#include <cstdint>
#include <type_traits>

#include "core/blocks.hpp"
#include "solver/sparse_matrix.hpp"

namespace cleave {

using SparseRows = Eigen::SparseMatrix<double, Eigen::RowMajor, std::int32_t>;

// (A x)_i; of a matrix by columns (A^T x)_i, the same if it is symmetric.
template <class Matrix, class Values>
double row_times(const Matrix& a, const Values& x, std::int64_t i) {
  const auto* start = a.outerIndexPtr();
  const auto* column = a.innerIndexPtr();
  const double* value = a.valuePtr();
  using Index = std::conditional_t<std::is_same_v<Values, Vector>, Eigen::Index, std::size_t>;
  double sum = 0;
  for (auto k = start[i]; k < start[i + 1]; ++k) sum += value[k] * x[static_cast<Index>(column[k])];
  return sum;
}

// f(i) for every row.
template <class F>
void for_rows(ThreadTeam& team, std::int64_t n, const F& f) {
  for_blocks(team, n, [&](std::int64_t, std::int64_t first, std::int64_t last) {
    for (std::int64_t i = first; i < last; ++i) f(i);
  });
}

// sum_i f(i), in blocks and then over these in order.
template <class F>
double sum_rows(ThreadTeam& team, std::int64_t n, const F& f) {
  BlockSums<1> sums;
  sums.resize(n);
  for_blocks(team, n, [&](std::int64_t block, std::int64_t first, std::int64_t last) {
    double sum = 0;
    for (std::int64_t i = first; i < last; ++i) sum += f(i);
    sums[block][0] = sum;
  });
  return sums.total()[0];
}

}  // namespace cleave
