#include "scene/walls.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include "scene/format.hpp"
#include "scene/index.hpp"

namespace cleave::driver {
namespace {

// Mean spacing: (volume / particles)^(1/dimension).
double mean_spacing(const BodyGeometry& body, const std::vector<double>& mass, double density) {
  double total = 0;
  for (const double m : mass) total += m;
  return std::pow(total / density / static_cast<double>(body.particles()), 1.0 / body.dimension);
}

Walls::Wall::Part part_of(const BodyGeometry& body, const Selection& selection, const Model& model,
                          double stiffness) {
  const auto mass = model.reals(selection.body, "mass");
  const double spacing = mean_spacing(body, mass, model.property(selection.body, "rho"));
  const double frequency = model.wave_speed(selection.body) / spacing;
  Walls::Wall::Part part{
      selection.body, selection.particles, {}, stiffness * frequency * frequency};
  part.stiffness.reserve(part.particle.size());
  for (const Index particle : part.particle)
    part.stiffness.push_back(part.frequency_squared * mass[at(particle)]);
  return part;
}

// How deep the deepest particle of a part begins in the wall.
double deepest(const BodyGeometry& body, const Walls::Wall& wall, const Walls::Wall::Part& part) {
  double depth = 0;
  for (const Index particle : part.particle) {
    double gap = wall.radius;
    for (std::size_t c = 0; c < 3; ++c)
      gap -= (body.X[at(3 * particle) + c] - wall.point[c]) * wall.normal[c];
    depth = std::max(depth, gap);
  }
  return depth;
}

}  // namespace

Walls::Walls(const Deck& deck, const std::vector<BodyGeometry>& bodies, const Sets& sets,
             const Model& model) {
  for (const DeckGroup* group : deck.all("wall")) {
    Wall wall{};
    wall.name = group->text("name");
    if (!is_column_name(wall.name)) {
      deck.fail(*group, "name",
                in_quotes(wall.name) + " names a column; use letters, digits, _, - and .");
    }
    const auto& point = group->reals("point");
    const auto& normal = group->reals("normal");
    const double length = std::hypot(normal[0], normal[1], normal[2]);
    if (!(length > 0)) {
      deck.fail(*group, "normal", "the normal has no length; give its direction out of the wall");
    }
    for (std::size_t k = 0; k < 3; ++k) {
      wall.point[k] = point[k];
      wall.normal[k] = normal[k] / length;
    }
    wall.radius = group->real("radius");
    for (const Selection& selection : sets.select(*group)) {
      const BodyGeometry& body = bodies[at(selection.body)];
      if (body.dimension == 2 && wall.normal[2] != 0) {
        deck.fail(*group, "normal",
                  "body " + in_quotes(body.name) + " is plane; the normal has no z component");
      }
      wall.parts.push_back(part_of(body, selection, model, group->real("stiffness")));
      const double depth = deepest(body, wall, wall.parts.back());
      if (depth > 1e-6 * shortest_edge(body)) {  // far above the rounding of positions
        deck.fail(*group, "point",
                  "body " + in_quotes(body.name) + " begins " + number(depth) +
                      " deep in the wall, which would throw it out; move the wall or the body, or "
                      "turn the normal round");
      }
    }
    walls_.push_back(std::move(wall));
  }
}

bool Walls::touches(std::int64_t body) const {
  return std::any_of(walls_.begin(), walls_.end(), [&](const Wall& wall) {
    return std::any_of(wall.parts.begin(), wall.parts.end(),
                       [&](const Wall::Part& part) { return part.body == body; });
  });
}

double Walls::frequency_squared() const {
  std::map<std::int64_t, double> of_body;
  for (const Wall& wall : walls_)
    for (const Wall::Part& part : wall.parts) of_body[part.body] += part.frequency_squared;
  double highest = 0;
  for (const auto& [body, square] : of_body) highest = std::fmax(highest, square);
  return highest;
}

void Walls::clear_resultants() {
  for (Wall& wall : walls_) std::fill_n(wall.force, 3, 0.0);
}

void Walls::add(std::int64_t body, const std::vector<double>& position,
                std::vector<double>& force) {
  for (Wall& wall : walls_) {
    for (const Wall::Part& part : wall.parts) {
      if (part.body != body) continue;
      for (std::size_t k = 0; k < part.particle.size(); ++k) {
        const std::size_t first = at(3 * part.particle[k]);
        double gap = wall.radius;
        for (std::size_t c = 0; c < 3; ++c)
          gap -= (position[first + c] - wall.point[c]) * wall.normal[c];
        if (!(gap > 0)) continue;
        for (std::size_t c = 0; c < 3; ++c) {
          const double push = part.stiffness[k] * gap * wall.normal[c];
          force[first + c] += push;
          wall.force[c] += push;
        }
      }
    }
  }
}

}  // namespace cleave::driver
