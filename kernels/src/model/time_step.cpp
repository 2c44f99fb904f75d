// One step of velocity Verlet, in two calls so that the host can set loads between them:
//   advance   v += dt/2 a,  u += dt v
//   update    break, gradient, stress, forces, a = f/m, v += dt/2 a
// and the works of the energy ledger, half a trapezoid in each call.                         [CBM 19]
#include <cmath>

#include "model/model.hpp"
#include "model/resident.hpp"

namespace cleave {

namespace {

double total_force(const PointArrays& pt, std::int64_t c) {
  return pt.internal[c] + pt.viscous[c] + pt.external[c];
}

// f(component of the dof, dof)
template <class F>
void for_prescribed(Body& body, const F& f) {
  for (const auto& dof : body.prescribed) f(kVector * dof.particle + dof.direction, dof);
}

// Adds half of the trapezoid of the works with the forces now in the arrays and dx = dt v.
void add_half_work(Body& body, double dt, ThreadTeam& team) {
  const PointArrays& pt = body.point;
  for_blocks(team, body.particles, [&](std::int64_t block, std::int64_t first, std::int64_t last) {
    double internal = 0, viscous = 0, external = 0;
    for (std::int64_t c = kVector * first; c < kVector * last; ++c) {
      internal += pt.internal[c] * pt.v[c];
      viscous += pt.viscous[c] * pt.v[c];
      external += pt.external[c] * pt.v[c];
    }
    body.work[block] = {internal, viscous, external};
  });
  const auto [internal, viscous, external] = body.work.total();
  double reaction = 0;
  for_prescribed(body, [&](std::int64_t c, const PrescribedDof& dof) {
    reaction += (pt.mass[dof.particle] * pt.a[c] - total_force(pt, c)) * pt.v[c];
  });
  const double half = 0.5 * dt;
  pt.ledger[ledger::kInternal] -= half * internal;
  pt.ledger[ledger::kViscous] -= half * viscous;
  pt.ledger[ledger::kExternal] += half * external;
  pt.ledger[ledger::kReaction] += half * reaction;
}

void kick(Body& body, double half, ThreadTeam& team) {
  const PointArrays& pt = body.point;
  for_blocks(team, body.particles, [&](std::int64_t, std::int64_t first, std::int64_t last) {
    for (std::int64_t c = kVector * first; c < kVector * last; ++c) pt.v[c] += half * pt.a[c];
  });
}

void accelerate(Body& body, ThreadTeam& team) {
  const PointArrays& pt = body.point;
  for_blocks(team, body.particles, [&](std::int64_t, std::int64_t first, std::int64_t last) {
    for (std::int64_t i = first; i < last; ++i) {
      const double inverse = 1 / pt.mass[i];
      for (int k = 0; k < body.dimension(); ++k) {
        pt.a[kVector * i + k] = total_force(pt, kVector * i + k) * inverse;
      }
    }
  });
  for_prescribed(body,
                 [&](std::int64_t c, const PrescribedDof& dof) { pt.a[c] = dof.acceleration; });
}

// The first step fixes what the balance is measured from. A prescribed velocity that jumps at the
// start is taken as v(t0) = v(t0+dt/2) - dt/2 a(t0), so that the integrator's identity holds for it
// too.
void start_ledger(Body& body, double dt) {
  const PointArrays& pt = body.point;
  for_prescribed(body, [&](std::int64_t c, const PrescribedDof& dof) {
    if (dof.motion == CLEAVE_MOTION_EXACT)
      pt.v[c] = (dof.displacement - pt.u[c]) / dt - 0.5 * dt * pt.a[c];
  });
  pt.ledger[ledger::kLastStep] = dt;
  const cleave_energies e = energies(body);
  pt.ledger[ledger::kStartTotal] = e.kinetic + e.elastic + e.plastic + e.stabilisation;
  pt.ledger[ledger::kStartStaggered] = e.kinetic_staggered;
  pt.ledger[ledger::kStarted] = 1;
}

// The integrator keeps K - dt^2/8 sum m a^2 + works for its dt; what a change of dt adds to it at time t
// is no error.
void change_step(Body& body, double dt) {
  const PointArrays& pt = body.point;
  const double before = pt.ledger[ledger::kLastStep];
  double sum = 0;
  for (std::int64_t i = 0; i < body.particles; ++i)
    for (int k = 0; k < kVector; ++k)
      sum += pt.mass[i] * pt.a[kVector * i + k] * pt.a[kVector * i + k];
  pt.ledger[ledger::kStartStaggered] -= (dt * dt - before * before) / 8 * sum;
  pt.ledger[ledger::kLastStep] = dt;
}

// What the ledger must know of a step that begins.
void begin_step(Body& body, double dt) {
  if (!(body.point.ledger[ledger::kStarted] > 0)) {
    fetch(body);
    start_ledger(body, dt);
  }
  if (dt == body.point.ledger[ledger::kLastStep]) return;
  fetch(body, "acceleration");
  change_step(body, dt);
}

void advance_body(Body& body, double dt, ThreadTeam& team) {
  begin_step(body, dt);
  if (ResidentStep* resident = body.formulation->resident()) {
    resident->advance(body, dt, team);
    return;
  }
  const PointArrays& pt = body.point;
  kick(body, 0.5 * dt, team);
  for_prescribed(body, [&](std::int64_t c, const PrescribedDof& dof) {
    if (dof.motion == CLEAVE_MOTION_EXACT) pt.v[c] = (dof.displacement - pt.u[c]) / dt;
  });
  add_half_work(body, dt, team);
  for_blocks(team, body.particles, [&](std::int64_t, std::int64_t first, std::int64_t last) {
    for (std::int64_t c = kVector * first; c < kVector * last; ++c) {
      pt.u[c] += dt * pt.v[c];
      pt.x[c] = pt.X[c] + pt.u[c];
    }
  });
  for_prescribed(body, [&](std::int64_t c, const PrescribedDof& dof) {
    if (dof.motion != CLEAVE_MOTION_EXACT) return;
    pt.u[c] = dof.displacement;
    pt.x[c] = pt.X[c] + pt.u[c];
  });
}

// A formulation names the particle; the step and the time are known here.
template <class F>
void at_clock(const Clock& clock, const F& f) {
  try {
    f();
  } catch (const Error& e) {
    throw Error(e.status, text(e.what(), "; at step ", clock.step, ", time ", clock.time));
  }
}

void update_body(Body& body, const Clock& clock, ThreadTeam& team) {
  if (ResidentStep* resident = body.formulation->resident()) {
    resident->update(body, clock, team);
    return;
  }
  body.formulation->break_bonds(body, clock, team);
  body.formulation->deform(body, clock, team);
  body.formulation->forces(body, team);
  accelerate(body, team);
  add_half_work(body, clock.dt, team);
  kick(body, 0.5 * clock.dt, team);
}

// The works see every force and velocity: if they are finite, so is the step. Only otherwise the
// culprit is looked for.
void check_finite(Body& body, const Clock& clock) {
  const PointArrays& pt = body.point;
  const double sum = pt.ledger[ledger::kInternal] + pt.ledger[ledger::kViscous] +
                     pt.ledger[ledger::kExternal] + pt.ledger[ledger::kReaction] +
                     pt.ledger[ledger::kFracture] + pt.ledger[ledger::kPlastic] +
                     pt.ledger[ledger::kShock];
  if (std::isfinite(sum)) return;
  fetch(body);
  for (const char* name : {"external_force", "displacement", "first_piola_kirchhoff_stress",
                           "internal_force", "viscous_force", "velocity"}) {
    const Field& f = *body.fields.find(name);
    for (std::size_t k = 0; k < f.real.size(); ++k) {
      if (std::isfinite(f.real[k])) continue;
      const std::size_t i = k / static_cast<std::size_t>(f.spec.components);
      throw Error(CLEAVE_NOT_FINITE,
                  text(body.label(), ": field ", name, " of ",
                       body.particle_label(static_cast<std::int64_t>(i)), " is not finite at step ",
                       clock.step, ", time ", clock.time,
                       "; a smaller step, viscosity or stabilisation may help"));
    }
  }
  throw Error(CLEAVE_NOT_FINITE, text(body.label(), ": the energy ledger is not finite at step ",
                                      clock.step, ", time ", clock.time));
}

}  // namespace

void fetch(Body& body, std::string_view field) {
  if (ResidentStep* resident = body.formulation->resident()) resident->fetch(body, field);
  if (!field.empty()) body.formulation->observe(body, field);
}

void take_fields(Body& body) {
  ResidentStep* resident = body.formulation->resident();
  if (resident == nullptr) return;
  resident->fetch(body, {});
  resident->changed({});
}

void prepare(cleave_model& model) {
  for (auto& body : model.bodies) {
    if (ResidentStep* resident = body->formulation->resident())
      resident->prepare(*body, model.team);
  }
}

void initialise(cleave_model& model, double time) {
  model.clock = {0, time, 0};
  for (auto& body : model.bodies) {
    fetch(*body);
    for (std::int64_t c = 0; c < kVector * body->particles; ++c)
      body->point.x[c] = body->point.X[c] + body->point.u[c];
    if (ResidentStep* resident = body->formulation->resident()) {
      resident->changed("displacement");
      at_clock(model.clock, [&] { resident->start(*body, model.clock, model.team); });
      continue;
    }
    body->formulation->deform(*body, model.clock, model.team);
    body->formulation->forces(*body, model.team);
    accelerate(*body, model.team);
  }
  model.phase = cleave_model::Phase::stepping;
}

void advance(cleave_model& model, double dt, double time_new) {
  if (!(dt > 0) || !std::isfinite(dt)) {
    throw Error(CLEAVE_BAD_ARGUMENT, text("the time step is ", dt, "; allowed: > 0 and finite"));
  }
  for (auto& body : model.bodies) advance_body(*body, dt, model.team);
  model.clock = {model.clock.step + 1, time_new, dt};
  model.phase = cleave_model::Phase::advanced;
}

void update(cleave_model& model) {
  for (auto& body : model.bodies) {
    at_clock(model.clock, [&] { update_body(*body, model.clock, model.team); });
    check_finite(*body, model.clock);
  }
  model.phase = cleave_model::Phase::stepping;
}

void restore(cleave_model& model, std::int64_t step, double time) {
  for (auto& body : model.bodies) {
    take_fields(*body);
    for (std::int64_t c = 0; c < kVector * body->particles; ++c)
      body->point.x[c] = body->point.X[c] + body->point.u[c];
    body->formulation->rebuild(*body, model.team);
  }
  model.clock = {step, time, 0};
  prepare(model);
  model.phase = cleave_model::Phase::stepping;
}

}  // namespace cleave
