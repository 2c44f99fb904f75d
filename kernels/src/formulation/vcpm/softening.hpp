// How a bond gives way beyond its onset: the force that it still carries by the largest strain it has had, and
// the share of its stiffness that is left for smaller strains. Of one bond alone; when bonds are looked at and
// what they release is peridynamics' business.                                        [VCPM softening]
#pragma once

#include "formulation/vcpm/lattice.hpp"
#include "formulation/vcpm/parameters.hpp"

namespace cleave::vcpm {

struct Softening {
  SofteningLaw law = SofteningLaw::none;
  double onset = 0;         // e_0
  double final_strain = 0;  // e_f
  double kink_strain = 0, kink_force = 0;

  bool active() const { return law != SofteningLaw::none; }
  // f: force at a strain beyond the onset over that at the onset.
  double envelope(double strain) const;
  // g = f e_0/strain: 1 up to the onset, 0 where the bond is broken.
  double integrity(double strain) const;
  // Strain at which the bond is broken.
  double end() const;
};

// From group vcpm; `onset` is the limit of the bonds, infinite if they have none. Throws for what does not
// go together.
Softening read_softening(const Body& body, Criterion criterion, double onset,
                         const Lattice& lattice);

}  // namespace cleave::vcpm
