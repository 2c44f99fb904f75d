// Elastic constants of a peridynamic body and its critical stretch.                   [PD constants, critical]
#pragma once

#include <cmath>
#include <numbers>

#include "formulation/peridynamics/parameters.hpp"
#include "model/body.hpp"

namespace cleave::peridynamics {

inline constexpr double kPi = std::numbers::pi;

// Of the material; in the plane, the two-dimensional solid: lambda of plane stress is 2 lambda mu/(lambda +
// 2 mu).
struct Elastic {
  double E = 0, nu = 0, lambda = 0, mu = 0, density = 0;
  double bulk() const { return E / (3 * (1 - 2 * nu)); }  // K of the solid in space
  // kappa of the law in `dimension` dimensions: lambda + 2 mu/dimension
  double bulk_in(int dimension) const { return lambda + 2 * mu / dimension; }
};

// Throws UNSUPPORTED for laws that are more than elastic: the formulation takes their constants only.
Elastic elastic_constants(const Body& body);

// c of bond-based peridynamics [PD bond].
double bond_constant(const Body& body, const Elastic& e, int dimension, double horizon,
                     double section, KeptModulus kept);

// Critical stretch of group fracture; negative: bonds do not break.      [PD critical]
double critical_stretch(const Body& body, const Elastic& e, int dimension, double horizon);

}  // namespace cleave::peridynamics
