// Verifies and reads an archive; archive_format.hpp describes the file.
#include <algorithm>
#include <array>
#include <bit>
#include <charconv>
#include <fstream>
#include <span>

#include "io/archive.hpp"
#include "io/archive_format.hpp"
#include "io/netcdf_file.hpp"
#include "io/netcdf_layout.hpp"
#include "io/new_file.hpp"

namespace cleave::io {

using namespace archive_format;

namespace {

[[noreturn]] void fail(const std::string& path, const std::string& what) {
  throw Error(path + ": " + what + "; this file cannot be used, take another one");
}

std::string name_in_memory(std::string name) {
  std::replace(name.begin(), name.end(), ':', '/');
  return name;
}

std::uint64_t stored_header_checksum(const std::string& path, std::int64_t offset) {
  std::array<unsigned char, 8> raw{};
  std::ifstream stream(path, std::ios::binary);
  stream.seekg(offset);
  if (!stream.read(reinterpret_cast<char*>(raw.data()), 8)) fail(path, "the file cannot be read");
  std::uint64_t value = 0;
  for (const unsigned char byte : raw) value = value << 8 | byte;
  return value;
}

// Everything but the arrays: after this the netCDF library may see the file.
void verify_header(const std::string& path) {
  const NetcdfLayout layout = read_netcdf_layout(path);
  if (layout.version != 5 || layout.variables.empty() ||
      layout.variables.front().name != kHeaderChecksum) {
    fail(path, "is a netCDF file, but not an archive written by Cleave, or its header is damaged");
  }
  if (layout.found_bytes != layout.promised_bytes) {
    fail(path, "is " + std::to_string(layout.found_bytes) + " bytes long, its header promises " +
                   std::to_string(layout.promised_bytes));
  }
  const std::uint64_t stored = stored_header_checksum(path, layout.variables.front().begin);
  const std::uint64_t found = checksum_of_beginning(path, layout.header_bytes);
  if (stored != found) {
    fail(path, "the header is damaged: its checksum is " + checksum_text(found) + ", stored is " +
                   checksum_text(stored));
  }
}

AttributeValue read_attribute(const NetcdfFile& file, const std::string& path,
                              const std::string& name) {
  const std::string operation = "read the attribute '" + name + "'";
  nc_type type = NC_NAT;
  std::size_t length = 0;
  file.check(nc_inq_att(file.id(), NC_GLOBAL, name.c_str(), &type, &length), operation);
  if (type == NC_CHAR) return file.text(NC_GLOBAL, name);
  if (length != 1 || (type != NC_INT64 && type != NC_DOUBLE)) {
    fail(path, "attribute '" + name + "' is neither text nor one number");
  }
  if (type == NC_INT64) {
    std::int64_t value = 0;
    file.check(nc_get_att(file.id(), NC_GLOBAL, name.c_str(), &value), operation);
    return value;
  }
  double value = 0;
  file.check(nc_get_att(file.id(), NC_GLOBAL, name.c_str(), &value), operation);
  return value;
}

std::uint64_t parse_checksum(const std::string& path, const std::string& array,
                             const std::string& text) {
  constexpr std::string_view kPrefix = "crc64:";
  std::uint64_t value = 0;
  const char* end = text.data() + text.size();
  if (!text.starts_with(kPrefix) ||
      std::from_chars(text.data() + kPrefix.size(), end, value, 16).ptr != end) {
    fail(path,
         "array '" + array + "' has the checksum '" + text + "', which this version cannot read");
  }
  return value;
}

ArrayInfo read_info(const NetcdfFile& file, const std::string& path, int variable) {
  ArrayInfo info;
  info.name = name_in_memory(file.variable_name(variable));
  int rank = 0;
  nc_type type = NC_NAT;
  std::array<int, NC_MAX_VAR_DIMS> dimensions{};
  const std::string operation = "read the description of array '" + info.name + "'";
  file.check(nc_inq_varndims(file.id(), variable, &rank), operation);
  if (rank < 1 || rank > 2) fail(path, "array '" + info.name + "' is not one of an archive");
  file.check(nc_inq_var(file.id(), variable, nullptr, &type, nullptr, dimensions.data(), nullptr),
             operation);
  if (type != NC_INT64 && type != NC_DOUBLE)
    fail(path, "array '" + info.name + "' has a foreign type");
  std::array<std::size_t, 2> lengths{1, 1};
  for (std::size_t i = 0; i < static_cast<std::size_t>(rank); ++i) {
    file.check(nc_inq_dimlen(file.id(), dimensions[i], &lengths[i]), operation);
  }
  info.is_integer = type == NC_INT64;
  info.components = static_cast<std::int64_t>(lengths[1]);
  info.size = static_cast<std::int64_t>(lengths[0] * lengths[1]);
  info.units = file.text(variable, "units");
  info.description = file.text(variable, "long_name");
  info.checksum = parse_checksum(path, info.name, file.text(variable, kChecksum));
  return info;
}

ArchiveHeader read_header(const NetcdfFile& file, const std::string& path) {
  ArchiveHeader header;
  int attributes = 0, variables = 0;
  file.check(nc_inq(file.id(), nullptr, &variables, &attributes, nullptr), "read the header");
  for (int i = 0; i < attributes; ++i) {
    std::array<char, NC_MAX_NAME + 1> name{};
    file.check(nc_inq_attname(file.id(), NC_GLOBAL, i, name.data()),
               "read the name of an attribute");
    header.attributes.emplace_back(name.data(), read_attribute(file, path, name.data()));
  }
  if (attributes == 0 || header.attributes.front() != Attribute{kFormat, kFormatName}) {
    throw Error(path + ": is not in the format '" + kFormatName +
                "' that this version reads; use the version of Cleave that wrote it");
  }
  header.attributes.erase(header.attributes.begin());
  for (int variable = 1; variable < variables; ++variable) {
    header.arrays.push_back(read_info(file, path, variable));
  }
  return header;
}

using BytesRead = std::function<void(std::int64_t)>;

// Reads the values of array `variable` in blocks of whole rows and verifies them; keeps them in
// `keep` if that is given.
template <class T>
void read_values(const NetcdfFile& file, const std::string& path, int variable,
                 const ArrayInfo& info, std::vector<T>* keep, const BytesRead& bytes_read = {}) {
  const std::int64_t most = std::max(kBlockValues, info.components);
  std::vector<T> buffer(
      static_cast<std::size_t>(keep != nullptr ? info.size : std::min(info.size, most)));
  std::uint64_t checksum = 0;
  for_row_blocks(info.size, info.components, [&](std::int64_t row, std::int64_t rows) {
    T* target = buffer.data() + (keep != nullptr ? row * info.components : 0);
    const std::array<std::size_t, 2> start{static_cast<std::size_t>(row), 0};
    const std::array<std::size_t, 2> extent{static_cast<std::size_t>(rows),
                                            static_cast<std::size_t>(info.components)};
    file.check(nc_get_vara(file.id(), variable, start.data(), extent.data(), target),
               "read the array '" + info.name + "'");
    const auto values = static_cast<std::size_t>(rows * info.components);
    checksum = crc64(std::span<const T>(target, values), checksum);
    if (bytes_read) bytes_read(static_cast<std::int64_t>(values * sizeof(T)));
  });
  if (checksum != info.checksum) {
    fail(path, "array '" + info.name + "' is damaged: its checksum is " + checksum_text(checksum) +
                   ", stored is " + checksum_text(info.checksum));
  }
  if (keep != nullptr) *keep = std::move(buffer);
}

void verify_array(const NetcdfFile& file, const std::string& path, int variable,
                  const ArrayInfo& info, const BytesRead& bytes_read = {}) {
  if (info.is_integer) {
    read_values<std::int64_t>(file, path, variable, info, nullptr, bytes_read);
  } else {
    read_values<double>(file, path, variable, info, nullptr, bytes_read);
  }
}

template <class T>
NamedArray read_array_of(const NetcdfFile& file, const std::string& path, int variable,
                         const ArrayInfo& info) {
  std::vector<T> values;
  read_values<T>(file, path, variable, info, &values);
  return {info.name, info.units, info.description, info.components, std::move(values)};
}

NamedArray read_array(const NetcdfFile& file, const std::string& path, int variable,
                      const ArrayInfo& info) {
  return info.is_integer ? read_array_of<std::int64_t>(file, path, variable, info)
                         : read_array_of<double>(file, path, variable, info);
}

}  // namespace

const AttributeValue* ArchiveHeader::find_attribute(const std::string& name) const {
  for (const auto& [key, value] : attributes) {
    if (key == name) return &value;
  }
  return nullptr;
}

const ArrayInfo* ArchiveHeader::find_array(const std::string& name) const {
  for (const ArrayInfo& array : arrays) {
    if (array.name == name) return &array;
  }
  return nullptr;
}

Archive read_archive(const std::string& path) {
  verify_header(path);
  const NetcdfFile file = NetcdfFile::open(path);
  ArchiveHeader header = read_header(file, path);
  Archive archive;
  archive.attributes = std::move(header.attributes);
  for (int i = 0; i < static_cast<int>(header.arrays.size()); ++i) {
    archive.arrays.push_back(
        read_array(file, path, i + 1, header.arrays[static_cast<std::size_t>(i)]));
  }
  return archive;
}

NamedArray read_archive_array(const std::string& path, const std::string& name) {
  verify_header(path);
  const NetcdfFile file = NetcdfFile::open(path);
  const ArchiveHeader header = read_header(file, path);
  const ArrayInfo* info = header.find_array(name);
  if (info == nullptr) fail(path, "has no array '" + name + "'");
  return read_array(file, path, 1 + static_cast<int>(info - header.arrays.data()), *info);
}

void verify_archive(const std::string& path) {
  verify_header(path);
  const NetcdfFile file = NetcdfFile::open(path);
  const ArchiveHeader header = read_header(file, path);
  for (int i = 0; i < static_cast<int>(header.arrays.size()); ++i)
    verify_array(file, path, i + 1, header.arrays[static_cast<std::size_t>(i)]);
}

std::vector<std::string> archive_damage(const std::string& path, const VerifyProgress& progress) {
  file_size(path);  // that there is a file
  std::vector<std::string> damage;
  try {
    verify_header(path);
    const NetcdfFile file = NetcdfFile::open(path);
    const ArchiveHeader header = read_header(file, path);
    std::int64_t all = 0, done = 0;
    for (const ArrayInfo& info : header.arrays) all += 8 * info.size;
    const BytesRead count = [&](std::int64_t bytes) {
      done += bytes;
      if (progress) progress(done, all);
    };
    for (int i = 0; i < static_cast<int>(header.arrays.size()); ++i) {
      try {
        verify_array(file, path, i + 1, header.arrays[static_cast<std::size_t>(i)], count);
      } catch (const Error& error) {
        damage.emplace_back(error.what());
      }
    }
  } catch (const Error& error) {
    damage.emplace_back(error.what());
  }
  return damage;
}

ArchiveHeader read_archive_header(const std::string& path) {
  verify_header(path);
  return read_header(NetcdfFile::open(path), path);
}

}  // namespace cleave::io
