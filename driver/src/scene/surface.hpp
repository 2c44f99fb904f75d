// Facets of the simplices that lie on the surface of a body: what tractions and pressures act on.
#pragma once

#include <cstdint>
#include <vector>

#include "scene/geometry.hpp"

namespace cleave::driver {

// (dimension, n) particles of the facets that belong to one simplex only and whose particles are
// all in `particles` (sorted). Ordered so that the normal points outwards: in the plane the body
// lies left of the way from the first to the second particle; in space the particles run
// counter-clockwise seen from outside. Facets are sorted by their particles, so that neither their
// order nor their corners depend on how the simplices were written.
std::vector<std::int64_t> surface_facets(const BodyGeometry& body,
                                         const std::vector<std::int64_t>& particles);

// Outward area vector of a facet with corners x[0..dimension-1] [m2] (2D: length vector [m]).
void area_vector(int dimension, const double* const* x, double* area);

}  // namespace cleave::driver
