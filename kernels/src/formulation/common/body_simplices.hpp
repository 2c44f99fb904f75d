// The simplices of a body whose points are particles: from what the host gave to the field.
#pragma once

#include <cstdint>

#include "model/body.hpp"

namespace cleave {

// Allocates and fills the fields of simplices; returns how many there are. Throws UNSUPPORTED for simplices of
// another order, BAD_SIMPLEX for a particle that does not exist.
std::int64_t take_simplices(Body& body);
// Volumes of particles: equal shares of the simplices around them, in ascending order.
// [in] corners (4,simplices): the field simplex_particles
void share_volumes(const Body& body, const std::int32_t* corners, std::int64_t simplices);

}  // namespace cleave
