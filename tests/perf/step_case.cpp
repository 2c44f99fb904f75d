#include "perf/step_case.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <sstream>
#include <stdexcept>
#include <utility>

#include "io/mesh.hpp"
#include "perf/resident.hpp"
#include "support/bonds.hpp"

namespace cleave::perf {

namespace {

// The steel of the necking bar.
constexpr double kDensity = 7800, kYoungs = 206.9e9, kPoisson = 0.29;
constexpr double kYield = 450e6, kSaturation = 715e6, kLinear = 129.24e6, kAlpha = 16.93;
constexpr double kSpacing = 1e-3;

// Far below the stable step, so that a motion goes on for some thousand steps as it was begun: waves
// from the surface pass a spacing in about fifty of them. The cost of a step does not depend on it.
constexpr double kShareOfStableStep = 0.02;
constexpr double kJostle = 1e-4;  // random velocity over the wave speed
// Plastic: isochoric stretch at the start, and a step. A yield stress far below the steel's keeps the
// elastic strains below what a step adds, so that no wave from the surface stops the flow.
constexpr double kPlasticStretch = 1e-2, kPlasticRate = 5e-8, kSoftening = 1e-4;
// Search: angle of a step, and how far the tightest bonds are from breaking. A block of 2048 particles is
// 13 spacings across, in the plane 45, so that its ends pass each other by 2e-4 spacings or more in a step; the
// straight paths of n steps stretch a bond by (n spin)^2/2: it breaks after 1500 steps, in the plane, where
// steps are fast, after 4500.
constexpr double kSpin = 1.5e-5, kSpinInPlane = 5e-6, kTight = 2.5e-4;
constexpr double kFar = 0.5;
constexpr double kCriticalStrain = 0.01, kFrontSpeed = 0.25;  // breaking; spacings a step

std::size_t at(std::int64_t i) { return static_cast<std::size_t>(i); }

void number_at_random(test::SimplexMesh& mesh) {
  test::Random random(2);
  std::vector<std::int64_t> place(at(mesh.particles()));
  for (std::size_t i = 0; i < place.size(); ++i) {
    place[i] = static_cast<std::int64_t>(i);
    const auto other = static_cast<std::size_t>(0.5 * (1 + random()) * static_cast<double>(i + 1));
    std::swap(place[i], place[std::min(other, i)]);
  }
  const std::vector<double> X = mesh.X;
  for (std::size_t i = 0; i < place.size(); ++i)
    for (std::size_t k = 0; k < 3; ++k) mesh.X[3 * at(place[i]) + k] = X[3 * i + k];
  for (std::int64_t& corner : mesh.simplices) corner = place[at(corner)];
}

// Stretch in x by 1 + e that keeps the volume: the factor of direction k, less one.
double isochoric(double e, std::size_t k, int dimension) {
  if (k == 0) return e;
  if (static_cast<int>(k) >= dimension) return 0;
  return std::pow(1 + e, -1.0 / (dimension - 1)) - 1;
}

}  // namespace

void check(std::int32_t status) {
  if (status == CLEAVE_OK) return;
  char message[4096];
  cleave_last_message(message, sizeof message, nullptr);
  throw std::runtime_error(message);
}

StepCase::StepCase(const std::string& words) : name(words) {
  std::istringstream list(words);
  std::getline(list, law, '+');
  for (std::string word; std::getline(list, word, '+');) {
    if (word == "plastic") {
      plastic = true;
    } else if (word == "fracture") {
      fracture = true;
    } else if (word == "search") {
      search = true;
    } else if (word == "breaking") {
      breaking = true;
    } else if (word == "viscosity") {
      viscosity = true;
    } else {
      throw std::runtime_error("case '" + words + "': unknown word '" + word +
                               "'; known: plastic, fracture, search, breaking, viscosity");
    }
  }
  if (fracture + search + breaking > 1)
    throw std::runtime_error("case '" + words + "': give one of fracture, search, breaking");
  if (plastic && breaking)
    throw std::runtime_error("case '" + words + "': plastic and breaking are different motions");
}

StepMesh::StepMesh(test::SimplexMesh m) : mesh(std::move(m)) {
  double box = 1;
  for (std::size_t k = 0; k < 3; ++k) {
    low[k] = std::numeric_limits<double>::infinity();
    high[k] = -low[k];
    for (std::size_t i = k; i < mesh.X.size(); i += 3) {
      low[k] = std::fmin(low[k], mesh.X[i]);
      high[k] = std::fmax(high[k], mesh.X[i]);
    }
    if (k < at(mesh.dimension)) box *= high[k] - low[k];
  }
  spacing = std::pow(box / static_cast<double>(mesh.particles()), 1.0 / mesh.dimension);
}

StepMesh lattice(int dimension, std::int64_t particles, bool shuffled) {
  const double side = std::pow(static_cast<double>(particles), 1.0 / dimension);
  const int cells = std::max(2, static_cast<int>(std::lround(side)) - 1);
  test::SimplexMesh mesh = test::patch(dimension, cells, kSpacing, 0.2, 1);
  if (shuffled) number_at_random(mesh);
  return StepMesh(std::move(mesh));
}

// Points that no simplex uses are left out.
StepMesh from_gmsh(const std::string& path) {
  const io::Mesh file = io::read_mesh(path);
  const io::CellBlock& cells = file.tetrahedra.count() > 0 ? file.tetrahedra : file.triangles;
  test::SimplexMesh mesh;
  mesh.dimension = static_cast<int>(cells.kind) - 1;
  std::vector<std::int64_t> place(at(file.point_count()), -1);
  for (const std::int64_t node : cells.nodes) place[at(node)] = 0;
  for (std::size_t i = 0; i < place.size(); ++i) {
    if (place[i] < 0) continue;
    place[i] = mesh.particles();
    mesh.X.insert(mesh.X.end(), &file.points[3 * i], &file.points[3 * i] + 3);
  }
  for (const std::int64_t node : cells.nodes) mesh.simplices.push_back(place[at(node)]);
  return StepMesh(std::move(mesh));
}

StepModel::StepModel(const StepCase& wanted, const StepMesh& mesh, int threads) {
  std::vector<double> u(mesh.mesh.X.size(), 0.0), v(mesh.mesh.X.size(), 0.0);
  return_freed_memory();
  reset_peak();
  const std::int64_t before = resident_bytes();
  const auto begun = std::chrono::steady_clock::now();
  try {
    add_body(wanted, mesh);
    set_threads(threads);
    check(cleave_model_setup(model_));
    put_motion(wanted, mesh, u, v);
    check(cleave_model_initialise(model_, 0));
    step();
  } catch (...) {
    cleave_model_destroy(model_);
    throw;
  }
  set_up_.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begun).count();
  set_up_.peak = peak_bytes() - before;
  set_up_.resident = resident_bytes() - before;
}

