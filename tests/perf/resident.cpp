#include "perf/resident.hpp"

#include <fstream>
#include <string>

#if defined(__GLIBC__)
#include <malloc.h>
#endif

namespace cleave::perf {

namespace {

// A line "VmRSS:   1234 kB" of /proc/self/status, in bytes.
std::int64_t status_line(const std::string& name) {
  std::ifstream file("/proc/self/status");
  for (std::string word; file >> word;) {
    std::int64_t kilobytes = 0;
    if (word == name && file >> kilobytes) return 1024 * kilobytes;
  }
  return 0;
}

}  // namespace

void return_freed_memory() {
#if defined(__GLIBC__)
  mallopt(M_MMAP_THRESHOLD, 256 * 1024);  // fixed: glibc otherwise raises it with what is freed
  malloc_trim(0);
#endif
}
std::int64_t resident_bytes() { return status_line("VmRSS:"); }
std::int64_t peak_bytes() { return status_line("VmHWM:"); }
void reset_peak() { std::ofstream("/proc/self/clear_refs") << "5"; }

}  // namespace cleave::perf
