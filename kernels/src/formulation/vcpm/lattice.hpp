// The lattices of the volume-compensated particle model: cells, bonds, and the springs that make them
// isotropic. Half of every bond belongs to each of its ends.                            [VCPM lattices]
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "formulation/vcpm/parameters.hpp"
#include "model/body.hpp"

namespace cleave::vcpm {

// Bonds of one length.
struct Shell {
  double length;     // d_s [m]
  double stiffness;  // k_s of a half spring [N m-1]
  double weight;     // w_s = 3/(n r_s), in the plane 2/(n r_s), with r_s = d_s/2 [m-1]
  std::int32_t number;
};

struct Lattice {
  LatticeChoice kind = LatticeChoice::triangular;
  double spacing = 0;  // of nearest neighbours, 2 R [m]
  double cell = 0;     // V [m3]; in the plane [m2]
  double reach = 0;    // between the last shell and the next [m]
  int neighbours = 0;  // of a particle inside, n
  std::vector<Shell> shells;

  const Shell& shell(double length) const {
    return shells.size() > 1 && length > middle ? shells[1] : shells[0];
  }
  double middle = 0;  // between the two shells [m]
};

// The lattice that the particles of a body are on. Throws BAD_ARGUMENT where they are on none.
// mu: shear modulus [Pa]
Lattice find_lattice(const Body& body, LatticeChoice wanted, double mu);

const char* lattice_name(LatticeChoice kind);

}  // namespace cleave::vcpm
