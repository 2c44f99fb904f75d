#include "model/model.hpp"

#include <algorithm>
#include <cmath>

void cleave_model::require(Phase wanted, const char* remedy) const {
  if (phase != wanted) throw cleave::Error(CLEAVE_WRONG_ORDER, remedy);
}

void cleave_model::require_set_up() const {
  if (phase == Phase::building) {
    throw cleave::Error(CLEAVE_WRONG_ORDER,
                        "the model is not set up yet; call cleave_model_setup first");
  }
}

cleave::Body& cleave_model::body(std::int64_t index) const {
  if (index < 0 || index >= static_cast<std::int64_t>(bodies.size())) {
    throw cleave::Error(CLEAVE_BAD_ARGUMENT,
                        cleave::text("body ", index + index_base, " does not exist; the model has ",
                                     bodies.size(), " bodies, counted from ", index_base));
  }
  return *bodies[static_cast<std::size_t>(index)];
}

namespace cleave {

void prescribe(Body& body, std::span<const std::int64_t> particle,
               std::span<const std::int32_t> direction, std::span<const std::int32_t> motion) {
  std::vector<char> taken(static_cast<std::size_t>(body.particles), 0);
  std::vector<PrescribedDof> list;
  list.reserve(particle.size());
  for (std::size_t k = 0; k < particle.size(); ++k) {
    body.check_particle(particle[k], CLEAVE_BAD_RANGE, "prescribed degrees of freedom");
    if (direction[k] < 0 || direction[k] >= body.dimension()) {
      throw Error(CLEAVE_BAD_ARGUMENT, text(body.label(), ": prescribed direction ", direction[k],
                                            "; allowed: 0 to ", body.dimension() - 1));
    }
    if (motion[k] != CLEAVE_MOTION_ACCELERATION && motion[k] != CLEAVE_MOTION_EXACT) {
      throw Error(CLEAVE_BAD_ARGUMENT,
                  text(body.label(), ": motion ", motion[k], " is not in enum cleave_motion"));
    }
    char& mask = taken[static_cast<std::size_t>(particle[k])];
    if ((mask >> direction[k]) & 1) {
      throw Error(CLEAVE_BAD_ARGUMENT, text(body.label(), ": particle ", body.number(particle[k]),
                                            " is prescribed twice in direction ", direction[k],
                                            "; give each degree of freedom once"));
    }
    mask = static_cast<char>(mask | (1 << direction[k]));
    list.push_back({static_cast<std::int32_t>(particle[k]), direction[k],
                    static_cast<cleave_motion>(motion[k])});
  }
  body.prescribed = std::move(list);
}

void set_up(cleave_model& model) {
  if (model.bodies.empty())
    throw Error(CLEAVE_WRONG_ORDER, "the model has no body; call cleave_body_add first");
  for (auto& body : model.bodies) {
    body->material_parameters.require_all();
    body->material = body->law->make(body->material_parameters.values(), body->kinematics);
    body->by_rows = model.by_rows;
    body->make_fields();
    body->formulation->setup(*body, model.team);
    body->events.reserve(static_cast<std::size_t>(std::min<std::int64_t>(body->particles, 65536)));
  }
  // Not earlier: a refused set-up can be repaired and called again. Assigning an empty list would keep the
  // memory.
  for (auto& body : model.bodies) {
    std::vector<double>().swap(body->given_positions);
    std::vector<std::int64_t>().swap(body->given_simplices);
    std::vector<double>().swap(body->given_volumes);
  }
  model.phase = cleave_model::Phase::ready;
}

// Force that keeps prescribed motion: m a - (all other forces), in prescribed directions.
void reaction(const Body& body, std::span<const std::int64_t> particles, double force[3]) {
  std::vector<char> mask(static_cast<std::size_t>(body.particles), 0);
  for (const auto& dof : body.prescribed) {
    char& m = mask[static_cast<std::size_t>(dof.particle)];
    m = static_cast<char>(m | (1 << dof.direction));
  }
  for (int k = 0; k < 3; ++k) force[k] = 0;
  const PointArrays& pt = body.point;
  for (const std::int64_t i : particles) {
    body.check_particle(i, CLEAVE_BAD_RANGE, "the reaction");
    for (int k = 0; k < 3; ++k) {
      const std::int64_t c = kVector * i + k;
      if ((mask[static_cast<std::size_t>(i)] >> k) & 1) {
        force[k] += pt.mass[i] * pt.a[c] - (pt.internal[c] + pt.viscous[c] + pt.external[c]);
      }
    }
  }
}

cleave_energies energies(const Body& body) {
  cleave_energies e{};
  const PointArrays& pt = body.point;
  double square_a = 0;
  for (std::int64_t i = 0; i < body.particles; ++i) {
    for (int k = 0; k < kVector; ++k) {
      e.kinetic += 0.5 * pt.mass[i] * pt.v[kVector * i + k] * pt.v[kVector * i + k];
      square_a += pt.mass[i] * pt.a[kVector * i + k] * pt.a[kVector * i + k];
    }
  }
  const double dt = pt.ledger[ledger::kLastStep];
  e.kinetic_staggered = e.kinetic - dt * dt / 8 * square_a;
  const StoredEnergy stored = body.formulation->stored_energy(body);
  e.elastic = stored.elastic;
  e.plastic = pt.ledger[ledger::kPlastic];
  e.stabilisation = stored.stabilisation;
  e.fracture = pt.ledger[ledger::kFracture];
  e.viscous = pt.ledger[ledger::kViscous] + pt.ledger[ledger::kShock];
  e.external = pt.ledger[ledger::kExternal];
  e.reaction = pt.ledger[ledger::kReaction];
  e.internal = pt.ledger[ledger::kInternal];
  const double work = e.external + e.reaction;
  if (pt.ledger[ledger::kStarted] > 0) {
    e.balance = e.kinetic + e.elastic + e.plastic + e.stabilisation + e.fracture + e.viscous -
                work - pt.ledger[ledger::kStartTotal];
    e.identity = e.kinetic_staggered + e.internal + pt.ledger[ledger::kViscous] - work -
                 pt.ledger[ledger::kStartStaggered];
  }
  e.hourglass = body.formulation->hourglass_energy(body);
  return e;
}

cleave_counts counts(const Body& body) {
  cleave_counts c{};
  c.particles = body.particles;
  body.formulation->count(body, c);
  return c;
}

}  // namespace cleave
