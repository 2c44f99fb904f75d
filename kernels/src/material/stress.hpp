// The stress update over a range of points: the local part of the step, between the two sparse
// products. Laws that work in lanes get as many points at once as a register holds; the bits are those
// of one point after the other, for any range and any neighbours.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>

#include "material/material.hpp"

namespace cleave {

// Where history component c of variable k of point q stands:
// base[k] + stride[k] * q + component_stride * c.
struct HistoryArrays {
  std::array<double*, kMaxHistory> base{};
  std::array<std::int64_t, kMaxHistory> stride{};
  std::int64_t component_stride = 1;

  // component_stride must be 1.
  History at(std::int64_t q) const {
    History h;
    for (std::size_t k = 0; k < kMaxHistory; ++k) {
      h.variable[k] = base[k] == nullptr ? nullptr : base[k] + stride[k] * q;
    }
    return h;
  }
};

// The arrays of a stress update. Pointers that may be NULL say so.
struct StressArrays {
  const double* h = nullptr;  // (9,n) displacement gradient [1]
  const double* volume =
      nullptr;        // (n) [m3]; NULL: all points live, and have `length` or `lengths`
  double dt = 0;      // [s]
  double length = 0;  // [m] without volume ...
  const double* lengths = nullptr;  // ... or of point q at lengths[length_stride * q]; may be NULL
  std::int64_t length_stride = 1;
  HistoryArrays history;
  double* p = nullptr;             // (9,n) first Piola-Kirchhoff stress [Pa]
  double* energy = nullptr;        // (n) stored [J m-3]; may be NULL
  double* plastic = nullptr;       // (n) dissipated by plastic flow in this update; may be NULL
  double* viscous = nullptr;       // (n) and by the law's own viscosity [J m-3]; may be NULL
  std::int32_t* failed = nullptr;  // (n) 1: the law has no answer; may be NULL

