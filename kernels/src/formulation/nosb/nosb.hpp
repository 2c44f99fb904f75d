// Non-ordinary state-based peridynamics, correspondence form: the deformation gradient is the
// least-squares fit over the horizon, weighed by an influence function.
#pragma once

#include "formulation/meshless/formulation.hpp"

namespace cleave::nosb {

class CorrespondencePeridynamics final : public meshless::KernelMethod {
 public:
  const char* name() const override { return "nosb"; }

 private:
  meshless::Kernel make_kernel(const Body& body) const override;
};

}  // namespace cleave::nosb
