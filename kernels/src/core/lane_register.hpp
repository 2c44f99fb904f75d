// One register of N doubles, and the flags of its lanes, for the instruction set that a file is compiled
// for. What lanes.hpp is built on; not for use beside it.
//
// By intrinsics where GCC 12 turns comparisons and selections of its own vector types into scalar moves.
// Every operation is the scalar one in each lane, so the bits do not depend on N.
#pragma once

#include <cmath>
#include <cstdint>
#include <cstring>

#if defined(__SSE2__)
#include <immintrin.h>
#endif

// For functions whose arguments would otherwise travel through memory.
#define CLEAVE_INLINE [[gnu::always_inline]] inline
#define CLEAVE_INLINE_CALL __attribute__((always_inline))  // of a lambda

namespace cleave {

#if defined(__AVX512F__) && defined(__AVX512DQ__)
inline constexpr int kNativeLanes = 8;
#elif defined(__AVX__)
inline constexpr int kNativeLanes = 4;
#else
inline constexpr int kNativeLanes = 2;
#endif

// Flags are a register too, all bits of a lane set or none.
template <int N>
struct Native {
  typedef double Reals __attribute__((vector_size(8 * N)));
  typedef std::int64_t Bits __attribute__((vector_size(8 * N)));
  using Flags = Bits;

