#include "core/bisection.hpp"

#include <algorithm>
#include <array>
#include <limits>
#include <numeric>

#include "core/tensor.hpp"

namespace cleave {

namespace {

// Inside a block the points follow from leaf to leaf; a leaf of this size fills a few cache lines.
constexpr std::int64_t kLeaf = 16;

using Place = std::vector<std::int32_t>::iterator;

int longest_axis(const double* X, int dimension, Place first, Place last) {
  std::array<double, 3> low, high;
  low.fill(std::numeric_limits<double>::infinity());
  high.fill(-std::numeric_limits<double>::infinity());
  for (Place i = first; i != last; ++i)
    for (std::size_t k = 0; k < static_cast<std::size_t>(dimension); ++k) {
      const double x = X[kVector * *i + static_cast<std::int64_t>(k)];
      low[k] = std::min(low[k], x);
      high[k] = std::max(high[k], x);
    }
  std::size_t axis = 0;
  for (std::size_t k = 1; k < static_cast<std::size_t>(dimension); ++k)
    if (high[k] - low[k] > high[axis] - low[axis]) axis = k;
  return static_cast<int>(axis);
}

void split(const double* X, int dimension, Place first, Place last, std::int64_t blocks,
           std::int32_t* counts) {
  const std::int64_t n = last - first;
  if (blocks == 1) {
    *counts = static_cast<std::int32_t>(n);
    return;
  }
  const std::int64_t left = blocks / 2;
  const Place middle = first + n * left / blocks;
  const int axis = longest_axis(X, dimension, first, last);
  // Ties go by number, so that the cut is the same for every library.
  std::nth_element(first, middle, last, [X, axis](std::int32_t a, std::int32_t b) {
    const double xa = X[kVector * a + axis], xb = X[kVector * b + axis];
    return xa < xb || (xa == xb && a < b);
  });
  split(X, dimension, first, middle, left, counts);
  split(X, dimension, middle, last, blocks - left, counts + left);
}

}  // namespace

Blocking bisect(const double* X, std::int64_t n, int dimension, std::int64_t blocks) {
  Blocking b;
  b.order.resize(static_cast<std::size_t>(n));
  std::iota(b.order.begin(), b.order.end(), 0);
  b.begin.assign(static_cast<std::size_t>(blocks) + 1, 0);
  split(X, dimension, b.order.begin(), b.order.end(), blocks, b.begin.data() + 1);
  for (std::size_t k = 1; k < b.begin.size(); ++k) b.begin[k] += b.begin[k - 1];
  for (std::size_t k = 1; k < b.begin.size(); ++k) {
    const Place first = b.order.begin() + b.begin[k - 1], last = b.order.begin() + b.begin[k];
    const std::int64_t leaves = std::max<std::int64_t>(1, (last - first) / kLeaf);
    std::vector<std::int32_t> counts(static_cast<std::size_t>(leaves));
    split(X, dimension, first, last, leaves, counts.data());
    Place leaf = first;
    for (const std::int32_t count : counts) {
      std::sort(leaf, leaf + count);
      leaf += count;
    }
  }
  return b;
}

}  // namespace cleave
