// The loops that block_kernels.hpp declares, compiled for every instruction set: a vector of a particle
// fills the lanes of a register.

#include "formulation/cbm/block_kernels.hpp"

#include <cmath>
#include <cstring>

#include "core/lanes.hpp"
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

template <int D>
void form_gradient(const BlockArrays& arrays, std::int32_t first, std::int32_t last, double* h) {
  const BlockArrays a = arrays;
  constexpr int kRows = D * kStride<D>;
  for (std::int32_t i = first; i < last; ++i) {
    Row<D> sum[D], ui[D];
    for (int r = 0; r < D; ++r) {
      sum[r] = load_row<D>(a.rows + kRows * i + kStride<D> * r);
      ui[r] = Row<D>(a.u[kStride<D> * i + r]);
    }
    for (std::int32_t b = a.twins.begin[i]; b < a.twins.begin[i + 1]; ++b) {
      const std::int64_t p = a.twins.end[b];
      const Row<D> zeta = load_row<D>(a.twins.zeta + D * static_cast<std::int64_t>(b));
      double* other = a.rows + kRows * p;
      for (int r = 0; r < D; ++r) {
        const Row<D> part = (Row<D>(a.u[kStride<D> * p + r]) - ui[r]) * zeta;
        sum[r] = sum[r] + part;
        add_row<D>(other + kStride<D> * r, part);
      }
    }
    for (std::int32_t b = a.halves.begin[i]; b < a.halves.begin[i + 1]; ++b) {
      const std::int64_t p = a.halves.end[b];
      const Row<D> zeta = load_row<D>(a.halves.zeta + D * static_cast<std::int64_t>(b));
      for (int r = 0; r < D; ++r)
        sum[r] = sum[r] + (Row<D>(a.u[kStride<D> * p + r]) - ui[r]) * zeta;
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
    for (std::int32_t b = a.twins.begin[i]; b < a.twins.begin[i + 1]; ++b) {
      const std::int64_t p = a.twins.end[b];
      const double* zeta = a.twins.zeta + D * static_cast<std::int64_t>(b);
      const double* other = a.P + kTensor * p;
      Row<D> pull = zeta[0] * (column[0] + load_row<D>(other));
      for (int c = 1; c < D; ++c) pull = pull + zeta[c] * (column[c] + load_row<D>(other + 3 * c));
      sum = sum + pull;
      double* to = a.f + kStride<D> * p;
      store_row<D>(load_row<D>(to) - pull, to);
    }
    for (std::int32_t b = a.halves.begin[i]; b < a.halves.begin[i + 1]; ++b) {
      const std::int64_t p = a.halves.end[b];
      const double* zeta = a.halves.zeta + D * static_cast<std::int64_t>(b);
      Row<D> pull = zeta[0] * column[0];
      for (int c = 1; c < D; ++c) pull = pull + zeta[c] * column[c];
      sum = sum + pull;
      double* to = a.f + kStride<D> * p;
      store_row<D>(load_row<D>(to) - pull, to);
    }
    store_row<D>(sum, a.f + kStride<D> * i);
  }
}

// beta rho0 c0 l rate_ip w / |x_ip|^2 with the weight and rate of theory/cbm section 5; zero for ends that
// coincide.
template <int D>
CLEAVE_INLINE double viscous_scale(const BlockArrays& a, std::int64_t i, std::int64_t p,
                                   double weight) {
  double square = 0, approach = 0;
  for (int k = 0; k < D; ++k) {
    const double x = a.x[kStride<D> * p + k] - a.x[kStride<D> * i + k];
    square += x * x;
    approach += (a.v[kStride<D> * p + k] - a.v[kStride<D> * i + k]) * x;
  }
  if (!(square > 0)) return 0.0;
  double l = a.length;
  if (a.X != nullptr) {
    double reference = 0;
    for (int k = 0; k < D; ++k) {
      const double x = a.X[kStride<D> * p + k] - a.X[kStride<D> * i + k];
      reference += x * x;
    }
    l = std::sqrt(reference);
  }
  return a.coefficient * l * approach * weight / ((square + 0.01 * l * l) * square);
}

template <int D>
void form_viscous_force(const BlockArrays& arrays) {
  const BlockArrays a = arrays;
  for (std::int32_t i = 0; i < a.own; ++i) {
    const Row<D> xi = load_row<D>(a.x + kStride<D> * i);
    Row<D> sum = load_row<D>(a.fv + kStride<D> * i);
    const auto pull = [&](std::int64_t p, double scale) {
      const Row<D> force = scale * (load_row<D>(a.x + kStride<D> * p) - xi);
      sum = sum + force;
      double* to = a.fv + kStride<D> * p;
      store_row<D>(load_row<D>(to) - force, to);
    };
    for (std::int32_t b = a.twins.begin[i]; b < a.twins.begin[i + 1]; ++b) {
      const std::int64_t p = a.twins.end[b];
      pull(p, viscous_scale<D>(a, i, p, a.twins.weight[b] * (a.J[i] + a.J[p])));
    }
    for (std::int32_t b = a.halves.begin[i]; b < a.halves.begin[i + 1]; ++b) {
      const std::int64_t p = a.halves.end[b];
      pull(p, viscous_scale<D>(a, i, p, a.halves.weight[b] * a.J[i]));
    }
    store_row<D>(sum, a.fv + kStride<D> * i);
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

template <int D, bool kViscous, bool kExternal>
CLEAVE_INLINE double total_force(const MotionArrays& a, std::int64_t c) {
  double f = a.f[c];
  if constexpr (kViscous) f = f + a.fv[c];
  if constexpr (kExternal) f = f + a.fe[c];
  return f;
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
        v = v + half * (total_force<D, kViscous, kExternal>(a, c) * scale);
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
      a.v[c] = v + half * (total_force<D, kViscous, kExternal>(a, c) * scale);
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
    {&advance_any<2>, &advance_any<3>},     {&kick_any<2>, &kick_any<3>},
    {&form_gradient<2>, &form_gradient<3>}, {&largest_square_strain<2>, &largest_square_strain<3>},
    {&form_force<2>, &form_force<3>},       {&form_viscous_force<2>, &form_viscous_force<3>}};

}  // namespace cleave
