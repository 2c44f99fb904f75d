// Several components of each point to lanes and back: consecutive in memory for one point, points a
// stride apart. By transposing blocks of registers, which costs about one instruction a number where
// single loads and insertions cost two or three.
#pragma once

#include "core/lanes.hpp"
#include "core/symmetric.hpp"

namespace cleave {

// kBlock components of N points, point l at base + l * stride.
template <int N>
struct Transposed;

template <>
struct Transposed<2> {
  static constexpr int kBlock = 2;
  using Reals = Native<2>::Reals;
  static Reals row(const double* from) {
    Reals r;
    std::memcpy(&r, from, sizeof r);
    return r;
  }
  static void load(const double* from, std::int64_t stride, Reals (&c)[2]) {
    const Reals a = row(from), b = row(from + stride);
    c[0] = __builtin_shufflevector(a, b, 0, 2);
    c[1] = __builtin_shufflevector(a, b, 1, 3);
  }
  static void store(const Reals (&c)[2], double* to, std::int64_t stride) {
    const Reals a = __builtin_shufflevector(c[0], c[1], 0, 2);
    const Reals b = __builtin_shufflevector(c[0], c[1], 1, 3);
    std::memcpy(to, &a, sizeof a);
    std::memcpy(to + stride, &b, sizeof b);
  }
};

#if defined(__AVX__)
template <>
struct Transposed<4> {
  static constexpr int kBlock = 4;
  using Reals = Native<4>::Reals;
  static Reals row(const double* from) {
    Reals r;
    std::memcpy(&r, from, sizeof r);
    return r;
  }
  static void turn(const Reals (&r)[4], Reals (&c)[4]) {
    const Reals even01 = __builtin_shufflevector(r[0], r[1], 0, 4, 2, 6);
    const Reals odd01 = __builtin_shufflevector(r[0], r[1], 1, 5, 3, 7);
    const Reals even23 = __builtin_shufflevector(r[2], r[3], 0, 4, 2, 6);
    const Reals odd23 = __builtin_shufflevector(r[2], r[3], 1, 5, 3, 7);
    c[0] = __builtin_shufflevector(even01, even23, 0, 1, 4, 5);
    c[1] = __builtin_shufflevector(odd01, odd23, 0, 1, 4, 5);
    c[2] = __builtin_shufflevector(even01, even23, 2, 3, 6, 7);
    c[3] = __builtin_shufflevector(odd01, odd23, 2, 3, 6, 7);
  }
  static void load(const double* from, std::int64_t stride, Reals (&c)[4]) {
    const Reals rows[4] = {row(from), row(from + stride), row(from + 2 * stride),
                           row(from + 3 * stride)};
    turn(rows, c);
  }
  static void store(const Reals (&c)[4], double* to, std::int64_t stride) {
    Reals rows[4];
    turn(c, rows);
    for (int l = 0; l < 4; ++l) std::memcpy(to + l * stride, &rows[l], sizeof rows[l]);
  }
};
#endif

#if defined(__AVX512F__) && defined(__AVX512DQ__)
template <>
struct Transposed<8> {
  static constexpr int kBlock = 4;
  using Reals = Native<8>::Reals;
  using Half = Native<4>::Reals;
  // Points p and p+2 beside each other: then the second step leaves the points in order.
  static Reals row(const double* from, std::int64_t stride, int p) {
    Half low, high;
    std::memcpy(&low, from + p * stride, sizeof low);
    std::memcpy(&high, from + (p + 2) * stride, sizeof high);
    return __builtin_shufflevector(low, high, 0, 1, 2, 3, 4, 5, 6, 7);
  }
  static void put(const Reals& r, double* to, std::int64_t stride, int p) {
    const Half low = __builtin_shufflevector(r, r, 0, 1, 2, 3);
    const Half high = __builtin_shufflevector(r, r, 4, 5, 6, 7);
    std::memcpy(to + p * stride, &low, sizeof low);
    std::memcpy(to + (p + 2) * stride, &high, sizeof high);
  }
  static Reals even(const Reals& a, const Reals& b) {
    return __builtin_shufflevector(a, b, 0, 8, 2, 10, 4, 12, 6, 14);
  }
  static Reals odd(const Reals& a, const Reals& b) {
    return __builtin_shufflevector(a, b, 1, 9, 3, 11, 5, 13, 7, 15);
  }
  static void load(const double* from, std::int64_t stride, Reals (&c)[4]) {
    const Reals r0 = row(from, stride, 0), r1 = row(from, stride, 1);
    const Reals r4 = row(from, stride, 4), r5 = row(from, stride, 5);
    const Reals even0 = even(r0, r1), odd0 = odd(r0, r1);
    const Reals even4 = even(r4, r5), odd4 = odd(r4, r5);
    c[0] = __builtin_shufflevector(even0, even4, 0, 1, 4, 5, 8, 9, 12, 13);
    c[1] = __builtin_shufflevector(odd0, odd4, 0, 1, 4, 5, 8, 9, 12, 13);
    c[2] = __builtin_shufflevector(even0, even4, 2, 3, 6, 7, 10, 11, 14, 15);
    c[3] = __builtin_shufflevector(odd0, odd4, 2, 3, 6, 7, 10, 11, 14, 15);
  }
  static void store(const Reals (&c)[4], double* to, std::int64_t stride) {
    // Pairs of components of points 0 2 4 6 and of points 1 3 5 7.
    const Reals even01 = even(c[0], c[1]), odd01 = odd(c[0], c[1]);
    const Reals even23 = even(c[2], c[3]), odd23 = odd(c[2], c[3]);
    put(__builtin_shufflevector(even01, even23, 0, 1, 8, 9, 2, 3, 10, 11), to, stride, 0);
    put(__builtin_shufflevector(odd01, odd23, 0, 1, 8, 9, 2, 3, 10, 11), to, stride, 1);
    put(__builtin_shufflevector(even01, even23, 4, 5, 12, 13, 6, 7, 14, 15), to, stride, 4);
    put(__builtin_shufflevector(odd01, odd23, 4, 5, 12, 13, 6, 7, 14, 15), to, stride, 5);
  }
};
#endif

// Components base[0], base[1] ... base[K-1] of the points of the lanes, point l at base + l * stride.
template <int K, class R>
CLEAVE_INLINE void load_components(const double* base, std::int64_t, R (&c)[K]) {
  for (int k = 0; k < K; ++k) c[k] = base[k];
}
template <int K, int W, int N>
CLEAVE_INLINE void load_components(const double* base, std::int64_t stride, Pack<W, N> (&c)[K]) {
  using Block = Transposed<N>;
  constexpr int kWhole = K / Block::kBlock * Block::kBlock;
  const auto block_at = [&](int n, int k) CLEAVE_INLINE_CALL {
    typename Block::Reals block[Block::kBlock];
    Block::load(base + n * N * stride + k, stride, block);
    for (int j = 0; j < Block::kBlock; ++j) c[k + j].r[n] = block[j];
  };
  for (int n = 0; n < W / N; ++n) {
    for (int k = 0; k < kWhole; k += Block::kBlock) block_at(n, k);
    // What is left over, with components that have been loaded before.
    if constexpr (kWhole < K && kWhole > 0) block_at(n, K - Block::kBlock);
  }
  if constexpr (kWhole == 0)
    for (int k = 0; k < K; ++k) c[k] = load_lanes<Pack<W, N>, false>(base + k, stride);
}

template <int K, class R>
CLEAVE_INLINE void store_components(const R (&c)[K], double* base, std::int64_t) {
  for (int k = 0; k < K; ++k) base[k] = c[k];
}
template <int K, int W, int N>
CLEAVE_INLINE void store_components(const Pack<W, N> (&c)[K], double* base, std::int64_t stride) {
  using Block = Transposed<N>;
  constexpr int kWhole = K / Block::kBlock * Block::kBlock;
  constexpr bool kOverlap = kWhole > 0 && K - kWhole > 1;
  const auto block_at = [&](int n, int k) CLEAVE_INLINE_CALL {
    typename Block::Reals block[Block::kBlock];
    for (int j = 0; j < Block::kBlock; ++j) block[j] = c[k + j].r[n];
    Block::store(block, base + n * N * stride + k, stride);
  };
  for (int n = 0; n < W / N; ++n) {
    for (int k = 0; k < kWhole; k += Block::kBlock) block_at(n, k);
    if constexpr (kOverlap) block_at(n, K - Block::kBlock);  // some a second time
  }
  if constexpr (!kOverlap)
    for (int k = kWhole; k < K; ++k) store_lanes<Pack<W, N>, false>(c[k], base + k, stride);
}

// Tensors in the order of arrays, 11 21 31 12 22 32 13 23 33, one after the other.
template <class R>
CLEAVE_INLINE Full<R> load_full(const double* base) {
  R c[9];
  load_components<9>(base, 9, c);
  return {c[0], c[3], c[6], c[1], c[4], c[7], c[2], c[5], c[8]};
}
template <class R>
CLEAVE_INLINE void store_full(const Full<R>& t, double* base) {
  const R c[9] = {t.xx, t.yx, t.zx, t.xy, t.yy, t.zy, t.xz, t.yz, t.zz};
  store_components<9>(c, base, 9);
}

// Tensors as three rows of four numbers, the fourth is not used and set to 0: 11 12 13 0 21 22 23 0 31 32 33 0.
inline constexpr std::int64_t kPaddedTensor = 12;
template <class R>
CLEAVE_INLINE Full<R> load_padded(const double* base) {
  R c[12];
  load_components<12>(base, kPaddedTensor, c);
  return {c[0], c[1], c[2], c[4], c[5], c[6], c[8], c[9], c[10]};
}
template <class R>
CLEAVE_INLINE void store_padded(const Full<R>& t, double* base) {
  const R zero(0.0),
      c[12] = {t.xx, t.xy, t.xz, zero, t.yx, t.yy, t.yz, zero, t.zx, t.zy, t.zz, zero};
  store_components<12>(c, base, kPaddedTensor);
}

}  // namespace cleave
