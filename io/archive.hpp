// Named arrays with units in a netCDF file: the form of checkpoints.
//
// CDF-5, self-describing; every array carries units, a description and a checksum, and the variable
// "header_checksum" covers everything else in the file. Written under a temporary name, flushed to
// disk, read back and verified, renamed, directory flushed. The same archive gives the same bytes.
// Arrays can be written and read one block or one array at a time; results over time are results.hpp.
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace cleave::io {

using ArrayData = std::variant<std::vector<double>, std::vector<std::int64_t>>;

// Names of arrays: letters, digits, '_', '.', '-', '/', '@', '+', beginning with a letter, a digit or '_';
// unique in the archive, at most 255 characters. In the file '/' is written ':' (netCDF forbids '/').
struct NamedArray {
  std::string name;
  std::string units;  // "m", "1", ...
  std::string description;
  std::int64_t components = 1;  // data is (components, n), components fastest
  ArrayData data;
};

using AttributeValue = std::variant<std::string, std::int64_t, double>;
using Attribute = std::pair<std::string, AttributeValue>;

struct Archive {
  std::vector<Attribute> attributes;  // names by the rules for arrays, without '/'
  std::vector<NamedArray> arrays;

  const AttributeValue* find_attribute(const std::string& name) const;  // nullptr if absent
  const NamedArray* find_array(const std::string& name) const;          // nullptr if absent
};

// Puts values first, first + 1, ... of an array into the span, which holds whole rows of components.
template <class T>
using ReadValues = std::function<void(std::int64_t first, std::span<T> values)>;

// An array that is written in blocks and need not be in memory as a whole.
struct ArraySource {
  std::string name, units, description;  // as in NamedArray
  std::int64_t components = 1;
  std::int64_t size = 0;  // values, all components together
  std::variant<ReadValues<double>, ReadValues<std::int64_t>> read;
};

struct ArchiveSource {
  std::vector<Attribute> attributes;
  std::vector<ArraySource> arrays;
};

// An archive without its data.
struct ArrayInfo {
  std::string name, units, description;
  bool is_integer = false;
  std::int64_t components = 1;
  std::int64_t size = 0;       // values, all components together
  std::uint64_t checksum = 0;  // CRC-64/XZ of the values (io/checksum.hpp)

  bool operator==(const ArrayInfo&) const = default;
};

struct ArchiveHeader {
  std::vector<Attribute> attributes;
  std::vector<ArrayInfo> arrays;

  const AttributeValue* find_attribute(const std::string& name) const;  // nullptr if absent
  const ArrayInfo* find_array(const std::string& name) const;           // nullptr if absent
};

// Throws io::Error (disk full, no permission, ...); a file that was at `path` is untouched then.
// A killed write leaves at most `path`.part, which the next write to `path` replaces.
void write_archive(const std::string& path, const Archive& archive);
// The same bytes from blocks: memory for one block, whatever the size. Every block is read once.
void write_archive_in_blocks(const std::string& path, const ArchiveSource& archive);

// Verifies every checksum; throws io::Error naming the file and the array that fails.
Archive read_archive(const std::string& path);

// As read_archive, but keeps nothing: memory for one block of one array, whatever the size.
void verify_archive(const std::string& path);

// Bytes of the arrays verified so far, and in all.
using VerifyProgress = std::function<void(std::int64_t done, std::int64_t all)>;
// Goes on after an array that fails: a message for each, none if the archive is good. A header that
// fails is one message, and nothing else can be verified then. Throws io::Error if there is no file.
std::vector<std::string> archive_damage(const std::string& path,
                                        const VerifyProgress& progress = {});

// One array; the header and that array are verified. Throws io::Error if there is none of that name.
NamedArray read_archive_array(const std::string& path, const std::string& name);

// The header is verified, the arrays are neither read nor verified.
ArchiveHeader read_archive_header(const std::string& path);

}  // namespace cleave::io
