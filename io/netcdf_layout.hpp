// Where things lie in a netCDF classic file (CDF-1, CDF-2, CDF-5), read from its bytes.
//
// For two jobs that the netCDF library does not do: to judge a file before the library sees it
// (garbage, truncated, too long), and to cut a growing file back to its first records in place, so
// that its bytes are those of a file that never was longer. Values are read through netcdf_file.hpp.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace cleave::io {

struct NetcdfLayout {
  struct Variable {
    std::string name;
    bool is_record = false;
    std::int64_t begin = 0;  // offset of its first byte
    std::int64_t bytes = 0;  // of the whole variable, or of one record
  };
  int version = 0;  // 1, 2 or 5
  std::int64_t header_bytes = 0;
  std::int64_t record_begin = 0;  // offset of record 0; 0 without record variables
  std::int64_t record_bytes = 0;  // one record of all record variables
  std::int64_t promised_records = 0, promised_bytes = 0;  // by the header
  std::int64_t found_records = 0, found_bytes = 0;        // whole records, length of the file
  std::vector<Variable> variables;

  const Variable* find(const std::string& name) const;  // nullptr if absent
  // The first byte of a record variable's values in record `record`, from 0.
  std::int64_t place(const Variable& variable, std::int64_t record) const {
    return variable.begin + record * record_bytes;
  }
};

// Throws io::Error if the file cannot be read, is not netCDF classic, contradicts itself, or ends
// before its first record. A kill while records are written can leave a file that promises more
// records than it has.
NetcdfLayout read_netcdf_layout(const std::string& path);

// Keeps the first `records` records, and waits for the disk. Interrupted at any point, it can be
// repeated. Throws io::Error if the file has fewer.
void truncate_records(const std::string& path, std::int64_t records);

}  // namespace cleave::io
