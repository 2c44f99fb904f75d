// The loops that lattice_pair_kernels.hpp declares.
#include "formulation/peridynamics/lattice_pair_kernels.hpp"

#include "formulation/peridynamics/bits.hpp"

namespace cleave {

namespace peridynamics {
namespace {

constexpr int kAlike = cleave_call::kAlikeForm;
constexpr int kProduct = static_cast<int>(PairForm::product);
constexpr int kSum = static_cast<int>(PairForm::sum);
constexpr int kSeries = static_cast<int>(PairForm::series);
constexpr int kMean = static_cast<int>(PairForm::mean);

// Below, 1 + e and l^2 are formed from the present vector itself: e has lost digits.
constexpr double kShort = 0.25;
// In place of no length at all: then g (D + u) is zero and g^2 (1 + e) is one.
constexpr double kNoLength = 1e-300;

template <int D>
struct Stretch {
  Lanes d[D], e, length;  // D + u; (l^2 - L^2)/L^2; l^2
  CLEAVE_INLINE void measure(const PairStep& step, const Lanes (&u)[D], const PairRows& a,
                             std::int64_t other) {
    Lanes change;
    for (int k = 0; k < D; ++k) {
      const Lanes moved = load_lanes8(a.u[k] + other) - u[k];
      d[k] = moved + step.D[k];
      const Lanes part = moved * (d[k] + step.D[k]);
      change = k == 0 ? part : change + part;
    }
    e = change * step.inverse_square;
    length = change + step.square;
  }
  // g for every e; corrects the length of short bonds.
  CLEAVE_INLINE Lanes exact_change(const PairStep& step) {
    Lanes square = 1.0 + e;
    const Mask<kWide> close = square < kShort;
    if (any(close)) {
      Lanes own = d[0] * d[0];
      for (int k = 1; k < D; ++k) own = own + d[k] * d[k];
      length = select(close, larger(own, Lanes(kNoLength)), length);
      square = select(close, length * step.inverse_square, square);
    }
    return e / (square + square_root(square));
  }
};

CLEAVE_INLINE void add(const Lanes& a, double* to) { store_lanes8(load_lanes8(to) + a, to); }
CLEAVE_INLINE void subtract(const Lanes& a, double* to) { store_lanes8(load_lanes8(to) - a, to); }

// Up to |e| = 1/32, that is a stretch of 1.5 %, g is a polynomial: e times that of degree 8 through
// 1/(1 + e + sqrt(1 + e)) at its Chebyshev points, within 4e-17 of it.
constexpr double kSmall = 0x1p-10;  // e^2
CLEAVE_INLINE Lanes small_change(const Lanes& e, const Lanes& e2) {
  const Lanes a = 0.5 + e * -0.37499999999999434;
  const Lanes b = 0.3124999999999946 + e * -0.2734375000770698;
  const Lanes c = 0.24609375007356768 + e * -0.22558565344138345;
  const Lanes d = 0.20947238509963742 + e * -0.1967682863372609;
  return e * ((a + b * e2) + (e2 * e2) * ((c + d * e2) + (e2 * e2) * 0.18584063437886522));
}

// Sums of the eight points, and how a bond adds to them and to its other end.
template <int kForm, int D>
struct Eight {
  const PairRows& a;
  std::int64_t at;
  Lanes u[D], f[D], energy{0.0}, own{0.0}, alpha{0.0};
  CLEAVE_INLINE Eight(const PairRows& arrays, std::int64_t where) : a(arrays), at(where) {
    for (int k = 0; k < D; ++k) {
      u[k] = load_lanes8(a.u[k] + at);
      f[k] = Lanes(0.0);
    }
    if constexpr (kForm != kAlike) own = load_lanes8(a.right + at);
    if constexpr (kForm == kSeries || kForm == kMean) alpha = load_lanes8(a.alpha + at);
  }
  // g: of the bonds of this step, 0 for those that do not carry.
  CLEAVE_INLINE void add_bond(const PairStep& step, const Stretch<D>& s, const Lanes& g) {
    const std::int64_t other = at + step.distance;
    Lanes pull = g * step.inverse, there(0.0);
    if constexpr (kForm != kAlike) there = load_lanes8(a.right + other);
    if constexpr (kForm == kSum) pull = pull * (own + there);
    if constexpr (kForm == kSeries) pull = pull / (alpha + load_lanes8(a.alpha + other));
    if constexpr (kForm == kMean) pull = pull * (alpha + load_lanes8(a.alpha + other));
    const Lanes stored = (pull * g) * s.length;
    if constexpr (kForm == kAlike || kForm == kSum) {
      for (int k = 0; k < D; ++k) {
        const Lanes force = pull * s.d[k];
        f[k] = f[k] + force;
        subtract(force, a.f[k] + other);
      }
      energy = energy + stored;
      add(stored, a.e + other);
    } else {
      const Lanes here = pull * there, back = pull * own;
      for (int k = 0; k < D; ++k) {
        f[k] = f[k] + here * s.d[k];
        subtract(back * s.d[k], a.f[k] + other);
      }
      energy = energy + stored * there;
      add(stored * own, a.e + other);
    }
  }
  CLEAVE_INLINE void store() const {
    for (int k = 0; k < D; ++k) add(f[k], a.f[k] + at);
    add(energy, a.e + at);
  }
};

// The bonds of several steps at a time, which do not wait for each other. Measured: two are 10 % faster than one, and
// than two with roots that share a division; three and four are slower again.
template <int kCount, bool kWhole, int kForm, int D>
CLEAVE_INLINE void add_bonds(Eight<kForm, D>& eight, const std::int32_t* list,
                             const std::uint8_t* carries) {
  unsigned byte[kCount], either = 0;
  for (int n = 0; n < kCount; ++n) {
    byte[n] = kWhole ? 0xffu : carries[list[n]];
    either |= byte[n];
  }
  if (!kWhole && either == 0) return;
  Stretch<D> s[kCount];
  Lanes g[kCount];
  Mask<kWide> large[kCount], some_large;
  for (int n = 0; n < kCount; ++n) {
    const PairStep& step = eight.a.steps[list[n]];
    s[n].measure(step, eight.u, eight.a, eight.at + step.distance);
    const Lanes square = s[n].e * s[n].e;
    large[n] = square > kSmall;
    some_large = n == 0 ? large[0] : some_large | large[n];
    g[n] = small_change(s[n].e, square);
  }
  if (any(some_large)) {
    for (int n = 0; n < kCount; ++n) {
      g[n] = select(large[n], s[n].exact_change(eight.a.steps[list[n]]), g[n]);
    }
  }
  for (int n = 0; n < kCount; ++n) {
    if constexpr (!kWhole) g[n] = lanes_of(byte[n]) * g[n];
    eight.add_bond(eight.a.steps[list[n]], s[n], g[n]);
  }
}

template <int kForm, int D, bool kWhole>
CLEAVE_INLINE void pull_eight(const PairRows& a, const PairRow& row, std::int64_t at,
                              const std::uint8_t* carries) {
  constexpr int kTogether = 2;
  Eight<kForm, D> eight(a, at);
  std::int32_t n = 0;
  for (; n + kTogether <= row.steps; n += kTogether)
    add_bonds<kTogether, kWhole>(eight, row.list + n, carries);
  for (; n < row.steps; ++n) add_bonds<1, kWhole>(eight, row.list + n, carries);
  eight.store();
}

template <int kForm, int D>
void pull_row(const PairRows& arrays, const PairRow& given) {
  const PairRows a = arrays;
  const PairRow row = given;
  for (std::int32_t n = 0; n < row.eights; ++n) {
    const std::int64_t eight = row.eight + n, at = row.at + n * kWide;
    const std::uint8_t* carries = a.carries + eight * a.step_count;
    a.whole[eight] != 0 ? pull_eight<kForm, D, true>(a, row, at, carries)
                        : pull_eight<kForm, D, false>(a, row, at, carries);
  }
}

template <int D>
void stretched(const PairRows& arrays, const PairRow& given) {
  const PairRows a = arrays;
  const PairRow row = given;
  for (std::int32_t n = 0; n < row.eights; ++n) {
    const std::int64_t at = row.at + n * kWide;
    const std::uint8_t* carries = a.carries + (row.eight + n) * a.step_count;
    const Lanes reach = load_lanes8(a.reach + at);
    Lanes u[D];
    for (int k = 0; k < D; ++k) u[k] = load_lanes8(a.u[k] + at);
    for (std::int32_t k = 0; k < row.steps; ++k) {
      const std::int32_t which = row.list[k];
      if (carries[which] == 0) continue;
      const PairStep& step = a.steps[which];
      const std::int64_t other = at + step.distance;
      Stretch<D> s;
      s.measure(step, u, a, other);
      const Mask<kWide> far = s.e > reach;
      if (!any(far)) continue;
      const Lanes found = select(far, lanes_of(carries[which]), Lanes(0.0));
      add(found, a.e + at);
      add(found, a.e + other);
    }
  }
}

}  // namespace
}  // namespace peridynamics

extern const cleave_call::LatticePairKernels kLatticePairKernels;
#define CLEAVE_BY_DIMENSION(form) \
  { &peridynamics::pull_row<form, 2>, &peridynamics::pull_row<form, 3> }
constinit const cleave_call::LatticePairKernels kLatticePairKernels = {
    {CLEAVE_BY_DIMENSION(peridynamics::kProduct), CLEAVE_BY_DIMENSION(peridynamics::kSum),
     CLEAVE_BY_DIMENSION(peridynamics::kSeries), CLEAVE_BY_DIMENSION(peridynamics::kMean),
     CLEAVE_BY_DIMENSION(peridynamics::kAlike)},
    {&peridynamics::stretched<2>, &peridynamics::stretched<3>}};
#undef CLEAVE_BY_DIMENSION

}  // namespace cleave
