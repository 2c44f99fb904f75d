// The one exception inside the kernels. The interface guard turns it into a status and a message;
// nothing of it reaches a host.
#pragma once

#include <cstdint>
#include <sstream>
#include <stdexcept>
#include <string>

#include "cleave/cleave.h"

namespace cleave {

struct Error : std::runtime_error {
  Error(cleave_status code, const std::string& text) : std::runtime_error(text), status(code) {}
  cleave_status status;
};

// Message from parts: text("bond ", 3, " is missing").
template <class... Parts>
std::string text(const Parts&... parts) {
  std::ostringstream out;
  out.imbue(std::locale::classic());
  out.precision(9);
  (out << ... << parts);
  return out.str();
}

}  // namespace cleave
