// Lattices cut to a body: turned in a shape, or to the outline of a mesh.
#pragma once

#include "io/lattice.hpp"
#include "io/mesh.hpp"

namespace cleave::io {

// The lattice of `spec` along its own axes, with a point in the middle of the shape. Its simplices are those
// of points in the shape. Faces of a block and ends of a cylinder are the groups of make_lattice: points within half
// a spacing of the outermost. Throws io::Error as make_lattice, and for axes that are parallel.
Mesh make_turned_lattice(const LatticeSpec& spec);

// Keeps the simplices of a lattice with this spacing whose corners and centre lie within the mesh `outline`
// (to 1e-6 of the spacing). The groups "xmin", "xmax" and so on are its ends, as above. Throws io::Error if none
// is left.
void cut_to_outline(const Mesh& outline, double spacing, Mesh& lattice);

// A block of `spec` that holds the outline.
LatticeSpec around(LatticeSpec spec, const Mesh& outline);

}  // namespace cleave::io