  template <int D>
  Increment increment(std::int64_t q) const {
    if (volume == nullptr) return {dt, lengths == nullptr ? length : lengths[length_stride * q]};
    return {dt, D == 2 ? std::sqrt(volume[q]) : std::cbrt(volume[q])};
  }
  bool live(std::int64_t q) const { return volume == nullptr || volume[q] > 0; }
};

// What a range of points dissipated [J] (with volume; else the sum of densities), and the first point
// without an answer, or -1.
struct StressResult {
  std::int64_t first_failed = -1;
  double plastic = 0, viscous = 0;
};

// A law that works on several points at once; see lane_point.hpp.
template <class Law>
concept LaneLaw = requires {
  Law::kLaneHistory;
};

namespace stress_update {

// Scalars of point q, and the sums.
inline void book(const StressArrays& a, std::int64_t q, bool valid, double energy, double plastic,
                 double viscous, StressResult& result) {
  if (!valid && result.first_failed < 0) result.first_failed = q;
  if (a.energy != nullptr) a.energy[q] = energy;
  if (a.plastic != nullptr) a.plastic[q] = plastic;
  if (a.viscous != nullptr) a.viscous[q] = viscous;
  if (a.failed != nullptr) a.failed[q] = valid ? 0 : 1;
  const double volume = a.volume == nullptr ? 1.0 : a.volume[q];
  result.plastic += volume * plastic;
  result.viscous += volume * viscous;
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
void update_point(const Law& law, const StressArrays& a, std::int64_t q, StressResult& result) {
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
  book(a, q, r.valid, r.energy, r.plastic, r.viscous, result);
}

// f(component of the lanes, its place in a tensor) for the components in D dimensions; `with_33`: that
// one too in two.
template <int D, bool with_33, class R, class F>
void each_component(Full<R>& t, const F& f) {
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
  if constexpr (D == 3 || with_33) f(t.zz, component(2, 2));
}

// f(component of the lanes, its address, distance to the next point)
template <class Law, class R, class F>
void each_history(std::array<R, Law::kLaneHistory>& history, const HistoryArrays& a, std::int64_t q,
                  const F& f) {
  std::size_t place = 0;
  for (std::size_t k = 0; k < Law::kHistory.size(); ++k) {
    for (int c = 0; c < Law::kHistory[k].components; ++c)
      f(history[place++], a.base[k] + a.stride[k] * q + a.component_stride * c, a.stride[k]);
  }
}

// Points q, q+1, ... of the lanes of R. kUnitHistory: the same history of neighbouring points stands
// side by side.
template <int D, class R, bool kUnitHistory, class Law>
void update_lanes(const Law& law, const StressArrays& a, std::int64_t q, StressResult& result) {
  constexpr int kLanes = kLanesOf<R>;
  LanePoint<R, Law::kLaneHistory> point;
  point.h = Full<R>{};
  each_component<D, false>(point.h, [&](R& x, int place) {
    x = load_lanes<R, false>(a.h + kTensor * q + place, kTensor);
  });
  each_history<Law>(point.history, a.history, q, [](R& x, const double* from, std::int64_t stride) {
    x = load_lanes<R, kUnitHistory>(from, stride);
  });
  Setting<R> setting{a.dt, R(a.length)};
  if constexpr (Law::kUsesLength) {
    for (int l = 0; l < kLanes; ++l)
      set_lane(setting.length, l, a.live(q + l) ? a.template increment<D>(q + l).length : 0.0);
  }
  law.update(point, setting);

  bool all_live = true;
  for (int l = 0; l < kLanes; ++l) all_live = all_live && a.live(q + l);
  if (all_live && all(point.valid)) {
    each_component<D, true>(point.p, [&](const R& x, int place) {
      store_lanes<R, false>(x, a.p + kTensor * q + place, kTensor);
    });
    each_history<Law>(point.history, a.history, q, [](const R& x, double* to, std::int64_t stride) {
      store_lanes<R, kUnitHistory>(x, to, stride);
    });
    for (int l = 0; l < kLanes; ++l)
      book(a, q + l, true, lane(point.energy, l), lane(point.plastic, l), lane(point.viscous, l),
           result);
    return;
  }
  for (int l = 0; l < kLanes; ++l) {
    const bool valid = lane(point.valid, l), good = valid && a.live(q + l);
    each_component<D, true>(point.p, [&](const R& x, int place) {
      a.p[kTensor * (q + l) + place] = good ? lane(x, l) : 0.0;
    });
    if (good) {
      each_history<Law>(point.history, a.history, q + l,
                        [&](const R& x, double* to, std::int64_t) { *to = lane(x, l); });
    }
    book(a, q + l, valid || !a.live(q + l), good ? lane(point.energy, l) : 0.0,
         good ? lane(point.plastic, l) : 0.0, good ? lane(point.viscous, l) : 0.0, result);
  }
}

template <int D, bool kUnitHistory, class Law>
void update_batches(const Law& law, const StressArrays& a, std::int64_t first, std::int64_t last,
                    StressResult& result) {
  using Lanes = Pack<kNativeLanes>;
  std::int64_t q = first;
  for (; q + kNativeLanes <= last; q += kNativeLanes) {
    update_lanes<D, Lanes, kUnitHistory>(law, a, q, result);
  }
  for (; q < last; ++q) update_lanes<D, double, kUnitHistory>(law, a, q, result);
}

}  // namespace stress_update

// One point after the other: the bits of update_stress.
template <int D, class Law>
StressResult update_stress_pointwise(const Law& law, const StressArrays& a, std::int64_t first,
                                     std::int64_t last) {
  StressResult result;
  for (std::int64_t q = first; q < last; ++q) stress_update::update_point<D>(law, a, q, result);
  return result;
}

// P and energy of first <= q < last from the displacement gradient. Points without volume get P = 0,
// energy 0, and keep their history. Where the law has no answer P = 0.
template <int D, class Law>
StressResult update_stress(const Law& law, const StressArrays& a, std::int64_t first,
                           std::int64_t last) {
  if constexpr (LaneLaw<Law>) {
    if (law.in_lanes()) {
      StressResult result;
      bool unit = true;
      for (std::size_t k = 0; k < Law::kHistory.size(); ++k)
        unit = unit && a.history.stride[k] == 1;
      if (unit) {
        stress_update::update_batches<D, true>(law, a, first, last, result);
      } else {
        stress_update::update_batches<D, false>(law, a, first, last, result);
      }
      return result;
    }
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
