// All of an Exodus results file that does not change with time; internal to io.
#pragma once

#include <string>

#include "io/results.hpp"

namespace cleave::io {

// Throws io::Error if the layout contradicts itself: index out of range, names twice or too long, ...
void check_layout(const std::string& path, const ResultLayout& layout);

// Writes a complete file without frames. The layout must have been checked.
void write_exodus_definition(const std::string& path, const ResultLayout& layout);

// "name: text" cut into info records of at most 80 bytes.
std::vector<std::string> information_records(const ResultLayout& layout);

}  // namespace cleave::io
