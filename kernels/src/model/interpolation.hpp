// Fields at given points of the reference configuration, through the simplices of a body: linear in a
// simplex for fields of particles (quadratic with six nodes), for fields of integration points the
// constant or linear function through the points of the element.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "model/body.hpp"

namespace cleave {

// Where a point lies: simplex and barycentric coordinates; simplex -1: outside of the body.
struct Location {
  std::int64_t simplex = -1;
  std::array<double, 4> weight{};
};

// [in] points (3,n) reference positions. A point within 1e-9 edges of a simplex counts as inside.
// Throws UNSUPPORTED for bodies without simplices.
std::vector<Location> locate(Body& body, std::span<const double> points);

// [out] values (components): zero outside.
void interpolate(Body& body, const Field& field, const Location& location, double* values);

}  // namespace cleave
