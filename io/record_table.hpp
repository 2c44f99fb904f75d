// A table that grows by records: the form of histories and of the event table.
//
// netCDF (CDF-5, unlimited dimension "record", one variable a column, units and long_name from the
// column) and, if asked, the same records as CSV beside it. Numbers in the CSV read back to the
// same double. Records gather in memory and go to the files with flush(), by themselves after
// every 4096 records, and when the table is destroyed; between flushes no file is open.
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
  bool is_integer = false;  // stored as int64
};

class RecordTable {
 public:
  // Makes new files `path` (netCDF) and, if csv_path is not empty, the CSV; old files of these names
  // are replaced. Throws io::Error.
  static RecordTable create(const std::string& path, const std::string& csv_path,
                            std::vector<Column> columns,
                            const std::vector<std::pair<std::string, std::string>>& attributes);
  // Opens existing files, keeps the first `records` records and drops what follows, so that
  // appending continues exactly there: the bytes are those of a table never longer. The CSV is written
  // anew from the netCDF file. Throws io::Error if there are fewer records, or the columns differ.
  static RecordTable reopen(const std::string& path, const std::string& csv_path,
                            std::vector<Column> columns, std::int64_t records);

  RecordTable(RecordTable&&) noexcept;
  RecordTable& operator=(RecordTable&&) noexcept;
  ~RecordTable();  // flushes; an error then is lost, so call flush() at the end

  // One value a column, in column order; integers are given as doubles that hold them exactly.
  void append(std::span<const double> values);
  // Afterwards readers see every record, and a kill of the process loses none. If it throws (disk
  // full), the files are as before and the records wait in memory for the next flush.
  void flush();
  // flush(), and waits for the disk: the records survive a loss of power. Call it before a checkpoint
  // that counts on them.
  void sync();
  // Appended so far, flushed or not.
  std::int64_t records() const;

 private:
  struct Impl;
  explicit RecordTable(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

}  // namespace cleave::io
