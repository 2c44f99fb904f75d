#include "io/record_table.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <set>

#include "io/csv.hpp"
#include "io/error.hpp"
#include "io/netcdf_file.hpp"
#include "io/netcdf_layout.hpp"
#include "io/new_file.hpp"
#include "io/record_file.hpp"

namespace cleave::io {
namespace {

constexpr std::int64_t kFlushRecords = 4096;
constexpr double kLargestInteger = 9007199254740992;  // 2^53: above it doubles skip integers

void check_columns(const std::string& path, const std::vector<Column>& columns) {
  if (columns.empty()) throw Error(path + ": a table needs at least one column");
  std::set<std::string> seen;
  for (const Column& column : columns) {
    if (!seen.insert(column.name).second) {
      throw Error(path + ": two columns have the name '" + column.name + "'; names are unique");
    }
  }
}

void write_empty_table(const std::string& path, const std::vector<Column>& columns,
                       const std::vector<std::pair<std::string, std::string>>& attributes) {
  NewFile new_file(path);
  NetcdfFile file = NetcdfFile::create(new_file.temporary_path());
  for (const auto& [name, text] : attributes) file.put_text(NC_GLOBAL, name, text);
  const int record = file.define_dimension("record", NC_UNLIMITED);
  for (const Column& column : columns) {
    int variable = -1;
    file.check(nc_def_var(file.id(), column.name.c_str(), column.is_integer ? NC_INT64 : NC_DOUBLE,
                          1, &record, &variable),
               "define the column '" + column.name + "'");
    file.put_text(variable, "units", column.units);
    file.put_text(variable, "long_name", column.description);
  }
  file.end_definitions();
  file.close();
  new_file.commit();
}

// Writes `records` (row by row) behind the first `first` records of the file.
void write_records(const std::string& path, const std::vector<Column>& columns, std::int64_t first,
                   std::span<const double> records) {
  const NetcdfLayout layout = read_netcdf_layout(path);
  const std::size_t width = columns.size();
  const Error changed(path + ": was changed while the run wrote it; start the run again");
  if (layout.variables.size() != width || layout.record_bytes != 8 * std::ssize(columns)) {
    throw changed;
  }
  std::vector<std::uint64_t> bits(records.size());  // columns in the order of the file
  for (std::size_t i = 0; i < records.size(); ++i) {
    const std::size_t column = i % width;
    const std::int64_t place = (layout.variables[column].begin - layout.record_begin) / 8;
    if (place >= std::ssize(columns)) throw changed;
    bits[i - column + static_cast<std::size_t>(place)] =
        columns[column].is_integer
            ? static_cast<std::uint64_t>(static_cast<std::int64_t>(records[i]))
            : std::bit_cast<std::uint64_t>(records[i]);
  }
  const std::int64_t end = first + std::ssize(records) / std::ssize(columns);
  RecordFile file(path, layout);
  file.write(layout.record_begin + first * layout.record_bytes, bits);
  file.set_records(end);
  file.close();
}

std::vector<double> read_records(const NetcdfFile& file, std::span<const Column> columns,
                                 std::int64_t first, std::int64_t end) {
  const std::size_t width = columns.size();
  const auto start = static_cast<std::size_t>(first), count = static_cast<std::size_t>(end - first);
  std::vector<double> column(count), records(count * width);
  for (std::size_t c = 0; c < width; ++c) {
    file.check(nc_get_vara_double(file.id(), static_cast<int>(c), &start, &count, column.data()),
               "read the column '" + columns[c].name + "'");
    for (std::size_t r = 0; r < count; ++r) records[r * width + c] = column[r];
  }
  return records;
}

void check_same_columns(const NetcdfFile& file, const std::string& path,
                        const std::vector<Column>& columns) {
  int variables = 0;
  file.check(nc_inq_nvars(file.id(), &variables), "read the header");
  if (variables != std::ssize(columns)) {
    throw Error(path + ": has " + std::to_string(variables) + " columns, this run has " +
                std::to_string(columns.size()) + "; continue with the deck that wrote it");
  }
  for (int c = 0; c < variables; ++c) {
    const Column& column = columns[static_cast<std::size_t>(c)];
    nc_type type = NC_NAT;
    file.check(nc_inq_vartype(file.id(), c, &type), "read the header");
    const std::string name = file.variable_name(c), units = file.text(c, "units");
    if (name != column.name || units != column.units ||
        type != (column.is_integer ? NC_INT64 : NC_DOUBLE)) {
      throw Error(path + ": column " + std::to_string(c + 1) + " is '" + name + " [" + units +
                  "]', this run has '" + column.name + " [" + column.units +
                  "]'; continue with the deck that wrote it");
    }
  }
}

}  // namespace

struct RecordTable::Impl {
  std::string path, csv_path;
  std::vector<Column> columns;
  std::int64_t flushed = 0;               // records in the files
  std::int64_t csv_bytes = 0;             // length of the CSV with them
  std::vector<double> waiting;            // records not in the files, one after the other
  std::int64_t flush_at = kFlushRecords;  // waiting records that start a flush
  bool files_are_whole = true;            // false: a failed flush could not be taken back yet

