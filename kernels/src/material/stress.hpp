// The stress update over a range of points: the local part of the step, between the two sparse
// products.
#pragma once

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

// P, energy (if not NULL) of first <= q < last from the displacement gradient. Points where volume
// (if not NULL) is zero get P = 0, energy 0, and keep their history. Where the law has no answer P
// = 0 and failed (if not NULL) is 1. Returns the first such point, or -1.
template <int D, class Law>
std::int64_t update_stress(const Law& law, const double* h, const double* volume,
                           std::int64_t first, std::int64_t last, const HistoryArrays& history,
                           double* p, double* energy, std::int32_t* failed) {
  std::int64_t first_failed = -1;
  for (std::int64_t q = first; q < last; ++q) {
    Response<Mat<D>> r;
    if (volume == nullptr || volume[q] > 0) r = law.respond(load_tensor<D>(h, q), history.at(q));
    if (!r.valid) {
      r = Response<Mat<D>>{};
      r.valid = false;
      if (first_failed < 0) first_failed = q;
    }
    store_tensor(r.stress, p, q);
    if constexpr (D == 2) p[kTensor * q + component(2, 2)] = r.stress_33;
    if (energy != nullptr) energy[q] = r.energy;
    if (failed != nullptr) failed[q] = r.valid ? 0 : 1;
  }
  return first_failed;
}

// What the law would answer at point q, with its history read and left alone: for questions such as
// "how much energy would be stored".
template <int D>
Response<Mat<D>> trial_response(const Material& material, const HistoryArrays& history,
                                const Mat<D>& h, std::int64_t q) {
  double copy[kMaxHistory][kTensor];
  History trial;
  for (std::size_t k = 0; k < kMaxHistory; ++k) {
    if (history.base[k] == nullptr) continue;
    for (int c = 0; c < history.stride[k]; ++c)
      copy[k][c] = history.base[k][history.stride[k] * q + c];
    trial.variable[k] = copy[k];
  }
  return with_law(material, [&](const auto& law) { return law.respond(h, trial); });
}

}  // namespace cleave
