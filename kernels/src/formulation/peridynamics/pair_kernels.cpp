// The loops that pair_kernels.hpp declares: eight neighbours fill the lanes of a register.
#include "formulation/peridynamics/pair_kernels.hpp"

#include "formulation/peridynamics/pair_lanes.hpp"

namespace cleave {

namespace peridynamics {
namespace {

struct Bond {
  Lanes d[3];     // x_ij
  Lanes L, l;     // lengths
  Lanes fourth;   // of `now`
  Lanes volume;   // of `reference`
  Lanes inverse;  // 1/l; finite where l is zero
};

CLEAVE_INLINE Bond bond_of(const PairArrays& a, const Eight& eight, std::int64_t i) {
  Lanes x[4], X[4];
  eight.rows(a.now, x);
  eight.rows(a.reference, X);
  Bond r;
  Lanes now(0.0), before(0.0);
  for (int k = 0; k < 3; ++k) {
    r.d[k] = x[k] - a.now[4 * i + k];
    const Lanes D = X[k] - a.reference[4 * i + k];
    now = now + r.d[k] * r.d[k];
    before = before + D * D;
  }
  r.l = square_root(now);
  r.L = square_root(before);
  r.inverse = 1.0 / select(now > 0.0, r.l, Lanes(1.0));
  r.fourth = x[3];
  r.volume = X[3];
  return r;
}

template <PairForm kForm>
CLEAVE_INLINE Lanes weight_of(const PairArrays& a, const Eight& eight, const Lanes& right,
                              std::int64_t i) {
  if constexpr (kForm == PairForm::product) return a.left[i] * right;
  if constexpr (kForm == PairForm::sum) return a.left[i] + right;
  const Lanes both = a.alpha[i] + eight.scalars(a.alpha);
  if constexpr (kForm == PairForm::series) return a.left[i] * right / both;
  return a.left[i] * right * both;
}

template <PairForm kForm>
void pair_force(const PairArrays& arrays, std::int64_t first, std::int64_t last) {
  const PairArrays a = arrays;
  for (std::int64_t i = first; i < last; ++i) {
    Lanes f[3] = {Lanes(0.0), Lanes(0.0), Lanes(0.0)}, energy(0.0);
    const std::int32_t end = a.row_begin[i + 1];
    for (std::int32_t b = a.row_begin[i]; b < end; b += kWide) {
      const unsigned byte = carrying(a.intact, b, end);
      if (byte == 0) continue;
      const Eight eight(a.neighbour, b, end);
      const Bond r = bond_of(a, eight, i);
      const Lanes weight = weight_of<kForm>(a, eight, r.fourth, i);
      const Lanes change = r.l - r.L, pull = lanes_of(byte) * weight * (change / r.L);
      const Lanes scale = pull * r.inverse;
      energy = energy + pull * change;
      for (int k = 0; k < 3; ++k) f[k] = f[k] + scale * r.d[k];
    }
    store_sums(f, a.force, i);
    a.energy[i] = 0.25 * sum_of(energy) / a.reference[4 * i + 3];
  }
}

CLEAVE_INLINE Lanes influence(const PairArrays& a, const Lanes& L) {
  if (a.influence == 0) return a.horizon / L;
  if (a.influence == 1) return Lanes(1.0);
  return 1.0 - L / Lanes(a.horizon * (1 + 1e-6));  // not negative on the horizon
}

void extension(const PairArrays& arrays, std::int64_t first, std::int64_t last) {
  const PairArrays a = arrays;
  for (std::int64_t i = first; i < last; ++i) {
    Lanes sum(0.0), square(0.0);
    const std::int32_t end = a.row_begin[i + 1];
    for (std::int32_t b = a.row_begin[i]; b < end; b += kWide) {
      const unsigned byte = carrying(a.intact, b, end);
      if (byte == 0) continue;
      const Bond r = bond_of(a, Eight(a.neighbour, b, end), i);
      const Lanes change = r.l - r.L;
      const Lanes weighed = lanes_of(byte) * influence(a, r.L) * r.volume * change;
      sum = sum + weighed * r.L;
      square = square + weighed * change;
    }
    a.extension[i] = sum_of(sum);
    a.square[i] = sum_of(square);
  }
}

void state_force(const PairArrays& arrays, std::int64_t first, std::int64_t last) {
  const PairArrays a = arrays;
  for (std::int64_t i = first; i < last; ++i) {
    Lanes f[3] = {Lanes(0.0), Lanes(0.0), Lanes(0.0)};
    const std::int32_t end = a.row_begin[i + 1];
    for (std::int32_t b = a.row_begin[i]; b < end; b += kWide) {
      const unsigned byte = carrying(a.intact, b, end);
      if (byte == 0) continue;
      const Eight eight(a.neighbour, b, end);
      const Bond r = bond_of(a, eight, i);
      const Lanes alpha = a.alpha[i] + eight.scalars(a.alpha);
      const Lanes spread = a.spread[i] + eight.scalars(a.spread);
      const Lanes scale = lanes_of(byte) * influence(a, r.L) * (a.left[i] * r.volume) *
                          (alpha * (r.l - r.L) + spread * r.L) * r.inverse;
      for (int k = 0; k < 3; ++k) f[k] = f[k] + scale * r.d[k];
    }
    store_sums(f, a.force, i);
  }
}

void stretched(const PairArrays& arrays, std::int64_t first, std::int64_t last, const double* limit,
               char* flag) {
  const PairArrays a = arrays;
  for (std::int64_t i = first; i < last; ++i) {
    const std::int32_t end = a.row_begin[i + 1];
    const std::int32_t upper = end - (a.bond_begin[i + 1] - a.bond_begin[i]);
    // A little below the limit, so that rounding hides none.
    const double most = (1 + limit[i]) * (1 - 1e-12), square = most * most;
    bool found = false;
    for (std::int32_t b = upper; b < end; b += kWide) {
      const Eight eight(a.neighbour, b, end);
      Lanes x[4], X[4];
      eight.rows(a.now, x);
      eight.rows(a.reference, X);
      Lanes now(0.0), before(0.0);
      for (int k = 0; k < 3; ++k) {
        const Lanes d = x[k] - a.now[4 * i + k], D = X[k] - a.reference[4 * i + k];
        now = now + d * d;
        before = before + D * D;
      }
      found = found || any(now > square * before);
    }
    flag[i - first] = found ? 1 : 0;
  }
}

}  // namespace
}  // namespace peridynamics

extern const cleave_call::PairKernels kPairKernels;
constinit const cleave_call::PairKernels kPairKernels = {
    {&peridynamics::pair_force<peridynamics::PairForm::product>,
     &peridynamics::pair_force<peridynamics::PairForm::sum>,
     &peridynamics::pair_force<peridynamics::PairForm::series>,
     &peridynamics::pair_force<peridynamics::PairForm::mean>},
    &peridynamics::extension,
    &peridynamics::state_force,
    &peridynamics::stretched};

}  // namespace cleave
