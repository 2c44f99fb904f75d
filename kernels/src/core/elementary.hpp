// exp, expm1, log, log1p and powers from IEEE arithmetic alone, for R = double and R = Pack: the same bits in
// every lane, on every machine and with every C library. Largest error against long double, measured
// over the ranges of the test: exp 1 ulp, expm1 2 ulp, log and log1p 2 ulp. Arguments must be finite;
// nothing here traps. Not for arguments near the ends of the range of double: they are cut, see each function.
#pragma once

#include "core/lanes.hpp"

namespace cleave {

namespace elementary {

// ln 2 in two parts; the first has 20 trailing zero bits, so that its product with an exponent is
// exact.
inline constexpr double kLn2High = 0x1.62e42feep-1, kLn2Low = 0x1.a39ef35793c76p-33;
inline constexpr double kInverseLn2 = 0x1.71547652b82fep0;

// expm1(r) for |r| <= ln(2)/2: Taylor to r^13; the next term is 1e-17 of r.
template <class R>
CLEAVE_INLINE R expm1_reduced(const R& r) {
  constexpr double kInverseFactorial[] = {1.0 / 2,        1.0 / 6,         1.0 / 24,
                                          1.0 / 120,      1.0 / 720,       1.0 / 5040,
                                          1.0 / 40320,    1.0 / 362880,    1.0 / 3628800,
                                          1.0 / 39916800, 1.0 / 479001600, 1.0 / 6227020800.0};
  const R r2 = r * r, r4 = r2 * r2;
  // Four interleaved quartets instead of one chain of twelve.
  const R low = (kInverseFactorial[0] + r * kInverseFactorial[1]) +
                r2 * (kInverseFactorial[2] + r * kInverseFactorial[3]);
  const R middle = (kInverseFactorial[4] + r * kInverseFactorial[5]) +
                   r2 * (kInverseFactorial[6] + r * kInverseFactorial[7]);
  const R high = (kInverseFactorial[8] + r * kInverseFactorial[9]) +
                 r2 * (kInverseFactorial[10] + r * kInverseFactorial[11]);
  return r + r2 * (low + r4 * (middle + r4 * high));
}

template <class R>
inline R reduce(const R& x, R& k) {
  k = nearest_integer(x * kInverseLn2);
  return (x - k * kLn2High) - k * kLn2Low;
}

template <class R>
CLEAVE_INLINE R expm1_unreduced(const R& x) {
  R k;
  const R r = reduce(larger(smaller(x, R(709.0)), R(-50.0)), k);
  const R scale = power_of_two(k);
  return scale * expm1_reduced(r) + (scale - 1.0);
}
template <class R>
[[gnu::noinline]] R expm1_wide(const R& x) {
  return expm1_unreduced(x);
}

// e ln 2 + ln(1+f) + corrected - e kLn2Low, for sqrt(1/2) <= 1+f <= sqrt(2).
template <class R>
CLEAVE_INLINE R log_assembled(const R& f, const R& e, const R& corrected) {
  const R s = f / (2.0 + f), z = s * s;  // |s| <= 0.1716
  // ln(1+f) = 2 artanh s = 2s + sum 2 s^(2k+1)/(2k+1), and 2s = f - s f.
  R tail = 2.0 / 23 + R(0.0);
  for (int n = 21; n >= 3; n -= 2) tail = 2.0 / n + z * tail;
  return e * kLn2High + (f - (s * (f - z * tail) - corrected));
}

}  // namespace elementary

// e^x; x is cut to [-708, 709].
template <class R>
inline R exponential(const R& x) {
  R k;
  const R r = elementary::reduce(larger(smaller(x, R(709.0)), R(-708.0)), k);
  return power_of_two(k) * (1.0 + elementary::expm1_reduced(r));
}

// e^x - 1 with all digits for small x; x is cut to [-50, 709] (e^-50 is lost beside 1).
template <class R>
CLEAVE_INLINE R exponential_minus_one(const R& x) {
  // Here k = 0 below, which gives these bits.
  if (all(absolute(x) < 0.34)) return elementary::expm1_reduced(x);
  return elementary::expm1_wide(x);
}

// The same bits without a branch and a call, for arguments that are often not small.
template <class R>
CLEAVE_INLINE R exponential_minus_one_wide(const R& x) {
  return elementary::expm1_unreduced(x);
}

// ln(1+x) with all digits for small x; x > -1 and 1+x normal and below 2^1022.
template <class R>
inline R log_one_plus(const R& x) {
  const R u = 1.0 + x;
  // What the sum lost, relative to u.
  const R lost = select(absolute(x) < 1.0, x - (u - 1.0), 1.0 - (u - x)) / u;
  R e = exponent_of(u);
  const R m = u * power_of_two(-e);  // exact, 1 <= m < 2
  const MaskOf<R> upper = m > 0x1.6a09e667f3bcdp0;
  e = select(upper, e + 1.0, e);
  const MaskOf<R> reduced = (e > 0.0) | (e < 0.0);
  const R f = select(reduced, select(upper, 0.5 * m, m) - 1.0, x);
  const R corrected = select(reduced, e * elementary::kLn2Low + lost, R(0.0));
  return elementary::log_assembled(f, e, corrected);
}

// ln x of a normal x > 0.
template <class R>
inline R logarithm(const R& x) {
  R e = exponent_of(x);
  const R m = x * power_of_two(-e);  // exact, 1 <= m < 2
  const MaskOf<R> upper = m > 0x1.6a09e667f3bcdp0;
  e = select(upper, e + 1.0, e);
  return elementary::log_assembled(select(upper, 0.5 * m, m) - 1.0, e, e * elementary::kLn2Low);
}

// x^a for x >= 0, a > 0: exp(a ln x), so that the relative error grows to 2 |a ln x| + 4 ulp; 0 below
// the normal range, and the exponent is cut as that of exponential().
template <class R>
inline R power(const R& x, double a) {
  const MaskOf<R> normal = x >= std::numeric_limits<double>::min();
  const R base = select(normal, x, R(1.0));
  return select(normal, exponential(a * logarithm(base)), R(0.0));
}

}  // namespace cleave
