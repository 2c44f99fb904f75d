// The stress update with the kernels of the instruction set in use.
#pragma once

#include "material/material.hpp"

namespace cleave {

// The same as update_stress<dimension>(law, ...) of stress.hpp for the law in `material`, to the bit.
StressResult update_stress(const Material& material, int dimension, const StressArrays& arrays,
                           std::int64_t first, std::int64_t last);

}  // namespace cleave
