// `cleave tables`: the other tables, for people and for the reference manual.
#pragma once

#include <string>
#include <vector>

#include "command/table_text.hpp"

namespace cleave::driver {

// fields, materials, formulations, groups, status, units
std::vector<std::string> listed_tables();
// Throws DeckError if there is no table of this name.
std::string table_listing(const std::string& name, TextFormat format);

}  // namespace cleave::driver
