// The model handle: life, set-up, stepping, questions.
#include "model/model.hpp"

#include <cmath>
#include <cstring>

#include "abi/material_checks.hpp"
#include "core/instruction_set.hpp"
#include "model/resident.hpp"
#include "solver/relaxation.hpp"

using namespace cleave;
using namespace cleave::abi;
using Phase = cleave_model::Phase;

namespace {

cleave_model& checked(cleave_model* model) { return required(model, "model"); }

constexpr const char* kBeforeSetup = "this call must come before cleave_model_setup";

template <class T>
std::span<const T> span_of(const T* data, std::int64_t count, const char* name) {
  if (count < 0) throw Error(CLEAVE_BAD_ARGUMENT, text("count is ", count, "; allowed: >= 0"));
  if (count > 0) required(data, name);
  return {data, static_cast<std::size_t>(count)};
}

void add(cleave_energies& sum, const cleave_energies& e) {
  sum.kinetic += e.kinetic;
  sum.kinetic_staggered += e.kinetic_staggered;
  sum.elastic += e.elastic;
  sum.plastic += e.plastic;
  sum.stabilisation += e.stabilisation;
  sum.fracture += e.fracture;
  sum.viscous += e.viscous;
  sum.external += e.external;
  sum.reaction += e.reaction;
  sum.internal += e.internal;
  sum.balance += e.balance;
  sum.identity += e.identity;
  sum.hourglass += e.hourglass;
}

void add(cleave_counts& sum, const cleave_counts& c) {
  sum.particles += c.particles;
  sum.bonds += c.bonds;
  sum.simplices += c.simplices;
  sum.broken += c.broken;
  sum.inert += c.inert;
  sum.isolated += c.isolated;
  sum.inverted += c.inverted;
}

// Value of one body, or the sum over all for body = -1.
template <class T, class Ask>
T one_or_all(const cleave_model& model, std::int64_t body, const Ask& ask) {
  const auto answer = [&](Body& b) {
    fetch(b);
    return ask(b);
  };
  if (body != -1) return answer(model.body(body));
  T sum{};
  for (const auto& b : model.bodies) add(sum, answer(*b));
  return sum;
}

}  // namespace

