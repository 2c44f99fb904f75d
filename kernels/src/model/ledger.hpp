// The energy ledger of a body: the numbers that must be accumulated, because they are not functions
// of the present state. Theory: energy audit of the Continuum Bond Method.
#pragma once

namespace cleave::ledger {

// Places in the field `ledger`. T[f] = sum over particles 1/2 (f_n + f_n+1) . (x_n+1 - x_n).
enum Entry {
  kInternal,    // -T[internal force]
  kViscous,     // -T[viscous force]: dissipated; relaxation: T[unbalanced force] after bonds broke
  kExternal,    // T[external force]
  kReaction,    // T[force that keeps prescribed motion]
  kFracture,    // released by breaking bonds
  kPlastic,     // dissipated by plastic flow
  kShock,       // dissipated by the viscosity of the law; the law's stress does this work
  kStarted,     // 1 once the two totals below are set, at the first step
  kStartTotal,  // kinetic + stored at the start
  kStartStaggered,  // kinetic_staggered at the start
  kLastStep,        // size of the last step [s]
  kCount            // components of the field
};

}  // namespace cleave::ledger
