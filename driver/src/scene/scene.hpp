// From a deck to a model that is ready for its first step: bodies, materials, options, sets, loads
// and pre-cracks, each with the place in the deck where it came from.
#pragma once

#include <memory>
#include <vector>

#include "deck/deck.hpp"
#include "scene/forces.hpp"
#include "scene/geometry.hpp"
#include "scene/model.hpp"
#include "scene/motions.hpp"
#include "scene/sections.hpp"
#include "scene/sets.hpp"

namespace cleave::driver {

class Scene {
 public:
  // Everything from the deck and its meshes; pre-cracks are made. Throws DeckError.
  static Scene from_deck(const Deck& deck, int threads);
  // The same for bodies that a checkpoint carried: meshes are not read and nothing is cracked,
  // because the state that follows knows which bonds are broken.
  static Scene from_bodies(const Deck& deck, std::vector<BodyGeometry> bodies, int threads);

  const Deck& deck() const { return *deck_; }
  const std::vector<BodyGeometry>& bodies() const { return *bodies_; }
  const Sets& sets() const { return *sets_; }
  Model& model() { return *model_; }
  const Model& model() const { return *model_; }
  Motions& motions() { return *motions_; }
  const Motions& motions() const { return *motions_; }
  Forces& forces() { return *forces_; }
  const Forces& forces() const { return *forces_; }
  Sections& sections() { return *sections_; }
  const Sections& sections() const { return *sections_; }

  // The largest stable step now [s]: that of the model, shortened by the stiffness of walls.
  double stable_step() const;
  bool is_stable(double dt) const;  // dt <= stable_step(), cheaper

  // Gives particles the velocities of the &initial groups.
  void put_initial_velocities();

 private:
  Scene() = default;

  const Deck* deck_ = nullptr;
  // On the heap, so that references between the parts stay good when a scene is moved.
  std::unique_ptr<std::vector<BodyGeometry>> bodies_;
  std::unique_ptr<Sets> sets_;
  std::unique_ptr<Model> model_;
  std::unique_ptr<Motions> motions_;
  std::unique_ptr<Forces> forces_;
  std::unique_ptr<Sections> sections_;
};

}  // namespace cleave::driver
