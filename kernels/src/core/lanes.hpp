// W doubles side by side, one lane a point: the same templated source runs with R = double and with
// R = Pack<W> and gives every lane the bits that double would give it. For that nothing here rounds
// differently from the scalar operation, and no operation mixes lanes but any() and all(), which may
// only decide whether work that every lane masks for itself is done at all. Not a general vector
// library: what the material laws need.
#pragma once

#include <bit>
#include <limits>

#include "core/lane_register.hpp"

namespace cleave {

// N: lanes a register; part of the type, so that translation units for different instruction sets
// do not share code.
template <int W, int N = (W < kNativeLanes ? W : kNativeLanes)>
struct Mask {
  static_assert(W % N == 0);
  static constexpr int kRegisters = W / N;
  typename Native<N>::Flags r[kRegisters];
};

template <int W, int N = (W < kNativeLanes ? W : kNativeLanes)>
struct Pack {
  static_assert(W % N == 0);
  using Register = typename Native<N>::Reals;
  static constexpr int kRegisters = W / N;
  Register r[kRegisters];

  Pack() = default;
  Pack(double x) {  // implicit on purpose: formulas mix lanes and constants
    for (auto& one : r) one = x - Register{};  // keeps the sign of -0
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
  CLEAVE_INLINE Pack<W, N> operator op(const Pack<W, N>& a, const Pack<W, N>& b) { \
    Pack<W, N> c;                                                                  \
    for (int k = 0; k < Pack<W, N>::kRegisters; ++k) c.r[k] = a.r[k] op b.r[k];    \
    return c;                                                                      \
  }                                                                                \
  template <int W, int N>                                                          \
  CLEAVE_INLINE Pack<W, N> operator op(const Pack<W, N>& a, double b) {            \
    return a op Pack<W, N>(b);                                                     \
  }                                                                                \
  template <int W, int N>                                                          \
  CLEAVE_INLINE Pack<W, N> operator op(double a, const Pack<W, N>& b) {            \
    return Pack<W, N>(a) op b;                                                     \
  }
CLEAVE_LANES_ARITHMETIC(+)
CLEAVE_LANES_ARITHMETIC(-)
CLEAVE_LANES_ARITHMETIC(*)
CLEAVE_LANES_ARITHMETIC(/)
#undef CLEAVE_LANES_ARITHMETIC

#define CLEAVE_LANES_BY_REGISTER(Result, name, Argument, expression)                   \
  template <int W, int N>                                                              \
  CLEAVE_INLINE Result<W, N> name(const Argument<W, N>& a, const Argument<W, N>& b) {  \
    Result<W, N> c;                                                                    \
    for (int k = 0; k < Result<W, N>::kRegisters; ++k) c.r[k] = Native<N>::expression; \
    return c;                                                                          \
  }
CLEAVE_LANES_BY_REGISTER(Mask, operator<, Pack, less(a.r[k], b.r[k]))
CLEAVE_LANES_BY_REGISTER(Mask, operator<=, Pack, less_equal(a.r[k], b.r[k]))
CLEAVE_LANES_BY_REGISTER(Mask, operator>, Pack, less(b.r[k], a.r[k]))
CLEAVE_LANES_BY_REGISTER(Mask, operator>=, Pack, less_equal(b.r[k], a.r[k]))
CLEAVE_LANES_BY_REGISTER(Mask, equal, Pack, equal(a.r[k], b.r[k]))
CLEAVE_LANES_BY_REGISTER(Mask, operator&, Mask, both(a.r[k], b.r[k]))
CLEAVE_LANES_BY_REGISTER(Mask, operator|, Mask, either(a.r[k], b.r[k]))
CLEAVE_LANES_BY_REGISTER(Mask, except, Mask, without(b.r[k], a.r[k]))  // a and not b
#undef CLEAVE_LANES_BY_REGISTER

#define CLEAVE_LANES_COMPARISON(op)                                     \
  template <int W, int N>                                               \
  CLEAVE_INLINE Mask<W, N> operator op(const Pack<W, N>& a, double b) { \
    return a op Pack<W, N>(b);                                          \
  }
CLEAVE_LANES_COMPARISON(<)
CLEAVE_LANES_COMPARISON(<=)
CLEAVE_LANES_COMPARISON(>)
CLEAVE_LANES_COMPARISON(>=)
#undef CLEAVE_LANES_COMPARISON

template <int W, int N>
CLEAVE_INLINE Mask<W, N> operator!(const Mask<W, N>& a) {
  return except(equal(Pack<W, N>(0.0), Pack<W, N>(0.0)), a);
}
template <int W, int N>
CLEAVE_INLINE Pack<W, N> operator-(const Pack<W, N>& a) {
  Pack<W, N> c;
  for (int k = 0; k < Pack<W, N>::kRegisters; ++k) c.r[k] = -a.r[k];
  return c;
}

CLEAVE_INLINE bool any(bool m) { return m; }
CLEAVE_INLINE bool all(bool m) { return m; }
template <int W, int N>
CLEAVE_INLINE bool any(const Mask<W, N>& m) {
  auto together = m.r[0];
  for (int k = 1; k < Mask<W, N>::kRegisters; ++k) together = Native<N>::either(together, m.r[k]);
  return Native<N>::any(together);
}
template <int W, int N>
CLEAVE_INLINE bool all(const Mask<W, N>& m) {
  auto together = m.r[0];
  for (int k = 1; k < Mask<W, N>::kRegisters; ++k) together = Native<N>::both(together, m.r[k]);
  return Native<N>::all(together);
}

// a where m, else b: both are computed, so neither may trap.
CLEAVE_INLINE double select(bool m, double a, double b) { return m ? a : b; }
template <int W, int N>
CLEAVE_INLINE Pack<W, N> select(const Mask<W, N>& m, const Pack<W, N>& a, const Pack<W, N>& b) {
  Pack<W, N> c;
  for (int k = 0; k < Pack<W, N>::kRegisters; ++k)
    c.r[k] = Native<N>::choose(m.r[k], a.r[k], b.r[k]);
  return c;
}

CLEAVE_INLINE double lane(double x, int) { return x; }
CLEAVE_INLINE bool lane(bool m, int) { return m; }
template <int W, int N>
CLEAVE_INLINE double lane(const Pack<W, N>& a, int l) {
  return a.r[l / N][l % N];
}
template <int W, int N>
CLEAVE_INLINE bool lane(const Mask<W, N>& m, int l) {
  return Native<N>::flag(m.r[l / N], l % N);
}
CLEAVE_INLINE void set_lane(double& x, int, double value) { x = value; }
CLEAVE_INLINE void set_lane(bool& m, int, bool value) { m = value; }
template <int W, int N>
CLEAVE_INLINE void set_lane(Pack<W, N>& a, int l, double value) {
  a.r[l / N][l % N] = value;
}
template <int W, int N>
CLEAVE_INLINE void set_lane(Mask<W, N>& m, int l, bool value) {
  Native<N>::set_flag(m.r[l / N], l % N, value);
}

CLEAVE_INLINE double square_root(double x) { return std::sqrt(x); }
template <int W, int N>
CLEAVE_INLINE Pack<W, N> square_root(const Pack<W, N>& a) {
  Pack<W, N> c;
  for (int k = 0; k < Pack<W, N>::kRegisters; ++k) c.r[k] = Native<N>::root(a.r[k]);
  return c;
}

CLEAVE_INLINE double absolute(double x) { return std::fabs(x); }
template <int W, int N>
CLEAVE_INLINE Pack<W, N> absolute(const Pack<W, N>& a) {
  Pack<W, N> c;
  for (int k = 0; k < Pack<W, N>::kRegisters; ++k) c.r[k] = Native<N>::absolute(a.r[k]);
  return c;
}

// By equality alone: unlike an order, it raises no flag for a quiet NaN.
CLEAVE_INLINE bool equal(double a, double b) { return a == b; }
CLEAVE_INLINE bool except(bool a, bool b) { return a && !b; }
template <class R>
CLEAVE_INLINE MaskOf<R> is_finite(const R& x) {
  return except(equal(x, x), equal(absolute(x), R(std::numeric_limits<double>::infinity())));
}

// The bits of both, for the two questions below about several numbers at once. Integer operations:
// nothing raises a flag, whatever the bits are.
CLEAVE_INLINE double join_bits(double a, double b) {
  return std::bit_cast<double>(std::bit_cast<std::uint64_t>(a) | std::bit_cast<std::uint64_t>(b));
}
template <int W, int N>
CLEAVE_INLINE Pack<W, N> join_bits(const Pack<W, N>& a, const Pack<W, N>& b) {
  Pack<W, N> c;
  for (int k = 0; k < Pack<W, N>::kRegisters; ++k) c.r[k] = Native<N>::join(a.r[k], b.r[k]);
  return c;
}
CLEAVE_INLINE bool any_bit(double a, std::int64_t bits) {
  return (std::bit_cast<std::int64_t>(a) & bits) != 0;
}
template <int W, int N>
CLEAVE_INLINE bool any_bit(const Pack<W, N>& a, std::int64_t bits) {
  auto together = a.r[0];
  for (int k = 1; k < Pack<W, N>::kRegisters; ++k) together = Native<N>::join(together, a.r[k]);
  return Native<N>::any_bit(together, bits);
}
// Whether one of the joined numbers, in any lane, is not below 2 in size (infinite and NaN: yes).
template <class R>
CLEAVE_INLINE bool any_reaches_two(const R& joined) {
  return any_bit(joined, std::int64_t{1} << 62);
}
// Whether one is not +0.
template <class R>
CLEAVE_INLINE bool any_not_zero(const R& joined) {
  return any_bit(joined, -1);
}
template <class R>
CLEAVE_INLINE bool any_negative(const R& x) {
  return any_bit(x, std::numeric_limits<std::int64_t>::min());
}

// The nearest integer of |x| < 2^51, ties to even.
template <class R>
CLEAVE_INLINE R nearest_integer(const R& x) {
  constexpr double kShift = 0x1.8p52;
  return (x + kShift) - kShift;
}

// 2^k of an integer -1022 <= k <= 1023: the sum's last bits are the biased exponent.
inline constexpr double kExponentShift = 0x1.8p52 + 1023;
CLEAVE_INLINE double power_of_two(double k) {
  return std::bit_cast<double>(std::bit_cast<std::uint64_t>(k + kExponentShift) << 52);
}
template <int W, int N>
CLEAVE_INLINE Pack<W, N> power_of_two(const Pack<W, N>& k) {
  typedef std::uint64_t Bits __attribute__((vector_size(8 * N)));
  using Reals = typename Pack<W, N>::Register;
  Pack<W, N> c;
  for (int n = 0; n < Pack<W, N>::kRegisters; ++n)
    c.r[n] = reinterpret_cast<Reals>(reinterpret_cast<Bits>(k.r[n] + kExponentShift) << 52);
  return c;
}

// The exponent e of a normal x > 0, 2^e <= x < 2^(e+1).
inline constexpr std::int64_t kBitsOfTwo52 = 0x4330000000000000ll;
CLEAVE_INLINE double exponent_of(double x) {
  return std::bit_cast<double>((std::bit_cast<std::int64_t>(x) >> 52) | kBitsOfTwo52) -
         (0x1p52 + 1023);
}
template <int W, int N>
CLEAVE_INLINE Pack<W, N> exponent_of(const Pack<W, N>& a) {
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
CLEAVE_INLINE R load_lanes(const double* base, std::int64_t stride) {
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
CLEAVE_INLINE void store_lanes(const R& a, double* base, std::int64_t stride) {
  if constexpr (kLanesOf<R> == 1) {
    *base = a;
  } else if constexpr (kUnit) {
    std::memcpy(base, &a, sizeof a);
  } else {
    for (int l = 0; l < kLanesOf<R>; ++l) base[l * stride] = lane(a, l);
  }
}

// a where a < b, else b; and a where a > b, else b.
CLEAVE_INLINE double smaller(double a, double b) { return a < b ? a : b; }
CLEAVE_INLINE double larger(double a, double b) { return a > b ? a : b; }
template <int W, int N>
CLEAVE_INLINE Pack<W, N> smaller(const Pack<W, N>& a, const Pack<W, N>& b) {
  Pack<W, N> c;
  for (int k = 0; k < Pack<W, N>::kRegisters; ++k) c.r[k] = Native<N>::smaller(a.r[k], b.r[k]);
  return c;
}
template <int W, int N>
CLEAVE_INLINE Pack<W, N> larger(const Pack<W, N>& a, const Pack<W, N>& b) {
  Pack<W, N> c;
  for (int k = 0; k < Pack<W, N>::kRegisters; ++k) c.r[k] = Native<N>::larger(a.r[k], b.r[k]);
  return c;
}

}  // namespace cleave
