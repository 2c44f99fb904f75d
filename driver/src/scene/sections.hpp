// Section resultants: force and moment that the material on the side of the normal exerts on the rest
// of the body, through a plane of the reference configuration; or that the rest exerts on a set. Summed over
// the particles behind the plane, or of the set: forces between two of them cancel, where the formulation
// keeps momentum.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "scene/model.hpp"
#include "scene/sets.hpp"

namespace cleave::driver {

class Sections {
 public:
  // Every &section. Throws DeckError: no normal, nothing on one side, unknown set.
  Sections(const Deck& deck, const std::vector<BodyGeometry>& bodies, const Sets& sets);

  struct Section {
    std::string name;
    std::int64_t body;
    bool plane;                          // the body is: moment about z only
    std::vector<std::int64_t> particle;  // behind the plane, or of the set
    double point[3];                     // moments are about it
    double force[3], moment[3];          // [N], [N m]
  };
  // With the forces of the last step.
  const std::vector<Section>& resultants(const Model& model);
  const std::vector<Section>& all() const { return sections_; }

 private:
  std::vector<Section> sections_;
  std::vector<double> internal_, viscous_, displacement_;
  const std::vector<BodyGeometry>* bodies_;
};

}  // namespace cleave::driver