void StepModel::add_body(const StepCase& wanted, const StepMesh& mesh) {
  const test::SimplexMesh& m = mesh.mesh;
  particles_ = m.particles();
  check(cleave_model_create(CLEAVE_ABI_VERSION, &model_));
  cleave_body_spec spec;
  check(cleave_body_spec_init(&spec));
  spec.kinematics = m.dimension == 3 ? CLEAVE_3D : CLEAVE_PLANE_STRAIN;
  check(cleave_table_find(CLEAVE_TABLE_MATERIAL, wanted.law.c_str(), &spec.material));
  spec.particles = particles_;
  spec.X = m.X.data();
  spec.simplex_count = m.simplex_count();
  spec.simplices = m.simplices.data();
  std::int64_t body = 0;
  check(cleave_body_add(model_, &spec, &body));
  choose_material(wanted);
  choose_fracture(wanted, mesh);
  if (wanted.viscosity) check(cleave_body_set_real(model_, 0, "viscosity", "length", mesh.spacing));
}

void StepModel::choose_material(const StepCase& wanted) {
  const auto set = [&](const char* name, double value) {
    check(cleave_body_set_real(model_, 0, "material", name, value));
  };
  set("rho", kDensity);
  set("E", kYoungs);
  set("nu", kPoisson);
  const double scale = wanted.plastic ? kSoftening : 1;
  if (wanted.law == "j2") {
    set("tau_y0", scale * kYield);
    set("tau_inf", scale * kSaturation);
    set("h0", scale * kLinear);
    set("alpha", kAlpha);
  }
  if (wanted.law == "j2_table") {  // the same curve in three pieces
    set("tau_y0", scale * kYield);
    const double strains[] = {0.02, 0.06, 0.2};
    for (int k = 0; k < 3; ++k) {
      const std::string place = std::to_string(k + 1);
      const double e = strains[k];
      set(("strain_" + place).c_str(), e);
      set(("stress_" + place).c_str(),
          scale * (kYield + kLinear * e + (kSaturation - kYield) * (1 - std::exp(-kAlpha * e))));
    }
  }
}

