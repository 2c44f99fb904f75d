// Particle-steps per second of the step of the Continuum Bond Method, at any size, in the cases that
// step_case.hpp names, beside the STREAM triad of the same minutes. All cases and thread counts are
// alive together and take turns, so that ratios hold on a machine whose clock drifts. Judges nothing.
#include <algorithm>
#include <cstdio>
#include <ctime>
#include <exception>
#include <memory>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "perf/machine.hpp"
#include "perf/resident.hpp"
#include "perf/step_case.hpp"

namespace {

using namespace cleave::perf;

constexpr char kUsage[] =
    "step_speed [--dimension 2|3] [--particles N [--shuffle] | --mesh FILE.msh] [--case WORDS]... "
    "[--threads "
    "1,2]\n"
    "           [--rounds N] [--seconds S] [--triad MIB] [--cpu] [--json]\n"
    "  --case     the law and words joined with +: svk, j2+plastic, svk+search, "
    "svk+search+viscosity,\n"
    "             svk+breaking; what the words mean is in step_case.hpp; several cases take turns\n"
    "  --rounds   turns of every case and thread count; the table has medians, lowest and highest\n"
    "  --seconds  least time of a turn, which ends after 100 steps\n"
    "  --triad    size of the triad's three arrays together, MiB; 0: none\n"
    "  --cpu      processor time instead of time, where others use the machine; with one thread "
    "only\n"
    "  --json     one line of JSON a measurement instead of the table\n";

struct Options {
  int dimension = 3;
  std::int64_t particles = 100000;
  std::string mesh;
  std::vector<std::string> cases;
  std::vector<int> threads{1, 2};
  int rounds = 5;
  double seconds = 0.5;
  std::size_t triad = 512;
  bool json = false, shuffle = false, cpu = false;
};
constexpr std::int64_t kMostSteps = 100;  // of a turn: the cases hold for some thousand steps

Options parse(int count, char** words) {
  Options o;
  for (int k = 1; k < count; ++k) {
    const std::string word = words[k];
    if (word == "--json") {
      o.json = true;
      continue;
    }
    if (word == "--cpu") {
      o.cpu = true;
      continue;
    }
    if (word == "--shuffle") {
      o.shuffle = true;
      continue;
    }
    if (k + 1 == count)
      throw std::runtime_error("'" + word + "': unknown, or without its value\n" + kUsage);
    const std::string value = words[++k];
    if (word == "--dimension") {
      o.dimension = std::stoi(value);
    } else if (word == "--particles") {
      o.particles = static_cast<std::int64_t>(std::stod(value));
    } else if (word == "--mesh") {
      o.mesh = value;
    } else if (word == "--case") {
      o.cases.push_back(value);
    } else if (word == "--threads") {
      o.threads.clear();
      std::istringstream list(value);
      for (std::string n; std::getline(list, n, ',');) o.threads.push_back(std::stoi(n));
    } else if (word == "--rounds") {
      o.rounds = std::stoi(value);
    } else if (word == "--seconds") {
      o.seconds = std::stod(value);
    } else if (word == "--triad") {
      o.triad = static_cast<std::size_t>(std::stoul(value));
    } else {
      throw std::runtime_error("'" + word + "': unknown option\n" + kUsage);
    }
  }
  if (o.cases.empty()) o.cases = {"svk", "j2", "j2+plastic"};
  if (o.cpu && o.threads != std::vector<int>{1})
    throw std::runtime_error("--cpu goes with --threads 1");
  if (o.threads.empty() || o.rounds < 1) throw std::runtime_error(kUsage);
  return o;
}

double processor_time() {
  return static_cast<double>(std::clock()) / static_cast<double>(CLOCKS_PER_SEC);
}

double median(std::vector<double> v) {
  std::sort(v.begin(), v.end());
  const std::size_t n = v.size();
  return n == 0 ? 0.0 : 0.5 * (v[(n - 1) / 2] + v[n / 2]);
}

// One case with everything measured of it so far.
struct Timed {
  StepCase what;
  std::unique_ptr<StepModel> model;
  double flowing = 0;
  std::vector<std::vector<double>> rates;  // per thread count: particle-steps per second
  std::vector<double> broken_per_step;
};

class Bench {
 public:
  explicit Bench(const Options& o) : o_(o), mesh_(make_mesh(o)) {
    n_ = mesh_.mesh.particles();
    for (const std::string& words : o.cases) {
      Timed t{StepCase(words), nullptr, 0, {}, {}};
      const int most = *std::max_element(o.threads.begin(), o.threads.end());
      t.model = std::make_unique<StepModel>(t.what, mesh_, most);
      t.flowing = t.model->flowing();
      t.rates.resize(o.threads.size());
      report_model(t);
      timed_.push_back(std::move(t));
    }
    for (const int threads : o.threads) {
      if (o.triad > 0) triads_.push_back(std::make_unique<Triad>(o.triad << 20, threads));
    }
    triad_rates_.resize(o.threads.size());
  }

  void run() {
    for (int round = 0; round < o_.rounds; ++round) {
      for (std::size_t k = 0; k < o_.threads.size(); ++k) {
        if (!triads_.empty()) time_triad(k);
        for (Timed& t : timed_) time_steps(t, k);
      }
    }
    for (const Timed& t : timed_) check_motion(t);
    if (!o_.json) print_table();
  }

 private:
  static StepMesh make_mesh(const Options& o) {
    return o.mesh.empty() ? lattice(o.dimension, o.particles, o.shuffle) : from_gmsh(o.mesh);
  }

