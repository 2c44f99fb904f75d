// Three-neighbour interactions around one point, as functions of plain arrays; compiled for every
// instruction set. A star is a point (the apex) with some of its neighbours; neighbours j < k < l that are
// pairwise within the horizon form a tetrahedron with it.                                    [PD three]
//
//   v = (x_ij x x_ik) . x_il,   V in the reference,   g = (v - sgn(v) |V|)/|V| or, signed, (v - V)/V sgn V
//   G_j = x_ik x x_il,  G_k = x_il x x_ij,  G_l = x_ij x x_ik,  G_i = - (G_j + G_k + G_l)
//
// Eight l at a time for each pair (j,k): with P = x_ij x x_ik and H = sum_l g x_il, what j gets is x_ik x H
// and what k gets is H x x_ij.
#pragma once

#include <cstdint>

namespace cleave_call {

// Arrays of neighbours are (count) and eight more; bit matrices have `words` words a row and one more.
struct Star {
  std::int32_t count, words;
  const double *X[3], *x[3];    // positions of the neighbours [m]
  double apex_X[3], apex_x[3];  // of the apex
  double square_limit;          // of the horizon [m2]
  double flat;                  // |V| up to this is no tetrahedron [m3]
  bool signed_volume;
  // Filled by `relate`: positions relative to the apex, and for j the k > j within the horizon of j.
  double *C[3], *c[3];
  std::uint64_t* adjacent;
  // Set by `cliques`: - sum of g G_m and sum of 1/2 |V| g^2 at each neighbour; scratch of four rows of eight
  // for each.
  double* f[3];
  double* e;
  double* rows;
  // Conservative weights only: W of the apex and of the neighbours, the apex's bonds that carry as 0 or 1,
  // and the adjacent pairs whose bond carries. NULL: plain sums.
  const double* weight;
  double apex_weight;
  const double* carries;
  const std::uint64_t* carrying;
  // `apex` only: relative velocities [m s-1].
  const double* velocity[3];
};

struct ApexSums {
  double force[3];  // - sum of g G_i
  double energy;    // sum of 1/2 |V| g^2
  double rate;      // sum of g dv/dt: its rate
};

// Of the tetrahedra at an apex, in the reference.
struct StarNumbers {
  double count;
  double volume;  // sum of |V| [m3]
  double rate;    // sum of |G_i| (|G_i| + |G_j| + |G_k| + |G_l|)/|V| [m]      [PD step]
};

struct CliqueKernels {
  void (*relate)(const Star&);
  // All tetrahedra of the star, each once; [out] the four numbers of the apex.
  void (*cliques)(const Star&, double apex[4]);
  void (*apex)(const Star&, ApexSums&);
  // sum of g (G_j (x) X_ij + G_k (x) X_ik + G_l (x) X_il), row by row
  void (*stress)(const Star&, double stress[9]);
  void (*numbers)(const Star&, StarNumbers&);
};

}  // namespace cleave_call

namespace cleave::cpd {
using cleave_call::ApexSums;
using cleave_call::CliqueKernels;
using cleave_call::Star;
using cleave_call::StarNumbers;
}  // namespace cleave::cpd
