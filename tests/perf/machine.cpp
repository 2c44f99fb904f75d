#include "perf/machine.hpp"

#include <algorithm>
#include <chrono>
#include <thread>

#if defined(__x86_64__)
#include <immintrin.h>
#endif

namespace cleave::perf {

namespace {

// f(part) for every part, each on a thread of its own.
template <class F>
void on_threads(int threads, const F& f) {
  std::vector<std::thread> others;
  for (int part = 1; part < threads; ++part) others.emplace_back(f, part);
  f(0);
  for (auto& t : others) t.join();
}

// Ten chains: enough to hide the latency of both operations on every core so far.
constexpr int kChains = 10;

template <class V>
inline __attribute__((always_inline)) double separate(long rounds) {
  V sum[kChains];
  const V factor = V{} + 0.999999, term = V{} + 1e-6;
  for (int k = 0; k < kChains; ++k) sum[k] = V{} + k;
  for (long r = 0; r < rounds; ++r) {
    for (int k = 0; k < kChains; ++k) sum[k] = sum[k] * factor + term;
  }
  for (int k = 1; k < kChains; ++k) sum[0] += sum[k];
  return sum[0][0];
}

typedef double V2 __attribute__((vector_size(16)));
double separate_2(long rounds) { return separate<V2>(rounds); }

#if defined(__x86_64__)
typedef double V4 __attribute__((vector_size(32)));
typedef double V8 __attribute__((vector_size(64)));
__attribute__((target("avx2"))) double separate_4(long rounds) { return separate<V4>(rounds); }
__attribute__((target("avx512f"))) double separate_8(long rounds) { return separate<V8>(rounds); }

__attribute__((target("avx2,fma"))) double fused_4(long rounds) {
  __m256d sum[kChains];
  const __m256d factor = _mm256_set1_pd(0.999999), term = _mm256_set1_pd(1e-6);
  for (int k = 0; k < kChains; ++k) sum[k] = _mm256_set1_pd(k);
  for (long r = 0; r < rounds; ++r) {
    for (int k = 0; k < kChains; ++k) sum[k] = _mm256_fmadd_pd(sum[k], factor, term);
  }
  for (int k = 1; k < kChains; ++k) sum[0] = _mm256_add_pd(sum[0], sum[k]);
  return _mm256_cvtsd_f64(sum[0]);
}
__attribute__((target("avx512f"))) double fused_8(long rounds) {
  __m512d sum[kChains];
  const __m512d factor = _mm512_set1_pd(0.999999), term = _mm512_set1_pd(1e-6);
  for (int k = 0; k < kChains; ++k) sum[k] = _mm512_set1_pd(k);
  for (long r = 0; r < rounds; ++r) {
    for (int k = 0; k < kChains; ++k) sum[k] = _mm512_fmadd_pd(sum[k], factor, term);
  }
  for (int k = 1; k < kChains; ++k) sum[0] = _mm512_add_pd(sum[0], sum[k]);
  return _mm512_cvtsd_f64(sum[0]);
}
#endif

}  // namespace

double seconds_now() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

Triad::Triad(std::size_t bytes_of_all_three, int threads)
    : n_(bytes_of_all_three / 24),
      threads_(threads),
      a_(new double[n_]),
      b_(new double[n_]),
      c_(new double[n_]) {
  // Each thread touches first what it will use, so that it lies near it.
  on_threads(threads_, [this](int part) {
    for (std::size_t k = edge(part); k < edge(part + 1); ++k) {
      a_[k] = 0;
      b_[k] = 1;
      c_[k] = 2;
    }
  });
}

std::size_t Triad::edge(int part) const {
  return part == threads_
             ? n_
             : n_ / static_cast<std::size_t>(threads_) * static_cast<std::size_t>(part);
}

void Triad::pass() {
  on_threads(threads_, [this](int part) {
    double* __restrict a = a_.get();
    const double *b = b_.get(), *c = c_.get();
    const std::size_t last = edge(part + 1);
    for (std::size_t k = edge(part); k < last; ++k) a[k] = b[k] + 3.0 * c[k];
  });
}

std::vector<MultiplyAdd> multiply_adds() {
  std::vector<MultiplyAdd> out{{"baseline, separate", separate_2, 2.0 * 2 * kChains}};
#if defined(__x86_64__)
  if (__builtin_cpu_supports("avx2")) {
    out.push_back({"AVX2, separate", separate_4, 2.0 * 4 * kChains});
    if (__builtin_cpu_supports("fma")) out.push_back({"AVX2, fused", fused_4, 2.0 * 4 * kChains});
  }
  if (__builtin_cpu_supports("avx512f")) {
    out.push_back({"AVX-512, separate", separate_8, 2.0 * 8 * kChains});
    out.push_back({"AVX-512, fused", fused_8, 2.0 * 8 * kChains});
  }
#endif
  return out;
}

double operations_per_second(const MultiplyAdd& kind, int threads, double seconds) {
  long rounds = 1 << 16;
  for (;;) {
    const double begun = seconds_now();
    on_threads(threads, [&](int) {
      volatile double keep = kind.run(rounds);
      static_cast<void>(keep);
    });
    const double took = seconds_now() - begun;
    if (took >= seconds) return kind.operations * static_cast<double>(rounds) * threads / took;
    rounds *= took > 0.1 * seconds ? 1 + static_cast<long>(1.1 * seconds / took) : 8;
  }
}

}  // namespace cleave::perf
