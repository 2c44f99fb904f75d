// Sets of small numbers as bits, and eight of them as numbers 0 or 1 in the lanes of a register. For use
// in kernels that are compiled for several instruction sets, too.
#pragma once

#include <array>
#include <cstdint>
#include <cstring>
#include <limits>

#include "core/lanes.hpp"

namespace cleave::peridynamics {

inline constexpr int kWide = 8;  // lanes of every kernel here, whatever the registers
using Lanes = Pack<kWide>;

CLEAVE_INLINE bool bit_of(const std::uint64_t* bits, std::int64_t k) {
  return ((bits[k >> 6] >> (k & 63)) & 1u) != 0;
}
CLEAVE_INLINE void set_bit(std::uint64_t* bits, std::int64_t k, bool value) {
  const std::uint64_t one = std::uint64_t{1} << (k & 63);
  bits[k >> 6] = value ? bits[k >> 6] | one : bits[k >> 6] & ~one;
}
// Bits k to k+7; a word follows the last.
CLEAVE_INLINE unsigned eight_bits(const std::uint64_t* bits, std::int64_t k) {
  const int shift = static_cast<int>(k & 63);
  std::uint64_t word = bits[k >> 6] >> shift;
  if (shift > 56) word |= bits[(k >> 6) + 1] << (64 - shift);
  return static_cast<unsigned>(word & 0xffu);
}

// 1 in the lanes of set bits, else 0.
using LaneTable = std::array<std::array<double, kWide>, 256>;
constexpr LaneTable make_lane_table() {
  LaneTable table{};
  for (unsigned byte = 0; byte < 256; ++byte)
    for (unsigned l = 0; l < kWide; ++l) table[byte][l] = ((byte >> l) & 1u) != 0 ? 1.0 : 0.0;
  return table;
}
alignas(64) inline constexpr LaneTable kLaneTable = make_lane_table();
// The lower bits of a byte: those of k < count.
CLEAVE_INLINE unsigned lower_bits(std::int64_t count) {
  return count >= kWide ? 0xffu : (1u << count) - 1u;
}
// |a| with the sign of b; a >= 0.
CLEAVE_INLINE Lanes with_sign_of(const Lanes& a, const Lanes& b) {
  constexpr int kNative = kWide < kNativeLanes ? kWide : kNativeLanes;
  typedef std::int64_t Bits __attribute__((vector_size(8 * kNative)));
  Lanes c;
  for (int k = 0; k < Lanes::kRegisters; ++k) {
    const Bits sign = reinterpret_cast<Bits>(b.r[k]) & std::numeric_limits<std::int64_t>::min();
    c.r[k] = reinterpret_cast<Lanes::Register>(reinterpret_cast<Bits>(a.r[k]) | sign);
  }
  return c;
}
// Register by register: GCC copies a pack of several through memory in pieces that stall the next load.
CLEAVE_INLINE Lanes load_lanes8(const double* from) {
  Lanes a;
  for (int k = 0; k < Lanes::kRegisters; ++k)
    std::memcpy(&a.r[k], from + kWide / Lanes::kRegisters * k, sizeof a.r[k]);
  return a;
}
CLEAVE_INLINE void store_lanes8(const Lanes& a, double* to) {
  for (int k = 0; k < Lanes::kRegisters; ++k)
    std::memcpy(to + kWide / Lanes::kRegisters * k, &a.r[k], sizeof a.r[k]);
}

CLEAVE_INLINE Lanes lanes_of(unsigned byte) { return load_lanes8(kLaneTable[byte].data()); }
// Lanes added in one order for every instruction set.
CLEAVE_INLINE double sum_of(const Lanes& a) {
  double l[kWide];
  store_lanes8(a, l);
  return ((l[0] + l[1]) + (l[2] + l[3])) + ((l[4] + l[5]) + (l[6] + l[7]));
}

}  // namespace cleave::peridynamics
