// Writes records into a netCDF classic file in place, byte by byte as its layout says.
//
// Not through the netCDF library: after a write that failed half way its buffer goes to a wrong place of the
// file at the next attempt, which destroys records that were good, and closing a file does not say so. Here
// values come first and their number last, so that a kill in between leaves a shorter file, not a false one.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "io/netcdf_layout.hpp"

namespace cleave::io {

class RecordFile {
 public:
  RecordFile(const std::string& path, const NetcdfLayout& layout);
  RecordFile(const RecordFile&) = delete;
  RecordFile& operator=(const RecordFile&) = delete;
  ~RecordFile();

  // Values of eight bytes, as 64-bit patterns, from byte `place` on.
  void write(std::int64_t place, std::span<const std::uint64_t> values);
  void write(std::int64_t place, std::span<const double> values);
  // The length of a file with so many records.
  void set_length(std::int64_t records);
  void set_records(std::int64_t records);
  void close();

 private:
  template <class T>
  void write_words(std::int64_t place, std::span<const T> values);
  void write_bytes(std::int64_t place, std::span<const char> bytes);

  std::string path_;
  int version_;
  std::int64_t record_begin_, record_bytes_;
  int fd_;
  std::vector<std::uint64_t> words_;  // on their way to the file
};

}  // namespace cleave::io
