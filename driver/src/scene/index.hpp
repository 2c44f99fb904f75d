// Indices of particles, bonds and simplices are signed 64-bit as in cleave.h; containers want size_t.
#pragma once

#include <cstddef>
#include <cstdint>

namespace cleave::driver {

using Index = std::int64_t;

constexpr std::size_t at(Index i) { return static_cast<std::size_t>(i); }

}  // namespace cleave::driver
