// What the writer and the reader of archives agree on; internal to io.
//
// Variable 0 is "header_checksum", the CRC-64 of every byte before it; then one variable an array,
// with the CRC-64 of its values in the attribute "checksum". So every byte is covered, and the header is
// verified before the netCDF library interprets it. Arrays without values lie along a record dimension
// without records, because classic netCDF has no other empty dimension.
#pragma once

#include <algorithm>
#include <cstdint>
#include <fstream>
#include <span>
#include <string>
#include <vector>

#include "io/checksum.hpp"
#include "io/error.hpp"

namespace cleave::io::archive_format {

inline constexpr const char* kHeaderChecksum = "header_checksum";  // a variable
inline constexpr const char* kFormat = "archive_format";           // an attribute
inline constexpr const char* kFormatName = "Cleave archive 1";
inline constexpr const char* kChecksum = "checksum";  // an attribute of every array

// Arrays are written, read and verified in blocks of whole rows of about this many values: 1 MiB.
inline constexpr std::int64_t kBlockValues = std::int64_t{1} << 17;

// Calls visit(row, rows) for every block of an array.
template <class Visit>
void for_row_blocks(std::int64_t size, std::int64_t components, Visit visit) {
  const std::int64_t rows = size / components;
  const std::int64_t block = std::max<std::int64_t>(1, kBlockValues / components);
  for (std::int64_t row = 0; row < rows; row += block) visit(row, std::min(block, rows - row));
}

// Of the first `count` bytes of the file.
inline std::uint64_t checksum_of_beginning(const std::string& path, std::int64_t count) {
  std::vector<char> bytes(static_cast<std::size_t>(count));
  std::ifstream stream(path, std::ios::binary);
  if (!stream.read(bytes.data(), count))
    throw Error(path + ": the header of the file cannot be read");
  return crc64(std::as_bytes(std::span(bytes)));
}

}  // namespace cleave::io::archive_format
