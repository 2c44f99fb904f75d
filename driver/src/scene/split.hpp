// Pre-cracks along meshed lines or surfaces: finding their facets in a body, and sharp cracks,
// whose particles are doubled. Cracks given by geometry are in precrack.hpp.
#pragma once

#include <cstdint>
#include <vector>

#include "io/mesh.hpp"
#include "scene/geometry.hpp"

namespace cleave::driver {

// Doubles the particles of `body` along the facets (dimension particles each) so that the simplices
// on the two sides share none. A particle is doubled once for every further group of its simplices
// that hangs together without crossing a facet: crack tips, where all still hang together, stay
// single. The new particles stand at the end of the body and belong to the sets of the old ones.
// Returns how many were added.
std::int64_t split_along(const std::vector<std::int64_t>& facets, BodyGeometry& body);

// Applies every &precrack with shape = 'group' to a body just taken from `mesh`: mode = 'split' is
// carried out, the facets of mode = 'delete' are kept in body.crack_facets. number_of: particle of
// every mesh node, -1 if the body does not use it. used: number of facets found for each such
// group, in the order of deck.all("precrack"), added to. Throws DeckError.
void take_mesh_cracks(const Deck& deck, const io::Mesh& mesh,
                      const std::vector<std::int64_t>& number_of, BodyGeometry& body,
                      std::vector<std::int64_t>& used);

}  // namespace cleave::driver
