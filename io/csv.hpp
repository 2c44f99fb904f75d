// Text of the CSV files beside record tables; internal to io.
#pragma once

#include <span>
#include <string>

#include "io/record_table.hpp"

namespace cleave::io {

// "name [units],...": one line, fields quoted where they hold a comma, a quote or a line end.
std::string csv_header(std::span<const Column> columns);

// Adds one line a record. Doubles have the fewest digits that read back to the same value ("nan" and
// "inf" as themselves), integer columns no decimals.
void append_csv_records(std::string& text, std::span<const Column> columns,
                        std::span<const double> records);

}  // namespace cleave::io
