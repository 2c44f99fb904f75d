#include "command/waiting_threads.hpp"

#include <unistd.h>

#include <cstdlib>

namespace cleave::driver {

void let_waiting_threads_sleep(char** argv) {
  if (std::getenv("GOMP_SPINCOUNT") != nullptr || std::getenv("OMP_WAIT_POLICY") != nullptr) return;
  if (setenv("GOMP_SPINCOUNT", "5000", 0) != 0) return;
  execv("/proc/self/exe", argv);  // returns only if it cannot: then the run is slower at worst
}

}  // namespace cleave::driver
