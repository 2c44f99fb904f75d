// Checks and writes an archive; archive_format.hpp describes the file.
#include "io/archive.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <map>
#include <set>
#include <span>

#include "io/archive_format.hpp"
#include "io/netcdf_file.hpp"
#include "io/netcdf_layout.hpp"
#include "io/new_file.hpp"

namespace cleave::io {
using namespace archive_format;

namespace {

// netCDF forbids '/' in names.
std::string name_in_file(std::string name) {
  std::replace(name.begin(), name.end(), '/', ':');
  return name;
}

// The checksums are not known yet.
ArchiveHeader describe(const ArchiveSource& archive) {
  ArchiveHeader header{archive.attributes, {}};
  for (const ArraySource& array : archive.arrays) {
    const bool is_integer = std::holds_alternative<ReadValues<std::int64_t>>(array.read);
    header.arrays.push_back(
        {array.name, array.units, array.description, is_integer, array.components, array.size, 0});
  }
  return header;
}

// Bit for bit: a number that is not a number equals itself.
bool same_value(const AttributeValue& a, const AttributeValue& b) {
  const auto *x = std::get_if<double>(&a), *y = std::get_if<double>(&b);
  if (x == nullptr || y == nullptr) return a == b;
  return std::bit_cast<std::uint64_t>(*x) == std::bit_cast<std::uint64_t>(*y);
}

bool same_header(const ArchiveHeader& a, const ArchiveHeader& b) {
  return a.arrays == b.arrays &&
         std::equal(a.attributes.begin(), a.attributes.end(), b.attributes.begin(),
                    b.attributes.end(), [](const Attribute& x, const Attribute& y) {
                      return x.first == y.first && same_value(x.second, y.second);
                    });
}

// ---- checks before writing -------------------------------------------------------------------

void check_name(const std::string& path, const std::string& what, const std::string& name,
                bool slash_allowed) {
  const auto is_word = [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_';
  };
  const auto allowed = [&](char c) {
    return is_word(c) || c == '.' || c == '-' || c == '@' || c == '+' ||
           (slash_allowed && c == '/');
  };
  if (name.empty() || name.size() > 255 || !is_word(name.front()) ||
      !std::all_of(name.begin(), name.end(), allowed)) {
    throw Error(path + ": " + what + " '" + name +
                "' has a name that cannot be stored; allowed are at most 255 letters, digits and _ "
                ". - @ + " +
                (slash_allowed ? "/ " : "") + "beginning with a letter, a digit or _");
  }
}

void check_unique(const std::string& path, const std::string& what, const std::string& name,
                  std::set<std::string>& seen) {
  if (!seen.insert(name).second) {
    throw Error(path + ": " + what + " '" + name +
                "' occurs twice, or its name is reserved; names in an archive are unique");
  }
}

void check_archive(const std::string& path, const ArchiveSource& archive) {
  std::set<std::string> seen{kFormat};
  for (const auto& [name, value] : archive.attributes) {
    check_name(path, "attribute", name, false);
    check_unique(path, "attribute", name, seen);
  }
  seen = {kHeaderChecksum};
  for (const ArraySource& array : archive.arrays) {
    check_name(path, "array", array.name, true);
    check_unique(path, "array", array.name, seen);
    if (array.components < 1 || array.size % array.components != 0) {
      throw Error(path + ": array '" + array.name + "' has " + std::to_string(array.size) +
                  " values, which is not a multiple of its " + std::to_string(array.components) +
                  " components");
    }
  }
}

// ---- writing ---------------------------------------------------------------------------------

class Dimensions {
 public:
  explicit Dimensions(const NetcdfFile& file) : file_(file) {}

  // The netCDF dimensions of an array, slowest first.
  std::vector<int> of(const ArrayInfo& array) {
    const std::int64_t rows = array.size / array.components;
    std::vector<int> ids;
    ids.push_back(rows == 0 ? get("empty", NC_UNLIMITED)
                            : get("size_" + std::to_string(rows), rows));
    if (array.components > 1) {
      ids.push_back(get("components_" + std::to_string(array.components), array.components));
    }
    return ids;
  }

 private:
  int get(const std::string& name, std::int64_t length) {
    const auto found = ids_.find(name);
    if (found != ids_.end()) return found->second;
    return ids_[name] = file_.define_dimension(name, length);
  }

