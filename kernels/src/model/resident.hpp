// A step that keeps the state of a body in arrays of its own, in an order of its own, while it runs. The
// fields stand still meanwhile, and those that nobody asks for have no memory; what is asked for is
// brought up to date first, what the host puts is taken over before the next call.
#pragma once

#include <string_view>

#include "core/thread_team.hpp"
#include "model/formulation.hpp"

namespace cleave {

class ResidentStep {
 public:
  virtual ~ResidentStep() = default;
  // Takes over the fields and allocates, as the first step would.
  virtual void prepare(Body& body, ThreadTeam& team) = 0;
  // stress, forces and accelerations of the present motion
  virtual void start(Body& body, const Clock& clock, ThreadTeam& team) = 0;
  // v += dt/2 a, u += dt v, and half of the works
  virtual void advance(Body& body, double dt, ThreadTeam& team) = 0;
  // break, gradient, stress, forces, a = f/m, the other half of the works, v += dt/2 a
  virtual void update(Body& body, const Clock& clock, ThreadTeam& team) = 0;
  // Brings a field up to date; with an empty name all of them.
  virtual void fetch(Body& body, std::string_view field) = 0;
  // A lower bound of the stretch of any line element at the last update, at most 1; 0: not known.
  virtual double shortest_stretch() = 0;
  // A field was changed from outside, after it was fetched; with an empty name any of them.
  virtual void changed(std::string_view field) = 0;
};

// Both do nothing for a body without such a step.
void fetch(Body& body, std::string_view field = {});
// The fields are about to change, and the step goes on from them.
void take_fields(Body& body);

}  // namespace cleave
