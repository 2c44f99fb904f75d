// Speed of the J2 return mapping in ns per point, elastic and plastic: our batches, the same source one
// point at a time, and beside them, in the same run, the algorithm as it stands in textbooks with an
// iterative eigen-solver of Eigen and with LAPACK's dsyev where these libraries were found. The batches
// use the instruction set in the label: CLEAVE_INSTRUCTION_SET=baseline|avx2|avx512. Judges nothing. Serial.
#include <benchmark/benchmark.h>

#include <cmath>
#include <cstdint>
#include <random>
#include <stdexcept>
#include <vector>

#include "cleave/cleave.h"
#include "core/instruction_set.hpp"
#include "material/stress.hpp"

#if defined(CLEAVE_BENCH_EIGEN)
#include <Eigen/Eigenvalues>
#endif
#if defined(CLEAVE_BENCH_LAPACK)
extern "C" void dsyev_(const char* jobz, const char* uplo, const int* n, double* a, const int* lda,
                       double* w, double* work, const int* lwork, int* info);
#endif

namespace {

// The steel of the necking bar [MPa].
constexpr double kYoungs = 206.9e3, kPoisson = 0.29;
constexpr double kYield = 450, kSaturation = 715, kLinear = 129.24, kAlpha = 16.93;
const std::vector<double> kSteel = {7.8e-9,      kYoungs, kPoisson, kYield,
                                    kSaturation, kLinear, kAlpha};
constexpr std::int64_t kPoints = 2048;  // fits the second-level cache
constexpr double kStrainSoFar = 0.05;   // eps_p before each plastic step

// Elastic: strains of 0.1 %. Plastic: every point flows in every pass, by about 1 % to and fro; eps_p
// is set back before each pass, so that the hardening does not end.
struct Points {
  explicit Points(bool plastic) : flowing(plastic), history(8 * kPoints, 0.0) {
    std::mt19937_64 engine(1);
    std::uniform_real_distribution<double> uniform(-1, 1);
    h[0].resize(9 * kPoints);
    for (double& x : h[0]) x = (plastic ? 5e-3 : 5e-4) * uniform(engine);
    h[1] = h[0];
    if (plastic)
      for (double& x : h[1]) x = -x;
    p.resize(9 * kPoints);
  }
  const double* next() {
    if (flowing)
      for (std::int64_t q = 0; q < kPoints; ++q)
        history[static_cast<std::size_t>(8 * q + 6)] = kStrainSoFar;
    pass = 1 - pass;
    return h[pass].data();
  }
  bool flowing;
  std::size_t pass = 0;
  std::vector<double> h[2], history, p;
};

void report(benchmark::State& state) {
  const double updates = static_cast<double>(state.iterations()) * static_cast<double>(kPoints);
  state.counters["per_point"] =
      benchmark::Counter(updates, benchmark::Counter::kIsRate | benchmark::Counter::kInvert);
}

cleave::StressArrays arrays(Points& points) {
  cleave::StressArrays a;
  const int offset[3] = {0, 6, 7};
  for (std::size_t k = 0; k < 3; ++k) {
    a.history.base[k] = points.history.data() + offset[k];
    a.history.stride[k] = 8;
  }
  a.p = points.p.data();
  return a;
}

void batch(benchmark::State& state) {
  Points points(state.range(0) != 0);
  for (auto _ : state) {
    const std::int32_t status = cleave_material_stress(
        CLEAVE_MATERIAL_j2, CLEAVE_3D, 7, kSteel.data(), 0, kPoints, points.next(),
        points.history.data(), points.p.data(), nullptr, nullptr);
    if (status != CLEAVE_OK) throw std::runtime_error("a point failed");
  }
  report(state);
  state.SetLabel(cleave::name_of(cleave::instruction_set()));
}
BENCHMARK(batch)->ArgName("plastic")->Arg(0)->Arg(1);

// The laws without history beside it.
void elastic(benchmark::State& state) {
  Points points(false);
  for (auto _ : state) {
    const std::int32_t status = cleave_material_stress(
        static_cast<std::int32_t>(state.range(0)), CLEAVE_3D, 3, kSteel.data(), 0, kPoints,
        points.next(), nullptr, points.p.data(), nullptr, nullptr);
    if (status != CLEAVE_OK) throw std::runtime_error("a point failed");
  }
  report(state);
  state.SetLabel(cleave::name_of(cleave::instruction_set()));
}
BENCHMARK(elastic)
    ->ArgName("law")
    ->Arg(CLEAVE_MATERIAL_svk)
    ->Arg(CLEAVE_MATERIAL_neo_hooke)
    ->Arg(CLEAVE_MATERIAL_linear_elastic);

// The same points kept by component, F in and Cauchy stress out, in blocks as host programs call.
// measure: enum cleave_stress_measure; block: points of a call.
void host_blocks(benchmark::State& state) {
  Points points(false);
  std::vector<double> f(9 * kPoints), history(8 * kPoints, 0.0), stress(6 * kPoints);
  for (std::int64_t q = 0; q < kPoints; ++q)
    for (std::int64_t c = 0; c < 9; ++c)
      f[static_cast<std::size_t>(kPoints * c + q)] =
          points.h[0][static_cast<std::size_t>(9 * q + c)] + (c % 4 == 0 ? 1 : 0);
  const std::int64_t six[9] = {0, 3, 5, 3, 1, 4, 5, 4, 2};
  for (auto _ : state) {
    cleave_material_call call;
    cleave_material_call_init(&call);
    call.material = CLEAVE_MATERIAL_j2;
    call.kinematics = CLEAVE_3D;
    call.property_count = 7;
    call.properties = kSteel.data();
    call.deformation = f.data();
    call.deformation_is_F = 1;
    call.history = history.data();
    call.stress = stress.data();
    call.deformation_point = call.history_point = call.stress_point = 1;
    call.deformation_component = call.history_component = call.stress_component = kPoints;
    std::copy_n(six, 9, call.stress_order);
    call.stress_measure = static_cast<std::int32_t>(state.range(0));
    for (call.first = 0; call.first < kPoints; call.first = call.last) {
      call.last = call.first + state.range(1);
      if (cleave_material_update(&call) != CLEAVE_OK) throw std::runtime_error("no answer");
    }
    benchmark::ClobberMemory();
  }
  report(state);
}
BENCHMARK(host_blocks)
    ->ArgNames({"measure", "block"})
    ->Args({CLEAVE_STRESS_CAUCHY, 1})
    ->Args({CLEAVE_STRESS_CAUCHY, 128})
    ->Args({CLEAVE_STRESS_COROTATED, 128})
    ->Args({CLEAVE_STRESS_SECOND_PIOLA, 128});

void point_by_point(benchmark::State& state) {
  Points points(state.range(0) != 0);
  const cleave::J2Voce law(kSteel, CLEAVE_3D);
  for (auto _ : state) {
    cleave::StressArrays a = arrays(points);
    a.h = points.next();
    const auto result = cleave::update_stress_pointwise<3>(law, a, 0, kPoints);
    if (result.first_failed >= 0) throw std::runtime_error("a point failed");
  }
  report(state);
}
BENCHMARK(point_by_point)->ArgName("plastic")->Arg(0)->Arg(1);

void tangent(benchmark::State& state) {
  Points points(state.range(0) != 0);
  const cleave::J2Voce law(kSteel, CLEAVE_3D);
  cleave::StressArrays a = arrays(points);
  for (auto _ : state) {
    a.h = points.next();
    cleave::Tangent<3> t;
    for (std::int64_t q = 0; q < kPoints; ++q) {
      if (!law.tangent<3>(cleave::load_tensor<3>(a.h, q), a.history.at(q), {}, t))
        throw std::runtime_error("a point failed");
      benchmark::DoNotOptimize(t);
    }
  }
  report(state);
}
BENCHMARK(tangent)->ArgName("plastic")->Arg(0)->Arg(1);

#if defined(CLEAVE_BENCH_EIGEN)

using Matrix = Eigen::Matrix3d;

struct IterativeEigen {
  Eigen::SelfAdjointEigenSolver<Matrix> solver;
  void operator()(const Matrix& b, Eigen::Vector3d& values, Matrix& vectors) {
    solver.compute(b);
    values = solver.eigenvalues();
    vectors = solver.eigenvectors();
  }
};
#if defined(CLEAVE_BENCH_LAPACK)
struct Lapack {
  void operator()(const Matrix& b, Eigen::Vector3d& values, Matrix& vectors) const {
    vectors = b;
    double work[64];
    const int n = 3, length = 64;
    int info = 0;
    dsyev_("V", "U", &n, vectors.data(), &n, values.data(), work, &length, &info);
    if (info != 0) throw std::runtime_error("dsyev failed");
  }
};
#endif

double yield(double e) {
  return kYield + kLinear * e + (kSaturation - kYield) * (1 - std::exp(-kAlpha * e));
}

// The update as in textbooks, with F, Cp^-1, log and exp.
template <class Solver>
void textbook_point(Solver& solve, const double* h, double* z, double& strain, double* p) {
  constexpr double g = kYoungs / (2 * (1 + kPoisson)), kappa = kYoungs / (3 * (1 - 2 * kPoisson));
  const Matrix f = Eigen::Map<const Matrix>(h) + Matrix::Identity();
  Matrix cpi;
  cpi << 1 + z[0], z[3], z[5], z[3], 1 + z[1], z[4], z[5], z[4], 1 + z[2];
  const Matrix b = f * cpi * f.transpose();
  Eigen::Vector3d values;
  Matrix vectors;
  solve(b, values, vectors);
  const Eigen::Vector3d e(0.5 * std::log(values[0]), 0.5 * std::log(values[1]),
                          0.5 * std::log(values[2]));
  const double t = e.sum();
  const Eigen::Vector3d deviator = e - Eigen::Vector3d::Constant(t / 3);
  const double equivalent = 2 * g * std::sqrt(1.5 * deviator.squaredNorm());
  double theta = 1;
  const Matrix inverse = f.inverse();
  if (equivalent > yield(strain)) {
    double x = 0;
    const double phi = equivalent - yield(strain);
    for (int n = 0; n < 50; ++n) {
      const double r = equivalent - 3 * g * x - yield(strain + x);
      if (std::fabs(r) <= 1e-14 * phi) break;
      x += r /
           (3 * g + kLinear + (kSaturation - kYield) * kAlpha * std::exp(-kAlpha * (strain + x)));
    }
    theta = 1 - 3 * g * x / equivalent;
    strain += x;
    Eigen::Vector3d stretch;
    for (int a = 0; a < 3; ++a) stretch[a] = std::exp(2 * (t / 3 + theta * deviator[a]));
    const Matrix c =
        inverse * (vectors * stretch.asDiagonal() * vectors.transpose()) * inverse.transpose();
    const double next[6] = {c(0, 0) - 1, c(1, 1) - 1, c(2, 2) - 1, c(0, 1), c(1, 2), c(2, 0)};
    std::copy(next, next + 6, z);
  }
  const Eigen::Vector3d tau = Eigen::Vector3d::Constant(kappa * t) + 2 * g * theta * deviator;
  Eigen::Map<Matrix> out(p);
  out = vectors * tau.asDiagonal() * vectors.transpose() * inverse.transpose();
}

template <class Solver>
void textbook(benchmark::State& state) {
  Points points(state.range(0) != 0);
  Solver solve;
  for (auto _ : state) {
    const double* h = points.next();
    for (std::int64_t q = 0; q < kPoints; ++q) {
      double* history = points.history.data() + 8 * q;
      textbook_point(solve, h + 9 * q, history, history[6], points.p.data() + 9 * q);
    }
    benchmark::ClobberMemory();
  }
  report(state);
}
BENCHMARK(textbook<IterativeEigen>)->ArgName("plastic")->Arg(0)->Arg(1);
#if defined(CLEAVE_BENCH_LAPACK)
BENCHMARK(textbook<Lapack>)->ArgName("plastic")->Arg(0)->Arg(1);
#endif

#endif

}  // namespace