  const NetcdfFile& file_;
  std::map<std::string, int> ids_;
};

void put_attribute(const NetcdfFile& file, const std::string& name, const AttributeValue& value) {
  if (const auto* text = std::get_if<std::string>(&value)) {
    file.put_text(NC_GLOBAL, name, *text);
    return;
  }
  int status = NC_NOERR;
  if (const auto* integer = std::get_if<std::int64_t>(&value)) {
    const long long number = *integer;
    status = nc_put_att_longlong(file.id(), NC_GLOBAL, name.c_str(), NC_INT64, 1, &number);
  } else {
    status = nc_put_att_double(file.id(), NC_GLOBAL, name.c_str(), NC_DOUBLE, 1,
                               &std::get<double>(value));
  }
  file.check(status, "define the attribute '" + name + "'");
}

int define_variable(const NetcdfFile& file, const std::string& name, bool is_integer,
                    const std::vector<int>& dimensions) {
  int variable = -1;
  file.check(nc_def_var(file.id(), name.c_str(), is_integer ? NC_INT64 : NC_DOUBLE,
                        static_cast<int>(dimensions.size()), dimensions.data(), &variable),
             "define the array '" + name + "'");
  return variable;
}

void define_header(const NetcdfFile& file, const ArchiveHeader& header) {
  file.put_text(NC_GLOBAL, kFormat, kFormatName);
  for (const auto& [name, value] : header.attributes) put_attribute(file, name, value);
  const int checksum = define_variable(file, kHeaderChecksum, true, {});
  file.put_text(checksum, "long_name",
                "CRC-64/XZ of all bytes of this file before this variable; attributes 'checksum': "
                "CRC-64/XZ of the values of an array, least significant byte first");
  Dimensions dimensions(file);
  for (const ArrayInfo& array : header.arrays) {
    const int variable =
        define_variable(file, name_in_file(array.name), array.is_integer, dimensions.of(array));
    file.put_text(variable, "units", array.units);
    file.put_text(variable, "long_name", array.description);
    file.put_text(variable, kChecksum, checksum_text(array.checksum));
  }
  file.end_definitions();
}

// Writes the values of array `variable` and returns their checksum.
template <class T>
std::uint64_t write_values(const NetcdfFile& file, int variable, const ArraySource& array,
                           const ReadValues<T>& read) {
  const std::int64_t most = std::max(kBlockValues, array.components);
  std::vector<T> buffer(static_cast<std::size_t>(std::min(array.size, most)));
  std::uint64_t checksum = 0;
  for_row_blocks(array.size, array.components, [&](std::int64_t row, std::int64_t rows) {
    const std::span values =
        std::span(buffer).first(static_cast<std::size_t>(rows * array.components));
    read(row * array.components, values);
    checksum = crc64(std::span<const T>(values), checksum);
    const std::array<std::size_t, 2> start{static_cast<std::size_t>(row), 0};
    const std::array<std::size_t, 2> extent{static_cast<std::size_t>(rows),
                                            static_cast<std::size_t>(array.components)};
    file.check(nc_put_vara(file.id(), variable, start.data(), extent.data(), values.data()),
               "write the array '" + array.name + "'");
  });
  return checksum;
}

// Sets the checksums in the header, which are known when the values have been written; as texts of one
// length they fit where they were defined.
void write_contents(const std::string& path, ArchiveHeader& header, const ArchiveSource& archive) {
  NetcdfFile file = NetcdfFile::create(path);
  define_header(file, header);
  const auto put_header_checksum = [&](std::uint64_t checksum) {
    const auto value = std::bit_cast<long long>(checksum);
    file.check(nc_put_var_longlong(file.id(), 0, &value), "write the checksum of the header");
  };
  put_header_checksum(0);
  for (std::size_t i = 0; i < archive.arrays.size(); ++i) {
    const ArraySource& array = archive.arrays[i];
    const int variable = static_cast<int>(i) + 1;
    header.arrays[i].checksum = std::visit(
        [&](const auto& read) { return write_values(file, variable, array, read); }, array.read);
    file.put_text(variable, kChecksum, checksum_text(header.arrays[i].checksum));
  }
  file.check(nc_sync(file.id()), "write the file");
  put_header_checksum(checksum_of_beginning(path, read_netcdf_layout(path).header_bytes));
  file.close();
}

template <class T>
ArraySource source_of(const NamedArray& array, const std::vector<T>& data) {
  const ReadValues<T> read = [&data](std::int64_t first, std::span<T> values) {
    std::copy_n(data.begin() + first, values.size(), values.begin());
  };
  return {array.name, array.units, array.description, array.components, std::ssize(data), read};
}

}  // namespace

const AttributeValue* Archive::find_attribute(const std::string& name) const {
  for (const auto& [key, value] : attributes) {
    if (key == name) return &value;
  }
  return nullptr;
}

const NamedArray* Archive::find_array(const std::string& name) const {
  for (const NamedArray& array : arrays) {
    if (array.name == name) return &array;
  }
  return nullptr;
}

void write_archive(const std::string& path, const Archive& archive) {
  ArchiveSource source{archive.attributes, {}};
  for (const NamedArray& array : archive.arrays) {
    source.arrays.push_back(
        std::visit([&](const auto& data) { return source_of(array, data); }, array.data));
  }
  write_archive_in_blocks(path, source);
}

void write_archive_in_blocks(const std::string& path, const ArchiveSource& archive) {
  check_archive(path, archive);
  ArchiveHeader header = describe(archive);
  NewFile file(path);
  write_contents(file.temporary_path(), header, archive);
  sync_file_and_drop_cache(file.temporary_path());
  verify_archive(file.temporary_path());
  // The checksum of the header was made from the file, so the header itself is compared, too.
  if (!same_header(read_archive_header(file.temporary_path()), header)) {
    throw Error(path +
                ": was not written as it should be: its header reads back differently; write to "
                "another disk and have this one checked");
  }
  file.commit();
}

}  // namespace cleave::io
