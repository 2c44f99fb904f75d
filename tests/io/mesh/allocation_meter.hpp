// The largest block that operator new was asked for; the operator is replaced in the whole program.
#pragma once

#include <cstddef>

namespace cleave::io::testing {

void reset_largest_allocation();
std::size_t largest_allocation();

}  // namespace cleave::io::testing
