// The tables behind cleave.h as lists: laws, formulations, parameter groups, status codes, fields.
#pragma once

#include <string>
#include <vector>

#include "cleave/cleave.h"

namespace cleave::driver {

// Throws std::logic_error with the library's message: the tables are part of the program.
std::vector<cleave_table_entry> table_entries(cleave_table table);
std::vector<std::string> table_names(cleave_table table);
// owner: a law or a parameter group
std::vector<cleave_parameter> table_parameters(const std::string& owner);
std::vector<cleave_field> table_fields();

}  // namespace cleave::driver
