#include "scene/forces.hpp"

#include <algorithm>
#include <cmath>

#include "scene/format.hpp"
#include "scene/index.hpp"
#include "scene/motions.hpp"
#include "scene/surface.hpp"

namespace cleave::driver {
namespace {

bool is_force(const std::string& kind) {
  return kind == "force" || kind == "traction" || kind == "pressure" || kind == "body_force" ||
         kind == "gravity";
}

// Reference area of the facets, shared equally by their corners.
void area_weights(const BodyGeometry& body, const std::vector<Index>& facets,
                  std::vector<Index>& particles, std::vector<double>& weights) {
  std::vector<double> all(at(body.particles()), 0.0);
  const auto corners = at(body.dimension);
  for (std::size_t f = 0; f < facets.size(); f += corners) {
    const double* x[3] = {};
    for (std::size_t a = 0; a < corners; ++a) x[a] = &body.X[at(3 * facets[f + a])];
    double area[3];
    area_vector(body.dimension, x, area);
    const double size = std::hypot(area[0], area[1], area[2]) / static_cast<double>(corners);
    for (std::size_t a = 0; a < corners; ++a) all[at(facets[f + a])] += size;
  }
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (all[i] > 0) {
      particles.push_back(static_cast<Index>(i));
      weights.push_back(all[i]);
    }
  }
}

std::vector<double> gathered(const std::vector<double>& field,
                             const std::vector<Index>& particles) {
  std::vector<double> values;
  values.reserve(particles.size());
  for (const Index particle : particles) values.push_back(field[at(particle)]);
  return values;
}

void check_keys(const Deck& deck, const DeckGroup& load) {
  const std::string& kind = load.text("kind");
  if (load.text("set").empty() && kind != "body_force" && kind != "gravity") {
    deck.fail(load, "set", "kind = " + in_quotes(kind) + " needs the set it acts on");
  }
  if (load.given("prescription") && load.text("prescription") != "exact") {  // the default
    deck.fail(load, "prescription",
              "prescription belongs to displacement, velocity and acceleration, not to kind = " +
                  in_quotes(kind));
  }
  if (kind == "pressure" && !load.text("directions").empty()) {
    deck.fail(load, "directions", "a pressure acts along the normal; remove directions");
  }
}

std::vector<int> all_directions(const std::vector<BodyGeometry>& bodies,
                                const std::vector<Selection>& selections) {
  const bool plane = std::all_of(
      selections.begin(), selections.end(),
      [&](const Selection& selection) { return bodies[at(selection.body)].dimension == 2; });
  return plane ? std::vector<int>{0, 1} : std::vector<int>{0, 1, 2};
}

}  // namespace

Forces::Forces(const Deck& deck, const std::vector<BodyGeometry>& bodies, const Sets& sets,
               const Model& model)
    : walls_(deck, bodies, sets, model),
      contact_frequency_squared_(walls_.frequency_squared()),
      loaded_(bodies.size(), 0),
      moving_(bodies.size(), 0) {
  for (const BodyGeometry& body : bodies) geometry_.push_back(&body);
  for (const DeckGroup* group : deck.all("load")) {
    if (is_force(group->text("kind"))) add(deck, bodies, sets, model, *group);
  }
  for (const Walls::Wall& wall : walls_.all()) {
    std::vector<int> directions;
    for (int k = 0; k < 3; ++k) {
      if (wall.normal[k] != 0) directions.push_back(k);
    }
    resultants_.push_back({wall.name, directions, {0, 0, 0}});
  }
  for (std::size_t body = 0; body < bodies.size(); ++body) {
    if (walls_.touches(static_cast<Index>(body))) loaded_[body] = moving_[body] = 1;
  }
  external_.resize(bodies.size());
  position_.resize(bodies.size());
  for (std::size_t body = 0; body < bodies.size(); ++body) {
    if (loaded_[body] != 0) external_[body].resize(bodies[body].X.size());
    if (moving_[body] != 0) position_[body].resize(bodies[body].X.size());
  }
}

Forces::Dead Forces::dead_load(const std::string& kind, const BodyGeometry& body,
                               const Selection& selection, const Model& model) {
  Dead dead{selection.body, {}, {}, 0};
  if (kind == "traction") {
    const auto facets = surface_facets(body, selection.particles);
    area_weights(body, facets, dead.particle, dead.weight);
  } else {
    dead.particle = selection.particles;
    dead.weight = gathered(model.reals(selection.body, "mass"), selection.particles);
    if (kind == "body_force" && model.find_field(selection.body, "region")) {
      // Materials of several densities.
      dead.weight = gathered(model.reals(selection.body, "volume"), selection.particles);
    } else if (kind == "body_force") {
      const double density = model.property(selection.body, "rho");
      for (double& weight : dead.weight) weight /= density;
    }
  }
  for (const double weight : dead.weight) dead.sum += weight;
  return dead;
}

