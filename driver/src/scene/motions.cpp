#include "scene/motions.hpp"

#include <algorithm>
#include <map>

#include "scene/format.hpp"
#include "scene/index.hpp"

namespace cleave::driver {
namespace {

const std::map<std::string, MotionKind>& motion_kinds() {
  static const std::map<std::string, MotionKind> kinds{{"displacement", MotionKind::displacement},
                                                       {"velocity", MotionKind::velocity},
                                                       {"acceleration", MotionKind::acceleration}};
  return kinds;
}

}  // namespace

std::string load_name(const Deck& deck, const DeckGroup& load) {
  const std::string& name = load.text("name");
  if (!name.empty() && !is_column_name(name)) {
    deck.fail(load, "name",
              in_quotes(name) + " names columns of the history; use letters, digits, _, - and .");
  }
  if (!name.empty()) return name;
  const auto loads = deck.all("load");
  const auto place = std::find(loads.begin(), loads.end(), &load);
  return "load" + std::to_string(place - loads.begin() + 1);
}

std::vector<int> load_directions(const Deck& deck, const DeckGroup& load,
                                 const std::vector<BodyGeometry>& bodies,
                                 const std::vector<Selection>& selections) {
  const std::string& letters = load.text("directions");
  if (letters.empty()) {
    deck.fail(load, "directions",
              "kind = " + in_quotes(load.text("kind")) +
                  " needs directions: one or more of the letters x, y, z");
  }
  std::vector<int> directions;
  for (const char letter : letters) {
    const int direction = (letter | 0x20) - 'x';  // upper case is the same
    if (direction < 0 || direction > 2) {
      deck.fail(load, "directions", in_quotes(letters) + " is not made of the letters x, y, z");
    }
    if (std::find(directions.begin(), directions.end(), direction) != directions.end()) {
      deck.fail(load, "directions", in_quotes(letters) + " names a direction twice");
    }
    for (const Selection& selection : selections) {
      const BodyGeometry& body = bodies[at(selection.body)];
      if (direction >= body.dimension) {
        deck.fail(load, "directions",
                  "body " + in_quotes(body.name) + " is plane: only x and y can be loaded");
      }
    }
    directions.push_back(direction);
  }
  std::sort(directions.begin(), directions.end());
  return directions;
}

Motions::Motions(const Deck& deck, const std::vector<BodyGeometry>& bodies, const Sets& sets)
    : bodies_(bodies.size()) {
  for (const DeckGroup* group : deck.all("load")) {
    if (motion_kinds().count(group->text("kind")) > 0) {
      add(deck, bodies, sets, *group, load_name(deck, *group));
    }
  }
  displacement_.resize(loads_.size());
  acceleration_.resize(loads_.size());
  for (BodyList& list : bodies_) {
    list.displacement.resize(list.particle.size());
    list.acceleration.resize(list.particle.size());
  }
}

void Motions::add(const Deck& deck, const std::vector<BodyGeometry>& bodies, const Sets& sets,
                  const DeckGroup& group, const std::string& name) {
  if (group.text("set").empty()) {
    deck.fail(group, "set",
              "kind = " + in_quotes(group.text("kind")) + " needs the set of particles it moves");
  }
  Load load{motion_kinds().at(group.text("kind")), group.text("prescription") == "exact",
            group.real("value"), Curve::of_load(deck, group), sets.select(group)};
  const std::string jump = load.curve.jump(load.kind);
  if (!load.exact && load.value != 0.0 && !jump.empty()) {
    deck.fail(group, "prescription",
              "prescription = 'paper' follows the accelerations of the curve, which cannot "
              "reproduce this one: " +
                  jump + ". Use 'exact' or a smooth curve");
  }
  const auto directions = load_directions(deck, group, bodies, load.selections);
  const std::size_t index = loads_.size();
  for (const Selection& selection : load.selections) {
    BodyList& list = bodies_[at(selection.body)];
    const BodyGeometry& body = bodies[at(selection.body)];
    for (std::size_t k = 0; k < list.particle.size(); ++k) {
      const int direction = list.direction[k];
      if (std::find(directions.begin(), directions.end(), direction) == directions.end()) continue;
      if (!std::binary_search(selection.particles.begin(), selection.particles.end(),
                              list.particle[k])) {
        continue;
      }
      deck.fail(group, "set",
                "loads " + in_quotes(reactions_[list.load[k]].load) + " and " + in_quotes(name) +
                    " both prescribe direction " + "xyz"[direction] + " of particle " +
                    number(body.point_ids[at(list.particle[k])]) + " at " +
                    point_text(&body.X[at(3 * list.particle[k])]) + " of body " +
                    in_quotes(body.name) + "; a degree of freedom follows one load only");
    }
    for (const Index particle : selection.particles) {
      for (const int direction : directions) {
        list.particle.push_back(particle);
        list.direction.push_back(direction);
        list.motion.push_back(load.exact ? CLEAVE_MOTION_EXACT : CLEAVE_MOTION_ACCELERATION);
        list.load.push_back(index);
      }
    }
  }
  loads_.push_back(std::move(load));
  reactions_.push_back({name, directions, {0, 0, 0}});
}

void Motions::prescribe(Model& model) const {
  for (std::size_t body = 0; body < bodies_.size(); ++body) {
    const BodyList& list = bodies_[body];
    if (list.particle.empty()) continue;
    check(cleave_body_prescribe(model.handle(), static_cast<Index>(body),
                                static_cast<Index>(list.particle.size()), list.particle.data(),
                                list.direction.data(), list.motion.data()));
  }
}

void Motions::start(Model& model, double dt) {
  for (std::size_t i = 0; i < loads_.size(); ++i) {
    const Load& load = loads_[i];
    const MotionValue now = load.curve.motion(load.kind, load.value, 0.0);
    const double next = load.curve.motion(load.kind, load.value, dt).displacement;
    displacement_[i] = now.displacement;
    // (u(dt) - 2u(0) + u(-dt))/dt^2 with u(-dt) = u(dt) - 2 dt v(0)
    acceleration_[i] = load.exact ? 2 * (next - now.displacement - dt * now.velocity) / (dt * dt)
                                  : now.acceleration;
  }
  put_start(model, true);
  send(model, true, true);
}

void Motions::start_at_rest(Model& model) {
  for (std::size_t i = 0; i < loads_.size(); ++i) {
    displacement_[i] = loads_[i].curve.motion(loads_[i].kind, loads_[i].value, 0.0).displacement;
    acceleration_[i] = 0;
  }
  put_start(model, false);
  send(model, true, true);
}

void Motions::put_start(Model& model, bool moving) const {
  for (std::size_t body = 0; body < bodies_.size(); ++body) {
    const BodyList& list = bodies_[body];
    if (list.particle.empty()) continue;
    const auto index = static_cast<Index>(body);
    auto displacement = model.reals(index, "displacement");
    auto velocity = model.reals(index, "velocity");
    for (std::size_t k = 0; k < list.particle.size(); ++k) {
      const Load& load = loads_[list.load[k]];
      const MotionValue now = load.curve.motion(load.kind, load.value, 0.0);
      const std::size_t entry = at(3 * list.particle[k] + list.direction[k]);
      displacement[entry] = now.displacement;
      velocity[entry] = moving ? now.velocity : 0.0;
    }
    model.put(index, "displacement", displacement);
    model.put(index, "velocity", velocity);
  }
}

void Motions::before_advance(Model& model, double t_new) {
  for (std::size_t i = 0; i < loads_.size(); ++i) {
    const Load& load = loads_[i];
    displacement_[i] = load.curve.motion(load.kind, load.value, t_new).displacement;
  }
  send(model, true, false);
}

void Motions::before_update(Model& model, double t_before, double t, double t_after, double dt) {
  for (std::size_t i = 0; i < loads_.size(); ++i) {
    const Load& load = loads_[i];
    const auto u = [&](double time) {
      return load.curve.motion(load.kind, load.value, time).displacement;
    };
    acceleration_[i] = load.exact ? (u(t_after) - 2 * u(t) + u(t_before)) / (dt * dt)
                                  : load.curve.motion(load.kind, load.value, t).acceleration;
  }
  send(model, false, true);
}

void Motions::send(Model& model, bool displacement, bool acceleration) {
  for (std::size_t body = 0; body < bodies_.size(); ++body) {
    BodyList& list = bodies_[body];
    if (list.particle.empty()) continue;
    for (std::size_t k = 0; k < list.load.size(); ++k) {
      list.displacement[k] = displacement_[list.load[k]];
      list.acceleration[k] = acceleration_[list.load[k]];
    }
    check(cleave_body_motion(model.handle(), static_cast<Index>(body),
                             static_cast<Index>(list.particle.size()),
                             displacement ? list.displacement.data() : nullptr,
                             acceleration ? list.acceleration.data() : nullptr));
  }
}

const std::vector<Motions::Reaction>& Motions::reactions(Model& model) {
  for (std::size_t i = 0; i < loads_.size(); ++i) {
    Reaction& reaction = reactions_[i];
    std::fill_n(reaction.force, 3, 0.0);
    for (const Selection& selection : loads_[i].selections) {
      double force[3];
      check(cleave_body_reaction(model.handle(), selection.body,
                                 static_cast<Index>(selection.particles.size()),
                                 selection.particles.data(), force));
      for (int k = 0; k < 3; ++k) reaction.force[k] += force[k];
    }
  }
  return reactions_;
}

}  // namespace cleave::driver
