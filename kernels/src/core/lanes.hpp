// W doubles side by side, one lane a point: the same templated source runs with R = double and with
// R = Pack<W> and gives every lane the bits that double would give it. For that nothing here rounds
// differently from the scalar operation, and no operation mixes lanes but any() and all(), which may
// only decide whether work that every lane masks for itself is done at all. Not a general vector
// library: what the material laws need.
#pragma once

#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>

#if defined(__SSE2__)
#include <immintrin.h>
#endif

namespace cleave {

// Doubles in one register of the instruction set that this file is compiled for. GCC 12 splits wider
// vector types into scalar code, so that a Pack of more lanes is an array of registers.
#if defined(__AVX512F__)
inline constexpr int kNativeLanes = 8;
#elif defined(__AVX__)
inline constexpr int kNativeLanes = 4;
#else
inline constexpr int kNativeLanes = 2;
#endif

// N: lanes a register; part of the type, so that translation units for different instruction sets
// do not share code.
template <int W, int N = (W < kNativeLanes ? W : kNativeLanes)>
struct Mask {
  static_assert(W % N == 0);
  typedef std::int64_t Register __attribute__((vector_size(8 * N)));
  static constexpr int kRegisters = W / N;
  Register r[kRegisters];
};

template <int W, int N = (W < kNativeLanes ? W : kNativeLanes)>
struct Pack {
  static_assert(W % N == 0);
  typedef double Register __attribute__((vector_size(8 * N)));
  static constexpr int kRegisters = W / N;
  Register r[kRegisters];

