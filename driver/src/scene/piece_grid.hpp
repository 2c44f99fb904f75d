// Finds the few of many pieces of a crack that lie near a bond: a grid of cells over the crack, each
// with the pieces whose boxes reach into it. Without it a crack of n meshed facets would cost n tests
// for every bond in its box.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "scene/geometry.hpp"

namespace cleave::driver {

class PieceGrid {
 public:
  // The boxes of the pieces; they should be grown by what counts as near.
  explicit PieceGrid(const std::vector<Box>& boxes);

  // Numbers, ascending, of pieces near the box; all whose boxes meet it are among them. Valid until
  // the next call.
  const std::vector<std::int32_t>& near(const Box& box);

 private:
  using Cell = std::array<std::int64_t, 3>;
  Cell cell_of(const double* x) const;
  template <class Visit>
  void for_cells(const Box& box, Visit visit) const;

  Box all_{};
  Cell count_{1, 1, 1};
  std::array<double, 3> size_{};
  std::vector<std::int32_t> begin_, pieces_;  // pieces of cell c: begin_[c] to begin_[c + 1]
  std::vector<std::int32_t> found_;
};

}  // namespace cleave::driver
