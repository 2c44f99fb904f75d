// Cuts points into blocks of nearly equal size by recursive coordinate bisection: neighbours in space
// become neighbours in memory, whatever order they came in. Depends on positions and counts alone.
#pragma once

#include <cstdint>
#include <vector>

namespace cleave {

struct Blocking {
  std::vector<std::int32_t> order;  // (n) the points, block after block
  std::vector<std::int32_t> begin;  // (blocks+1) into order
  std::int32_t blocks() const { return static_cast<std::int32_t>(begin.size()) - 1; }
};

// [in] X (3,n), of which `dimension` components count     [in] blocks: 1 <= blocks <= n
Blocking bisect(const double* X, std::int64_t n, int dimension, std::int64_t blocks);

}  // namespace cleave
