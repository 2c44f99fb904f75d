// Components of points to lanes and back, against single loads, with what lies between left alone.
#include "core/lane_memory.hpp"

#include <gtest/gtest.h>

#include <numeric>
#include <vector>

namespace cleave {
namespace {

template <int K, int W>
void there_and_back(std::int64_t stride) {
  using P = Pack<W>;
  std::vector<double> numbers(static_cast<std::size_t>(stride * W + 3));
  std::iota(numbers.begin(), numbers.end(), 1.0);
  P c[K];
  load_components<K>(numbers.data() + 1, stride, c);
  for (int k = 0; k < K; ++k)
    for (int l = 0; l < W; ++l)
      ASSERT_EQ(lane(c[k], l), static_cast<double>(2 + k + stride * l)) << K << " " << W;
  auto expected = numbers;
  for (int k = 0; k < K; ++k) {
    c[k] = -c[k];
    for (int l = 0; l < W; ++l) expected[static_cast<std::size_t>(1 + k + stride * l)] *= -1;
  }
  store_components<K>(c, numbers.data() + 1, stride);
  EXPECT_EQ(numbers, expected) << K << " " << W;
}

template <int W>
void all_counts() {
  there_and_back<1, W>(1);
  there_and_back<2, W>(3);
  there_and_back<3, W>(3);
  there_and_back<4, W>(7);
  there_and_back<5, W>(9);
  there_and_back<6, W>(8);
  there_and_back<9, W>(9);
  there_and_back<12, W>(12);
}
TEST(LaneMemory, TransposesAndLeavesTheRestAlone) {
  all_counts<2>();
  all_counts<4>();
  all_counts<8>();
}

TEST(LaneMemory, TensorsStandWhereTheirIndicesSay) {
  using P = Pack<4>;
  double array[36], padded[48];
  for (int l = 0; l < 4; ++l)
    for (int k = 0; k < 9; ++k) array[9 * l + k] = 100 * (k % 3 + 1) + 10 * (k / 3 + 1) + l;
  const Full<P> t = load_full<P>(array);
  EXPECT_EQ(lane(t.xy, 2), 122);
  EXPECT_EQ(lane(t.zx, 1), 311);
  EXPECT_EQ(lane(t.zz, 3), 333);
  store_padded(t, padded);
  for (int l = 0; l < 4; ++l)
    for (int i = 0; i < 3; ++i) {
      for (int j = 0; j < 3; ++j)
        EXPECT_EQ(padded[12 * l + 4 * i + j], 100 * (i + 1) + 10 * (j + 1) + l);
      EXPECT_EQ(padded[12 * l + 4 * i + 3], 0);
    }
  double back[36], one[9];
  store_full(load_padded<P>(padded), back);
  for (int k = 0; k < 36; ++k) EXPECT_EQ(back[k], array[k]);
  store_full(load_full<double>(array + 9), one);
  for (int k = 0; k < 9; ++k) EXPECT_EQ(one[k], array[9 + k]);
}

}  // namespace
}  // namespace cleave
