// Checks that several array calls share.
#pragma once

#include <cstdint>
#include <type_traits>

#include "abi/guard.hpp"

namespace cleave::abi {

inline void check_dimension(std::int32_t dimension) {
  if (dimension != 2 && dimension != 3) {
    throw Error(CLEAVE_BAD_ARGUMENT, text("dimension is ", dimension, "; allowed: 2, 3"));
  }
}

// A struct that the caller filled by its init function; `type`: its name, which is that of the function.
template <class T>
void check_size(const T& given, const char* type) {
  if (given.size == static_cast<std::int64_t>(sizeof(T))) return;
  throw Error(CLEAVE_ABI_MISMATCH, text(type, " has size ", given.size, ", this library expects ",
                                        sizeof(T), "; fill it with ", type, "_init first"));
}

inline void check_index_base(std::int32_t base) {
  if (base != 0 && base != 1)
    throw Error(CLEAVE_BAD_ARGUMENT, text("index_base is ", base, "; allowed: 0, 1"));
}

inline void check_rows(std::int64_t first, std::int64_t last) {
  if (first < 0 || last < first) {
    throw Error(CLEAVE_BAD_RANGE,
                text("range ", first, " <= i < ", last, " is not a range of particles"));
  }
}

// F applied with D as a compile-time number.
template <class F>
void with_dimension(std::int32_t dimension, const F& f) {
  check_dimension(dimension);
  if (dimension == 2) {
    f(std::integral_constant<int, 2>{});
  } else {
    f(std::integral_constant<int, 3>{});
  }
}

}  // namespace cleave::abi
