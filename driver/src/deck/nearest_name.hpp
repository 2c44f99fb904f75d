// The known name nearest to a misspelt one, for error messages.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace cleave::driver {

// Number of insertions, deletions, replacements and swaps of neighbours that turn one word into the
// other; upper and lower case count as the same.
std::size_t edit_distance(std::string_view a, std::string_view b);

// Empty if nothing known is near: at most a third of the letters may differ (at least one), or one
// word begins with the other.
std::string nearest_name(std::string_view name, const std::vector<std::string>& known);

// `; did you mean "poisson"?`, or `.` if nothing is near.
std::string did_you_mean(std::string_view name, const std::vector<std::string>& known,
                         std::string_view before = "\"", std::string_view after = "\"");

// `a, b, c`, every name between the two marks.
std::string listed(const std::vector<std::string>& names, std::string_view before = "",
                   std::string_view after = "");

}  // namespace cleave::driver
