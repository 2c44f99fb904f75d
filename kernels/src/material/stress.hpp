// The stress update over a range of points: the local part of the step, between the two sparse
// products.
#pragma once

#include <cmath>
#include <cstdint>

#include "material/material.hpp"

namespace cleave {

// Where history variable k of point q stands: base[k] + stride[k] * q.
struct HistoryArrays {
  std::array<double*, kMaxHistory> base{};
  std::array<int, kMaxHistory> stride{};

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
  const double* h = nullptr;       // (9,n) displacement gradient [1]
  const double* volume = nullptr;  // (n) [m3]; NULL: all points live and `length` holds for all
  double dt = 0;                   // [s]
  double length = 0;               // [m] without volume
  HistoryArrays history;
  double* p = nullptr;             // (9,n) first Piola-Kirchhoff stress [Pa]
  double* energy = nullptr;        // (n) stored [J m-3]; may be NULL
  double* plastic = nullptr;       // (n) dissipated by plastic flow in this update; may be NULL
  std::int32_t* failed = nullptr;  // (n) 1: the law has no answer; may be NULL

  template <int D>
  Increment increment(std::int64_t q) const {
    if (volume == nullptr) return {dt, length};
    return {dt, D == 2 ? std::sqrt(volume[q]) : std::cbrt(volume[q])};
  }
};

// What a range of points dissipated [J] (with volume; else the sum of densities), and the first point
// without an answer, or -1.
struct StressResult {
  std::int64_t first_failed = -1;
  double plastic = 0, viscous = 0;
};

// P and energy of first <= q < last from the displacement gradient. Points without volume get P = 0,
// energy 0, and keep their history. Where the law has no answer P = 0.
template <int D, class Law>
StressResult update_stress(const Law& law, const StressArrays& a, std::int64_t first,
                           std::int64_t last) {
  StressResult result;
  for (std::int64_t q = first; q < last; ++q) {
    Response<Mat<D>> r;
    const double volume = a.volume == nullptr ? 1.0 : a.volume[q];
    if (volume > 0) {
      r = law.respond(load_tensor<D>(a.h, q), a.history.at(q), a.template increment<D>(q));
    }
    if (!r.valid) {
      r = Response<Mat<D>>{};
      r.valid = false;
      if (result.first_failed < 0) result.first_failed = q;
    }
    store_tensor(r.stress, a.p, q);
    if constexpr (D == 2) a.p[kTensor * q + component(2, 2)] = r.stress_33;
    if (a.energy != nullptr) a.energy[q] = r.energy;
    if (a.plastic != nullptr) a.plastic[q] = r.plastic;
    if (a.failed != nullptr) a.failed[q] = r.valid ? 0 : 1;
    result.plastic += volume * r.plastic;
    result.viscous += volume * r.viscous;
  }
  return result;
}

// What the law would answer at point q, with its history read and left alone: for questions such as
// "how much energy would be stored".
template <int D>
Response<Mat<D>> trial_response(const Material& material, const HistoryArrays& history,
                                const Mat<D>& h, const Increment& increment, std::int64_t q) {
  double copy[kMaxHistory][kTensor];
  History trial;
  for (std::size_t k = 0; k < kMaxHistory; ++k) {
    if (history.base[k] == nullptr) continue;
    for (int c = 0; c < history.stride[k]; ++c)
      copy[k][c] = history.base[k][history.stride[k] * q + c];
    trial.variable[k] = copy[k];
  }
  return with_law(material, [&](const auto& law) { return law.respond(h, trial, increment); });
}

}  // namespace cleave