extern "C" {

int32_t cleave_model_create(int32_t abi, cleave_model** model) {
  return guarded("cleave_model_create", [&] {
    required(model, "model");
    check_abi(abi);
    instruction_set();  // throws if the environment asks for one that this machine has not
    *model = new cleave_model;
  });
}

int32_t cleave_model_destroy(cleave_model* model) {
  return guarded("cleave_model_destroy", [&] { delete model; });
}

int32_t cleave_model_set_index_base(cleave_model* model, int32_t base) {
  return guarded("cleave_model_set_index_base", [&] {
    check_index_base(base);
    if (!checked(model).bodies.empty())
      throw Error(CLEAVE_WRONG_ORDER, "the model has a body already; call this before the first");
    model->index_base = base;
  });
}

int32_t cleave_model_set_threads(cleave_model* model, int32_t threads) {
  return guarded("cleave_model_set_threads", [&] {
    if (threads < 1)
      throw Error(CLEAVE_BAD_ARGUMENT, text("threads is ", threads, "; allowed: >= 1"));
    checked(model).team.resize(threads);
  });
}

int32_t cleave_model_set_order(cleave_model* model, int32_t order) {
  return guarded("cleave_model_set_order", [&] {
    checked(model).require(Phase::building, kBeforeSetup);
    if (order != CLEAVE_ORDER_BLOCKS && order != CLEAVE_ORDER_ROWS) {
      throw Error(CLEAVE_BAD_ARGUMENT,
                  text("order is ", order, "; allowed: CLEAVE_ORDER_BLOCKS, CLEAVE_ORDER_ROWS"));
    }
    model->by_rows = order == CLEAVE_ORDER_ROWS;
  });
}

int32_t cleave_body_spec_init(cleave_body_spec* spec) {
  return guarded("cleave_body_spec_init", [&] {
    required(spec, "spec") = {sizeof(cleave_body_spec),
                              CLEAVE_FORMULATION_cbm,
                              CLEAVE_3D,
                              CLEAVE_MATERIAL_svk,
                              0,
                              0,
                              nullptr,
                              0,
                              nullptr,
                              ""};
  });
}

int32_t cleave_body_add(cleave_model* model, const cleave_body_spec* spec, int64_t* body) {
  return guarded("cleave_body_add", [&] {
    checked(model).require(Phase::building, kBeforeSetup);
    required(body, "body");
    check_size(required(spec, "spec"), "cleave_body_spec");
    required(spec->X, "spec->X");
    if (spec->simplex_count > 0) required(spec->simplices, "spec->simplices");
    model->bodies.push_back(
        std::make_unique<Body>(*spec, static_cast<int>(model->bodies.size()), model->index_base));
    *body = static_cast<int64_t>(model->bodies.size()) - 1;
  });
}

int32_t cleave_body_set_real(cleave_model* model, int64_t body, const char* group, const char* name,
                             double value) {
  return guarded("cleave_body_set_real", [&] {
    checked(model).require(Phase::building, kBeforeSetup);
    model->body(body).group(&required(group, "group")).set_real(&required(name, "name"), value);
  });
}

int32_t cleave_body_set_choice(cleave_model* model, int64_t body, const char* group,
                               const char* name, const char* choice) {
  return guarded("cleave_body_set_choice", [&] {
    checked(model).require(Phase::building, kBeforeSetup);
    model->body(body)
        .group(&required(group, "group"))
        .set_choice(&required(name, "name"), &required(choice, "choice"));
  });
}

int32_t cleave_body_get_real(cleave_model* model, int64_t body, const char* group, const char* name,
                             double* value) {
  return guarded("cleave_body_get_real", [&] {
    required(value, "value") =
        checked(model).body(body).group(&required(group, "group")).real(&required(name, "name"));
  });
}

int32_t cleave_body_prescribe(cleave_model* model, int64_t body, int64_t count,
                              const int64_t* particle, const int32_t* direction,
                              const int32_t* motion) {
  return guarded("cleave_body_prescribe", [&] {
    checked(model).require(Phase::building, kBeforeSetup);
    prescribe(model->body(body), span_of(particle, count, "particle"),
              span_of(direction, count, "direction"), span_of(motion, count, "motion"));
  });
}

int32_t cleave_body_exempt(cleave_model* model, int64_t body, int64_t count,
                           const int64_t* particle) {
  return guarded("cleave_body_exempt", [&] {
    checked(model).require(Phase::building, kBeforeSetup);
    Body& b = model->body(body);
    const auto list = span_of(particle, count, "particle");
    for (const int64_t i : list) b.check_particle(i, CLEAVE_BAD_RANGE, "the zone without fracture");
    b.exempt.resize(static_cast<std::size_t>(b.particles), 0);
    for (const int64_t i : list) b.exempt[static_cast<std::size_t>(i)] = 1;
  });
}

int32_t cleave_body_volumes(cleave_model* model, int64_t body, int64_t count,
                            const double* volume) {
  return guarded("cleave_body_volumes", [&] {
    checked(model).require(Phase::building, kBeforeSetup);
    Body& b = model->body(body);
    const auto list = span_of(volume, count, "volume");
    if (count != b.particles) {
      throw Error(CLEAVE_BAD_ARGUMENT, text("count is ", count, "; ", b.label(), " has ",
                                            b.particles, " particles, and each needs a volume"));
    }
    for (int64_t i = 0; i < count; ++i) {
      const double v = list[static_cast<std::size_t>(i)];
      if (!(v > 0) || !std::isfinite(v)) {
        throw Error(CLEAVE_BAD_ARGUMENT, text(b.label(), ": the volume of particle ", b.number(i),
                                              " is ", v, "; allowed: > 0 and finite"));
      }
    }
    if (!b.formulation->takes_volumes()) {
      throw Error(CLEAVE_UNSUPPORTED,
                  text(b.label(), ": formulation ", b.formulation->name(),
                       " takes the volumes of its particles from simplices; give a mesh, or use "
                       "bond_pd, cpd or lps"));
    }
    b.given_volumes.assign(list.begin(), list.end());
  });
}

int32_t cleave_body_region(cleave_model* model, int64_t body, int64_t count,
                           const int64_t* particle, int32_t material, int64_t property_count,
                           const double* properties, double critical_strain, double Gf) {
  return guarded("cleave_body_region", [&] {
    checked(model).require(Phase::building, kBeforeSetup);
    Body& b = model->body(body);
    const auto list = span_of(particle, count, "particle");
    for (const int64_t i : list) b.check_particle(i, CLEAVE_BAD_RANGE, "the region");
    if (!b.formulation->takes_regions()) {
      throw Error(CLEAVE_UNSUPPORTED,
                  text(b.label(), ": formulation ", b.formulation->name(),
                       " has one material in a body; use bond_pd, cpd or lps, or two bodies"));
    }
    if (!(critical_strain >= 0) || !(Gf >= 0) || (critical_strain > 0 && Gf > 0)) {
      throw Error(
          CLEAVE_BAD_ARGUMENT,
          text("region of ", b.label(), ": critical_strain is ", critical_strain, ", Gf is ", Gf,
               "; allowed: one of them > 0, or both 0 for what group fracture says"));
    }
    b.regions.push_back({&find_material(material),
                         abi::make_checked(material, b.kinematics, property_count, properties),
                         critical_strain, Gf});
    b.region.resize(static_cast<std::size_t>(b.particles), 0);
    for (const int64_t i : list)
      b.region[static_cast<std::size_t>(i)] = static_cast<int32_t>(b.regions.size());
  });
}

int32_t cleave_model_setup(cleave_model* model) {
  return guarded("cleave_model_setup", [&] {
    checked(model).require(Phase::building, "the model is set up already; make a new one");
    set_up(*model);
  });
}

int32_t cleave_body_precrack(cleave_model* model, int64_t body, int64_t count,
                             const int64_t* pairs) {
  return guarded("cleave_body_precrack", [&] {
    checked(model).require(
        Phase::ready,
        "pre-cracks come after cleave_model_setup and before cleave_model_initialise");
    Body& b = model->body(body);
    b.formulation->precrack(b, span_of(pairs, 2 * count, "pairs"));
  });
}

int32_t cleave_model_stable_step(cleave_model* model, double* step) {
  return guarded("cleave_model_stable_step", [&] {
    checked(model).require_set_up();
    required(step, "step") = stable_step(*model);
  });
}

int32_t cleave_model_is_stable(cleave_model* model, double dt, int32_t* stable) {
  return guarded("cleave_model_is_stable", [&] {
    checked(model).require_set_up();
    required(stable, "stable") = is_stable(*model, dt) ? 1 : 0;
  });
}

int32_t cleave_body_wave_speed(cleave_model* model, int64_t body, double* speed) {
  return guarded("cleave_body_wave_speed", [&] {
    checked(model).require_set_up();
    required(speed, "speed") = model->body(body).wave_speed();
  });
}

int32_t cleave_body_motion(cleave_model* model, int64_t body, int64_t count,
                           const double* displacement, const double* acceleration) {
  return guarded("cleave_body_motion", [&] {
    checked(model).require_set_up();
    auto& list = model->body(body).prescribed;
    if (count != static_cast<int64_t>(list.size())) {
      throw Error(CLEAVE_BAD_ARGUMENT,
                  text("count is ", count, ", but ", list.size(),
                       " degrees of freedom are prescribed (cleave_body_prescribe)"));
    }
    for (std::size_t k = 0; k < list.size(); ++k) {
      if (displacement != nullptr) list[k].displacement = displacement[k];
      if (acceleration != nullptr) list[k].acceleration = acceleration[k];
    }
  });
}

int32_t cleave_model_initialise(cleave_model* model, double time) {
  return guarded("cleave_model_initialise", [&] {
    checked(model).require(Phase::ready,
                           "cleave_model_initialise comes once, after cleave_model_setup");
    initialise(*model, time);
  });
}

int32_t cleave_model_advance(cleave_model* model, double dt, double time_new) {
  return guarded("cleave_model_advance", [&] {
    checked(model).require(
        Phase::stepping,
        "cleave_model_advance comes after cleave_model_initialise or cleave_model_update");
    advance(*model, dt, time_new);
  });
}

int32_t cleave_model_update(cleave_model* model) {
  return guarded("cleave_model_update", [&] {
    checked(model).require(Phase::advanced, "cleave_model_update comes after cleave_model_advance");
    update(*model);
  });
}

int32_t cleave_body_event_count(cleave_model* model, int64_t body, int64_t* count) {
  return guarded("cleave_body_event_count", [&] {
    required(count, "count") = static_cast<int64_t>(checked(model).body(body).events.size());
  });
}

int32_t cleave_body_event_get(cleave_model* model, int64_t body, int64_t index,
                              cleave_event* event) {
  return guarded("cleave_body_event_get", [&] {
    const auto& events = checked(model).body(body).events;
    check_range(index, index + 1, static_cast<int64_t>(events.size()));
    fill_sized(event, events[static_cast<std::size_t>(index)], "event");
  });
}

int32_t cleave_body_clear_events(cleave_model* model, int64_t body) {
  return guarded("cleave_body_clear_events", [&] { checked(model).body(body).events.clear(); });
}

int32_t cleave_energies_get(cleave_model* model, int64_t body, cleave_energies* energies_out) {
  return guarded("cleave_energies_get", [&] {
    checked(model).require_set_up();
    fill_sized(energies_out,
               one_or_all<cleave_energies>(*model, body, [](const Body& b) { return energies(b); }),
               "energies");
  });
}

int32_t cleave_counts_get(cleave_model* model, int64_t body, cleave_counts* counts_out) {
  return guarded("cleave_counts_get", [&] {
    checked(model).require_set_up();
    fill_sized(counts_out,
               one_or_all<cleave_counts>(*model, body, [](const Body& b) { return counts(b); }),
               "counts");
  });
}

int32_t cleave_model_memory(cleave_model* model, int64_t* bytes) {
  return guarded("cleave_model_memory", [&] {
    int64_t sum = 0;
    for (const auto& b : checked(model).bodies) sum += b->fields.bytes() + b->formulation->bytes();
    if (model->relaxation != nullptr) sum += model->relaxation->bytes();
    required(bytes, "bytes") = sum;
  });
}

int32_t cleave_body_reaction(cleave_model* model, int64_t body, int64_t count,
                             const int64_t* particle, double force[3]) {
  return guarded("cleave_body_reaction", [&] {
    checked(model).require_set_up();
    required(force, "force");
    fetch(model->body(body), "acceleration");
    reaction(model->body(body), span_of(particle, count, "particle"), force);
  });
}

int32_t cleave_model_restore(cleave_model* model, int64_t step, double time) {
  return guarded("cleave_model_restore", [&] {
    checked(model).require(Phase::ready,
                           "cleave_model_restore comes after cleave_model_setup and the fields, "
                           "instead of cleave_model_initialise");
    if (step < 0) throw Error(CLEAVE_BAD_ARGUMENT, text("step is ", step, "; allowed: >= 0"));
    restore(*model, step, time);
  });
}

int32_t cleave_model_clock(cleave_model* model, int64_t* step, double* time) {
  return guarded("cleave_model_clock", [&] {
    required(step, "step") = checked(model).clock.step;
    required(time, "time") = model->clock.time;
  });
}

}  // extern "C"
