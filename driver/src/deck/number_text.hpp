// Numbers as text, the same in every locale.
#pragma once

#include <cstdint>
#include <string>

namespace cleave::driver {

// Shortest text that reads back to the same double, recognisable as a real: "1.0", "1e-06".
std::string real_text(double value);
// Four significant digits, for messages.
std::string short_text(double value);

}  // namespace cleave::driver
