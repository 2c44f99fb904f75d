#include "run/threads.hpp"

#include <sched.h>

#include <cstdio>

namespace cleave::driver {
namespace {

// Those that this process may use (queues and `taskset` give fewer than there are); 0: not known.
int available_cores() {
#if defined(__linux__)
  cpu_set_t cores;
  return sched_getaffinity(0, sizeof cores, &cores) == 0 ? CPU_COUNT(&cores) : 0;
#else
  return 0;
#endif
}

}  // namespace

int threads_of(const Deck& deck, const RunOptions& options) {
  const int threads =
      options.threads > 0 ? options.threads : static_cast<int>(deck.one("run").integer("threads"));
  const int cores = available_cores();
  if (!options.quiet && cores > 0 && threads > cores) {
    std::printf("note: %d threads, but %d %s for this process: --threads %d is not slower\n",
                threads, cores, cores == 1 ? "core" : "cores", cores);
    std::fflush(stdout);
  }
  return threads;
}

}  // namespace cleave::driver