  // The cases are still what they are called.
  static void check_motion(const Timed& t) {
    const double flowing = t.model->flowing();
    if (t.what.plastic != (flowing > 0.9) || (!t.what.plastic && flowing > 0))
      throw std::runtime_error(t.what.name + ": at the end " + std::to_string(100 * flowing) +
                               " % of the particles flow");
    if (!t.what.breaking && t.model->counts().broken > 0)
      throw std::runtime_error(t.what.name + ": bonds broke");
  }

  void time_triad(std::size_t k) {
    const auto clock = o_.cpu ? processor_time : seconds_now;
    const double begun = clock();
    triads_[k]->pass();
    const double rate = triads_[k]->bytes() / (clock() - begun);
    triad_rates_[k].push_back(rate);
    if (o_.json) {
      std::printf("{\"kind\": \"triad\", \"threads\": %d, \"bytes_per_second\": %.6g}\n",
                  o_.threads[k], rate);
      std::fflush(stdout);
    }
  }

  void time_steps(Timed& t, std::size_t k) {
    t.model->set_threads(o_.threads[k]);
    t.model->step();  // wakes the threads, and brings the fields back into the caches
    t.model->take_broken();
    const auto clock = o_.cpu ? processor_time : seconds_now;
    const double begun = clock();
    double took = 0;
    std::int64_t steps = 0;
    do {
      t.model->step();
      ++steps;
      took = clock() - begun;
    } while (took < o_.seconds && steps < kMostSteps);
    const double broken = static_cast<double>(t.model->take_broken()) / static_cast<double>(steps);
    t.rates[k].push_back(static_cast<double>(steps * n_) / took);
    t.broken_per_step.push_back(broken);
    if (o_.json) {
      std::printf(
          "{\"kind\": \"step\", \"case\": \"%s\", \"threads\": %d, \"steps\": %lld, "
          "\"seconds_per_step\": %.6g, \"broken_per_step\": %.6g}\n",
          t.what.name.c_str(), o_.threads[k], static_cast<long long>(steps),
          took / static_cast<double>(steps), broken);
      std::fflush(stdout);
    }
  }

  void report_model(const Timed& t) const {
    // As between two outputs: what was asked for at the start is given back by then.
    for (int k = 0; k < 2; ++k) t.model->step();
    const std::int64_t bytes = t.model->bytes();
    const cleave_counts c = t.model->counts();
    const SetUp& s = t.model->set_up();
    if (o_.json) {
      std::printf(
          "{\"kind\": \"model\", \"case\": \"%s\", \"dimension\": %d, \"particles\": %lld, "
          "\"bonds\": %lld, \"simplices\": %lld, \"set_up_seconds\": %.6g, \"bytes\": %lld, "
          "\"resident\": %lld, \"peak\": %lld, \"flowing\": %.4g}\n",
          t.what.name.c_str(), mesh_.mesh.dimension, static_cast<long long>(c.particles),
          static_cast<long long>(c.bonds), static_cast<long long>(c.simplices), s.seconds,
          static_cast<long long>(bytes), static_cast<long long>(s.resident),
          static_cast<long long>(s.peak), t.flowing);
      std::fflush(stdout);
      return;
    }
    const auto each = [&](std::int64_t amount) {
      return static_cast<double>(amount) / static_cast<double>(c.particles);
    };
    std::printf(
        "%-24s %dD, %lld particles, %.2f bonds each; set up in %.2f s; bytes per particle: %.0f "
        "by the library, %.0f resident, %.0f peak; flowing %.0f %%\n",
        t.what.name.c_str(), mesh_.mesh.dimension, static_cast<long long>(c.particles),
        2 * each(c.bonds), s.seconds, each(bytes), each(s.resident), each(s.peak), 100 * t.flowing);
    std::fflush(stdout);
  }

  void print_table() const {
    std::printf("\n%-24s %7s  %s\n", "case", "threads",
                "M particle-steps/s: median (lowest - highest), "
                "broken per step");
    for (const Timed& t : timed_) {
      for (std::size_t k = 0; k < o_.threads.size(); ++k) {
        const auto [low, high] = std::minmax_element(t.rates[k].begin(), t.rates[k].end());
        std::printf("%-24s %7d  %7.3f (%.3f - %.3f)", t.what.name.c_str(), o_.threads[k],
                    median(t.rates[k]) / 1e6, *low / 1e6, *high / 1e6);
        if (t.what.breaking) std::printf("  %.1f", median(t.broken_per_step));
        std::printf("\n");
      }
    }
    for (std::size_t k = 0; k < triads_.size(); ++k) {
      const auto [low, high] = std::minmax_element(triad_rates_[k].begin(), triad_rates_[k].end());
      std::printf("%-24s %7d  %7.2f (%.2f - %.2f) GB/s\n", "STREAM triad", o_.threads[k],
                  median(triad_rates_[k]) / 1e9, *low / 1e9, *high / 1e9);
    }
  }

  Options o_;
  StepMesh mesh_;
  std::int64_t n_ = 0;
  std::vector<Timed> timed_;
  std::vector<std::unique_ptr<Triad>> triads_;
  std::vector<std::vector<double>> triad_rates_;
};

}  // namespace

int main(int count, char** words) {
  try {
    Bench(parse(count, words)).run();
    return 0;
  } catch (const std::exception& e) {
    std::fprintf(stderr, "step_speed: %s\n", e.what());
    return 1;
  }
}
