// External forces: from the &load groups of kind force, traction, pressure, body_force and gravity,
// and from &wall, to the field "external_force" of every body.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "scene/curve.hpp"
#include "scene/model.hpp"
#include "scene/sets.hpp"
#include "scene/walls.hpp"

namespace cleave::driver {

// Tractions are dead loads per reference area; pressures act on the deformed facets, compression
// positive. Both stay on the facets that were surface at the start, whatever breaks.
class Forces {
 public:
  // After the set-up of the model, which knows masses and volumes. Throws DeckError.
  Forces(const Deck& deck, const std::vector<BodyGeometry>& bodies, const Sets& sets,
         const Model& model);

  // Puts the forces at `time` if they differ from those put last. Does not allocate.
  void apply(Model& model, double time);

  // Of the walls; see there [s-2].
  double contact_frequency_squared() const { return contact_frequency_squared_; }

  struct Resultant {
    std::string load;
    std::vector<int> directions;
    double force[3];  // sum over all particles [N], as put last
  };
  // Loads, then walls.
  const std::vector<Resultant>& resultants() const { return resultants_; }

 private:
  // Forces per unit of value * factor: weight in each of the directions of the load.
  struct Dead {
    std::int64_t body;
    std::vector<std::int64_t> particle;
    std::vector<double> weight;
    double sum = 0;
  };
  struct Surface {
    std::int64_t body;
    std::vector<std::int64_t> facets;
  };
  struct Load {
    double value;
    Curve curve;
    std::vector<Dead> dead;
    std::vector<Surface> surfaces;  // of a pressure
    double amount = 0;              // value * factor put last
  };
  void add(const Deck& deck, const std::vector<BodyGeometry>& bodies, const Sets& sets,
           const Model& model, const DeckGroup& group);
  static Dead dead_load(const std::string& kind, const BodyGeometry& body,
                        const Selection& selection, const Model& model);
  void add_dead(std::size_t load);
  void add_pressure(std::size_t load);
  void add_walls();
  void find_positions(const Model& model);

  std::vector<BodyGeometry const*> geometry_;
  std::vector<Load> loads_;
  Walls walls_;
  double contact_frequency_squared_;
  std::vector<Resultant> resultants_;
  std::vector<char> loaded_, moving_;  // per body: has a force, one that depends on position
  std::vector<std::vector<double>> external_;  // (3, n) per loaded body
  std::vector<std::vector<double>> position_;  // (3, n) per body with such a force
  bool fresh_ = true;
};

}  // namespace cleave::driver
