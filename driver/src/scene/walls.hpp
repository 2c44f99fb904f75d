// Rigid, frictionless plane walls that particles are pushed back from by a penalty [CBM wall]:
//   f_i = k_i g n,  g = radius - (x_i - point) . n > 0,  k_i = stiffness c0^2 m_i / dx^2
// with c0 the wave speed of the body, m_i the particle's mass and dx the body's mean spacing, so that
// every particle bounces with the frequency sqrt(stiffness) c0/dx whatever its mass.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "scene/model.hpp"
#include "scene/sets.hpp"

namespace cleave::driver {

class Walls {
 public:
  // Every &wall; after the set-up of the model. Throws DeckError.
  Walls(const Deck& deck, const std::vector<BodyGeometry>& bodies, const Sets& sets,
        const Model& model);

  struct Wall {
    std::string name;
    double point[3], normal[3];  // normal: unit length, out of the wall
    double radius;
    struct Part {
      std::int64_t body;
      std::vector<std::int64_t> particle;
      std::vector<double> stiffness;  // k_i [N m-1]
      double frequency_squared;       // k_i / m_i [s-2]
    };
    std::vector<Part> parts;
    double force[3];  // of the wall on the particles, as added last [N]
  };
  const std::vector<Wall>& all() const { return walls_; }
  bool touches(std::int64_t body) const;
  // Square of the highest frequency that they add to that of a body: the sum of k_i/m_i of the walls of
  // a body, the largest of the bodies [s-2].
  double frequency_squared() const;

  // Adds the forces of every wall on a body at these positions.
  void add(std::int64_t body, const std::vector<double>& position, std::vector<double>& force);
  void clear_resultants();

 private:
  std::vector<Wall> walls_;
};

}  // namespace cleave::driver
