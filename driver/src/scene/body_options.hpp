// Formulation, material and options (fracture, viscosity, stabilisation) of bodies: from deck
// groups to the parameters of the kernels. Which parameters there are, the kernels' tables say.
#pragma once

#include <vector>

#include "scene/geometry.hpp"
#include "scene/model.hpp"
#include "scene/sets.hpp"

namespace cleave::driver {

// Adds every body to the model with its parameters. Throws DeckError with the place of the group.
void add_bodies(const Deck& deck, const std::vector<BodyGeometry>& bodies, const Sets& sets,
                Model& model);

}  // namespace cleave::driver
