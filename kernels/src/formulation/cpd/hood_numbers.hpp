// How many two- and three-neighbour sets a point has in the reference, how large they are on average and
// how stiff: what the weights and the stable step need. Points whose neighbours lie alike share one
// computation, so that lattices cost a few hundred.                                [PD hood, step]
#pragma once

#include <cstdint>
#include <vector>

#include "formulation/peridynamics/neighbourhood.hpp"

namespace cleave::cpd {

struct HoodNumbers {
  double pairs = 0, triples = 0;  // unordered, not flat
  double area = 0, volume = 0;    // mean A [m2] and |V| [m3]
  double pair_rate = 0;    // sum of |e_i| (|e_i| + |e_j| + |e_k|)/A, e: edge opposite to the corner
  double triple_rate = 0;  // sum of |G_i| (|G_i| + |G_j| + |G_k| + |G_l|)/|V| [m]
};

std::vector<HoodNumbers> hood_numbers(const peridynamics::Neighbourhood& hood);

}  // namespace cleave::cpd
