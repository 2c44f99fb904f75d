// Lines of the fields table for the history of a law, and lists put together from parts.
#pragma once

#include <algorithm>
#include <array>

#include "core/field.hpp"

namespace cleave {

constexpr FieldSpec point_history(const char* name, int components, const char* units, bool output,
                                  const char* description) {
  return {name,
          CLEAVE_RELATION_INTEGRATION_POINT,
          components,
          CLEAVE_REAL,
          units,
          CLEAVE_LIFETIME_STATE,
          Exchange::none,
          output,
          "",
          description};
}

// One list after another.
template <class T, std::size_t... N>
constexpr auto joined(const std::array<T, N>&... parts) {
  std::array<T, (N + ...)> all{};
  auto to = all.begin();
  ((to = std::copy(parts.begin(), parts.end(), to)), ...);
  return all;
}

}  // namespace cleave
