// Loops over blocks: every entry once, and sums that do not depend on threads.
#include "core/blocks.hpp"

#include <gtest/gtest.h>

#include "support/meshes.hpp"

namespace cleave {
namespace {

TEST(Blocks, VisitEveryEntryOnce) {
  for (const std::int64_t n : {0, 1, 511, 512, 513, 5000}) {
    for (const int threads : {1, 3}) {
      ThreadTeam team(threads);
      std::vector<int> visits(static_cast<std::size_t>(n), 0);
      for_blocks(team, n, [&](std::int64_t block, std::int64_t first, std::int64_t last) {
        EXPECT_EQ(first, block * kBlock);
        EXPECT_LE(last - first, kBlock);
        for (std::int64_t i = first; i < last; ++i) ++visits[static_cast<std::size_t>(i)];
      });
      EXPECT_EQ(visits, std::vector<int>(static_cast<std::size_t>(n), 1));
    }
  }
}

TEST(Blocks, SumIsTheSameForAnyNumberOfThreads) {
  constexpr std::int64_t n = 20000;
  test::Random random(1);
  std::vector<double> a(n);
  for (double& x : a) x = random();
  const auto sum = [&](int threads) {
    ThreadTeam team(threads);
    BlockSums<1> sums;
    sums.resize(n);
    for_blocks(team, n, [&](std::int64_t block, std::int64_t first, std::int64_t last) {
      double s = 0;
      for (std::int64_t i = first; i < last; ++i) s += a[static_cast<std::size_t>(i)];
      sums[block] = {s};
    });
    return sums.total()[0];
  };
  const double one = sum(1);
  for (const int threads : {2, 3, 7}) EXPECT_EQ(sum(threads), one);
}

}  // namespace
}  // namespace cleave
