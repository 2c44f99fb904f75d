#include "run/time_step.hpp"

#include <cmath>
#include <limits>

#include "deck/kernel_tables.hpp"
#include "deck/units.hpp"
#include "scene/format.hpp"

namespace cleave::driver {
namespace {

std::string governing_body(const Scene& scene) {
  double least = std::numeric_limits<double>::infinity();
  std::string text;
  for (std::size_t i = 0; i < scene.bodies().size(); ++i) {
    const double edge = shortest_edge(scene.bodies()[i]);
    const double speed = scene.model().wave_speed(static_cast<std::int64_t>(i));
    if (edge / speed < least) {
      least = edge / speed;
      text = "body " + in_quotes(scene.bodies()[i].name) + ": shortest bond " + number(edge) +
             ", wave speed " + number(speed);
    }
  }
  return text;
}

std::vector<std::string> implausible_units(const Scene& scene) {
  std::vector<std::string> warnings;
  for (std::int64_t body = 0; body < scene.model().bodies(); ++body) {
    double density = 0;
    check(cleave_body_get_real(scene.model().handle(), body, "material", "rho", &density));
    const std::string text = implausible_wave_speed(scene.deck().one("run").text("units"),
                                                    scene.model().wave_speed(body), density);
    const std::string& name = scene.bodies()[static_cast<std::size_t>(body)].name;
    if (!text.empty()) warnings.push_back("body " + in_quotes(name) + ": " + text);
  }
  return warnings;
}

}  // namespace

std::int64_t steps_to_end(double t_end, double dt) {
  const double ratio = t_end / dt;
  const double whole = std::round(ratio);
  const bool is_whole =
      std::abs(ratio - whole) <= 1e-9 * whole;  // rounding of a quotient in a deck
  return static_cast<std::int64_t>(std::max(1.0, is_whole ? whole : std::ceil(ratio)));
}

TimeStep choose_time_step(const Scene& scene) {
  const DeckGroup& run = scene.deck().one("run");
  const double t_end = run.real("t_end");
  const double given = run.real("time_step");
  TimeStep step;
  step.stable = scene.stable_step();
  step.governed_by = governing_body(scene);
  step.warnings = implausible_units(scene);
  if (run.text("mode") == "static") {
    step.clock.steps = scene.deck().one("static").integer("increments");
    step.clock.dt = t_end / static_cast<double>(step.clock.steps);
    return step;
  }
  const double wanted = given > 0 ? given : run.real("step_factor") * step.stable;
  if (!(wanted > 0)) {
    scene.deck().fail(run, "step_factor", "the time step would be zero; give step_factor > 0");
  }
  const double count = t_end / wanted;
  if (!(count < 1e15)) {
    scene.deck().fail(run, "t_end",
                      "this run would need " + number(count) + " steps of " + number(wanted) +
                          "; check t_end and units");
  }
  step.clock.steps = steps_to_end(t_end, wanted);
  step.clock.dt = given > 0 ? given : t_end / static_cast<double>(step.clock.steps);
  if (given > step.stable) {
    const std::string text = "time_step = " + number(given) + " is above the stable step " +
                             number(step.stable) + " (" + step.governed_by +
                             "); use time_step <= " + number(step.stable) +
                             ", or time_step = 0 for step_factor times the stable step";
    if (run.text("step_check") == "refuse") scene.deck().fail(run, "time_step", text);
    step.warnings.push_back(text);
  }
  return step;
}

}  // namespace cleave::driver
