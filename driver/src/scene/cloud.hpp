// Bodies without simplices: points from a file, or the middles of the cells of a mesh, with volumes.
#pragma once

#include "io/mesh.hpp"
#include "scene/geometry.hpp"

namespace cleave::driver {

// The points of a &points group. Throws DeckError.
BodyGeometry read_points(const Deck& deck, const DeckGroup& points, int dimension);

// Whether a &lattice has its points in the middle of its cells; throws DeckError where it cannot.
bool has_cell_points(const DeckGroup& source);
void check_cell_points(const Deck& deck, const DeckGroup& lattice);

// Gives the body of a &body the volumes of its particles where they have their own: cells of its mesh, or of
// a lattice `source`. Throws DeckError.
void take_volumes(const Deck& deck, const DeckGroup& group, const DeckGroup& source,
                  BodyGeometry& body);

// Makes particles of the simplices of the body; groups keep the cells all of whose corners they hold.
void turn_cells_into_points(BodyGeometry& body);

// Takes out the particles in the regions of every &notch of the deck. Throws DeckError for a notch that
// holds no particle.
void cut_notches(const Deck& deck, std::vector<BodyGeometry>& bodies);

}  // namespace cleave::driver
