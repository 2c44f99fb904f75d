// The arrays that a stress update works on, and what it answers.
//
// In a namespace of their own: these types go from code that runs everywhere to kernels of one
// instruction set (core/instruction_set.hpp). Member functions are always inlined, so that none of them
// exists a second time with other instructions.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>

namespace cleave_call {

#define CLEAVE_CALL_INLINE [[gnu::always_inline]]

// Pointers to the history variables of one point, in the order of the law's kHistory. The same law
// serves separate fields (the model) and packed arrays (array calls).
inline constexpr int kMaxHistory = 12;
struct History {
  std::array<double*, kMaxHistory> variable{};
};

// What a law is told of the update besides the deformation.
struct Increment {
  double dt = 0;  // [s] size of the step; 0 in statics and at the first evaluation: no rates
  double length =
      0;  // [m] size of the particle in the reference configuration, for shock viscosity
};

// Where history component c of variable k of point q stands:
// base[k] + stride[k] * q + component_stride * c.
struct HistoryArrays {
  std::array<double*, kMaxHistory> base{};
  std::array<std::int64_t, kMaxHistory> stride{};
  std::int64_t component_stride = 1;

  // component_stride must be 1.
  CLEAVE_CALL_INLINE History at(std::int64_t q) const {
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
  CLEAVE_CALL_INLINE Increment increment(std::int64_t q) const {
    if (volume == nullptr) return {dt, lengths == nullptr ? length : lengths[length_stride * q]};
    return {dt, D == 2 ? std::sqrt(volume[q]) : std::cbrt(volume[q])};
  }
  CLEAVE_CALL_INLINE bool live(std::int64_t q) const { return volume == nullptr || volume[q] > 0; }
};
#undef CLEAVE_CALL_INLINE

// What a range of points dissipated [J] (with volume; else the sum of densities), and the first point
// without an answer, or -1.
struct StressResult {
  std::int64_t first_failed = -1;
  double plastic = 0, viscous = 0;
};

// The stress update of a law in lanes, for points first <= q < last. `law` points to the bytes of the law,
// which is the same in all instruction sets.
using StressKernel = StressResult (*)(const void* law, const StressArrays& arrays,
                                      std::int64_t first, std::int64_t last);
// By place in the materials table and dimension minus two; NULL for laws without lanes.
inline constexpr int kMaxLaws = 32;
struct StressKernels {
  StressKernel update[kMaxLaws][2];
};

}  // namespace cleave_call

namespace cleave {
using cleave_call::History;
using cleave_call::HistoryArrays;
using cleave_call::Increment;
using cleave_call::kMaxHistory;
using cleave_call::StressArrays;
using cleave_call::StressResult;
}  // namespace cleave
