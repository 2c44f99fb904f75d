// Text of numbers and lists for messages, free of the locale. Not for data files.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace cleave::driver {

// At most `digits` significant digits, without trailing zeros: 1.5e-08, 0.25, 14400.
std::string number(double value, int digits = 6);
std::string number(std::int64_t value);
// "(1, 2, 3)"
std::string point_text(const double* x);
// a, b, c; "none" for an empty list; cut after `most` names with the number of the others.
std::string list(const std::vector<std::string>& names, std::size_t most = 40);
// 'name'
std::string in_quotes(std::string_view name);

// Letters, digits, '_', '-' and '.' only, and not empty: what files can use as a name.
bool is_column_name(std::string_view name);

}  // namespace cleave::driver
