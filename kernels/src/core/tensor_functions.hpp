// ln(I+X) of a symmetric 3x3 X and exp(X)-I of a deviator X, with all digits for small X.
//
// Small arguments: the power series, with every power of X reduced to s2 X^2 + s1 X + s0 I by the
// theorem of Cayley and Hamilton. No eigenvectors, no square roots, no degenerate case. The number of
// terms follows from the norm of the lane alone: lanes that need fewer start with coefficients that
// are zero, which leaves the bits that they would have without their neighbours. Larger arguments: by
// eigenvalues, that lane alone. The two agree to a few units of the last place of |X|.
#pragma once

#include <algorithm>
#include <array>
#include <type_traits>

#include "core/elementary.hpp"
#include "core/jacobi.hpp"
#include "core/symmetric.hpp"

namespace cleave {

// X and what its powers are made of. kTraceless: tr X is round-off and taken for 0.
template <class R, bool kTraceless = false>
struct TensorPowers {
  Symmetric<R> x, square;
  R i1, i2, i3;  // X^3 = i1 X^2 - i2 X + i3 I
  R squared_norm;
};
template <class R>
CLEAVE_INLINE TensorPowers<R> powers_of(const Symmetric<R>& x) {
  TensorPowers<R> p{x, commuting_product(x, x), trace(x), R(0.0), determinant(x), R(0.0)};
  p.squared_norm = trace(p.square);
  p.i2 = 0.5 * (p.i1 * p.i1 - p.squared_norm);
  return p;
}
template <class R>
CLEAVE_INLINE TensorPowers<R, true> powers_of_deviator(const Symmetric<R>& x) {
  TensorPowers<R, true> p{x, commuting_product(x, x), R(0.0), R(0.0), determinant(x), R(0.0)};
  p.squared_norm = trace(p.square);
  p.i2 = -0.5 * p.squared_norm;
  return p;
}

namespace series {

// A number of terms n, and the norm up to which the remainder is below 2^-56 of |X|.
struct Reach {
  int terms;
  double norm;
};
template <std::size_t K>
struct Series {
  static constexpr std::size_t kReaches = K;
  std::array<Reach, K> reach;            // ascending
  std::array<double, 40> coefficient{};  // of X^(k+1)
  constexpr double limit(std::size_t c) const { return reach[c].norm * reach[c].norm; }
};

// |X|^n / ((n+1)(1-|X|)) < 1.4e-17.
inline constexpr auto kLogarithm = [] {
  Series<4> s{{Reach{6, 2e-3}, {12, 0.047}, {16, 0.1}, {28, 0.25}}};
  for (int k = 0; k < 40; ++k)
    s.coefficient[static_cast<std::size_t>(k)] = (k % 2 == 0 ? 1.0 : -1.0) / (k + 1);
  return s;
}();
// |X|^n / (n+1)! (1 + |X|) < 1.4e-17.
inline constexpr auto kExponential = [] {
  Series<4> s{{Reach{5, 1.5e-3}, {8, 0.038}, {12, 0.24}, {16, 0.6}}};
  double inverse = 1;
  for (int k = 0; k < 40; ++k) s.coefficient[static_cast<std::size_t>(k)] = inverse /= k + 1;
  return s;
}();

// sum_k coefficient_k X^(k+1) = s2 X^2 + s1 X + s0 I, by Horner: one step multiplies by X.
template <class R>
struct Quadratic {
  R s2{0.0}, s1{0.0}, s0{0.0};
  CLEAVE_INLINE void step(const TensorPowers<R>& p, const R& constant) {
    const R next1 = s0 - s2 * p.i2, next0 = s2 * p.i3 + constant;
    s2 = s2 * p.i1 + s1;
    s1 = next1;
    s0 = next0;
  }
  CLEAVE_INLINE void step(const TensorPowers<R, true>& p, const R& constant) {
    const R next1 = s0 - s2 * p.i2, next0 = s2 * p.i3 + constant;
    s2 = s1;
    s1 = next1;
    s0 = next0;
  }
};

template <const auto& kSeries, class R>
CLEAVE_INLINE R coefficient(int k) {
  return R(kSeries.coefficient[static_cast<std::size_t>(k)]);
}

// As many terms as the first reach has, in all lanes.
template <const auto& kSeries, class P>
CLEAVE_INLINE auto sum_first(const P& p) {
  using R = std::decay_t<decltype(p.i1)>;
  constexpr int kTerms = kSeries.reach[0].terms;
  Quadratic<R> q{coefficient<kSeries, R>(kTerms - 1), coefficient<kSeries, R>(kTerms - 2),
                 coefficient<kSeries, R>(kTerms - 3)};
#pragma GCC unroll 16
  for (int k = kTerms - 4; k >= 0; --k) q.step(p, coefficient<kSeries, R>(k));
  q.step(p, R(0.0));
  return q;
}

template <const auto& kSeries, class R>
CLEAVE_INLINE R masked(const MaskOf<R>& more, int k) {
  return select(more, coefficient<kSeries, R>(k), R(0.0));
}

// As many as the second has; lanes within the first reach have zeros in front.
template <const auto& kSeries, class P>
CLEAVE_INLINE auto sum_second(const P& p) {
  using R = std::decay_t<decltype(p.i1)>;
  constexpr int kFirst = kSeries.reach[0].terms, kTerms = kSeries.reach[1].terms;
  const MaskOf<R> more = p.squared_norm >= kSeries.limit(0);
  Quadratic<R> q{masked<kSeries, R>(more, kTerms - 1), masked<kSeries, R>(more, kTerms - 2),
                 masked<kSeries, R>(more, kTerms - 3)};
#pragma GCC unroll 16
  for (int k = kTerms - 4; k >= kFirst; --k) q.step(p, masked<kSeries, R>(more, k));
#pragma GCC unroll 16
  for (int k = std::min(kFirst, kTerms - 3) - 1; k >= 0; --k) q.step(p, coefficient<kSeries, R>(k));
  q.step(p, R(0.0));
  return q;
}

// Any number of terms.
template <const auto& kSeries, class P>
[[gnu::noinline]] auto sum_mixed(const P& p) {
  using R = std::decay_t<decltype(p.i1)>;
  int most = kSeries.reach[0].terms;
  R terms(static_cast<double>(most));
  for (std::size_t c = 1; c < kSeries.reach.size(); ++c) {
    const MaskOf<R> more = p.squared_norm >= kSeries.limit(c - 1);
    if (!any(more)) break;
    most = kSeries.reach[c].terms;
    terms = select(more, R(static_cast<double>(most)), terms);
  }
  Quadratic<R> q;
  for (int k = most - 1; k >= 0; --k)
    q.step(p, select(terms > static_cast<double>(k), coefficient<kSeries, R>(k), R(0.0)));
  q.step(p, R(0.0));
  return q;
}

// |X| below the last reach in every lane.
template <const auto& kSeries, class R, bool kTraceless>
CLEAVE_INLINE Symmetric<R> sum(const TensorPowers<R, kTraceless>& p) {
  Quadratic<R> q;
  if (all(p.squared_norm < kSeries.limit(0))) {
    q = sum_first<kSeries>(p);
  } else if (all(p.squared_norm < kSeries.limit(1))) {
    q = sum_second<kSeries>(p);
  } else {
    q = sum_mixed<kSeries>(p);
  }
  return plus_spherical(scaled(q.s2, p.square) + scaled(q.s1, p.x), q.s0);
}

inline constexpr double kLogarithmLimit = kLogarithm.limit(kLogarithm.kReaches - 1);
inline constexpr double kExponentialLimit = kExponential.limit(kExponential.kReaches - 1);

}  // namespace series

// ln(I+X) by the series; |X|^2 < series::kLogarithmLimit in every lane.
template <class R>
CLEAVE_INLINE Symmetric<R> log_series(const TensorPowers<R>& p) {
  return series::sum<series::kLogarithm>(p);
}
// exp(X)-I; |X|^2 < series::kExponentialLimit.
template <class R>
CLEAVE_INLINE Symmetric<R> expm1_series(const TensorPowers<R, true>& p) {
  return series::sum<series::kExponential>(p);
}

// By eigenvalues. False if I+X is not positive definite or an eigenvalue of ln(I+X) exceeds
// `largest`; `result` is untouched then.
inline bool log_by_eigenvalues(const Symmetric<double>& x, double largest,
                               Symmetric<double>& result) {
  const Spectral e = spectral(x);
  double logarithm[3];
  for (int a = 0; a < 3; ++a) {
    const double b = 1 + e.value[a];
    if (!(b >= exponential(-largest) && b <= exponential(largest))) return false;
    logarithm[a] = log_one_plus(e.value[a]);
  }
  result = assemble(e, logarithm);
  return true;
}
inline Symmetric<double> expm1_by_eigenvalues(const Symmetric<double>& x) {
  const Spectral e = spectral(x);
  const double f[3] = {exponential_minus_one(e.value[0]), exponential_minus_one(e.value[1]),
                       exponential_minus_one(e.value[2])};
  return assemble(e, f);
}

// Some lanes are outside the radius: rare, and kept out of the way of the others.
template <class R>
[[gnu::noinline, gnu::cold]] Symmetric<R> expm1_wide(const Symmetric<R>& x,
                                                     const MaskOf<R>& inside) {
  Symmetric<R> result = expm1_series(powers_of_deviator(select(inside, x, Symmetric<R>{})));
  for (int l = 0; l < kLanesOf<R>; ++l)
    if (!lane(inside, l)) set_lane(result, l, expm1_by_eigenvalues(lane(x, l)));
  return result;
}
template <class R>
[[gnu::noinline, gnu::cold]] Symmetric<R> log_wide(const Symmetric<R>& x, const MaskOf<R>& inside,
                                                   const R& volume_change, double largest,
                                                   MaskOf<R>& valid) {
  // I + X = e^(2/3 ln J) (I + isochoric)
  const R third = (2.0 / 3) * log_one_plus(select(inside, R(0.0), volume_change));
  const R shrink = exponential_minus_one(-third);
  const Symmetric<R> isochoric = plus_spherical(scaled(1.0 + shrink, x), shrink);
  const Symmetric<R> split = select(inside, x, isochoric);
  const MaskOf<R> near = squared_norm(split) < series::kLogarithmLimit;
  Symmetric<R> result = log_series(powers_of(select(near, split, Symmetric<R>{})));
  result = select(inside, result, plus_spherical(result, third));
  for (int l = 0; l < kLanesOf<R>; ++l) {
    if (lane(near, l)) continue;
    Symmetric<double> one;
    if (!log_by_eigenvalues(lane(x, l), largest, one)) set_lane(valid, l, false);
    set_lane(result, l, one);
  }
  return result;
}

// exp(X) - I for a deviator X with eigenvalues below 700.
template <class R>
CLEAVE_INLINE Symmetric<R> expm1_of_deviator(const Symmetric<R>& x) {
  const TensorPowers<R, true> p = powers_of_deviator(x);
  const MaskOf<R> inside = p.squared_norm < series::kExponentialLimit;
  return all(inside) ? expm1_series(p) : expm1_wide<R>(x, inside);
}

// ln(I+X). With J^2 near det(I+X), volume_change = J - 1 > -1 is split off where X is outside the
// radius, so that a change of volume alone does not leave it. Lanes without a logarithm, or with one
// of an eigenvalue beyond `largest`, get 0 and lose `valid`.
template <class R>
CLEAVE_INLINE Symmetric<R> log_of(const Symmetric<R>& x, const R& volume_change, double largest,
                                  MaskOf<R>& valid) {
  const TensorPowers<R> p = powers_of(x);
  const MaskOf<R> inside = p.squared_norm < series::kLogarithmLimit;
  return all(inside) ? log_series(p) : log_wide<R>(x, inside, volume_change, largest, valid);
}

}  // namespace cleave
