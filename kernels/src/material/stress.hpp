// The stress update over a range of points: the local part of the step, between the two sparse
// products. Laws that work in lanes get as many points at once as a register holds; the bits are those
// of one point after the other, for any range and any neighbours.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <type_traits>

#include "core/lane_memory.hpp"
#include "material/material.hpp"

namespace cleave {

// A law that works on several points at once; see lane_point.hpp.
template <class Law>
concept LaneLaw = requires {
  Law::kLaneHistory;
};

namespace stress_update {

// What points dissipate, in eight sums over every eighth point of the range: the same for any number
// of lanes up to eight.
struct Sums {
  static constexpr std::int64_t kSums = 8;
  explicit Sums(std::int64_t first_point) : first(first_point) {}
  std::int64_t first;  // of the range
  StressResult result;
  double plastic[kSums] = {}, viscous[kSums] = {};

  // Points q, q+1 ... of the lanes; q - first is a multiple of their number.
  template <class R>
  CLEAVE_INLINE void add(std::int64_t q, const R& volume, const R& plastic_here,
                         const R& viscous_here) {
    static_assert(kSums % kLanesOf<R> == 0);
    double* p = plastic + (q - first) % kSums;
    double* v = viscous + (q - first) % kSums;
    store_lanes<R, true>(load_lanes<R, true>(p, 1) + volume * plastic_here, p, 1);
    store_lanes<R, true>(load_lanes<R, true>(v, 1) + volume * viscous_here, v, 1);
  }
  StressResult total() const {
    StressResult r = result;
    for (int k = 0; k < kSums; ++k) {
      r.plastic += plastic[k];
      r.viscous += viscous[k];
    }
    return r;
  }
};

// Scalars of point q, and the sums.
inline void book(const StressArrays& a, std::int64_t q, bool valid, double energy, double plastic,
                 double viscous, Sums& sums) {
  if (!valid && sums.result.first_failed < 0) sums.result.first_failed = q;
  if (a.energy != nullptr) a.energy[q] = energy;
  if (a.plastic != nullptr) a.plastic[q] = plastic;
  if (a.viscous != nullptr) a.viscous[q] = viscous;
  if (a.failed != nullptr) a.failed[q] = valid ? 0 : 1;
  sums.add(q, a.volume == nullptr ? 1.0 : a.volume[q], plastic, viscous);
}

// History of one point beside each other, for arrays that stand otherwise.
template <class Law>
struct LocalHistory {
  static constexpr int kVariables = static_cast<int>(Law::kHistory.size());
  double value[kMaxHistory][kTensor];
  History pointers;

