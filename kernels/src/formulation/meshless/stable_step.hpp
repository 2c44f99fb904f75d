// The stable step of the kernel methods from the largest frequency and damping rate of the
// undeformed body. These depend on kernel, surfaces, spacing and penalty in ways that no length of
// the mesh tells, so they are computed: a few Lanczos steps with the linearised forces.   [SPH step]
#pragma once

#include <vector>

#include "formulation/common/viscosity.hpp"
#include "formulation/meshless/hourglass.hpp"

namespace cleave::meshless {

struct LargestRates {
  double stiffness = 0;  // omega^2 [s-2]
  double damping = 0;    // of the artificial viscosity [s-1]
};

// bond_weight: zeta_ip . X_ip of every half-bond for the viscosity, or empty: none
LargestRates largest_rates(const Body& body, const GradientOperator& g, const Hourglass& hourglass,
                           const BondRate<std::int32_t>& rate,
                           const std::vector<double>& bond_weight);

// Largest step with its safety [s].
double stable_step_of(const LargestRates& rates);

}  // namespace cleave::meshless
