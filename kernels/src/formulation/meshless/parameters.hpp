// Options of the kernel methods, total-Lagrangian SPH and correspondence peridynamics: the kernel,
// and the penalty on hourglass modes.
#pragma once

#include <array>

#include "core/parameter.hpp"

namespace cleave::meshless {

enum class RadiusMeaning { kernel, cutoff };
enum class GradientForm { corrected, plain };
enum class HourglassForm { none, projected, conservative };

inline constexpr std::array kKernelParameters = {
    real_parameter("radius", "m", kNotNegative, 0.0,
                   "kernel radius, required; 3 times the particle spacing is usual", "[SPH 27]"),
    choice_parameter("radius_meaning", "kernel|cutoff", "kernel",
                     "kernel: neighbours reach as far as twice the radius; cutoff: as far as the "
                     "radius (the horizon of peridynamics)",
                     "[SPH 27]"),
    choice_parameter("gradient", "corrected|plain", "corrected",
                     "corrected: exact for affine motion; plain: without correction, wrong at "
                     "surfaces; tlsph only",
                     "[SPH moment]"),
    choice_parameter("influence", "default|constant|cone|spline|inverse_distance|gaussian|tlsph",
                     "default",
                     "weight of a neighbour by its distance, nosb only; default: spline; tlsph: "
                     "the one that makes both methods equal",
                     "[SPH influence]"),
};

inline constexpr std::array kHourglassParameters = {
    choice_parameter("form", "none|projected|conservative", "projected",
                     "projected: the published force along bonds, not conservative; conservative: "
                     "the gradient of an energy",
                     "[SPH 28]"),
    real_parameter("psi", "1", kNotNegative, 0.1, "strength; 0: none", "[SPH 28]"),
};

}  // namespace cleave::meshless
