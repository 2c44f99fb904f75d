// What a C++ caller gets: array calls and a model on a small mesh, every result under a name, for the
// Fortran programs of this folder to compare with bit by bit. No judgement here.
#include <cstring>
#include <map>
#include <stdexcept>
#include <string>

#include "support/bonds.hpp"

namespace cleave::test {
namespace {

std::map<std::string, std::vector<double>> reals;
std::map<std::string, std::vector<std::int64_t>> integers;

void ok(std::int32_t status) {
  char text[4096];
  if (status == CLEAVE_OK) return;
  cleave_last_message(text, sizeof text, nullptr);
  throw std::runtime_error(text);
}

// rho, E, nu, then those of Voce's hardening; order of cleave_parameter_get("j2").
std::vector<double> j2_properties() {
  std::int64_t count = 0;
  ok(cleave_parameter_count("j2", &count));
  std::vector<double> out;
  for (std::int64_t k = 0; k < count; ++k) {
    cleave_parameter p{};
    p.size = sizeof p;
    ok(cleave_parameter_get("j2", k, &p));
    const std::string name = p.name;
    double value = p.default_value;
    if (name == "rho") value = 1190;
    if (name == "E") value = 3.24e9;
    if (name == "nu") value = 0.35;
    if (name == "tau_y0") value = 60e6;
    if (name == "tau_inf") value = 90e6;
    if (name == "h0") value = 100e6;
    if (name == "alpha") value = 20;
    out.push_back(value);
  }
  return out;
}

void array_calls(const SimplexMesh& m, std::int32_t kinematics) {
  const std::vector<std::int32_t> alive = random_deletions(m, 0.1, 4);
  const Bonds b(m, alive);
  const std::int64_t n = m.particles(), first = 3, last = n - 5;
  const std::vector<double> u = random_vectors(m, 1e-3, 7), v = random_vectors(m, 4.0, 8);
  const std::size_t size = b.volume.size();
  std::vector<double> x = m.X, J(size, 0.97);
  for (std::size_t k = 0; k < x.size(); ++k) x[k] += u[k];
  reals["X"] = m.X;
  integers["simplices"] = m.simplices;
  integers["alive"].assign(alive.begin(), alive.end());
  integers["row_begin"] = b.row_begin;
  integers["neighbour"] = b.neighbour;
  integers["reverse"] = b.reverse;
  reals["zeta"] = b.zeta;
  reals["volume"] = b.volume;
  reals["u"] = u;
  reals["v"] = v;
  reals["w"] = b.weights();
  reals["J"] = J;

  const cleave_network network = b.network();
  std::vector<double> H(9 * size, 7.0), P(9 * size, 7.0), energy(size, 7.0), f(3 * size, 0.5),
      viscous(3 * size, 0.25);
  ok(cleave_displacement_gradient(&network, first, last, u.data(), H.data()));
  const std::vector<double> properties = j2_properties();
  std::int64_t variables = 0;
  ok(cleave_material_history_count(CLEAVE_MATERIAL_j2, &variables));
  std::vector<double> history(static_cast<std::size_t>(variables) * size, 0.0);
  std::vector<std::int32_t> failed(size, 7);
  ok(cleave_material_stress(CLEAVE_MATERIAL_j2, kinematics,
                            static_cast<std::int64_t>(properties.size()), properties.data(), first,
                            last, H.data(), history.data(), P.data(), energy.data(),
                            failed.data()));
  ok(cleave_bond_force(&network, first, last, P.data(), f.data()));
  ok(cleave_bond_viscosity(&network, first, last, b.weights().data(), x.data(), v.data(), J.data(),
                           5.0, 0.01, viscous.data()));
  reals["properties"] = properties;
  reals["H"] = H;
  reals["P"] = P;
  reals["energy"] = energy;
  reals["history"] = history;
  reals["f"] = f;
  reals["viscous"] = viscous;
  integers["range"] = {first, last};
  integers["failed"].assign(failed.begin(), failed.end());
  double speed = 0, ramp[3] = {0, 0, 0};
  ok(cleave_material_wave_speed(CLEAVE_MATERIAL_j2, kinematics,
                                static_cast<std::int64_t>(properties.size()), properties.data(),
                                &speed));
  ok(cleave_ramp(CLEAVE_RAMP_VELOCITY, 3.0, 2.0, 0.7, ramp, ramp + 1, ramp + 2));
  reals["speed"] = {speed};
  reals["ramp"].assign(ramp, ramp + 3);
}

// Non-symmetric F in Abaqus' order, Cauchy stress as 11 22 33 12 23 31; then the tangent dP/dF.
void material_update() {
  const std::int64_t n = 13;
  Random random(11);
  std::vector<double> F, lengths;
  for (std::int64_t q = 0; q < n; ++q) {
    for (int c = 0; c < 9; ++c) F.push_back((c < 3 ? 1.0 : 0.0) + 0.02 * random());
    lengths.push_back(0.01);
  }
  std::int64_t variables = 0;
  ok(cleave_material_history_count(CLEAVE_MATERIAL_j2, &variables));
  std::vector<double> history(static_cast<std::size_t>(variables * n), 0.0);
  const std::vector<double> properties = j2_properties();
  std::vector<double> stress(6 * n, 7.0), energy(n, 7.0), plastic(n, 7.0), viscous(n, 7.0),
      tangent(81 * n, 7.0);
  std::vector<std::int32_t> failed(n, 7);
  cleave_material_call c;
  ok(cleave_material_call_init(&c));
  c.material = CLEAVE_MATERIAL_j2;
  c.kinematics = CLEAVE_3D;
  c.property_count = static_cast<std::int64_t>(properties.size());
  c.properties = properties.data();
  c.first = 2;
  c.last = n - 1;
  c.dt = 1e-6;
  c.lengths = lengths.data();
  c.deformation = F.data();
  c.deformation_is_F = 1;
  const std::int64_t abaqus[9] = {0, 6, 5, 3, 1, 7, 8, 4, 2};
  std::memcpy(c.deformation_order, abaqus, sizeof abaqus);
  c.history = history.data();
  c.tangent = tangent.data();
  ok(cleave_material_tangent(&c));
  c.stress_measure = CLEAVE_STRESS_CAUCHY;
  const std::int64_t symmetric[9] = {0, 3, 5, 3, 1, 4, 5, 4, 2};
  std::memcpy(c.stress_order, symmetric, sizeof symmetric);
  c.stress = stress.data();
  c.stress_point = 6;
  c.energy = energy.data();
  c.plastic = plastic.data();
  c.viscous = viscous.data();
  c.failed = failed.data();
  ok(cleave_material_update(&c));
  reals["update_F"] = F;
  reals["update_lengths"] = lengths;
  reals["update_tangent"] = tangent;
  reals["update_stress"] = stress;
  reals["update_energy"] = energy;
  reals["update_plastic"] = plastic;
  reals["update_viscous"] = viscous;
  reals["update_history"] = history;
  integers["update_failed"].assign(failed.begin(), failed.end());
}

template <class Struct>
Struct sized() {
  Struct s{};
  s.size = sizeof s;
  return s;
}

std::int64_t patch_body(cleave_model* model, const SimplexMesh& m, std::int32_t kinematics) {
  cleave_body_spec spec;
  ok(cleave_body_spec_init(&spec));
  spec.formulation = CLEAVE_FORMULATION_cbm;
  spec.kinematics = kinematics;
  spec.material = CLEAVE_MATERIAL_svk;
  spec.particles = m.particles();
  spec.X = m.X.data();
  spec.simplex_count = m.simplex_count();
  spec.simplices = m.simplices.data();
  spec.name = "patch";
  std::int64_t body = -1;
  ok(cleave_body_add(model, &spec, &body));
  ok(cleave_body_set_real(model, body, "material", "rho", 1190));
  ok(cleave_body_set_real(model, body, "material", "E", 3.24e9));
  ok(cleave_body_set_real(model, body, "material", "nu", 0.35));
  return body;
}

std::vector<double> real_field(cleave_model* model, const char* name) {
  cleave_field f = sized<cleave_field>();
  ok(cleave_field_find(model, 0, name, &f));
  std::vector<double> out(static_cast<std::size_t>(f.count * f.components));
  ok(cleave_field_get_real(model, 0, name, 0, f.count, out.data()));
  return out;
}

std::vector<std::int64_t> integer_field(cleave_model* model, const char* name) {
  cleave_field f = sized<cleave_field>();
  ok(cleave_field_find(model, 0, name, &f));
  std::vector<std::int64_t> out(static_cast<std::size_t>(f.count * f.components));
  ok(cleave_field_get_integer(model, 0, name, 0, f.count, out.data()));
  return out;
}

// Torn by its velocity, two particles led, one bond cut before, some exempt from fracture.
void model_run(const SimplexMesh& m, std::int32_t kinematics) {
  cleave_model* model = nullptr;
  ok(cleave_model_create(CLEAVE_ABI_VERSION, &model));
  const std::int64_t body = patch_body(model, m, kinematics);
  ok(cleave_body_set_real(model, body, "fracture", "critical_strain", 0.01));
  ok(cleave_body_set_real(model, body, "viscosity", "length", 0.01));
  ok(cleave_body_set_choice(model, body, "viscosity", "form", "central"));
  const std::int64_t particle[2] = {0, 4};
  const std::int32_t direction[2] = {1, 0};
  const std::int32_t motion[2] = {CLEAVE_MOTION_EXACT, CLEAVE_MOTION_ACCELERATION};
  ok(cleave_body_prescribe(model, body, 2, particle, direction, motion));
  const std::int64_t exempt[3] = {1, 2, 3};
  ok(cleave_body_exempt(model, body, 3, exempt));
  ok(cleave_model_set_threads(model, 2));
  ok(cleave_model_setup(model));
  const std::vector<std::int64_t> ends = integer_field(model, "bond_ends");
  ok(cleave_body_precrack(model, body, 1, ends.data() + ends.size() - 2));
  std::vector<double> v = random_vectors(m, 4.0, 5);
  for (std::size_t i = 0; i < v.size() / 3; ++i) v[3 * i] += 1000 * m.X[3 * i];
  ok(cleave_field_put_real(model, body, "velocity", 0, m.particles(), v.data()));
  double step = 0, wave = 0, beta = 0, force[3];
  ok(cleave_model_initialise(model, 0.0));
  ok(cleave_model_stable_step(model, &step));
  ok(cleave_body_wave_speed(model, body, &wave));
  ok(cleave_body_get_real(model, body, "viscosity", "beta", &beta));
  const double dt = 0.4 * step;
  for (int k = 1; k <= 120; ++k) {
    const double t = k * dt;
    const double u[2] = {1e-3 * t, 0.0}, a[2] = {0.0, 10.0};
    ok(cleave_body_motion(model, body, 2, u, nullptr));
    ok(cleave_model_advance(model, dt, t));
    ok(cleave_body_motion(model, body, 2, nullptr, a));
    ok(cleave_model_update(model));
  }
  cleave_energies e = sized<cleave_energies>();
  ok(cleave_energies_get(model, -1, &e));
  cleave_counts c = sized<cleave_counts>();
  ok(cleave_counts_get(model, body, &c));
  cleave_event event = sized<cleave_event>();
  std::int64_t events = 0, steps = 0;
  double time = 0;
  ok(cleave_body_event_count(model, body, &events));
  ok(cleave_body_event_get(model, body, events - 1, &event));
  ok(cleave_body_reaction(model, body, 2, particle, force));
  ok(cleave_model_clock(model, &steps, &time));
  const std::vector<double> points = {0.031, 0.042, 0.027, 5.0, 5.0, 5.0, 0.011, 0.012, 0.013};
  std::vector<std::int64_t> simplex(3);
  std::vector<double> weight(12), sample(9);
  ok(cleave_body_locate(model, body, 3, points.data(), simplex.data(), weight.data()));
  ok(cleave_field_interpolate(model, body, "displacement", 3, simplex.data(), weight.data(),
                              sample.data()));
  reals["run_v"] = v;
  reals["run_numbers"] = {step, wave, beta, time, force[0], force[1], force[2]};
  reals["run_displacement"] = real_field(model, "displacement");
  reals["run_stress"] = real_field(model, "first_piola_kirchhoff_stress");
  reals["run_energies"] = {e.kinetic,  e.kinetic_staggered, e.elastic,  e.plastic,  e.stabilisation,
                           e.fracture, e.viscous,           e.external, e.reaction, e.internal,
                           e.balance,  e.identity,          e.hourglass};
  reals["run_event"] = {event.time,      event.midpoint[0], event.midpoint[1], event.midpoint[2],
                        event.criterion, event.limit,       event.released};
  reals["run_points"] = points;
  reals["run_weight"] = weight;
  reals["run_sample"] = sample;
  integers["run_counts"] = {c.particles, c.bonds,    c.simplices, c.broken,
                            c.inert,     c.isolated, c.inverted};
  integers["run_event"] = {events, event.step, event.first, event.second, steps};
  integers["run_alive"] = integer_field(model, "simplex_alive");
  integers["run_ends"] = ends;
  integers["run_simplex"] = simplex;
  ok(cleave_model_destroy(model));
}

// One corner pushed by Newton's method, then further by relaxation, the others held.
void statics(const SimplexMesh& m, std::int32_t kinematics) {
  cleave_model* model = nullptr;
  ok(cleave_model_create(CLEAVE_ABI_VERSION, &model));
  const std::int64_t body = patch_body(model, m, kinematics);
  std::vector<std::int64_t> particle;
  std::vector<std::int32_t> direction, motion;
  for (std::int64_t i = 0; i < m.particles(); i += 3) {
    for (std::int32_t d = 0; d < m.dimension; ++d) {
      particle.push_back(i);
      direction.push_back(d);
      motion.push_back(CLEAVE_MOTION_EXACT);
    }
  }
  const std::int64_t count = static_cast<std::int64_t>(particle.size());
  ok(cleave_body_prescribe(model, body, count, particle.data(), direction.data(), motion.data()));
  ok(cleave_model_setup(model));
  ok(cleave_model_initialise(model, 0.0));
  std::vector<double> u(particle.size(), 0.0);
  u[0] = 1e-4;
  ok(cleave_body_motion(model, body, count, u.data(), nullptr));
  cleave_static_options options;
  ok(cleave_static_options_init(&options));
  options.tolerance = 1e-7;
  cleave_static_report report = sized<cleave_static_report>();
  ok(cleave_model_solve_static(model, 1.0, &options, &report));
  reals["static_displacement"] = real_field(model, "displacement");
  reals["static_residual"] = {report.residual};
  integers["static_report"] = {report.iterations, report.unknowns, report.broken, report.critical};
  reals["static_fraction"] = {report.fraction};
  options.breaking = CLEAVE_BREAKING_ONE;
  ok(cleave_model_break_static(model, &options, &report));
  integers["static_broken"] = {report.iterations, report.broken, report.critical};
  u[0] = 2e-4;
  ok(cleave_body_motion(model, body, count, u.data(), nullptr));
  cleave_relaxation_report relaxed = sized<cleave_relaxation_report>();
  ok(cleave_model_relax(model, 2.0, nullptr, &relaxed));
  reals["relaxed_displacement"] = real_field(model, "displacement");
  reals["relaxed_residual"] = {relaxed.residual};
  integers["relaxed_report"] = {relaxed.iterations, relaxed.rounds, relaxed.broken,
                                relaxed.unknowns};
  ok(cleave_model_destroy(model));
}

}  // namespace
}  // namespace cleave::test

