// A host that calls the interface from several threads at once, as POSIX threads and as an OpenMP loop:
// array calls on disjoint ranges of shared arrays, one model a thread, each with a team of threads of its
// own, tables and messages. Results are those of one thread, bit for bit; run under the thread sanitizer,
// which ends the program with a failure where it sees a race.
//
//   concurrent_calls pthreads|openmp|models|teams|tables     exit status 0: as expected
//   concurrent_calls race             two threads on one range: a race, on purpose
//   concurrent_calls race_in_team     two blocks that write the same number
#include <atomic>
#include <barrier>
#include <cstdio>
#include <cstring>
#include <functional>
#include <string>
#include <thread>

#include "core/thread_team.hpp"
#include "support/bonds.hpp"

namespace cleave::test {
namespace {

constexpr int kThreads = 4;
constexpr int kSteps = 5;
const std::vector<double> kSteel = {7850, 206.9e9, 0.29, 450e6, 715e6, 129.24e6, 16.93};
constexpr std::int64_t kHistory = 8;

[[noreturn]] void fail(const std::string& what) {
  char message[4096];
  cleave_last_message(message, sizeof message, nullptr);
  std::fprintf(stderr, "%s; last message: %s\n", what.c_str(), message);
  std::exit(1);
}
void ok(std::int32_t status) {
  if (status != CLEAVE_OK) fail("status " + std::to_string(status));
}

// The arrays of a host, and its step on a range of particles in two phases with a wait between them:
// forces need the stress of neighbours.
struct Host {
  Host() : bonds(patch(3, 8, 0.01, 0.15, 5)), n(bonds.mesh.particles()), net(bonds.network()) {
    const auto size = static_cast<std::size_t>(n);
    u = random_vectors(bonds.mesh, 2e-4, 7);
    H.resize(9 * size);
    P.resize(9 * size);
    f.resize(3 * size);
    v.resize(3 * size);
    history.resize(kHistory * size);
  }
  void stress(std::int64_t first, std::int64_t last) {
    ok(cleave_displacement_gradient(&net, first, last, u.data(), H.data()));
    ok(cleave_material_stress(CLEAVE_MATERIAL_j2, CLEAVE_3D,
                              static_cast<std::int64_t>(kSteel.size()), kSteel.data(), first, last,
                              H.data(), history.data(), P.data(), nullptr, nullptr));
  }
  void move(std::int64_t first, std::int64_t last) {
    std::fill(f.begin() + 3 * first, f.begin() + 3 * last, 0.0);
    ok(cleave_bond_force(&net, first, last, P.data(), f.data()));
    for (auto c = static_cast<std::size_t>(3 * first); c < static_cast<std::size_t>(3 * last); ++c)
      v[c] += 1e-7 * f[c];
  }
  // After every thread has forces: displacements are read by neighbours.
  void drift(std::int64_t first, std::int64_t last) {
    for (auto c = static_cast<std::size_t>(3 * first); c < static_cast<std::size_t>(3 * last); ++c)
      u[c] += 1e-7 * v[c];
  }
  bool operator==(const Host& o) const {
    return u == o.u && H == o.H && P == o.P && f == o.f && history == o.history;
  }
  Bonds bonds;
  std::int64_t n;
  cleave_network net;
  std::vector<double> u, H, P, f, v, history;
};

// One thread's share of all steps.
void run_share(Host& host, int thread, std::barrier<>& all) {
  const std::int64_t first = host.n * thread / kThreads, last = host.n * (thread + 1) / kThreads;
  for (int step = 0; step < kSteps; ++step) {
    host.stress(first, last);
    all.arrive_and_wait();
    host.move(first, last);
    all.arrive_and_wait();
    host.drift(first, last);
    all.arrive_and_wait();
  }
}

Host serial() {
  Host host;
  for (int step = 0; step < kSteps; ++step) {
    host.stress(0, host.n);
    host.move(0, host.n);
    host.drift(0, host.n);
  }
  return host;
}

void compare(const Host& host) {
  const Host one = serial();
  if (!(host == one)) fail("several threads gave other bits than one");
  double plastic = 0;
  for (std::int64_t i = 0; i < host.n; ++i)
    plastic += host.history[static_cast<std::size_t>(kHistory * i + 6)];
  if (!(plastic > 0)) fail("nothing yielded");
}

void in_threads(const std::function<void(int)>& work) {
  std::vector<std::thread> threads;
  for (int t = 0; t < kThreads; ++t) threads.emplace_back(work, t);
  for (auto& t : threads) t.join();
}

void by_pthreads() {
  Host host;
  std::barrier<> all(kThreads);
  in_threads([&](int t) { run_share(host, t, all); });
  compare(host);
}

// The waiting of the OpenMP library is invisible to the sanitizer, so the end of the region is marked by an
// atomic that it sees.
void by_openmp() {
  Host host;
  std::barrier<> all(kThreads);
  std::atomic<int> done = 0;
#ifdef _OPENMP
#pragma omp parallel for schedule(static) num_threads(kThreads)
  for (int t = 0; t < kThreads; ++t) {
    run_share(host, t, all);
    ++done;
  }
  if (done.load() != kThreads) fail("a thread is missing");
#else
  in_threads([&](int t) { run_share(host, t, all); });
#endif
  compare(host);
}

// A whole life of a model with fracture; the end state.
std::vector<double> life(unsigned seed, int cells, int threads) {
  const SimplexMesh mesh = patch(2, cells, 0.08 / cells, 0.15, seed);
  cleave_model* model = nullptr;
  ok(cleave_model_create(CLEAVE_ABI_VERSION, &model));
  ok(cleave_model_set_threads(model, threads));
  cleave_body_spec spec;
  ok(cleave_body_spec_init(&spec));
  spec.formulation = CLEAVE_FORMULATION_cbm;
  spec.kinematics = CLEAVE_PLANE_STRAIN;
  spec.material = CLEAVE_MATERIAL_svk;
  spec.particles = mesh.particles();
  spec.X = mesh.X.data();
  spec.simplex_count = mesh.simplex_count();
  spec.simplices = mesh.simplices.data();
  std::int64_t body = -1;
  ok(cleave_body_add(model, &spec, &body));
  for (const auto& [name, value] :
       {std::pair{"rho", 1190.0}, std::pair{"E", 3.24e9}, std::pair{"nu", 0.35}})
    ok(cleave_body_set_real(model, body, "material", name, value));
  ok(cleave_body_set_real(model, body, "fracture", "critical_strain", 0.02));
  ok(cleave_body_set_real(model, body, "viscosity", "length", 0.01));
  // A mistake on the way, with its message: each thread reads its own.
  const std::string wrong = "wrong" + std::to_string(seed);
  if (cleave_body_set_real(model, body, "material", wrong.c_str(), 1) != CLEAVE_UNKNOWN_NAME)
    fail("an unknown name was taken");
  char message[512];
  cleave_last_message(message, sizeof message, nullptr);
  if (std::strstr(message, wrong.c_str()) == nullptr) fail("the message is another thread's");
  ok(cleave_model_setup(model));
  std::vector<double> v(mesh.X.size(), 0.0);
  for (std::size_t i = 0; i < v.size(); i += 3) v[i] = 1000 * mesh.X[i];
  ok(cleave_field_put_real(model, body, "velocity", 0, mesh.particles(), v.data()));
  double dt = 0, t = 0;
  ok(cleave_model_initialise(model, 0));
  ok(cleave_model_stable_step(model, &dt));
  for (int step = 0; step < 40; ++step) {
    t += 0.4 * dt;
    ok(cleave_model_advance(model, 0.4 * dt, t));
    ok(cleave_model_update(model));
  }
  ok(cleave_field_get_real(model, body, "displacement", 0, mesh.particles(), v.data()));
  ok(cleave_model_destroy(model));
  return v;
}

// One model a host thread, each of them with a team of as many threads as said.
void many_models(int cells, int threads) {
  std::vector<std::vector<double>> found(kThreads);
  in_threads([&](int t) {
    found[static_cast<std::size_t>(t)] = life(static_cast<unsigned>(t), cells, threads);
  });
  for (int t = 0; t < kThreads; ++t)
    if (found[static_cast<std::size_t>(t)] != life(static_cast<unsigned>(t), cells, 1))
      fail("a model beside others is not the same as alone");
}

// The first calls of a process, from all threads at once.
void tables_first() {
  std::barrier<> all(kThreads);
  in_threads([&](int) {
    all.arrive_and_wait();
    std::int64_t count = 0;
    std::uint64_t fingerprint = 0;
    std::int32_t value = 0;
    ok(cleave_field_table_fingerprint(&fingerprint));
    ok(cleave_field_table_count(&count));
    for (std::int64_t k = 0; k < count; ++k) {
      cleave_field field{};
      field.size = sizeof field;
      ok(cleave_field_table_get(k, &field));
    }
    ok(cleave_table_find(CLEAVE_TABLE_MATERIAL, "johnson_cook", &value));
    ok(cleave_parameter_count("johnson_cook", &count));
  });
}

void race() {
  Host host;
  in_threads([&](int) { host.stress(0, host.n); });
}

void race_in_team() {
  ThreadTeam team(2);
  std::barrier<> both(2);
  std::int64_t last = 0;
  team.for_blocks(2, [&](std::int64_t block) {
    both.arrive_and_wait();
    last = block;
  });
  std::printf("%d\n", static_cast<int>(last));
}

}  // namespace
}  // namespace cleave::test

int main(int count, char** arguments) {
  using namespace cleave::test;
  const std::string part = count == 2 ? arguments[1] : "";
  if (part == "pthreads") {
    by_pthreads();
  } else if (part == "openmp") {
    by_openmp();
  } else if (part == "models") {
    many_models(8, 1);
  } else if (part == "teams") {
    many_models(40, 3);  // several blocks of particles
  } else if (part == "tables") {
    tables_first();
  } else if (part == "race") {
    race();
  } else if (part == "race_in_team") {
    race_in_team();
  } else {
    std::fprintf(stderr,
                 "usage: concurrent_calls pthreads|openmp|models|teams|tables|race|race_in_team\n");
    return 2;
  }
  return 0;
}
