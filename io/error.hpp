// The one exception of the io library. It is for people: the text says what was found and where,
// what would be right, and what to do next.
#pragma once

#include <stdexcept>
#include <string>

namespace cleave::io {

struct Error : std::runtime_error {
  using std::runtime_error::runtime_error;
};

}  // namespace cleave::io
