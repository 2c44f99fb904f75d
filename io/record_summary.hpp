// What a record table (a history, an event table) holds, without its records: for `cleave info`.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "io/record_table.hpp"

namespace cleave::io {

struct RecordSummary {
  std::int64_t records = 0;
  std::vector<Column> columns;
  // Value of every column in the first and in the last record; empty without records.
  std::vector<double> first, last;
};

// Throws io::Error if the file cannot be read or is no record table.
RecordSummary summarise_records(const std::string& path);

}  // namespace cleave::io
