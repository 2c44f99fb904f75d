#include "allocation_meter.hpp"

#include <algorithm>
#include <cstdlib>
#include <new>

namespace {
std::size_t largest = 0;  // the tests have one thread
}

namespace cleave::io::testing {

void reset_largest_allocation() { largest = 0; }
std::size_t largest_allocation() { return largest; }

}  // namespace cleave::io::testing

void* operator new(std::size_t bytes) {
  largest = std::max(largest, bytes);
  if (void* memory = std::malloc(std::max<std::size_t>(bytes, 1))) return memory;
  throw std::bad_alloc();
}
void operator delete(void* memory) noexcept { std::free(memory); }
void operator delete(void* memory, std::size_t) noexcept { std::free(memory); }
