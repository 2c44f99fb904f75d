// Total-Lagrangian smoothed particle hydrodynamics: gradients of the cubic spline kernel in the
// reference configuration, corrected so that affine motion is exact.
#pragma once

#include "formulation/meshless/formulation.hpp"

namespace cleave::tlsph {

class TotalLagrangianSph final : public meshless::KernelMethod {
 public:
  const char* name() const override { return "tlsph"; }

 private:
  meshless::Kernel make_kernel(const Body& body) const override;
};

}  // namespace cleave::tlsph
