// Text of CSV files: one form for the files beside record tables and for exported results.
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

// Parts of such a line, for tables that also hold texts or gaps.
void append_csv_number(std::string& text, double value, bool is_integer);
std::string csv_field(const std::string& text);

}  // namespace cleave::io
