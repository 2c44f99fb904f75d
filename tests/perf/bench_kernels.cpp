// Speed of the array calls and of the whole step, in particle-steps per second, beside the STREAM
// triad of the same machine in the same run. Judges nothing: compare two revisions, or two machines.
// Serial but for the whole step, whose second argument is the number of threads.
#include <benchmark/benchmark.h>

#include <cstdint>
#include <stdexcept>
#include <string>
#include <vector>

#include "cleave/cleave.h"
#include "support/bonds.hpp"

namespace {

using cleave::test::Bonds;
using cleave::test::SimplexMesh;

constexpr double kSpacing = 1e-3;
const std::vector<double> kPmma = {1190, 3.24e9, 0.35};

void check(std::int32_t status) {
  if (status == CLEAVE_OK) return;
  char message[4096];
  cleave_last_message(message, sizeof message, nullptr);
  throw std::runtime_error(message);
}

// The two problems: 14 400 particles in the plane (the branching plate), 97 336 in space.
SimplexMesh mesh(std::int64_t dimension) {
  return cleave::test::patch(static_cast<int>(dimension), dimension == 2 ? 119 : 45, kSpacing, 0.2,
                             1);
}
std::int32_t kinematics(std::int64_t dimension) {
  return dimension == 2 ? CLEAVE_PLANE_STRESS : CLEAVE_3D;
}

struct Problem {
  explicit Problem(int dimension)
      : bonds(mesh(dimension)),
        n(bonds.mesh.particles()),
        u(cleave::test::random_vectors(bonds.mesh, 0.01 * kSpacing, 2)),
        v(cleave::test::random_vectors(bonds.mesh, 1.0, 3)),
        x(u),
        H(bonds.gradient(u)),
        stress(cleave::test::stress(CLEAVE_MATERIAL_svk, kinematics(dimension), kPmma, H)),
        f(u.size(), 0.0),
        w(bonds.weights()),
        J(bonds.volume.size(), 1.0) {
    for (std::size_t k = 0; k < x.size(); ++k) x[k] += bonds.mesh.X[k];
  }
  Bonds bonds;
  std::int64_t n;
  std::vector<double> u, v, x, H;
  cleave::test::Stress stress;
  std::vector<double> f, w, J;
};

// Made once a dimension: set-up takes longer than a measurement.
Problem& problem(std::int64_t dimension) {
  static Problem plane(2), space(3);
  return dimension == 2 ? plane : space;
}

using benchmark::Counter;

void report(benchmark::State& state, std::int64_t particles, std::int64_t half_bonds) {
  const double rounds = static_cast<double>(state.iterations());
  state.counters["particles"] = static_cast<double>(particles);
  state.counters["particle_steps/s"] =
      Counter(rounds * static_cast<double>(particles), Counter::kIsRate);
  if (half_bonds > 0) {
    state.counters["bond_updates/s"] =
        Counter(rounds * 0.5 * static_cast<double>(half_bonds), Counter::kIsRate);
  }
}

void displacement_gradient(benchmark::State& state) {
  Problem& p = problem(state.range(0));
  const Bonds& b = p.bonds;
  const cleave_network net = b.network();
  for (auto _ : state) {
    check(cleave_displacement_gradient(&net, 0, p.n, p.u.data(), p.H.data()));
    benchmark::ClobberMemory();
  }
  report(state, p.n, b.half_bonds());
}

void bond_force(benchmark::State& state) {
  Problem& p = problem(state.range(0));
  const Bonds& b = p.bonds;
  const cleave_network net = b.network();
  for (auto _ : state) {
    check(cleave_bond_force(&net, 0, p.n, p.stress.P.data(), p.f.data()));
    benchmark::ClobberMemory();
  }
  report(state, p.n, b.half_bonds());
}

void bond_viscosity(benchmark::State& state) {
  Problem& p = problem(state.range(0));
  const Bonds& b = p.bonds;
  const cleave_network net = b.network();
  for (auto _ : state) {
    check(cleave_bond_viscosity(&net, 0, p.n, p.w.data(), p.x.data(), p.v.data(), p.J.data(), 1.0,
                                kSpacing, p.f.data()));
    benchmark::ClobberMemory();
  }
  report(state, p.n, b.half_bonds());
}

void svk_stress(benchmark::State& state) {
  Problem& p = problem(state.range(0));
  for (auto _ : state) {
    check(cleave_material_stress(CLEAVE_MATERIAL_svk, kinematics(state.range(0)), 3, kPmma.data(),
                                 0, p.n, p.H.data(), nullptr, p.stress.P.data(),
                                 p.stress.energy.data(), nullptr));
    benchmark::ClobberMemory();
  }
  report(state, p.n, 0);
  state.counters["per_stress_update"] =
      Counter(static_cast<double>(state.iterations()) * static_cast<double>(p.n),
              Counter::kIsRate | Counter::kInvert);
}

// Bond vectors and volumes of the whole mesh: the cost of set-up and of a restart.
void cbm_bonds(benchmark::State& state) {
  const Bonds& b = problem(state.range(0)).bonds;
  const cleave_network net = b.network();
  for (auto _ : state) {
    check(cleave_cbm_bonds(&net, b.mesh.X.data(), b.mesh.simplex_count(), b.mesh.simplices.data(),
                           nullptr));
    benchmark::ClobberMemory();
  }
  report(state, b.mesh.particles(), b.half_bonds());
}

// Step of a model with fracture (no bond breaks) and viscosity.
class Run {
 public:
  Run(std::int64_t dimension, std::int32_t threads) {
    const SimplexMesh m = mesh(dimension);
    check(cleave_model_create(CLEAVE_ABI_VERSION, &model_));
    cleave_body_spec spec;
    check(cleave_body_spec_init(&spec));
    spec.kinematics = kinematics(dimension);
    spec.particles = m.particles();
    spec.X = m.X.data();
    spec.simplex_count = m.simplex_count();
    spec.simplices = m.simplices.data();
    std::int64_t body = 0;
    check(cleave_body_add(model_, &spec, &body));
    const char* names[] = {"rho", "E", "nu"};
    for (std::size_t k = 0; k < 3; ++k)
      check(cleave_body_set_real(model_, 0, "material", names[k], kPmma[k]));
    check(cleave_body_set_real(model_, 0, "fracture", "critical_strain", 0.5));
    check(cleave_body_set_real(model_, 0, "viscosity", "beta", 0.5));
    check(cleave_body_set_real(model_, 0, "viscosity", "length", kSpacing));
    check(cleave_model_set_threads(model_, threads));
    check(cleave_model_setup(model_));
    const auto v = cleave::test::random_vectors(m, 1.0, 4);
    check(cleave_field_put_real(model_, 0, "velocity", 0, m.particles(), v.data()));
    check(cleave_model_initialise(model_, 0));
    check(cleave_model_stable_step(model_, &dt_));
    dt_ *= 0.5;
  }
  ~Run() { cleave_model_destroy(model_); }
  Run(const Run&) = delete;
  Run& operator=(const Run&) = delete;

