#include "run/wall_time.hpp"

#include <algorithm>
#include <charconv>
#include <chrono>
#include <cmath>

namespace cleave::driver {
namespace {

using WallClock = std::chrono::steady_clock;
const WallClock::time_point program_start = WallClock::now();

std::optional<double> plain_number(const std::string& text) {
  double value = 0;
  const char* end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, value);
  if (error != std::errc{} || stop != end || !std::isfinite(value) || std::signbit(value))
    return {};
  return value;
}

}  // namespace

double seconds_since_start() {
  return std::chrono::duration<double>(WallClock::now() - program_start).count();
}

std::optional<double> parse_wall_time(const std::string& text) {
  constexpr int kMostParts = 3;
  double seconds = 0;
  int parts = 0;
  for (std::size_t begin = 0; begin <= text.size(); ++parts) {
    const std::size_t colon = std::min(text.find(':', begin), text.size());
    const auto part = plain_number(text.substr(begin, colon - begin));
    if (!part || parts == kMostParts || (parts > 0 && *part >= 60)) return {};
    seconds = 60 * seconds + *part;
    begin = colon + 1;
  }
  return seconds;
}

}  // namespace cleave::driver
