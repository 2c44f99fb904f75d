// Three-neighbour sums of eight lattice points side by side: the shapes of tetrahedra are the same at each
// point, so that they are listed once. Compiled for every instruction set.          [PD three]
//
// Lengths are in lattice spacings. The members of all shapes are numbered, and what the sums need of them
// is laid out in a bench of eight rows a member: its place from the first point (three), whether it and the
// first point are there, its sums of - g G (three) and of |V| g^2. A pair (a,b) of members comes with all
// third members c behind it: P = a x b and H = sum g c serve them all, see clique_kernels.hpp. A member that
// is missing lies on the first point: then every force on members that are there vanishes by itself, and
// only the energy needs a mask.
//
// Conservative weights: a tetrahedron counts with the sum of a quarter of the weights of its members, each without the
// three bonds of that member if one of them is broken.                              [PD weights, 12, 13]
#pragma once

#include <cstdint>

namespace cleave_call {

struct ShapePair {
  std::uint16_t a, b;
  std::int32_t first, last;  // its third members
};
struct ShapeThird {
  std::uint16_t member;
  std::int16_t volume;  // V in spacings^3, with its sign
};
struct Shapes {
  const std::int32_t* distance;  // of members in memory from the first point
  std::int32_t members;
  const ShapePair* pairs;
  std::int32_t pair_count;
  const ShapeThird* thirds;
  // By V + offset: V and 1/|V|.
  const double *volume, *inverse;
  std::int32_t offset;
  bool signed_volume;
  // Of the pairs, and of the thirds (a c, then b c): which bond between two members it is, for `carries`.
  const std::int32_t *pair_bond, *third_bonds;
};

// The points of a tile and of what it reaches, row by row; cells without a point have there = 0 and any
// finite position.
struct LatticeTile {
  const double* x[3];
  const double* there;   // 0 or 1
  double* f[3];          // - sum of g G, added to
  double* e;             // sum of |V| g^2, added to
  const double* weight;  // a quarter of the weight; then sums are weighed. NULL: plain sums
};

struct LatticeKernels {
  // Eight points from `at` on; full: all members of all eight are there. bench: eight rows of eight a member,
  // on a cache line.
  // With weights the bench is a row longer for each member. carries: a byte for each member and then for each
  // bond between two: in which of the eight it carries; NULL: all do. A tetrahedron counts for a member if the three
  // bonds at it carry.
  void (*eight)(const Shapes&, const LatticeTile&, std::int64_t at, bool full, double* bench,
                const std::uint8_t* carries);
  // sum of g (G_j (x) X_ij + G_k (x) X_ik + G_l (x) X_il) of eight points, anywhere, from the shapes around a point of
  // which it is the first, whatever the order of the others. bench: four rows of eight a member: its place from
  // the point, 1 or 0: the bond to it carries, else place 0. cells (3,members): X_ij of the members. [out] sums: nine
  // rows of eight, row by row of the tensor                                                       [PD stress]
  void (*stress)(const Shapes&, const double* cells, const double* bench, double* sums);
};

}  // namespace cleave_call

namespace cleave::cpd {
using cleave_call::LatticeKernels;
using cleave_call::LatticeTile;
using cleave_call::ShapePair;
using cleave_call::Shapes;
using cleave_call::ShapeThird;
}  // namespace cleave::cpd
