// Cracks that are there before the first step, given by geometry: the bonds that cross them.
//
// A particle on the crack would leave it open on which side it stands. The rule: a particle closer
// to the crack than 1e-6 of the shortest bond counts as lying that far on the side of the normal
// (left of the way from the first to the second point of a segment; along the normal of a plane or
// disc, where the normal of a plane is first edge x second edge).
#pragma once

#include <cstdint>
#include <vector>

#include "scene/geometry.hpp"
#include "scene/model.hpp"
#include "scene/sets.hpp"

namespace cleave::driver {

// A crack as a list of pieces: segments in the plane; triangles and discs in space.
struct CrackPiece {
  enum class Kind { segment, triangle, disc } kind;
  double p[3][3];     // segment: 2 points; triangle: 3 corners; disc: centre and normal of length 1
  double radius = 0;  // of a disc
};

// The pieces of a &precrack with a geometric shape. Throws DeckError.
std::vector<CrackPiece> crack_pieces(const Deck& deck, const DeckGroup& precrack, int dimension);
// The pieces of facets of a mesh, turned so that neighbours have their normals on one side.
std::vector<CrackPiece> crack_pieces(const std::vector<std::int64_t>& facets,
                                     const BodyGeometry& body);

// Pairs (2, n) among the bonds (2, m) that cross the crack.
std::vector<std::int64_t> crossing_bonds(const std::vector<CrackPiece>& pieces,
                                         const BodyGeometry& body,
                                         const std::vector<std::int64_t>& bonds);

// Breaks the bonds of every &precrack with mode = 'delete'; after set-up of the model, before the
// first step. Throws DeckError where a crack crosses no bond.
void delete_cracks(const Deck& deck, const std::vector<BodyGeometry>& bodies, const Sets& sets,
                   Model& model);

}  // namespace cleave::driver
