// Eight neighbours of a row in the lanes of a register, for kernels over bonds.
#pragma once

#include "core/lane_memory.hpp"
#include "formulation/peridynamics/bits.hpp"

namespace cleave::peridynamics {

// The neighbours b to b+7 of a row that ends before `last`; those beyond the end repeat the last.
struct Eight {
  std::int32_t point[kWide];
  CLEAVE_INLINE Eight(const std::int32_t* neighbour, std::int32_t b, std::int32_t last) {
    for (int l = 0; l < kWide; ++l) point[l] = neighbour[b + l < last ? b + l : last - 1];
  }
  // Four numbers of each.
  CLEAVE_INLINE void rows(const double* from, Lanes (&c)[4]) const {
    alignas(64) double row[kWide][4];
    for (int l = 0; l < kWide; ++l)
      std::memcpy(row[l], from + 4 * static_cast<std::int64_t>(point[l]), sizeof row[l]);
    load_components<4>(&row[0][0], 4, c);
  }
  CLEAVE_INLINE Lanes scalars(const double* from) const {
    alignas(64) double value[kWide];
    for (int l = 0; l < kWide; ++l) value[l] = from[point[l]];
    return load_lanes8(value);
  }
};

// Bits of those that carry.
CLEAVE_INLINE unsigned carrying(const std::uint64_t* intact, std::int32_t b, std::int32_t last) {
  return eight_bits(intact, b) & lower_bits(last - b);
}

CLEAVE_INLINE void store_sums(const Lanes (&f)[3], double* force, std::int64_t i) {
  for (int k = 0; k < 3; ++k) force[3 * i + k] = sum_of(f[k]);
}

}  // namespace cleave::peridynamics
