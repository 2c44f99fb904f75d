#include "scene/scene.hpp"

#include <algorithm>
#include <cmath>

#include "scene/body_options.hpp"
#include "scene/format.hpp"
#include "scene/index.hpp"
#include "scene/precrack.hpp"

namespace cleave::driver {
namespace {

void exempt(const Deck& deck, const Sets& sets, Model& model) {
  for (const DeckGroup* group : deck.all("exempt")) {
    for (const Selection& selection : sets.select(*group)) {
      check(cleave_body_exempt(model.handle(), selection.body,
                               static_cast<Index>(selection.particles.size()),
                               selection.particles.data()));
    }
  }
}

}  // namespace

Scene Scene::from_bodies(const Deck& deck, std::vector<BodyGeometry> bodies, int threads) {
  Scene scene;
  scene.deck_ = &deck;
  scene.bodies_ = std::make_unique<std::vector<BodyGeometry>>(std::move(bodies));
  scene.sets_ = std::make_unique<Sets>(deck, *scene.bodies_);
  scene.motions_ = std::make_unique<Motions>(deck, *scene.bodies_, *scene.sets_);
  scene.sections_ = std::make_unique<Sections>(deck, *scene.bodies_, *scene.sets_);
  try {
    const bool by_rows = deck.one("run").text("order") == "rows";
    scene.model_ =
        std::make_unique<Model>(threads, by_rows ? CLEAVE_ORDER_ROWS : CLEAVE_ORDER_BLOCKS);
    add_bodies(deck, *scene.bodies_, *scene.sets_, *scene.model_);
    exempt(deck, *scene.sets_, *scene.model_);
    scene.motions_->prescribe(*scene.model_);
    scene.model_->setup();
  } catch (const KernelError& error) {
    throw DeckError(deck.source.path + ": " + deck.in_units(error.what()));
  }
  scene.forces_ = std::make_unique<Forces>(deck, *scene.bodies_, *scene.sets_, *scene.model_);
  return scene;
}

Scene Scene::from_deck(const Deck& deck, int threads) {
  Scene scene = from_bodies(deck, take_bodies(deck), threads);
  delete_cracks(deck, scene.bodies(), scene.sets(), scene.model());
  return scene;
}

// Stability: the largest eigenvalue of a sum is at most the sum of the largest. Accuracy: contact that
// begins and ends between steps keeps the energy while omega dt is small.         [CBM contact-step]
constexpr double kContactPhase = 0.6;

double Scene::stable_step() const {
  const double step = model().stable_step();
  const double square = forces().contact_frequency_squared();
  if (!(square > 0)) return step;
  return std::min(step / std::sqrt(1 + 0.25 * step * step * square),
                  kContactPhase / std::sqrt(square));
}

// dt <= stable_step(), solved for the step without contact.
bool Scene::is_stable(double dt) const {
  const double square = forces().contact_frequency_squared();
  if (!(square > 0)) return model().is_stable(dt);
  return dt <= kContactPhase / std::sqrt(square) &&
         model().is_stable(dt / std::sqrt(1 - 0.25 * dt * dt * square));
}

void Scene::put_initial_velocities() {
  for (const DeckGroup* group : deck().all("initial")) {
    const auto& v = group->reals("velocity");
    const auto& w = group->reals("angular_velocity");
    const auto& centre = group->reals("centre");
    for (const Selection& selection : sets().select(*group)) {
      const BodyGeometry& body = bodies()[at(selection.body)];
      if (body.dimension == 2 && (v[2] != 0 || w[0] != 0 || w[1] != 0)) {
        deck().fail(*group, "body " + in_quotes(body.name) +
                                " is plane: velocity has no z component and rotation is about z");
      }
      auto velocity = model().reals(selection.body, "velocity");
      for (const Index i : selection.particles) {
        const double* X = &body.X[at(3 * i)];
        const double r[3] = {X[0] - centre[0], X[1] - centre[1], X[2] - centre[2]};
        velocity[at(3 * i)] = v[0] + w[1] * r[2] - w[2] * r[1];
        velocity[at(3 * i + 1)] = v[1] + w[2] * r[0] - w[0] * r[2];
        velocity[at(3 * i + 2)] = v[2] + w[0] * r[1] - w[1] * r[0];
      }
      model().put(selection.body, "velocity", velocity);
    }
  }
}

}  // namespace cleave::driver
