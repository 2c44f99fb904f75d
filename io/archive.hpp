// Named arrays with units in a netCDF file: the form of checkpoints.
//
// CDF-5, self-describing; every array carries units, a description and a checksum; the attributes
// carry a checksum over the header. Written under a temporary name, flushed to disk, read back and
// verified, renamed, directory flushed.
#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace cleave::io {

using ArrayData = std::variant<std::vector<double>, std::vector<std::int64_t>>;

struct NamedArray {
  std::string name;         // letters, digits, '_', '.', '/'; unique in the archive
  std::string units;        // "m", "1", ...
  std::string description;
  std::int64_t components = 1;  // data is (components, n), components fastest
  ArrayData data;
};

using AttributeValue = std::variant<std::string, std::int64_t, double>;

struct Archive {
  std::vector<std::pair<std::string, AttributeValue>> attributes;
  std::vector<NamedArray> arrays;

  const AttributeValue* find_attribute(const std::string& name) const;
  const NamedArray* find_array(const std::string& name) const;
};

// Throws io::Error (disk full, no permission, ...); the file `path`, if there was one, is untouched then.
void write_archive(const std::string& path, const Archive& archive);
// Verifies every checksum; throws io::Error naming the file and the array that fails.
Archive read_archive(const std::string& path);
// The attributes and the arrays' names, units and sizes, without reading or verifying the data.
Archive read_archive_header(const std::string& path);

}  // namespace cleave::io
