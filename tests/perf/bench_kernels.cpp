// Speed of the array calls, the laws, the whole step and set-up, in particle-steps per second, beside the
// STREAM triad of the same machine in the same run. Judges nothing: compare two revisions, or two machines;
// the table of the manual is made by tests/perf/run. Serial where no number of threads is given.
#include <benchmark/benchmark.h>

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "cleave/cleave.h"
#include "perf/machine.hpp"
#include "perf/step_case.hpp"
#include "support/bonds.hpp"

namespace {

using cleave::perf::check;
using cleave::test::Bonds;
using cleave::test::SimplexMesh;

constexpr double kSpacing = 1e-3;
const std::vector<double> kPmma = {1190, 3.24e9, 0.35};

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

// A law of the materials table on its own: PMMA with round numbers for what else it asks.
double property(const std::string& name, double fallback) {
  static const std::map<std::string, double> known = {
      {"rho", 1190},     {"E", 3.24e9}, {"nu", 0.35},    {"tau_y0", 60e6}, {"tau_inf", 90e6},
      {"h0", 100e6},     {"alpha", 20}, {"eps_0", 0.01}, {"n", 0.2},       {"strain_1", 0.1},
      {"stress_1", 8e7}, {"A", 60e6},   {"B", 100e6},    {"C", 0.02},      {"eps_dot_0", 1},
      {"T_melt", 450},   {"c_p", 1500}, {"D1", 0.5},     {"c0", 1739},     {"s", 1.5},
      {"Gamma0", 1},     {"G", 1.2e9}};
  const auto found = known.find(name);
  return found == known.end() ? fallback : found->second;
}

void law(benchmark::State& state, const cleave_table_entry& entry, bool large) {
  Problem& p = problem(3);
  std::int64_t count = 0, variables = 0;
  check(cleave_parameter_count(entry.name, &count));
  std::vector<double> properties;
  for (std::int64_t k = 0; k < count; ++k) {
    cleave_parameter q{};
    q.size = sizeof q;
    check(cleave_parameter_get(entry.name, k, &q));
    properties.push_back(property(q.name, q.default_value));
  }
  check(cleave_material_history_count(entry.value, &variables));
  // Strains of about 1e-4, or of some percent, each time from the virgin state.
  std::vector<double> h = p.H;
  for (double& component : h) component *= large ? 5.0 : 1e-2;
  const std::vector<double> virgin(static_cast<std::size_t>(variables * p.n), 0.0);
  std::vector<double> history = virgin;
  for (auto _ : state) {
    if (large && variables > 0) {
      state.PauseTiming();
      history = virgin;
      state.ResumeTiming();
    }
    check(cleave_material_stress(entry.value, CLEAVE_3D, count, properties.data(), 0, p.n, h.data(),
                                 history.data(), p.stress.P.data(), nullptr, nullptr));
    benchmark::ClobberMemory();
  }
  report(state, p.n, 0);
  state.counters["per_point"] =
      Counter(static_cast<double>(state.iterations()) * static_cast<double>(p.n),
              Counter::kIsRate | Counter::kInvert);
}

// All laws that there are, those that remember also far beyond their elastic range.
int register_laws() {
  std::int64_t laws = 0;
  check(cleave_table_count(CLEAVE_TABLE_MATERIAL, &laws));
  for (std::int64_t k = 0; k < laws; ++k) {
    cleave_table_entry entry{};
    entry.size = sizeof entry;
    check(cleave_table_get(CLEAVE_TABLE_MATERIAL, k, &entry));
    std::int64_t variables = 0;
    check(cleave_material_history_count(entry.value, &variables));
    for (const bool large : {false, true}) {
      if (large && variables == 0) continue;
      const std::string name = std::string("law/") + entry.name + (large ? "/large" : "");
      benchmark::RegisterBenchmark(name.c_str(), [entry, large](benchmark::State& state) {
        law(state, entry, large);
      })->Unit(benchmark::kMillisecond);
    }
  }
  return 0;
}
const int kLaws = register_laws();

// The step, and making a model of it; the cases of step_case.hpp.
const char* const kCases[] = {"svk",          "svk+search", "svk+search+viscosity",
                              "svk+breaking", "j2",         "j2+plastic+search+viscosity"};
const cleave::perf::StepMesh& step_mesh(std::int64_t dimension) {
  static const cleave::perf::StepMesh plane(mesh(2)), space(mesh(3));
  return dimension == 2 ? plane : space;
}

void whole_step(benchmark::State& state) {
  const cleave::perf::StepCase wanted(kCases[state.range(1)]);
  const auto threads = static_cast<int>(state.range(2));
  cleave::perf::StepModel model(wanted, step_mesh(state.range(0)), threads);
  for (auto _ : state) model.step();
  const cleave_counts c = model.counts();
  state.SetLabel(wanted.name);
  report(state, c.particles, 2 * c.bonds);
  state.counters["bytes/particle"] =
      static_cast<double>(model.bytes()) / static_cast<double>(c.particles);
}

void model_set_up(benchmark::State& state) {
  const cleave::perf::StepCase wanted("j2+plastic+search");
  std::int64_t particles = 0;
  for (auto _ : state) {
    const cleave::perf::StepModel model(wanted, step_mesh(state.range(0)),
                                        static_cast<int>(state.range(1)));
    particles = model.counts().particles;
  }
  report(state, particles, 0);
}

void stream_triad(benchmark::State& state) {
  cleave::perf::Triad triad(std::size_t{192} << 20, static_cast<int>(state.range(0)));
  for (auto _ : state) triad.pass();
  state.SetBytesProcessed(
      static_cast<std::int64_t>(static_cast<double>(state.iterations()) * triad.bytes()));
}

BENCHMARK(stream_triad)
    ->ArgName("threads")
    ->Arg(1)
    ->Arg(2)
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime();
BENCHMARK(displacement_gradient)->Arg(2)->Arg(3)->Unit(benchmark::kMillisecond);
BENCHMARK(bond_force)->Arg(2)->Arg(3)->Unit(benchmark::kMillisecond);
BENCHMARK(bond_viscosity)->Arg(2)->Arg(3)->Unit(benchmark::kMillisecond);
BENCHMARK(cbm_bonds)->Arg(2)->Arg(3)->Unit(benchmark::kMillisecond);
BENCHMARK(whole_step)
    ->ArgNames({"dimension", "case", "threads"})
    ->ArgsProduct({{2, 3}, benchmark::CreateDenseRange(0, 5, 1), {1, 2}})
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime();
BENCHMARK(model_set_up)
    ->ArgNames({"dimension", "threads"})
    ->ArgsProduct({{2, 3}, {1, 2}})
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime();

}  // namespace
