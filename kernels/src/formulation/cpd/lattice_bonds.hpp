// Which bonds of points on a lattice carry, as one bit for each cell and each place of a neighbour ahead, so that a
// kernel finds those of eight points side by side in a byte.                                    [PD 12, 13]
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "formulation/cpd/lattice_kernels.hpp"

namespace cleave::cpd {

class LatticeBonds {
 public:
  using Cell = std::array<std::int32_t, 3>;  // along the fast, middle and slow axis

  // ahead: places of the neighbours that come later in the order of slow, middle, fast; thirds: behind their pairs, with
  // places in the same list. Two places closer than the square root of `limit` are bonded.
  void setup(const Cell& shape, std::int32_t reach, const std::vector<Cell>& ahead,
             const std::vector<ShapePair>& pairs, const std::vector<ShapeThird>& thirds,
             double limit);
  // The bond of a cell to a place ahead.
  void set(const Cell& cell, std::int32_t place, bool carries);
  // For the eight cells from one on: a byte for each place ahead, then for each bond between two of them. False:
  // all carry, or no bond of the body is broken.
  bool look_up(const Cell& cell, std::uint8_t* bytes) const;
  std::size_t count() const { return bonds_.size(); }  // bytes of an eight
  // Of the pairs (a b), and of the thirds (a c, then b c): their places among the bonds between two members.
  const std::int32_t* of_pairs() const { return of_pairs_.data(); }
  const std::int32_t* of_thirds() const { return of_thirds_.data(); }
  std::int64_t bytes() const;

 private:
  struct Bond {  // from which cell, counted from the first of the eight, to which place ahead of it
    std::int64_t distance;
    std::int32_t place;
  };
  std::int64_t bit(const Cell& cell) const;  // in a plane

  Cell shape_{};
  std::int32_t reach_ = 0;
  std::vector<Bond> bonds_;
  std::vector<std::int32_t> of_pairs_, of_thirds_;
  std::vector<std::uint64_t> carry_;  // plane_ words for each place ahead; 0: broken
  std::int64_t plane_ = 0, broken_ = 0;
};

}  // namespace cleave::cpd