  std::int64_t waiting_records() const { return std::ssize(waiting) / std::ssize(columns); }

  void flush();
  void write_waiting();
  void restore_files();
  void write_csv();
};

void RecordTable::Impl::flush() {
  if (waiting.empty()) return;
  if (!files_are_whole) restore_files();
  try {
    write_waiting();
  } catch (const Error&) {
    files_are_whole = false;
    flush_at = waiting_records() + kFlushRecords;  // not again at every record
    try {
      restore_files();
    } catch (const Error&) {  // the first error is the one to report
    }
    throw;
  }
  flushed += waiting_records();
  waiting.clear();
  flush_at = kFlushRecords;
}

void RecordTable::Impl::write_waiting() {
  write_records(path, columns, flushed, waiting);
  if (csv_path.empty()) return;
  std::string text;
  append_csv_records(text, columns, waiting);
  append_to_file(csv_path, text);
  csv_bytes += std::ssize(text);
}

// After a failed flush: both files back to the records they had.
void RecordTable::Impl::restore_files() {
  truncate_records(path, flushed);
  if (!csv_path.empty()) set_file_size(csv_path, csv_bytes);
  files_are_whole = true;
}

// The whole CSV from the netCDF file, in blocks.
void RecordTable::Impl::write_csv() {
  const NetcdfFile file = NetcdfFile::open(path);
  NewFile new_file(csv_path);
  create_empty_file(new_file.temporary_path());
  append_to_file(new_file.temporary_path(), csv_header(columns));
  for (std::int64_t first = 0; first < flushed; first += kFlushRecords) {
    const std::int64_t end = std::min(first + kFlushRecords, flushed);
    std::string text;
    append_csv_records(text, columns, read_records(file, columns, first, end));
    append_to_file(new_file.temporary_path(), text);
  }
  csv_bytes = file_size(new_file.temporary_path());
  new_file.commit();
}

RecordTable RecordTable::create(
    const std::string& path, const std::string& csv_path, std::vector<Column> columns,
    const std::vector<std::pair<std::string, std::string>>& attributes) {
  check_columns(path, columns);
  write_empty_table(path, columns, attributes);
  auto impl = std::make_unique<Impl>();
  impl->path = path;
  impl->csv_path = csv_path;
  impl->columns = std::move(columns);
  if (!csv_path.empty()) impl->write_csv();
  return RecordTable(std::move(impl));
}

RecordTable RecordTable::reopen(const std::string& path, const std::string& csv_path,
                                std::vector<Column> columns, std::int64_t records) {
  check_columns(path, columns);
  const NetcdfLayout layout = read_netcdf_layout(path);
  if (layout.version != 5) throw Error(path + ": is not a table written by Cleave; check the name");
  check_same_columns(NetcdfFile::open(path), path, columns);
  truncate_records(path, records);
  auto impl = std::make_unique<Impl>();
  impl->path = path;
  impl->csv_path = csv_path;
  impl->columns = std::move(columns);
  impl->flushed = records;
  if (!csv_path.empty()) impl->write_csv();
  return RecordTable(std::move(impl));
}

RecordTable::RecordTable(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
RecordTable::RecordTable(RecordTable&&) noexcept = default;

RecordTable& RecordTable::operator=(RecordTable&& other) noexcept {
  const RecordTable old(std::move(impl_));  // flushes at the end of this function
  impl_ = std::move(other.impl_);
  return *this;
}

RecordTable::~RecordTable() {
  if (impl_ == nullptr) return;
  try {
    impl_->flush();
  } catch (const Error&) {  // a destructor cannot report; flush() before it can
  }
}

void RecordTable::append(std::span<const double> values) {
  Impl& t = *impl_;
  if (values.size() != t.columns.size()) {
    throw Error(t.path + ": a record has " + std::to_string(values.size()) +
                " values, the table has " + std::to_string(t.columns.size()) + " columns");
  }
  for (std::size_t c = 0; c < values.size(); ++c) {
    const bool is_exact =
        std::fabs(values[c]) <= kLargestInteger && values[c] == std::trunc(values[c]);
    if (t.columns[c].is_integer && !is_exact) {
      throw Error(t.path + ": column '" + t.columns[c].name +
                  "' holds integers up to 2^53; the value given is none of them");
    }
  }
  t.waiting.insert(t.waiting.end(), values.begin(), values.end());
  if (t.waiting_records() >= t.flush_at) t.flush();
}

void RecordTable::flush() { impl_->flush(); }

void RecordTable::sync() {
  impl_->flush();
  sync_file(impl_->path);
  if (!impl_->csv_path.empty()) sync_file(impl_->csv_path);
}

std::int64_t RecordTable::records() const { return impl_->flushed + impl_->waiting_records(); }

}  // namespace cleave::io
