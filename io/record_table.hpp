// A table that grows by records: the form of histories and of the event table.
//
// netCDF (64-bit offset classic, unlimited dimension "record", one variable a column, units and
// long_name from the column) and, if asked, the same records as CSV beside it. Numbers in the CSV read
// back to the same double.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace cleave::io {

struct Column {
  std::string name, units, description;
  bool is_integer = false;  // stored as int64 in CDF-5
};

class RecordTable {
 public:
  // Makes new files `path` (netCDF) and, if csv_path is not empty, the CSV. Throws io::Error.
  static RecordTable create(const std::string& path, const std::string& csv_path, std::vector<Column> columns,
                            const std::vector<std::pair<std::string, std::string>>& attributes);
  // Opens existing files, keeps the first `records` records and drops what follows, so that
  // appending continues exactly there: the bytes are those of a table never longer. Throws io::Error if
  // there are fewer, or the columns differ.
  static RecordTable reopen(const std::string& path, const std::string& csv_path, std::vector<Column> columns,
                            std::int64_t records);

  RecordTable(RecordTable&&) noexcept;
  RecordTable& operator=(RecordTable&&) noexcept;
  ~RecordTable();

  // One value a column, in column order; integers are given as doubles that hold them exactly.
  void append(std::span<const double> values);
  void flush();
  std::int64_t records() const;

 private:
  struct Impl;
  explicit RecordTable(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

}  // namespace cleave::io