void Forces::add(const Deck& deck, const std::vector<BodyGeometry>& bodies, const Sets& sets,
                 const Model& model, const DeckGroup& group) {
  const std::string& kind = group.text("kind");
  check_keys(deck, group);
  const std::vector<Selection> selections = sets.select(group);
  const std::vector<int> directions = kind == "pressure"
                                          ? all_directions(bodies, selections)
                                          : load_directions(deck, group, bodies, selections);
  Load load{group.real("value"), Curve::of_load(deck, group), {}, {}, 0};
  double total = 0;  // of the weights
  std::size_t facets = 0;
  for (const Selection& selection : selections) {
    const BodyGeometry& body = bodies[at(selection.body)];
    loaded_[at(selection.body)] = 1;
    if ((kind == "pressure" || kind == "traction") && body.quadratic) {
      deck.fail(group, "kind",
                "a " + kind + " cannot act on quadratic elements; use a force or linear elements");
    }
    if ((kind == "pressure" || kind == "traction") && body.cloud) {
      deck.fail(group, "kind",
                "a " + kind + " needs facets, and body " + in_quotes(body.name) +
                    " is a cloud of points; use a force or body_force on a layer of points");
    }
    if (kind == "pressure") {
      moving_[at(selection.body)] = 1;
      load.surfaces.push_back({selection.body, surface_facets(body, selection.particles)});
      facets += load.surfaces.back().facets.size();
    } else {
      load.dead.push_back(dead_load(kind, body, selection, model));
      total += load.dead.back().sum;
    }
  }
  if (total == 0 && facets == 0) {
    deck.fail(group, "set",
              "the set " + in_quotes(group.text("set")) +
                  " holds no whole facet of the surface, so a " + kind +
                  " has nothing to act on; all particles of a facet must be in the set");
  }
  if (kind == "force") {  // a total, whatever the mass of the set
    for (Dead& dead : load.dead) {
      for (double& weight : dead.weight) weight /= total;
      dead.sum /= total;
    }
  }
  loads_.push_back(std::move(load));
  resultants_.push_back({load_name(deck, group), directions, {0, 0, 0}});
}

void Forces::apply(Model& model, double time) {
  if (resultants_.empty()) return;
  bool changed = fresh_ || !walls_.all().empty();
  for (Load& load : loads_) {
    const double amount = load.value * load.curve.factor(time);
    changed = changed || amount != load.amount || (!load.surfaces.empty() && amount != 0);
    load.amount = amount;
  }
  if (!changed) return;
  fresh_ = false;
  find_positions(model);
  for (std::vector<double>& force : external_) std::fill(force.begin(), force.end(), 0.0);
  for (std::size_t i = 0; i < loads_.size(); ++i) {
    std::fill_n(resultants_[i].force, 3, 0.0);
    add_dead(i);
    add_pressure(i);
  }
  add_walls();
  for (std::size_t body = 0; body < external_.size(); ++body) {
    if (loaded_[body] != 0) model.put(static_cast<Index>(body), "external_force", external_[body]);
  }
}

void Forces::add_dead(std::size_t index) {
  const Load& load = loads_[index];
  for (const Dead& dead : load.dead) {
    std::vector<double>& force = external_[at(dead.body)];
    for (const int direction : resultants_[index].directions) {
      for (std::size_t k = 0; k < dead.particle.size(); ++k) {
        force[at(3 * dead.particle[k] + direction)] += load.amount * dead.weight[k];
      }
      resultants_[index].force[direction] += load.amount * dead.sum;
    }
  }
}

void Forces::add_pressure(std::size_t index) {
  const Load& load = loads_[index];
  for (const Surface& surface : load.surfaces) {
    const int dimension = geometry_[at(surface.body)]->dimension;
    const auto corners = at(dimension);
    const std::vector<double>& position = position_[at(surface.body)];
    std::vector<double>& force = external_[at(surface.body)];
    for (std::size_t f = 0; f < surface.facets.size(); f += corners) {
      const double* x[3] = {};
      for (std::size_t a = 0; a < corners; ++a) x[a] = &position[at(3 * surface.facets[f + a])];
      double area[3];
      area_vector(dimension, x, area);
      for (int k = 0; k < 3; ++k) {
        const double share = -load.amount * area[k] / dimension;
        for (std::size_t a = 0; a < corners; ++a) force[at(3 * surface.facets[f + a] + k)] += share;
        resultants_[index].force[k] += share * dimension;
      }
    }
  }
}

void Forces::add_walls() {
  walls_.clear_resultants();
  for (std::size_t body = 0; body < external_.size(); ++body) {
    if (moving_[body] != 0) walls_.add(static_cast<Index>(body), position_[body], external_[body]);
  }
  for (std::size_t i = 0; i < walls_.all().size(); ++i)
    std::copy_n(walls_.all()[i].force, 3, resultants_[loads_.size() + i].force);
}

void Forces::find_positions(const Model& model) {
  for (std::size_t body = 0; body < position_.size(); ++body) {
    if (moving_[body] == 0) continue;
    std::vector<double>& position = position_[body];
    model.get(static_cast<Index>(body), "displacement", position);
    for (std::size_t i = 0; i < position.size(); ++i) position[i] += geometry_[body]->X[i];
  }
}

}  // namespace cleave::driver