  static Flags less(Reals a, Reals b) { return a < b; }
  static Flags less_equal(Reals a, Reals b) { return a <= b; }
  static Flags equal(Reals a, Reals b) { return a == b; }
  static Flags both(Flags a, Flags b) { return a & b; }
  static Flags either(Flags a, Flags b) { return a | b; }
  static Flags without(Flags a, Flags b) { return ~a & b; }  // b where not a
  static Reals choose(Flags m, Reals a, Reals b) {
    return reinterpret_cast<Reals>((m & reinterpret_cast<Bits>(a)) |
                                   (~m & reinterpret_cast<Bits>(b)));
  }
  static Reals smaller(Reals a, Reals b) { return choose(less(a, b), a, b); }
  static Reals larger(Reals a, Reals b) { return choose(less(b, a), a, b); }
  static Reals absolute(Reals a) {
    return reinterpret_cast<Reals>(reinterpret_cast<Bits>(a) & INT64_MAX);
  }
  static Reals root(Reals a) {
    double lanes[N];
    std::memcpy(lanes, &a, sizeof a);
    for (double& x : lanes) x = std::sqrt(x);
    std::memcpy(&a, lanes, sizeof a);
    return a;
  }
  static bool any(Flags m) {
    std::int64_t lanes[N], together = 0;
    std::memcpy(lanes, &m, sizeof m);
    for (const std::int64_t x : lanes) together |= x;
    return together != 0;
  }
  static bool all(Flags m) { return !any(~m); }
  static Reals join(Reals a, Reals b) {  // the bits of both
    return reinterpret_cast<Reals>(reinterpret_cast<Bits>(a) | reinterpret_cast<Bits>(b));
  }
  static bool any_bit(Reals a, std::int64_t bits) { return any(reinterpret_cast<Bits>(a) & bits); }
  static bool flag(Flags m, int l) {
    std::int64_t lanes[N];
    std::memcpy(lanes, &m, sizeof m);
    return lanes[l] != 0;
  }
  static void set_flag(Flags& m, int l, bool value) {
    std::int64_t lanes[N];
    std::memcpy(lanes, &m, sizeof m);
    lanes[l] = value ? -1 : 0;
    std::memcpy(&m, lanes, sizeof m);
  }
};

#if defined(__SSE2__)
template <>
struct Native<2> {
  typedef __m128d Reals;
  typedef __m128i Bits;
  using Flags = Reals;
  static Flags less(Reals a, Reals b) { return _mm_cmplt_pd(a, b); }
  static Flags less_equal(Reals a, Reals b) { return _mm_cmple_pd(a, b); }
  static Flags equal(Reals a, Reals b) { return _mm_cmpeq_pd(a, b); }
  static Flags both(Flags a, Flags b) { return _mm_and_pd(a, b); }
  static Flags either(Flags a, Flags b) { return _mm_or_pd(a, b); }
  static Flags without(Flags a, Flags b) { return _mm_andnot_pd(a, b); }
  static Reals choose(Flags m, Reals a, Reals b) { return either(both(m, a), without(m, b)); }
  static Reals smaller(Reals a, Reals b) { return _mm_min_pd(a, b); }
  static Reals larger(Reals a, Reals b) { return _mm_max_pd(a, b); }
  static Reals absolute(Reals a) { return _mm_andnot_pd(_mm_set1_pd(-0.0), a); }
  static Reals root(Reals a) { return _mm_sqrt_pd(a); }
  static bool any(Flags m) { return _mm_movemask_pd(m) != 0; }
  static bool all(Flags m) { return _mm_movemask_pd(m) == 3; }
  static Reals join(Reals a, Reals b) { return _mm_or_pd(a, b); }
  static bool any_bit(Reals a, std::int64_t bits) {
    std::int64_t lanes[2];
    std::memcpy(lanes, &a, sizeof a);
    return ((lanes[0] | lanes[1]) & bits) != 0;
  }
  static bool flag(Flags m, int l) { return ((_mm_movemask_pd(m) >> l) & 1) != 0; }
  static void set_flag(Flags& m, int l, bool value) {
    std::int64_t lanes[2];
    std::memcpy(lanes, &m, sizeof m);
    lanes[l] = value ? -1 : 0;
    std::memcpy(&m, lanes, sizeof m);
  }
};
#endif

#if defined(__AVX__)
template <>
struct Native<4> {
  typedef __m256d Reals;
  typedef __m256i Bits;
  using Flags = Reals;
  static Flags less(Reals a, Reals b) { return _mm256_cmp_pd(a, b, _CMP_LT_OS); }
  static Flags less_equal(Reals a, Reals b) { return _mm256_cmp_pd(a, b, _CMP_LE_OS); }
  static Flags equal(Reals a, Reals b) { return _mm256_cmp_pd(a, b, _CMP_EQ_OQ); }
  static Flags both(Flags a, Flags b) { return _mm256_and_pd(a, b); }
  static Flags either(Flags a, Flags b) { return _mm256_or_pd(a, b); }
  static Flags without(Flags a, Flags b) { return _mm256_andnot_pd(a, b); }
  static Reals choose(Flags m, Reals a, Reals b) { return _mm256_blendv_pd(b, a, m); }
  static Reals smaller(Reals a, Reals b) { return _mm256_min_pd(a, b); }
  static Reals larger(Reals a, Reals b) { return _mm256_max_pd(a, b); }
  static Reals absolute(Reals a) { return _mm256_andnot_pd(_mm256_set1_pd(-0.0), a); }
  static Reals root(Reals a) { return _mm256_sqrt_pd(a); }
  static bool any(Flags m) { return _mm256_movemask_pd(m) != 0; }
  static bool all(Flags m) { return _mm256_movemask_pd(m) == 15; }
  static Reals join(Reals a, Reals b) { return _mm256_or_pd(a, b); }
  static bool any_bit(Reals a, std::int64_t bits) {
    return _mm256_testz_si256(_mm256_castpd_si256(a), _mm256_set1_epi64x(bits)) == 0;
  }
  static bool flag(Flags m, int l) { return ((_mm256_movemask_pd(m) >> l) & 1) != 0; }
  static void set_flag(Flags& m, int l, bool value) {
    std::int64_t lanes[4];
    std::memcpy(lanes, &m, sizeof m);
    lanes[l] = value ? -1 : 0;
    std::memcpy(&m, lanes, sizeof m);
  }
};
#endif

#if defined(__AVX512F__) && defined(__AVX512DQ__)
// Flags are one bit a lane.
template <>
struct Native<8> {
  typedef __m512d Reals;
  typedef __m512i Bits;
  using Flags = __mmask8;
  static Flags less(Reals a, Reals b) { return _mm512_cmp_pd_mask(a, b, _CMP_LT_OS); }
  static Flags less_equal(Reals a, Reals b) { return _mm512_cmp_pd_mask(a, b, _CMP_LE_OS); }
  static Flags equal(Reals a, Reals b) { return _mm512_cmp_pd_mask(a, b, _CMP_EQ_OQ); }
  static Flags both(Flags a, Flags b) { return _kand_mask8(a, b); }
  static Flags either(Flags a, Flags b) { return _kor_mask8(a, b); }
  static Flags without(Flags a, Flags b) { return _kandn_mask8(a, b); }
  static Reals choose(Flags m, Reals a, Reals b) { return _mm512_mask_blend_pd(m, b, a); }
  static Reals smaller(Reals a, Reals b) { return _mm512_maskz_min_pd(0xff, a, b); }
  static Reals larger(Reals a, Reals b) { return _mm512_maskz_max_pd(0xff, a, b); }
  static Reals absolute(Reals a) { return _mm512_andnot_pd(_mm512_set1_pd(-0.0), a); }
  static Reals root(Reals a) { return _mm512_maskz_sqrt_pd(0xff, a); }
  static bool any(Flags m) { return _kortestz_mask8_u8(m, m) == 0; }
  static bool all(Flags m) { return _kortestc_mask8_u8(m, m) != 0; }
  static Reals join(Reals a, Reals b) { return _mm512_or_pd(a, b); }
  static bool any_bit(Reals a, std::int64_t bits) {
    return _mm512_test_epi64_mask(_mm512_castpd_si512(a), _mm512_set1_epi64(bits)) != 0;
  }
  static bool flag(Flags m, int l) { return ((m >> l) & 1) != 0; }
  static void set_flag(Flags& m, int l, bool value) {
    const int bit = 1 << l;
    m = static_cast<Flags>(value ? m | bit : m & ~bit);
  }
};
#endif

}  // namespace cleave