  template <class F>
  void each(const HistoryArrays& arrays, std::int64_t q, const F& f) {
    for (std::size_t k = 0; k < kVariables; ++k) {
      for (int c = 0; c < Law::kHistory[k].components; ++c)
        f(value[k][c], arrays.base[k][arrays.stride[k] * q + arrays.component_stride * c]);
    }
  }
  LocalHistory(const HistoryArrays& arrays, std::int64_t q) {
    each(arrays, q, [](double& mine, double& theirs) { mine = theirs; });
    for (std::size_t k = 0; k < kVariables; ++k) pointers.variable[k] = value[k];
  }
};

// One point by the law's respond.
template <int D, class Law>
void update_point(const Law& law, const StressArrays& a, std::int64_t q, Sums& sums) {
  Response<Mat<D>> r;
  if (a.live(q)) {
    const Mat<D> h = load_tensor<D>(a.h, q);
    if (a.history.component_stride == 1) {
      r = law.respond(h, a.history.at(q), a.template increment<D>(q));
    } else {
      LocalHistory<Law> local(a.history, q);
      r = law.respond(h, local.pointers, a.template increment<D>(q));
      if (r.valid)
        local.each(a.history, q, [](const double& mine, double& theirs) { theirs = mine; });
    }
    if (!r.valid) {
      r = Response<Mat<D>>{};
      r.valid = false;
    }
  }
  store_tensor(r.stress, a.p, q);
  if constexpr (D == 2) a.p[kTensor * q + component(2, 2)] = r.stress_33;
  book(a, q, r.valid, r.energy, r.plastic, r.viscous, sums);
}

// f(component of the lanes, its place in a tensor) for what is stored in D dimensions.
template <int D, class R, class F>
void each_stress(const Full<R>& t, const F& f) {
  f(t.xx, component(0, 0));
  f(t.yx, component(1, 0));
  f(t.xy, component(0, 1));
  f(t.yy, component(1, 1));
  if constexpr (D == 3) {
    f(t.zx, component(2, 0));
    f(t.zy, component(2, 1));
    f(t.xz, component(0, 2));
    f(t.yz, component(1, 2));
  }
  f(t.zz, component(2, 2));
}

template <int D, class R>
CLEAVE_INLINE Full<R> load_gradient(const double* base) {
  if constexpr (D == 3) {
    return load_full<R>(base);
  } else {
    R c[5];
    load_components<5>(base, kTensor, c);
    Full<R> h;
    h.xx = c[component(0, 0)];
    h.yx = c[component(1, 0)];
    h.xy = c[component(0, 1)];
    h.yy = c[component(1, 1)];
    return h;
  }
}
template <int D, class R>
CLEAVE_INLINE void store_stress(const Full<R>& p, double* base) {
  if constexpr (D == 3) {
    store_full(p, base);
  } else {
    each_stress<D>(p,
                   [&](const R& x, int place) { store_lanes<R, false>(x, base + place, kTensor); });
  }
}

// One variable of K components to lanes and back; `base` belongs to the first point.
template <int K, class R>
CLEAVE_INLINE void load_variable(const double* base, std::int64_t component_stride,
                                 std::int64_t stride, R* x) {
  if (K > 1 && component_stride == 1) {
    R c[K];
    load_components<K>(base, stride, c);
    for (int k = 0; k < K; ++k) x[k] = c[k];
  } else if (stride == 1) {
    for (int k = 0; k < K; ++k) x[k] = load_lanes<R, true>(base + component_stride * k, 1);
  } else {
    for (int k = 0; k < K; ++k) x[k] = load_lanes<R, false>(base + component_stride * k, stride);
  }
}
template <int K, class R>
CLEAVE_INLINE void store_variable(const R* x, double* base, std::int64_t component_stride,
                                  std::int64_t stride) {
  if (K > 1 && component_stride == 1) {
    R c[K];
    for (int k = 0; k < K; ++k) c[k] = x[k];
    store_components<K>(c, base, stride);
  } else if (stride == 1) {
    for (int k = 0; k < K; ++k) store_lanes<R, true>(x[k], base + component_stride * k, 1);
  } else {
    for (int k = 0; k < K; ++k) store_lanes<R, false>(x[k], base + component_stride * k, stride);
  }
}

// f(number of components as a type, variable k, place of its first component)
template <class Law, std::size_t k = 0, std::size_t kPlace = 0, class F>
CLEAVE_INLINE void each_variable(const F& f) {
  if constexpr (kPlace < Law::kLaneHistory) {
    constexpr int kComponents = Law::kHistory[k].components;
    f(std::integral_constant<int, kComponents>{}, k, kPlace);
    each_variable<Law, k + 1, kPlace + kComponents>(f);
  }
}
template <class Law, class R>
CLEAVE_INLINE void load_history(const HistoryArrays& a, std::int64_t q,
                                std::array<R, Law::kLaneHistory>& history) {
  each_variable<Law>([&](auto components, std::size_t k, std::size_t place) {
    load_variable<components()>(a.base[k] + a.stride[k] * q, a.component_stride, a.stride[k],
                                history.data() + place);
  });
}
template <class Law, class R>
CLEAVE_INLINE void store_history(const std::array<R, Law::kLaneHistory>& history,
                                 const HistoryArrays& a, std::int64_t q) {
  each_variable<Law>([&](auto components, std::size_t k, std::size_t place) {
    store_variable<components()>(history.data() + place, a.base[k] + a.stride[k] * q,
                                 a.component_stride, a.stride[k]);
  });
}

// Scalars of points q, q+1 ... that are all live and have an answer.
template <class R, int kComponents>
CLEAVE_INLINE void book_lanes(const StressArrays& a, std::int64_t q, const R& volume,
                              const LanePoint<R, kComponents>& point, Sums& sums) {
  if (a.energy != nullptr) store_lanes<R, true>(point.energy, a.energy + q, 1);
  if (a.plastic != nullptr) store_lanes<R, true>(point.plastic, a.plastic + q, 1);
  if (a.viscous != nullptr) store_lanes<R, true>(point.viscous, a.viscous + q, 1);
  if (a.failed != nullptr) std::fill_n(a.failed + q, kLanesOf<R>, 0);
  sums.add(q, volume, point.plastic, point.viscous);
}

// The same where some are not: one after the other, with stress and history.
template <int D, class Law, class R>
[[gnu::noinline, gnu::cold]] void store_some(const StressArrays& a, std::int64_t q,
                                             const LanePoint<R, Law::kLaneHistory>& point,
                                             Sums& sums) {
  for (int l = 0; l < kLanesOf<R>; ++l) {
    const bool valid = lane(point.valid, l), good = valid && a.live(q + l);
    each_stress<D>(point.p, [&](const R& x, int place) {
      a.p[kTensor * (q + l) + place] = good ? lane(x, l) : 0.0;
    });
    if (good) {
      std::array<double, Law::kLaneHistory> history;
      for (std::size_t k = 0; k < history.size(); ++k) history[k] = lane(point.history[k], l);
      store_history<Law>(history, a.history, q + l);
    }
    book(a, q + l, valid || !a.live(q + l), good ? lane(point.energy, l) : 0.0,
         good ? lane(point.plastic, l) : 0.0, good ? lane(point.viscous, l) : 0.0, sums);
  }
}

// Points q, q+1, ... of the lanes of R.
template <int D, class R, class Law>
CLEAVE_INLINE void update_lanes(const Law& law, const StressArrays& a, std::int64_t q, Sums& sums) {
  LanePoint<R, Law::kLaneHistory> point;
  point.h = load_gradient<D, R>(a.h + kTensor * q);
  load_history<Law>(a.history, q, point.history);
  Setting<R> setting{a.dt, R(a.length)};
  if constexpr (Law::kUsesLength) {
    for (int l = 0; l < kLanesOf<R>; ++l)
      set_lane(setting.length, l, a.live(q + l) ? a.template increment<D>(q + l).length : 0.0);
  }
  law.update(point, setting);

  const R volume = a.volume == nullptr ? R(1.0) : load_lanes<R, true>(a.volume + q, 1);
  if (all(point.valid & (volume > 0.0))) {
    store_stress<D>(point.p, a.p + kTensor * q);
    if (!point.unchanged) store_history<Law>(point.history, a.history, q);
    book_lanes(a, q, volume, point, sums);
  } else {
    store_some<D, Law>(a, q, point, sums);
  }
}

template <int D, int W, class Law>
void update_batches(const Law& law, const StressArrays& a, std::int64_t first, std::int64_t last,
                    Sums& sums) {
  std::int64_t q = first;
  for (; q + W <= last; q += W) update_lanes<D, Pack<W>>(law, a, q, sums);
  for (; q < last; ++q) update_lanes<D, double>(law, a, q, sums);
}

}  // namespace stress_update

// One point after the other: the bits of update_stress.
template <int D, class Law>
StressResult update_stress_pointwise(const Law& law, const StressArrays& a, std::int64_t first,
                                     std::int64_t last) {
  stress_update::Sums sums(first);
  for (std::int64_t q = first; q < last; ++q) stress_update::update_point<D>(law, a, q, sums);
  return sums.total();
}

// The same for a law in lanes that is in_lanes().
template <int D, LaneLaw Law>
StressResult update_stress_in_lanes(const Law& law, const StressArrays& a, std::int64_t first,
                                    std::int64_t last) {
  stress_update::Sums sums(first);
  stress_update::update_batches<D, kNativeLanes>(law, a, first, last, sums);
  return sums.total();
}

// P and energy of first <= q < last from the displacement gradient. Points without volume get P = 0,
// energy 0, and keep their history. Where the law has no answer P = 0. With the instructions that the
// including file is compiled for; stress_dispatch.hpp has the best of the machine.
template <int D, class Law>
StressResult update_stress(const Law& law, const StressArrays& a, std::int64_t first,
                           std::int64_t last) {
  if constexpr (LaneLaw<Law>) {
    if (law.in_lanes()) return update_stress_in_lanes<D>(law, a, first, last);
  }
  return update_stress_pointwise<D>(law, a, first, last);
}

// What the law would answer at point q, with its history read and left alone: for questions such as
// "how much energy would be stored".
template <int D>
Response<Mat<D>> trial_response(const Material& material, const HistoryArrays& history,
                                const Mat<D>& h, const Increment& increment, std::int64_t q) {
  return with_law(material, [&](const auto& law) {
    stress_update::LocalHistory<std::decay_t<decltype(law)>> trial(history, q);
    return law.respond(h, trial.pointers, increment);
  });
}

}  // namespace cleave
