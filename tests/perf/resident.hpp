// Memory of this process as Linux counts it; zero elsewhere.
#pragma once

#include <cstdint>

namespace cleave::perf {

// Makes what is freed go back to the system at once, so that the numbers below are those of live memory.
void return_freed_memory();
std::int64_t resident_bytes();
// Largest resident size since the last reset_peak.
std::int64_t peak_bytes();
void reset_peak();

}  // namespace cleave::perf
