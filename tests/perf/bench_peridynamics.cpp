// Speed of a step of the peridynamic formulations on lattices: the plate of Kalthoff and Winkler, 88 x 177 x 8
// points with all three-neighbour interactions, and a small one. Processor time of one thread unless said;
// judges nothing.
//   build/release/bin/bench_peridynamics --benchmark_filter=Kalthoff --benchmark_repetitions=3
#include <benchmark/benchmark.h>

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "cleave/cleave.h"
#include "perf/step_case.hpp"

namespace {

using cleave::perf::check;

class Plate {
 public:
  Plate(std::int32_t formulation, std::array<int, 3> cells, const char* stencil, int threads,
        const char* weights = "paper") {
    check(cleave_model_create(CLEAVE_ABI_VERSION, &model_));
    check(cleave_model_set_threads(model_, threads));
    constexpr double kSpacing = 1.125;
    std::vector<double> X;
    for (int z = 0; z < cells[2]; ++z)
      for (int y = 0; y < cells[1]; ++y)
        for (int x = 0; x < cells[0]; ++x)
          for (const int at : {x, y, z}) X.push_back((at + 0.5) * kSpacing);
    cleave_body_spec spec;
    check(cleave_body_spec_init(&spec));
    spec.formulation = formulation;
    spec.kinematics = CLEAVE_3D;
    spec.material = CLEAVE_MATERIAL_linear_elastic;
    spec.particles = static_cast<std::int64_t>(X.size()) / 3;
    spec.X = X.data();
    spec.name = "plate";
    std::int64_t body = 0;
    check(cleave_body_add(model_, &spec, &body));
    const std::vector<double> volume(X.size() / 3, kSpacing * kSpacing * kSpacing);
    check(cleave_body_volumes(model_, 0, spec.particles, volume.data()));
    check(cleave_body_set_real(model_, 0, "material", "E", 190000));
    check(cleave_body_set_real(model_, 0, "material", "rho", 8e-9));
    check(cleave_body_set_real(model_, 0, "material", "nu", 0.3));
    check(cleave_body_set_choice(model_, 0, "peridynamics", "modulus", "shear"));
    check(cleave_body_set_real(model_, 0, "peridynamics", "horizon", 3.015 * kSpacing));
    check(cleave_body_set_choice(model_, 0, "peridynamics", "stencil", stencil));
    if (formulation == CLEAVE_FORMULATION_cpd)
      check(cleave_body_set_choice(model_, 0, "cpd", "weights", weights));
    check(cleave_body_set_real(model_, 0, "fracture", "critical_strain", 0.1));
    check(cleave_model_setup(model_));
    std::vector<double> v(X.size());
    for (std::size_t c = 0; c < v.size(); ++c)
      v[c] = 1000 * static_cast<double>((c * 2654435761u) % 1000) / 1000;
    check(cleave_field_put_real(model_, 0, "velocity", 0, spec.particles, v.data()));
    check(cleave_model_initialise(model_, 0));
    check(cleave_model_stable_step(model_, &dt_));
    double interactions[3];
    check(cleave_field_get_real(model_, 0, "interactions", 0, 1, interactions));
    points_ = static_cast<double>(spec.particles);
    triples_ = interactions[2];
  }
  ~Plate() { cleave_model_destroy(model_); }
  Plate(const Plate&) = delete;
  Plate& operator=(const Plate&) = delete;
  void step() {
    ++steps_;
    check(cleave_model_advance(model_, 0.5 * dt_, 0.5 * dt_ * steps_));
    check(cleave_model_update(model_));
  }
  void stress() {
    stress_.resize(9 * static_cast<std::size_t>(points_));
    check(cleave_field_get_real(model_, 0, "cauchy_stress", 0, static_cast<std::int64_t>(points_),
                                stress_.data()));
  }
  double points() const { return points_; }
  double triples() const { return triples_; }

 private:
  cleave_model* model_ = nullptr;
  double dt_ = 0, points_ = 0, triples_ = 0;
  int steps_ = 0;
  std::vector<double> stress_;
};

void stress(benchmark::State& state, const char* stencil) {
  Plate plate(CLEAVE_FORMULATION_cpd, {16, 16, 8}, stencil, 1);
  for (auto _ : state) {
    state.PauseTiming();
    plate.step();
    state.ResumeTiming();
    plate.stress();
  }
  state.counters["us/point"] =
      benchmark::Counter(plate.points() * static_cast<double>(state.iterations()) / 1e6,
                         benchmark::Counter::kIsRate | benchmark::Counter::kInvert);
}

void run(benchmark::State& state, std::int32_t formulation, std::array<int, 3> cells,
         const char* stencil, int threads = 1, const char* weights = "paper") {
  Plate plate(formulation, cells, stencil, threads, weights);
  plate.step();
  for (auto _ : state) plate.step();
  const auto rate = [&](double amount) {
    return benchmark::Counter(amount * static_cast<double>(state.iterations()),
                              benchmark::Counter::kIsRate);
  };
  state.counters["points/s"] = rate(plate.points());
  state.counters["ordered triples/s"] = rate(plate.triples());
}

constexpr std::array<int, 3> kSmall = {16, 16, 8}, kKalthoff = {88, 177, 8};

#define PLATE(name, formulation, cells, stencil)                                 \
  BENCHMARK_CAPTURE(run, name, CLEAVE_FORMULATION_##formulation, cells, stencil) \
      ->Unit(benchmark::kMillisecond)
PLATE(small_bond_pd, bond_pd, kSmall, "lattice");
PLATE(small_lps, lps, kSmall, "lattice");
PLATE(small_cpd, cpd, kSmall, "lattice");
BENCHMARK_CAPTURE(run, small_cpd_conservative, CLEAVE_FORMULATION_cpd, kSmall, "lattice", 1,
                  "conservative")
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(run, small_cpd_conservative_cloud, CLEAVE_FORMULATION_cpd, kSmall, "never", 1,
                  "conservative")
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(stress, small_lattice, "lattice")->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(stress, small_cloud, "never")->Unit(benchmark::kMillisecond);
PLATE(small_cpd_cloud, cpd, kSmall, "never");
PLATE(Kalthoff_bond_pd, bond_pd, kKalthoff, "lattice");
PLATE(Kalthoff_bond_pd_cloud, bond_pd, kKalthoff, "never");
PLATE(Kalthoff_lps, lps, kKalthoff, "lattice");
PLATE(Kalthoff_cpd, cpd, kKalthoff, "lattice");
PLATE(Kalthoff_cpd_cloud, cpd, kKalthoff, "never");
BENCHMARK_CAPTURE(run, Kalthoff_cpd_two_threads, CLEAVE_FORMULATION_cpd, kKalthoff, "lattice", 2)
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime();

}  // namespace
