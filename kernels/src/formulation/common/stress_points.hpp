// What every formulation with a stress at points does alike: gradients through the operator, stress
// through the law, force through the operator, and the energies of the points.
#pragma once

#include <cstdint>
#include <vector>

#include "core/blocks.hpp"
#include "core/gradient_operator.hpp"
#include "core/thread_team.hpp"
#include "model/body.hpp"

namespace cleave {

class StressPoints {
 public:
  // Allocates; body.points is known.
  void setup(const Body& body);

  // H and det F of all points from the displacements.
  void gradients(Body& body, const GradientOperator& g, ThreadTeam& team) const;
  // The same, then the stress; books what plastic flow and the law's viscosity dissipate. Throws
  // BAD_JACOBIAN naming the first point whose law has no answer.
  void deform(Body& body, const GradientOperator& g, const Clock& clock, ThreadTeam& team);
  // Throws BAD_JACOBIAN for a point whose law has no answer; det F is current.
  [[noreturn]] void refuse(const Body& body, const GradientOperator& g, std::int64_t q) const;
  // Stress and energy of all points from the present gradient and history, which is left alone: for laws
  // that answer by the state alone.
  void observe(Body& body, ThreadTeam& team) const;
  // sum of Omega psi [J]
  double stored_energy(const Body& body) const;
  // Points with volume and det F <= 0.
  std::int64_t inverted(const Body& body) const;

 private:
  std::vector<std::int64_t> failed_;  // per block: first point whose law has no answer, or -1
  BlockSums<2> dissipated_;           // per block: plastic, viscous [J]
};

// The arrays of the stress update of a body; history is the body's own.
StressArrays stress_arrays(const Body& body, const Clock& clock);

// "particle 7 (at X = ...)" or "integration point 7 (at ...)" for messages.
std::string point_label(const Body& body, const GradientOperator& g, std::int64_t q);

}  // namespace cleave
