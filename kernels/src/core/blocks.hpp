// Loops over fixed blocks of entries, and sums in block order.
//
// The block is the unit of work. Its size never depends on the number of threads, and every sum is
// formed inside blocks and then over blocks in order, so results do not depend on threads, bit for
// bit.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

#include "core/thread_team.hpp"

namespace cleave {

inline constexpr std::int64_t kBlock =
    512;  // particles; 8192 bytes a scalar pair: fits L1 with company

constexpr std::int64_t block_count(std::int64_t n) { return (n + kBlock - 1) / kBlock; }

// f(block, first, last) for every block, by the threads of the team. f must not throw and must only write
// what belongs to its block.
template <class F>
void for_blocks(ThreadTeam& team, std::int64_t n, const F& f) {
  team.for_blocks(block_count(n),
                  [&](std::int64_t b) { f(b, b * kBlock, std::min(n, (b + 1) * kBlock)); });
}

// K partial sums a block; allocated once.
template <int K>
class BlockSums {
 public:
  void resize(std::int64_t n) { partial_.assign(static_cast<std::size_t>(block_count(n)), {}); }
  std::array<double, K>& operator[](std::int64_t block) {
    return partial_[static_cast<std::size_t>(block)];
  }
  std::array<double, K> total() const {
    std::array<double, K> sum{};
    for (const auto& p : partial_)
      for (int k = 0; k < K; ++k)
        sum[static_cast<std::size_t>(k)] += p[static_cast<std::size_t>(k)];
    return sum;
  }

 private:
  std::vector<std::array<double, K>> partial_;
};

}  // namespace cleave
