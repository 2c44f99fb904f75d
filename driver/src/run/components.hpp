// How the components of a field are called in files: velocity_x, cauchy_stress_xy, ...
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace cleave::driver {

struct Component {
  std::int64_t index;  // among the components of the field
  std::string suffix;  // "", "_x", "_xy", "_1"
};

// Scalars have no suffix, vectors x, y, z; tensors ij in the order of cleave.h; others a number
// from
// 1. plane: without the components of tensors that are zero in the plane (xz, zx, yz, zy).
std::vector<Component> components_of(std::int64_t components, bool plane);

}  // namespace cleave::driver