extern "C" {

// 0 if all results are there.
std::int32_t reference_open(std::int32_t dimension) {
  using namespace cleave::test;
  try {
    reals.clear();
    integers.clear();
    const SimplexMesh m = patch(dimension, dimension == 2 ? 12 : 5, 0.01, 0.15, 91);
    const std::int32_t kinematics = dimension == 2 ? CLEAVE_PLANE_STRAIN : CLEAVE_3D;
    array_calls(m, kinematics);
    material_update();
    model_run(m, kinematics);
    statics(m, kinematics);
    return 0;
  } catch (const std::exception& e) {
    cleave_set_last_message(e.what());
    return 1;
  }
}

// Number of entries of a result; -1 if there is none of this name and kind.
std::int64_t reference_count(const char* name, std::int32_t real) {
  using namespace cleave::test;
  if (real != 0) {
    return reals.count(name) == 0 ? -1 : static_cast<std::int64_t>(reals[name].size());
  }
  return integers.count(name) == 0 ? -1 : static_cast<std::int64_t>(integers[name].size());
}

void reference_reals(const char* name, double* values) {
  const auto& from = cleave::test::reals[name];
  std::memcpy(values, from.data(), from.size() * sizeof(double));
}

void reference_integers(const char* name, std::int64_t* values) {
  const auto& from = cleave::test::integers[name];
  std::memcpy(values, from.data(), from.size() * sizeof(std::int64_t));
}
}
