// Prints what the machine can do, one line of JSON a measurement: the triad at several sizes and the
// multiply-add rates, for each thread count, in turns.
//   machine_speed [MIB of the triad] [SECONDS of a turn] [ROUNDS] [THREADS]...
#include <cstdio>
#include <exception>
#include <memory>
#include <string>
#include <vector>

#include "cleave/cleave.h"
#include "perf/machine.hpp"

namespace {

using namespace cleave::perf;

void measure(std::size_t mebibytes, double seconds, int rounds, const std::vector<int>& counts) {
  std::vector<std::unique_ptr<Triad>> triads;
  for (const int threads : counts)
    triads.push_back(std::make_unique<Triad>(mebibytes << 20, threads));
  for (int round = 0; round < rounds; ++round) {
    for (std::size_t k = 0; k < counts.size(); ++k) {
      const double begun = seconds_now();
      triads[k]->pass();
      std::printf("{\"kind\": \"triad\", \"threads\": %d, \"bytes_per_second\": %.6g}\n", counts[k],
                  triads[k]->bytes() / (seconds_now() - begun));
      for (const MultiplyAdd& kind : multiply_adds()) {
        std::printf(
            "{\"kind\": \"multiply_add\", \"name\": \"%s\", \"threads\": %d, "
            "\"operations_per_second\": %.6g}\n",
            kind.name.c_str(), counts[k], operations_per_second(kind, counts[k], seconds));
      }
      std::fflush(stdout);
    }
  }
}

}  // namespace

int main(int count, char** words) {
  try {
    const std::size_t mebibytes = count > 1 ? std::stoul(words[1]) : 512;
    const double seconds = count > 2 ? std::stod(words[2]) : 0.1;
    const int rounds = count > 3 ? std::stoi(words[3]) : 5;
    std::vector<int> counts;
    for (int k = 4; k < count; ++k) counts.push_back(std::stoi(words[k]));
    if (counts.empty()) counts = {1, 2};
    std::printf("{\"kind\": \"build\", \"compiler\": \"%s\", \"version\": \"%s\"}\n", __VERSION__,
                cleave_version());
    measure(mebibytes, seconds, rounds, counts);
    return 0;
  } catch (const std::exception& e) {
    std::fprintf(stderr, "machine_speed: %s\n", e.what());
    return 1;
  }
}
