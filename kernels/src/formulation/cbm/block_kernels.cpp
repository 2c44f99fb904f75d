// The loops that block_kernels.hpp declares, compiled for every instruction set: a vector of a particle
// fills the lanes of a register.

#include "formulation/cbm/block_kernels.hpp"

#include <algorithm>
#include <cstring>
#include <limits>
#include <type_traits>

#include "core/lane_memory.hpp"
#include "core/tensor.hpp"

namespace cleave {

namespace {

template <int D>
using Row = Pack<kStride<D>>;

template <int D>
CLEAVE_INLINE Row<D> load_row(const double* from) {
  Row<D> r;
  std::memcpy(&r, from, sizeof r);
  return r;
}
template <int D>
CLEAVE_INLINE void store_row(const Row<D>& r, double* to) {
  std::memcpy(to, &r, sizeof r);
}
template <int D>
CLEAVE_INLINE void add_row(double* to, const Row<D>& r) {
  store_row<D>(load_row<D>(to) + r, to);
}

// Numbers of bond vectors that are asked for early: one page, which the hardware does not look beyond.
constexpr std::int64_t kAhead = 512;

template <int D>
void form_gradient(const BlockArrays& arrays, std::int32_t first, std::int32_t last, double* h) {
  const BlockArrays a = arrays;
  constexpr int kRows = D * kStride<D>;
  for (std::int32_t i = first; i < last; ++i) {
    Row<D> sum[D], ui[D];
    for (int r = 0; r < D; ++r) {
      sum[r] = load_row<D>(a.rows + kRows * i + kStride<D> * r);
      ui[r] = Row<D>(a.u[D * i + r]);
    }
    const std::int64_t twins = a.twins.begin[i];
    for (std::int64_t b = twins; b < twins + a.twins.count[i]; ++b) {
      const std::int64_t p = a.twins.end[b];
      const Row<D> zeta = load_row<D>(a.twins.zeta + D * b);
      __builtin_prefetch(a.twins.zeta + D * b + kAhead);
      double* other = a.rows + kRows * p;
      for (int r = 0; r < D; ++r) {
        const Row<D> part = (Row<D>(a.u[D * p + r]) - ui[r]) * zeta;
        sum[r] = sum[r] + part;
        add_row<D>(other + kStride<D> * r, part);
      }
    }
    const std::int64_t halves = a.halves.begin[i];
    for (std::int64_t b = halves; b < halves + a.halves.count[i]; ++b) {
      const double* up = a.u + D * static_cast<std::int64_t>(a.halves.end[b]);
      const Row<D> zeta = load_row<D>(a.halves.zeta + D * b);
      for (int r = 0; r < D; ++r) sum[r] = sum[r] + (Row<D>(up[r]) - ui[r]) * zeta;
    }
    const double inverse = a.volume[i] > 0 ? 1 / a.volume[i] : 0.0;
    double* to = h + kTensor * (i - first);
    for (int r = 0; r < D; ++r) {
      double line[kStride<D>];
      store_row<D>(inverse * sum[r], line);
      for (int c = 0; c < D; ++c) to[component(r, c)] = line[c];
    }
  }
}

template <int D>
void form_force(const BlockArrays& arrays) {
  const BlockArrays a = arrays;
  for (std::int32_t i = 0; i < a.own; ++i) {
    Row<D> column[D];
    for (int c = 0; c < D; ++c) column[c] = load_row<D>(a.P + kTensor * i + 3 * c);
    Row<D> sum = load_row<D>(a.f + kStride<D> * i);
    const std::int64_t twins = a.twins.begin[i];
    for (std::int64_t b = twins; b < twins + a.twins.count[i]; ++b) {
      const std::int64_t p = a.twins.end[b];
      const double* zeta = a.twins.zeta + D * b;
      const double* other = a.P + kTensor * p;
      Row<D> pull = zeta[0] * (column[0] + load_row<D>(other));
      for (int c = 1; c < D; ++c) pull = pull + zeta[c] * (column[c] + load_row<D>(other + 3 * c));
      sum = sum + pull;
      double* to = a.f + kStride<D> * p;
      store_row<D>(load_row<D>(to) - pull, to);
    }
    const std::int64_t halves = a.halves.begin[i];
    for (std::int64_t b = halves; b < halves + a.halves.count[i]; ++b) {
      const double* zeta = a.halves.zeta + D * b;
      Row<D> pull = zeta[0] * column[0];
      for (int c = 1; c < D; ++c) pull = pull + zeta[c] * column[c];
      sum = sum + pull;
      double* to = a.f + kStride<D> * a.halves.end[b];
      store_row<D>(load_row<D>(to) - pull, to);
    }
    store_row<D>(sum, a.f + kStride<D> * i);
  }
}

// Bonds whose scales are computed side by side.
constexpr int kGroup = 4;
using Lanes = Pack<kGroup>;

// Differences of a vector over the bonds of a group.
template <int D>
struct GroupRows {
  Row<D> row[kGroup];
  // Their components, a bond a lane.
  CLEAVE_INLINE void lanes(Lanes (&c)[kStride<D>]) const {
    if constexpr (std::is_same_v<Row<D>, Lanes> && Lanes::kRegisters == 1) {
      Lanes::Register rows[kStride<D>], turned[kStride<D>];
      for (int g = 0; g < kGroup; ++g) rows[g] = row[g].r[0];
      Transposed<kStride<D>>::turn(rows, turned);
      for (int k = 0; k < kGroup; ++k) c[k].r[0] = turned[k];
    } else {
      alignas(32) double memory[kGroup][kStride<D>];
      for (int g = 0; g < kGroup; ++g) store_row<D>(row[g], memory[g]);
      load_components<kStride<D>>(&memory[0][0], kStride<D>, c);
    }
  }
};

// beta rho0 c0 l rate_ip w / |x_ip|^2 with the weight and rate of theory/cbm section 5; zero for ends that
// coincide.
template <int D>
CLEAVE_INLINE Lanes viscous_scale(const BlockArrays& a, const GroupRows<D>& xs,
                                  const GroupRows<D>& vs, const Lanes& length,
                                  const Lanes& weight) {
  Lanes x[kStride<D>], v[kStride<D>];
  xs.lanes(x);
  vs.lanes(v);
  Lanes square = x[0] * x[0], approach = v[0] * x[0];
  for (int k = 1; k < D; ++k) {
    square = square + x[k] * x[k];
    approach = approach + v[k] * x[k];
  }
  const auto apart = square > 0.0;
  const Lanes divisor = select(apart, (square + 0.01 * length * length) * square, Lanes(1.0));
  return select(apart, a.coefficient * length * approach * weight / divisor, Lanes(0.0));
}

template <int D>
CLEAVE_INLINE Lanes length_of(const GroupRows<D>& X) {
  Lanes c[kStride<D>];
  X.lanes(c);
  Lanes square = c[0] * c[0];
  for (int k = 1; k < D; ++k) square = square + c[k] * c[k];
  return square_root(square);
}

// The bonds of one row: scale_ip x_ip on i (returned), the opposite on p.
template <int D, bool kTwins>
CLEAVE_INLINE Row<D> viscous_row(const BlockArrays& a, const BlockRows& rows, std::int64_t i,
                                 Row<D> sum) {
  const Row<D> xi = load_row<D>(a.x + kStride<D> * i), vi = load_row<D>(a.v + kStride<D> * i);
  const std::int64_t first = rows.begin[i], last = first + rows.count[i];
  for (std::int64_t b = first; b < last; b += kGroup) {
    GroupRows<D> x, v;
    double weight[kGroup], scale[kGroup];
    std::int64_t p[kGroup];
    for (int g = 0; g < kGroup; ++g) {
      const std::int64_t bond = std::min(b + g, last - 1);
      p[g] = rows.end[bond];
      x.row[g] = load_row<D>(a.x + kStride<D> * p[g]) - xi;
      v.row[g] = load_row<D>(a.v + kStride<D> * p[g]) - vi;
      weight[g] = rows.weight[bond] * (kTwins ? a.J[i] + a.J[p[g]] : a.J[i]);
    }
    Lanes length(a.length);
    if (a.X != nullptr) {
      GroupRows<D> X;
      const Row<D> Xi = load_row<D>(a.X + kStride<D> * i);
      for (int g = 0; g < kGroup; ++g) X.row[g] = load_row<D>(a.X + kStride<D> * p[g]) - Xi;
      length = length_of<D>(X);
    }
    store_lanes<Lanes, true>(viscous_scale<D>(a, x, v, length, load_lanes<Lanes, true>(weight, 1)),
                             scale, 1);
    for (int g = 0; g < kGroup && b + g < last; ++g) {
      const Row<D> force = scale[g] * x.row[g];
      sum = sum + force;
      double* to = a.fv + kStride<D> * p[g];
      store_row<D>(load_row<D>(to) - force, to);
    }
  }
  return sum;
}

template <int D>
void form_viscous_force(const BlockArrays& arrays) {
  const BlockArrays a = arrays;
  for (std::int64_t i = 0; i < a.own; ++i) {
    Row<D> sum = load_row<D>(a.fv + kStride<D> * i);
    sum = viscous_row<D, true>(a, a.twins, i, sum);
    sum = viscous_row<D, false>(a, a.halves, i, sum);
    store_row<D>(sum, a.fv + kStride<D> * i);
  }
}

// The least of limit - |x_ip|^2 over the bonds of a row and `least`.
template <int D>
CLEAVE_INLINE Lanes least_left(const LookArrays& a, const BlockRows& rows, const float* limits,
                               std::int64_t i, Lanes least) {
  const Row<D> xi = load_row<D>(a.x + kStride<D> * i);
  const std::int64_t first = rows.begin[i], last = first + rows.count[i];
  for (std::int64_t b = first; b < last; b += kGroup) {
    GroupRows<D> x;
    alignas(32) double limit[kGroup];
    for (int g = 0; g < kGroup; ++g) {
      const std::int64_t bond = std::min(b + g, last - 1);
      x.row[g] = load_row<D>(a.x + kStride<D> * rows.end[bond]) - xi;
      limit[g] = limits[bond];
    }
    Lanes d[kStride<D>];
    x.lanes(d);
    Lanes square = d[0] * d[0];
    for (int k = 1; k < D; ++k) square = square + d[k] * d[k];
    const Lanes left = load_lanes<Lanes, true>(limit, 1) - square;
    least = select(left < least, left, least);
  }
  return least;
}

template <int D>
void look(const LookArrays& arrays) {
  const LookArrays a = arrays;
  const auto place = [&](std::int64_t from, std::int64_t l) {
    store_row<D>(load_row<D>(a.X + D * from) + load_row<D>(a.u + D * from), a.x + kStride<D> * l);
  };
  for (std::int64_t l = 0; l < a.own; ++l) place(a.first + l, l);
  for (std::int64_t l = a.own; l < a.locals; ++l) place(a.foreign[l - a.own], l);
  for (std::int64_t i = 0; i < a.own; ++i) {
    if (a.slack[i] > 0) continue;
    Lanes least(std::numeric_limits<double>::infinity());
    least = least_left<D>(a, a.twins, a.twin_limits, i, least);
    least = least_left<D>(a, a.halves, a.half_limits, i, least);
    double left[kGroup];
    store_lanes<Lanes, true>(least, left, 1);
    a.slack[i] = static_cast<float>(std::min({left[0], left[1], left[2], left[3]}) * a.scale);
  }
}

template <int D>
double largest_square_strain(const double* h, std::int32_t count) {
  double largest = 0;
  for (std::int32_t q = 0; q < count; ++q) {
    const double* t = h + kTensor * q;
    double square = 0;
    for (int c = 0; c < D; ++c) {
      for (int r = 0; r <= c; ++r) {
        double e = t[component(r, c)] + t[component(c, r)];
        for (int k = 0; k < D; ++k) e += t[component(k, r)] * t[component(k, c)];
        square += (r == c ? 1 : 2) * (e * e);
      }
    }
    largest = square > largest ? square : largest;
  }
  return largest;
}

// One chain of sums a direction: they do not wait for each other.
template <int D>
struct Sums {
  double internal[D] = {}, viscous[D] = {}, external[D] = {};
  PowerSums total() const {
    PowerSums t{internal[0], viscous[0], external[0]};
    for (int k = 1; k < D; ++k) {
      t.internal += internal[k];
      t.viscous += viscous[k];
      t.external += external[k];
    }
    return t;
  }
};

// Without forces from outside 0 is added, not nothing: the sign of a zero must not depend on whether there
// were some before a restart.
template <bool kViscous, bool kExternal>
CLEAVE_INLINE double total_force(const MotionArrays& a, std::int64_t c) {
  double f = a.f[c];
  if constexpr (kViscous) f = f + a.fv[c];
  return f + (kExternal ? a.fe[c] : 0.0);
}
template <int D, bool kViscous, bool kExternal>
CLEAVE_INLINE void add_power(const MotionArrays& a, std::int64_t c, int k, double v, Sums<D>& s) {
  s.internal[k] += a.f[c] * v;
  if constexpr (kViscous) s.viscous[k] += a.fv[c] * v;
  if constexpr (kExternal) s.external[k] += a.fe[c] * v;
}

template <int D, bool kViscous, bool kExternal>
PowerSums advance(const MotionArrays& arrays, std::int64_t first, std::int64_t last, double half,
                  double dt, VelocityBox& box) {
  const MotionArrays a = arrays;
  Sums<D> sums;
  double low[D], high[D];
  for (int k = 0; k < D; ++k) low[k] = high[k] = first < last ? a.v[D * first + k] : 0.0;
  for (std::int64_t p = first; p < last; ++p) {
    const double scale = a.driven[p] != 0 ? 0.0 : a.inverse_mass[p];
    for (int k = 0; k < D; ++k) {
      const std::int64_t c = D * p + k;
      double v = a.v[c];
      if (scale > 0) {
        v = v + half * (total_force<kViscous, kExternal>(a, c) * scale);
        add_power<D, kViscous, kExternal>(a, c, k, v, sums);
        a.v[c] = v;
        a.u[c] = a.u[c] + dt * v;
      }
      low[k] = v < low[k] ? v : low[k];
      high[k] = v > high[k] ? v : high[k];
    }
  }
  for (int k = 0; k < 3; ++k) {
    box.low[k] = k < D ? low[k] : 0.0;
    box.high[k] = k < D ? high[k] : 0.0;
  }
  return sums.total();
}

template <int D, bool kViscous, bool kExternal>
PowerSums kick(const MotionArrays& arrays, std::int64_t first, std::int64_t last, double half) {
  const MotionArrays a = arrays;
  Sums<D> sums;
  for (std::int64_t p = first; p < last; ++p) {
    if (a.driven[p] != 0) continue;
    const double scale = a.inverse_mass[p];
    for (int k = 0; k < D; ++k) {
      const std::int64_t c = D * p + k;
      const double v = a.v[c];
      add_power<D, kViscous, kExternal>(a, c, k, v, sums);
      a.v[c] = v + half * (total_force<kViscous, kExternal>(a, c) * scale);
    }
  }
  return sums.total();
}

template <int D>
PowerSums advance_any(const MotionArrays& a, std::int64_t first, std::int64_t last, double half,
                      double dt, VelocityBox& box) {
  if (a.fv != nullptr) {
    return a.fe != nullptr ? advance<D, true, true>(a, first, last, half, dt, box)
                           : advance<D, true, false>(a, first, last, half, dt, box);
  }
  return a.fe != nullptr ? advance<D, false, true>(a, first, last, half, dt, box)
                         : advance<D, false, false>(a, first, last, half, dt, box);
}

template <int D>
PowerSums kick_any(const MotionArrays& a, std::int64_t first, std::int64_t last, double half) {
  if (a.fv != nullptr) {
    return a.fe != nullptr ? kick<D, true, true>(a, first, last, half)
                           : kick<D, true, false>(a, first, last, half);
  }
  return a.fe != nullptr ? kick<D, false, true>(a, first, last, half)
                         : kick<D, false, false>(a, first, last, half);
}

}  // namespace

extern const BlockKernels kBlockKernels;
constinit const BlockKernels kBlockKernels = {
    {&advance_any<2>, &advance_any<3>},
    {&kick_any<2>, &kick_any<3>},
    {&form_gradient<2>, &form_gradient<3>},
    {&largest_square_strain<2>, &largest_square_strain<3>},
    {&form_force<2>, &form_force<3>},
    {&form_viscous_force<2>, &form_viscous_force<3>},
    {&look<2>, &look<3>}};

}  // namespace cleave
