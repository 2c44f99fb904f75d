// Lattices cut to simple shapes and split into simplices: meshes without a mesh file.
#pragma once

#include <array>
#include <string>

#include "io/mesh.hpp"

namespace cleave::io {

enum class LatticeKind { square, hexagonal, cubic, bcc, fcc };
enum class ShapeKind { block, cylinder, sphere };  // in two dimensions: rectangle, disc (sphere)

struct LatticeSpec {
  LatticeKind lattice = LatticeKind::cubic;
  ShapeKind shape = ShapeKind::block;
  double spacing = 0;  // nearest-neighbour distance [m]
  std::array<double, 3> origin{
      0, 0, 0};  // block: lowest corner; cylinder: centre of the base; sphere: centre
  std::array<double, 3> size{0, 0, 0};  // block: edge lengths (fitted: see below)
  double radius = 0, height = 0;        // cylinder (axis `axis`), sphere, disc
  int axis = 2;
  // Directions of the lattice's own axes; in two dimensions x_axis alone.
  std::array<double, 3> x_axis{1, 0, 0}, y_axis{0, 1, 0};
};

// Points are numbered lexicographically. square and hexagonal give triangles, the others tetrahedra
// (Kuhn split of the primitive cell; square: alternating diagonals), all of positive volume. A
// block of a square or cubic lattice whose edge is not a multiple of the spacing (to 1e-6 of the
// edge) is refused with the two nearest sizes, and one that is ends exactly at its size; of the
// others what fits is kept, from the lowest corner (block) or the centre on. Points without a
// simplex are dropped. Groups: all simplices as "all"; for a block the points of its faces as
// "xmin", "xmax", "ymin", "ymax", "zmin", "zmax" (extreme coordinates within half a spacing *
// 1e-6), for a cylinder those of its base and top, "zmin" and "zmax" if its axis is z.
// A lattice that is turned is that of make_turned_lattice (lattice_cut.hpp).
// Throws io::Error: spacing, size or radius not above zero, more than 2^31 points, not one cell.
Mesh make_lattice(const LatticeSpec& spec);

}  // namespace cleave::io
