// Whether points stand on a square or cubic lattice along the axes, and where.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "formulation/peridynamics/neighbourhood.hpp"

namespace cleave::peridynamics {

struct Lattice {
  double spacing = 0;                   // [m]; 0: no lattice
  std::array<std::int32_t, 3> shape{};  // cells along the axes
  std::vector<std::int32_t> cell;       // (3,n) of each point, from 0
  bool found() const { return spacing > 0; }
};

// No lattice: points off it by more than 1e-6 spacings, two in one cell, or more than seven in eight cells
// of the box around the body empty.
Lattice find_lattice(const Neighbourhood& hood);

// Axes, the longest first.
std::array<std::size_t, 3> axes_by_length(const Lattice& lattice);

// Points of the whole lattice within the horizon of one of them, itself not counted.
std::int64_t full_neighbours(const Neighbourhood& hood, double spacing);

}  // namespace cleave::peridynamics
