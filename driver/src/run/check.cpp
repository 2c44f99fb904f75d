// `cleave check`: everything that can be said about a run without running it.

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>

#include "run/run.hpp"
#include "run/simulation.hpp"
#include "run/stop_file.hpp"
#include "run/threads.hpp"
#include "scene/format.hpp"
#include "scene/index.hpp"
#include "scene/region.hpp"

namespace cleave::driver {
namespace {

void say(const std::string& line) { std::fputs((line + "\n").c_str(), stdout); }

// Whether the way between two particles leads through a region.
bool leads_through(const Region& region, const double* from, const double* to) {
  constexpr int kParts = 8;
  for (int n = 1; n < kParts; ++n) {
    const double t = static_cast<double>(n) / kParts;
    double x[3];
    for (int k = 0; k < 3; ++k) x[k] = (1 - t) * from[k] + t * to[k];
    if (region.contains(x, 0)) return true;
  }
  return false;
}

// A horizon may be longer than a notch is wide: then bonds hold it together.
void say_bridged_notches(const Scene& scene, Index body) {
  const BodyGeometry& geometry = scene.bodies()[static_cast<std::size_t>(body)];
  Index place = 0;
  for (const DeckGroup* notch : scene.deck().all("notch")) {
    ++place;
    if (!notch->text("body").empty() && notch->text("body") != geometry.name) continue;
    const Region region(scene.deck(), *notch);
    const auto ends = scene.model().integers(body, "bond_ends");
    const auto status = scene.model().integers(body, "bond_status");
    Index bridges = 0;
    for (std::size_t b = 0; b < status.size(); ++b)
      if (status[b] == 0 && leads_through(region, geometry.X.data() + 3 * ends[2 * b],
                                          geometry.X.data() + 3 * ends[2 * b + 1]))
        ++bridges;
    if (bridges == 0) continue;
    say("  " + number(bridges) + " bonds reach across notch " + number(place) +
        " and hold it together; &precrack cuts them");
  }
}

void say_bodies(const Scene& scene) {
  for (Index body = 0; body < scene.model().bodies(); ++body) {
    const BodyGeometry& geometry = scene.bodies()[static_cast<std::size_t>(body)];
    const cleave_counts counts = scene.model().counts(body);
    const Box box = bounding_box(geometry);
    say("body " + in_quotes(geometry.name) + ": " + number(counts.particles) + " particles, " +
        number(counts.bonds) + " bonds, " + number(counts.simplices) + " simplices, " +
        number(counts.inert) + " bonds inert at the start");
    say("  from " + point_text(box.lower) + " to " + point_text(box.upper) + ", shortest bond " +
        number(shortest_edge(geometry)) + ", wave speed " + number(scene.model().wave_speed(body)));
    if (scene.model().find_field(body, "interactions")) {
      const std::vector<double> n = scene.model().reals(body, "interactions");
      say("  interactions: " + number(Index(std::llround(n[0]))) + " one-neighbour, " +
          number(Index(std::llround(n[1]))) + " two-neighbour, " +
          number(Index(std::llround(n[2]))) + " three-neighbour");
      say_bridged_notches(scene, body);
    }
    for (const NamedSet& set : scene.sets().of_body(body)) {
      say("  set " + in_quotes(set.name) + ": " + number(Index(set.particles.size())) +
          " particles");
    }
  }
}

// A static run then seeks equilibrium anew after bonds broke, as often as it takes.
bool has_bonds_that_break(const Model& model) {
  for (Index body = 0; body < model.bodies(); ++body)
    if (model.find_field(body, "bond_status")) return true;
  return false;
}

struct StepCost {
  double seconds = 0;
  bool at_least = false;  // it was not waited for
};

// From a few steps. The model is spoiled for a run afterwards.
StepCost time_a_step(Scene& scene, const Clock& clock) {
  using WallClock = std::chrono::steady_clock;
  const Stepping stepping(scene.deck());
  stepping.start(scene, clock.dt);
  const auto begin = WallClock::now();
  const auto seconds = [&] {
    return std::chrono::duration<double>(WallClock::now() - begin).count();
  };
  constexpr Index kSteps = 50;
  constexpr double kSeconds = 1.0;
  constexpr double kPatience = 10.0;  // for a static increment
  Index step = 0;
  const auto patient = [&] { return seconds() < kPatience; };
  const StepWatch watch{[&](const StepReport&) { return patient(); },
                        [&](double, const StepReport&) { return patient(); }};
  while (step < std::min(kSteps, clock.steps) && seconds() < kSeconds) {
    if (!stepping.step(scene, clock, step++, watch).finished)
      return {seconds() / static_cast<double>(step), true};
  }
  return {seconds() / static_cast<double>(step), false};
}

}  // namespace

int check_deck(const Deck& deck, const RunOptions& options) {
  const int threads = threads_of(deck, options);
  Scene scene = Scene::from_deck(deck, threads);
  const TimeStep step = choose_time_step(scene);
  StopFile(deck, FileNames::of_deck(deck)).refuse_leftover(deck);
  // Requests for output are checked like those of a run.
  const ResultsFile results(scene);
  const HistoryFile history(scene);
  StepCost cost;
  try {
    cost = time_a_step(scene, step.clock);
  } catch (const KernelError& error) {
    throw RunError("the first steps failed: " + deck.in_units(error.what()));
  }
  if (options.quiet) return 0;
  say_bodies(scene);
  say("memory " + bytes_text(scene.model().memory()));
  const std::string end = " to t = " + number(step.clock.time(step.clock.steps));
  if (Stepping(deck).is_static()) {
    say(number(step.clock.steps) + " load increments of " + number(step.clock.dt) + end);
  } else {
    say("stable step " + number(step.stable) + " (" + step.governed_by + ")");
    say("step " + number(step.clock.dt) + ", " + number(step.clock.steps) + " steps" + end);
  }
  for (const std::string& warning : step.warnings) say("warning: " + warning);
  const double total = cost.seconds * static_cast<double>(step.clock.steps);
  const bool may_break = Stepping(deck).is_static() && has_bonds_that_break(scene.model());
  say(std::string("estimated ") + (cost.at_least || may_break ? "at least " : "") +
      number(total / 3600, 3) + " hours (" + duration_text(total) + ") on " +
      std::to_string(threads) + (threads == 1 ? " thread" : " threads") + ", without output" +
      (may_break ? " and bonds that break" : ""));
  say("the deck is good");
  return 0;
}

}  // namespace cleave::driver