  void step() {
    ++n_;
    check(cleave_model_advance(model_, dt_, static_cast<double>(n_) * dt_));
    check(cleave_model_update(model_));
  }
  cleave_counts counts() const {
    cleave_counts c{};
    c.size = sizeof c;
    check(cleave_counts_get(model_, 0, &c));
    return c;
  }
  double bytes() const {
    std::int64_t b = 0;
    check(cleave_model_memory(model_, &b));
    return static_cast<double>(b);
  }

 private:
  cleave_model* model_ = nullptr;
  double dt_ = 0;
  std::int64_t n_ = 0;
};

void whole_step(benchmark::State& state) {
  Run run(state.range(0), static_cast<std::int32_t>(state.range(1)));
  for (auto _ : state) run.step();
  const cleave_counts c = run.counts();
  report(state, c.particles, 2 * c.bonds);
  state.counters["bytes/particle"] = run.bytes() / static_cast<double>(c.particles);
}

// a = b + s c on arrays far beyond the caches; counts the three arrays once, as STREAM does.
void stream_triad(benchmark::State& state) {
  const std::size_t n = std::size_t{8} << 20;  // three times 64 MiB
  std::vector<double> a(n, 1.0), b(n, 2.0), c(n, 3.0);
  for (auto _ : state) {
    double* out = a.data();
    const double *left = b.data(), *right = c.data();
    for (std::size_t k = 0; k < n; ++k) out[k] = left[k] + 3.0 * right[k];
    benchmark::ClobberMemory();
  }
  state.SetBytesProcessed(static_cast<std::int64_t>(state.iterations() * 3 * n * sizeof(double)));
}

BENCHMARK(stream_triad)->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK(displacement_gradient)->Arg(2)->Arg(3)->Unit(benchmark::kMillisecond);
BENCHMARK(bond_force)->Arg(2)->Arg(3)->Unit(benchmark::kMillisecond);
BENCHMARK(bond_viscosity)->Arg(2)->Arg(3)->Unit(benchmark::kMillisecond);
BENCHMARK(svk_stress)->Arg(2)->Arg(3)->Unit(benchmark::kMillisecond);
BENCHMARK(cbm_bonds)->Arg(2)->Arg(3)->Unit(benchmark::kMillisecond);
BENCHMARK(whole_step)->ArgsProduct({{2, 3}, {1, 2}})->Unit(benchmark::kMillisecond)->UseRealTime();

}  // namespace