  Pack() = default;
  Pack(double x) {  // implicit on purpose: formulas mix lanes and constants
    for (auto& one : r) one = Register{} + x;
  }
};

// The type of a comparison, and the number of lanes, of R = double or Pack.
template <class R>
struct LaneTraits;
template <>
struct LaneTraits<double> {
  using Mask = bool;
  static constexpr int kLanes = 1;
};
template <int W, int N>
struct LaneTraits<Pack<W, N>> {
  using Mask = cleave::Mask<W, N>;
  static constexpr int kLanes = W;
};
template <class R>
using MaskOf = typename LaneTraits<R>::Mask;
template <class R>
inline constexpr int kLanesOf = LaneTraits<R>::kLanes;

#define CLEAVE_LANES_ARITHMETIC(op)                                                \
  template <int W, int N>                                                          \
  inline Pack<W, N> operator op(const Pack<W, N>& a, const Pack<W, N>& b) {        \
    Pack<W, N> c;                                                                  \
    for (int k = 0; k < Pack<W, N>::kRegisters; ++k) c.r[k] = a.r[k] op b.r[k];    \
    return c;                                                                      \
  }                                                                                \
  template <int W, int N>                                                          \
  inline Pack<W, N> operator op(const Pack<W, N>& a, double b) {                   \
    return a op Pack<W, N>(b);                                                     \
  }                                                                                \
  template <int W, int N>                                                          \
  inline Pack<W, N> operator op(double a, const Pack<W, N>& b) {                   \
    return Pack<W, N>(a) op b;                                                     \
  }
CLEAVE_LANES_ARITHMETIC(+)
CLEAVE_LANES_ARITHMETIC(-)
CLEAVE_LANES_ARITHMETIC(*)
CLEAVE_LANES_ARITHMETIC(/)
#undef CLEAVE_LANES_ARITHMETIC

#define CLEAVE_LANES_COMPARISON(op)                                                \
  template <int W, int N>                                                          \
  inline Mask<W, N> operator op(const Pack<W, N>& a, const Pack<W, N>& b) {        \
    Mask<W, N> m;                                                                  \
    for (int k = 0; k < Pack<W, N>::kRegisters; ++k) m.r[k] = a.r[k] op b.r[k];    \
    return m;                                                                      \
  }                                                                                \
  template <int W, int N>                                                          \
  inline Mask<W, N> operator op(const Pack<W, N>& a, double b) {                   \
    return a op Pack<W, N>(b);                                                     \
  }
CLEAVE_LANES_COMPARISON(<)
CLEAVE_LANES_COMPARISON(<=)
CLEAVE_LANES_COMPARISON(>)
CLEAVE_LANES_COMPARISON(>=)
#undef CLEAVE_LANES_COMPARISON

#define CLEAVE_LANES_LOGIC(op)                                                     \
  template <int W, int N>                                                          \
  inline Mask<W, N> operator op(const Mask<W, N>& a, const Mask<W, N>& b) {        \
    Mask<W, N> m;                                                                  \
    for (int k = 0; k < Mask<W, N>::kRegisters; ++k) m.r[k] = a.r[k] op b.r[k];    \
    return m;                                                                      \
  }
CLEAVE_LANES_LOGIC(&)
CLEAVE_LANES_LOGIC(|)
#undef CLEAVE_LANES_LOGIC

template <int W, int N>
inline Mask<W, N> operator!(const Mask<W, N>& a) {
  Mask<W, N> m;
  for (int k = 0; k < Mask<W, N>::kRegisters; ++k) m.r[k] = ~a.r[k];
  return m;
}
template <int W, int N>
inline Pack<W, N> operator-(const Pack<W, N>& a) {
  Pack<W, N> c;
  for (int k = 0; k < Pack<W, N>::kRegisters; ++k) c.r[k] = -a.r[k];
  return c;
}

inline bool any(bool m) { return m; }
inline bool all(bool m) { return m; }
template <int W, int N>
inline bool any(const Mask<W, N>& m) {
  typename Mask<W, N>::Register together = m.r[0];
  for (int k = 1; k < Mask<W, N>::kRegisters; ++k) together |= m.r[k];
#if defined(__AVX512F__)
  if constexpr (N == 8) return _mm512_movepi64_mask(reinterpret_cast<__m512i>(together)) != 0;
#endif
#if defined(__AVX__)
  if constexpr (N == 4) return _mm256_movemask_pd(reinterpret_cast<__m256d>(together)) != 0;
#endif
#if defined(__SSE2__)
  if constexpr (N == 2) return _mm_movemask_pd(reinterpret_cast<__m128d>(together)) != 0;
#endif
  for (int l = 0; l < N; ++l)
    if (together[l] != 0) return true;
  return false;
}
template <int W, int N>
inline bool all(const Mask<W, N>& m) {
  return !any(!m);
}

// a where m, else b: both are computed, so neither may trap.
inline double select(bool m, double a, double b) { return m ? a : b; }
template <int W, int N>
inline Pack<W, N> select(const Mask<W, N>& m, const Pack<W, N>& a, const Pack<W, N>& b) {
  Pack<W, N> c;
  for (int k = 0; k < Pack<W, N>::kRegisters; ++k) c.r[k] = m.r[k] ? a.r[k] : b.r[k];
  return c;
}

inline double lane(double x, int) { return x; }
inline bool lane(bool m, int) { return m; }
template <int W, int N>
inline double lane(const Pack<W, N>& a, int l) {
  return a.r[l / N][l % N];
}
template <int W, int N>
inline bool lane(const Mask<W, N>& m, int l) {
  return m.r[l / N][l % N] != 0;
}
inline void set_lane(double& x, int, double value) { x = value; }
inline void set_lane(bool& m, int, bool value) { m = value; }
template <int W, int N>
inline void set_lane(Pack<W, N>& a, int l, double value) {
  a.r[l / N][l % N] = value;
}
template <int W, int N>
inline void set_lane(Mask<W, N>& m, int l, bool value) {
  m.r[l / N][l % N] = value ? -1 : 0;
}

inline double square_root(double x) { return std::sqrt(x); }
template <int W, int N>
inline Pack<W, N> square_root(const Pack<W, N>& a) {
  Pack<W, N> c;
  for (int k = 0; k < Pack<W, N>::kRegisters; ++k) {
#if defined(__AVX512F__)
    if constexpr (N == 8) c.r[k] = _mm512_sqrt_pd(a.r[k]);
#endif
#if defined(__AVX__)
    if constexpr (N == 4) c.r[k] = _mm256_sqrt_pd(a.r[k]);
#endif
#if defined(__SSE2__)
    if constexpr (N == 2) c.r[k] = _mm_sqrt_pd(a.r[k]);
#else
    for (int l = 0; l < N; ++l) c.r[k][l] = std::sqrt(a.r[k][l]);
#endif
  }
  return c;
}

inline double absolute(double x) { return std::fabs(x); }
template <int W, int N>
inline Pack<W, N> absolute(const Pack<W, N>& a) {
  using Bits = typename Mask<W, N>::Register;
  using Reals = typename Pack<W, N>::Register;
  Pack<W, N> c;
  for (int k = 0; k < Pack<W, N>::kRegisters; ++k)
    c.r[k] = reinterpret_cast<Reals>(reinterpret_cast<Bits>(a.r[k]) & 0x7fffffffffffffffll);
  return c;
}

// Of the bits alone: no comparison that a quiet NaN would make raise a flag.
inline bool is_finite(double x) {
  return (std::bit_cast<std::int64_t>(x) & 0x7ff0000000000000ll) != 0x7ff0000000000000ll;
}
template <int W, int N>
inline Mask<W, N> is_finite(const Pack<W, N>& a) {
  using Bits = typename Mask<W, N>::Register;
  Mask<W, N> m;
  for (int k = 0; k < Pack<W, N>::kRegisters; ++k)
    m.r[k] = (reinterpret_cast<Bits>(a.r[k]) & 0x7ff0000000000000ll) != 0x7ff0000000000000ll;
  return m;
}

// The nearest integer of |x| < 2^51, ties to even.
template <class R>
inline R nearest_integer(const R& x) {
  constexpr double kShift = 0x1.8p52;
  return (x + kShift) - kShift;
}

// 2^k of an integer -1022 <= k <= 1023: the sum's last bits are the biased exponent.
inline constexpr double kExponentShift = 0x1.8p52 + 1023;
inline double power_of_two(double k) {
  return std::bit_cast<double>(std::bit_cast<std::uint64_t>(k + kExponentShift) << 52);
}
template <int W, int N>
inline Pack<W, N> power_of_two(const Pack<W, N>& k) {
  using Bits = typename Mask<W, N>::Register;
  using Reals = typename Pack<W, N>::Register;
  Pack<W, N> c;
  for (int n = 0; n < Pack<W, N>::kRegisters; ++n)
    c.r[n] = reinterpret_cast<Reals>(reinterpret_cast<Bits>(k.r[n] + kExponentShift) << 52);
  return c;
}

// The exponent e of a normal x > 0, 2^e <= x < 2^(e+1).
inline constexpr std::int64_t kBitsOfTwo52 = 0x4330000000000000ll;
inline double exponent_of(double x) {
  return std::bit_cast<double>((std::bit_cast<std::int64_t>(x) >> 52) | kBitsOfTwo52) -
         (0x1p52 + 1023);
}
template <int W, int N>
inline Pack<W, N> exponent_of(const Pack<W, N>& a) {
  typedef std::uint64_t Unsigned __attribute__((vector_size(8 * N)));
  using Reals = typename Pack<W, N>::Register;
  Pack<W, N> c;
  for (int k = 0; k < Pack<W, N>::kRegisters; ++k) {
    const Unsigned biased = reinterpret_cast<Unsigned>(a.r[k]) >> 52;
    c.r[k] = reinterpret_cast<Reals>(biased | static_cast<std::uint64_t>(kBitsOfTwo52)) -
             (0x1p52 + 1023);
  }
  return c;
}

// Lane l is base[l * stride]. kUnit: stride is one.
template <class R, bool kUnit>
inline R load_lanes(const double* base, std::int64_t stride) {
  if constexpr (kLanesOf<R> == 1) {
    return *base;
  } else {
    R a;
    if constexpr (kUnit) {
      std::memcpy(&a, base, sizeof a);
    } else {
      for (int l = 0; l < kLanesOf<R>; ++l) set_lane(a, l, base[l * stride]);
    }
    return a;
  }
}
template <class R, bool kUnit>
inline void store_lanes(const R& a, double* base, std::int64_t stride) {
  if constexpr (kLanesOf<R> == 1) {
    *base = a;
  } else if constexpr (kUnit) {
    std::memcpy(base, &a, sizeof a);
  } else {
    for (int l = 0; l < kLanesOf<R>; ++l) base[l * stride] = lane(a, l);
  }
}

template <class R>
inline R smaller(const R& a, const R& b) {
  return select(a < b, a, b);
}
template <class R>
inline R larger(const R& a, const R& b) {
  return select(a > b, a, b);
}

}  // namespace cleave
