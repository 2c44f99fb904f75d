// Wall time as a run counts it: from the start of the program, so that a queue's limit can be given
// as it is.
#pragma once

#include <optional>
#include <string>

namespace cleave::driver {

// Since the program was started.
double seconds_since_start();

// Seconds ("5400", "0.5") or hours, minutes and seconds ("1:30:00", "90:00"); nothing for another
// text.
std::optional<double> parse_wall_time(const std::string& text);

}  // namespace cleave::driver
