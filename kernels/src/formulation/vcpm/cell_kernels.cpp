// The loops that cell_kernels.hpp declares: eight neighbours fill the lanes of a register.
#include "formulation/vcpm/cell_kernels.hpp"

#include "formulation/peridynamics/pair_lanes.hpp"

namespace cleave {

namespace vcpm {
namespace {

using peridynamics::carrying;
using peridynamics::Eight;
using peridynamics::kWide;
using peridynamics::Lanes;
using peridynamics::lanes_of;
using peridynamics::load_lanes8;
using peridynamics::lower_bits;
using peridynamics::sum_of;

struct Bonds {
  Lanes n[3];        // zero where the ends coincide
  Lanes elongation;  // dL
  Lanes length;      // of the unloaded bond
  Lanes k, w;        // k_s, w_s
};

template <bool kLinear>
CLEAVE_INLINE Bonds bonds_of(const CellArrays& a, const Eight& eight, std::int64_t i,
                             std::int32_t b) {
  Bonds r;
  r.length = load_lanes8(a.length + b);
  const auto outer = r.length > a.middle;
  r.k = select(outer, Lanes(a.stiffness[1]), Lanes(a.stiffness[0]));
  r.w = select(outer, Lanes(a.weight[1]), Lanes(a.weight[0]));
  Lanes now[4];
  eight.rows(a.now, now);
  Lanes square(0.0);
  if constexpr (kLinear) {
    Lanes X[4];
    eight.rows(a.reference, X);
    for (int k = 0; k < 3; ++k) {
      r.n[k] = (X[k] - a.reference[4 * i + k]) / r.length;
      square = square + (now[k] - a.now[4 * i + k]) * r.n[k];
    }
    r.elongation = square;
    return r;
  }
  for (int k = 0; k < 3; ++k) {
    r.n[k] = now[k] - a.now[4 * i + k];
    square = square + r.n[k] * r.n[k];
  }
  const Lanes l = square_root(square), inverse = 1.0 / select(l > 0.0, l, Lanes(1.0));
  for (int k = 0; k < 3; ++k) r.n[k] = r.n[k] * inverse;
  r.elongation = l - r.length;
  return r;
}

// g of the bonds that carry, else 0.
template <bool kWeighed>
CLEAVE_INLINE Lanes integrity_of(const CellArrays& a, unsigned byte, std::int32_t b) {
  if constexpr (kWeighed) return lanes_of(byte) * load_lanes8(a.integrity + b);
  return lanes_of(byte);
}

template <bool kLinear, bool kWeighed>
CLEAVE_INLINE void pressures_of(const CellArrays& a, std::int64_t first, std::int64_t last) {
  for (std::int64_t i = first; i < last; ++i) {
    Lanes sum(0.0);
    const std::int32_t end = a.row_begin[i + 1];
    for (std::int32_t b = a.row_begin[i]; b < end; b += kWide) {
      const unsigned byte = carrying(a.intact, b, end);
      if (byte == 0) continue;
      const Bonds r = bonds_of<kLinear>(a, Eight(a.neighbour, b, end), i, b);
      sum = sum + integrity_of<kWeighed>(a, byte, b) * (0.5 * r.w * r.elongation);
    }
    const double theta = a.factor[i] * sum_of(sum);
    a.pressure[i] = 0.5 * a.cell * a.modulus * a.factor[i] * theta;
  }
}

// Whether one of the bonds of `byte` is at its limit, or so little below that rounding hides none.
CLEAVE_INLINE bool any_critical(const CellArrays& a, const Bonds& r, const Lanes& F,
                                unsigned byte) {
  const double most = a.limit * (1 - 1e-9);
  const Lanes mask = lanes_of(byte);
  if (a.criterion == cleave_call::kCellStrain) return any(mask * r.elongation > most * r.length);
  if (a.criterion == cleave_call::kCellForce) return any(mask * F > most);
  const auto pulls = (F > 0.0) & (r.elongation > 0.0);
  return any(select(pulls, mask * (0.5 * F * r.elongation), Lanes(0.0)) > most);
}

template <bool kLinear, bool kWeighed>
CLEAVE_INLINE void forces_of(const CellArrays& a, std::int64_t first, std::int64_t last) {
  for (std::int64_t i = first; i < last; ++i) {
    Lanes f[3] = {Lanes(0.0), Lanes(0.0), Lanes(0.0)}, springs(0.0), sum(0.0);
    const std::int32_t end = a.row_begin[i + 1];
    const std::int32_t upper = end - (a.bond_begin[i + 1] - a.bond_begin[i]);
    bool found = false;
    for (std::int32_t b = a.row_begin[i]; b < end; b += kWide) {
      const unsigned byte = carrying(a.intact, b, end);
      if (byte == 0) continue;
      const Eight eight(a.neighbour, b, end);
      const Bonds r = bonds_of<kLinear>(a, eight, i, b);
      const Lanes g = integrity_of<kWeighed>(a, byte, b);
      const Lanes pull = r.k * r.elongation, both = a.pressure[i] + eight.scalars(a.pressure);
      const Lanes F = g * (0.5 * pull + r.w * both);
      springs = springs + g * (0.125 * pull * r.elongation);
      sum = sum + g * (0.5 * r.w * r.elongation);
      for (int k = 0; k < 3; ++k) f[k] = f[k] + F * r.n[k];
      if (a.flag == nullptr) continue;
      const unsigned higher = upper > b ? byte & ~lower_bits(upper - b) : byte;
      found = found || (higher != 0 && any_critical(a, r, F, higher));
    }
    if (a.flag != nullptr) a.flag[i] = found ? 1 : 0;
    const double theta = a.factor[i] * sum_of(sum);
    peridynamics::store_sums(f, a.force, i);
    a.energy[i] = sum_of(springs) / a.cell + 0.5 * a.modulus * theta * theta;
  }
}

void pressures(const CellArrays& arrays, std::int64_t first, std::int64_t last) {
  const CellArrays a = arrays;
  if (a.linear == 0) {
    a.integrity == nullptr ? pressures_of<false, false>(a, first, last)
                           : pressures_of<false, true>(a, first, last);
  } else {
    a.integrity == nullptr ? pressures_of<true, false>(a, first, last)
                           : pressures_of<true, true>(a, first, last);
  }
}

void forces(const CellArrays& arrays, std::int64_t first, std::int64_t last) {
  const CellArrays a = arrays;
  if (a.linear == 0) {
    a.integrity == nullptr ? forces_of<false, false>(a, first, last)
                           : forces_of<false, true>(a, first, last);
  } else {
    a.integrity == nullptr ? forces_of<true, false>(a, first, last)
                           : forces_of<true, true>(a, first, last);
  }
}

}  // namespace
}  // namespace vcpm

extern const cleave_call::CellKernels kCellKernels;
constinit const cleave_call::CellKernels kCellKernels = {&vcpm::pressures, &vcpm::forces};

}  // namespace cleave