// Breaking: only bonds with an end in the slab across the middle of the last direction may break.
void StepModel::choose_fracture(const StepCase& wanted, const StepMesh& mesh) {
  if (!wanted.fracture && !wanted.search && !wanted.breaking) return;
  const double critical = wanted.breaking ? kCriticalStrain
                          : wanted.search ? kTight + (wanted.plastic ? kPlasticStretch : 0.0)
                                          : kFar;
  check(cleave_body_set_real(model_, 0, "fracture", "critical_strain", critical));
  if (!wanted.breaking) return;
  const std::size_t across = at(mesh.mesh.dimension - 1);
  const double middle = 0.5 * (mesh.low[across] + mesh.high[across]);
  std::vector<std::int64_t> exempt;
  for (std::int64_t i = 0; i < particles_; ++i) {
    if (std::fabs(mesh.mesh.X[at(3 * i) + across] - middle) > 0.6 * mesh.spacing)
      exempt.push_back(i);
  }
  check(cleave_body_exempt(model_, 0, static_cast<std::int64_t>(exempt.size()), exempt.data()));
}

// Stretch across the slab that falls off along the body from the critical one to none, and grows
// everywhere alike: the front is where it is critical.
void StepModel::open_slab(const StepMesh& mesh, std::vector<double>& u,
                          std::vector<double>& v) const {
  const std::vector<double>& X = mesh.mesh.X;
  const std::size_t across = at(mesh.mesh.dimension - 1), along = across - 1;
  const double length = mesh.high[along] - mesh.low[along];
  const double rate = kCriticalStrain * kFrontSpeed * mesh.spacing / length / dt_;
  for (std::size_t i = 0; i < v.size(); i += 3) {
    const double height = X[i + across] - 0.5 * (mesh.low[across] + mesh.high[across]);
    u[i + across] = kCriticalStrain * (mesh.high[along] - X[i + along]) / length * height;
    v[i + across] = rate * height;
  }
}

// Displacement and velocity at the start, and the step that goes with them.
void StepModel::put_motion(const StepCase& wanted, const StepMesh& mesh, std::vector<double>& u,
                           std::vector<double>& v) {
  const test::SimplexMesh& m = mesh.mesh;
  double stable = 0, speed = 0;
  check(cleave_model_stable_step(model_, &stable));
  check(cleave_body_wave_speed(model_, 0, &speed));
  dt_ = kShareOfStableStep * stable;
  if (wanted.breaking) {
    open_slab(mesh, u, v);
  } else if (!wanted.plastic && !wanted.search) {
    v = test::random_vectors(m, kJostle * speed, 3);
  }
  const double spin = m.dimension == 2 ? kSpinInPlane : kSpin;
  for (std::size_t i = 0; i < v.size(); i += 3) {
    for (std::size_t k = 0; k < 3 && wanted.plastic; ++k) {
      const double still = isochoric(kPlasticStretch, k, m.dimension) * m.X[i + k];
      const double share = k == 0                              ? 1.0
                           : static_cast<int>(k) < m.dimension ? -1.0 / (m.dimension - 1)
                                                               : 0.0;
      u[i + k] = still;
      v[i + k] = kPlasticRate / dt_ * share * (m.X[i + k] + still);
    }
    if (!wanted.search) continue;
    const double x = m.X[i] + u[i], y = m.X[i + 1] + u[i + 1];
    v[i] -= spin / dt_ * y;
    v[i + 1] += spin / dt_ * x;
  }
  check(cleave_field_put_real(model_, 0, "displacement", 0, particles_, u.data()));
  check(cleave_field_put_real(model_, 0, "velocity", 0, particles_, v.data()));
  cleave_field strain{};
  strain.size = sizeof strain;
  has_plastic_strain_ =
      cleave_field_find(model_, 0, "equivalent_plastic_strain", &strain) == CLEAVE_OK;
}

void StepModel::step() {
  ++step_;
  check(cleave_model_advance(model_, dt_, static_cast<double>(step_) * dt_));
  check(cleave_model_update(model_));
}

cleave_counts StepModel::counts() const {
  cleave_counts c{};
  c.size = sizeof c;
  check(cleave_counts_get(model_, 0, &c));
  return c;
}

std::int64_t StepModel::bytes() const {
  std::int64_t b = 0;
  check(cleave_model_memory(model_, &b));
  return b;
}

std::int64_t StepModel::take_broken() {
  std::int64_t count = 0;
  check(cleave_body_event_count(model_, 0, &count));
  check(cleave_body_clear_events(model_, 0));
  return count;
}

std::vector<double> StepModel::plastic_strain() const {
  std::vector<double> e(at(particles_));
  check(cleave_field_get_real(model_, 0, "equivalent_plastic_strain", 0, particles_, e.data()));
  return e;
}

double StepModel::flowing() {
  if (!has_plastic_strain_) {
    step();
    return 0;
  }
  const std::vector<double> before = plastic_strain();
  step();
  const std::vector<double> after = plastic_strain();
  std::int64_t grown = 0;
  for (std::size_t i = 0; i < before.size(); ++i) grown += after[i] > before[i] ? 1 : 0;
  return static_cast<double>(grown) / static_cast<double>(particles_);
}

}  // namespace cleave::perf
