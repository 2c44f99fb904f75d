// Elastic constants of a peridynamic body and its critical stretch.                   [PD constants, critical]
#pragma once

#include <cmath>
#include <numbers>
#include <string>
#include <vector>

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

// Of the body's own material and of its regions, in the order of Body::region_of. Throws UNSUPPORTED for laws
// that are more than elastic: the formulation takes their constants only.
std::vector<Elastic> elastic_constants(const Body& body);

// For messages: the body, or one of its regions.
std::string material_label(const Body& body, std::size_t region);

// What all materials of a body have in common.
struct Reach {
  int dimension;
  double horizon, section;
};

// c of bond-based peridynamics [PD bond].
double bond_constant(const Body& body, std::size_t region, const Elastic& e, const Reach& reach,
                     KeptModulus kept);

// Critical stretch of the bonds of each material, of the region itself or of group fracture; infinite: they do
// not break.                                                                               [PD critical]
std::vector<double> critical_stretches(const Body& body, const std::vector<Elastic>& materials,
                                       const Reach& reach);

}  // namespace cleave::peridynamics
