#include "io/netcdf_layout.hpp"

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <optional>

#include "io/error.hpp"
#include "io/new_file.hpp"
#include "io/record_file.hpp"

namespace cleave::io {
namespace {

// Tags of the classic format (netCDF User's Guide, "File Format Specifications").
constexpr std::int64_t kDimensionTag = 10, kVariableTag = 11, kAttributeTag = 12;
constexpr std::int64_t kHuge = std::int64_t{1} << 62;

std::int64_t saturating_product(std::int64_t a, std::int64_t b) {
  if (a == 0 || b == 0) return 0;
  return a > kHuge / b ? kHuge : a * b;
}

std::int64_t saturating_sum(std::int64_t a, std::int64_t b) {
  return a > kHuge - b ? kHuge : a + b;
}

std::int64_t pad_to_four(std::int64_t bytes) { return saturating_sum(bytes, 3) / 4 * 4; }

// Reads a header from its first byte to its last; every length is compared with the file before use.
class HeaderReader {
 public:
  explicit HeaderReader(const std::string& path)
      : path_(path), file_bytes_(io::file_size(path)), stream_(path, std::ios::binary) {
    if (!stream_) throw_system_error(path, "read the file", errno);
  }

  NetcdfLayout read() {
    NetcdfLayout layout;
    layout.version = read_magic();
    version_ = layout.version;
    layout.promised_records = read_count();
    read_dimensions();
    skip_attributes();
    read_variables(layout);
    layout.header_bytes = position_;
    finish(layout);
    return layout;
  }

 private:
  [[noreturn]] void fail(const std::string& what) const {
    throw Error(path_ + ": " + what + " (at byte " + std::to_string(position_) + " of " +
                std::to_string(file_bytes_) + "); the file is damaged or incomplete, use another");
  }

  void need(std::int64_t bytes) const {
    if (bytes < 0 || bytes > file_bytes_ - position_) fail("the header ends early");
  }

  void skip(std::int64_t bytes) {
    need(bytes);
    stream_.ignore(bytes);
    position_ += bytes;
  }

  std::int64_t read_integer(int bytes) {
    std::array<unsigned char, 8> raw{};
    read_raw(raw.data(), bytes);
    std::uint64_t value = 0;
    for (int i = 0; i < bytes; ++i) value = value << 8 | raw[static_cast<std::size_t>(i)];
    if (value > static_cast<std::uint64_t>(kHuge)) fail("impossible number in the header");
    return static_cast<std::int64_t>(value);
  }

  void read_raw(void* target, std::int64_t bytes) {
    need(bytes);
    stream_.read(static_cast<char*>(target), bytes);
    if (stream_.gcount() != bytes) fail("the header cannot be read");
    position_ += bytes;
  }

  std::int64_t read_tag() { return read_integer(4); }
  std::int64_t read_count() { return read_integer(version_ == 5 ? 8 : 4); }
  std::int64_t read_offset() { return read_integer(version_ == 1 ? 4 : 8); }

  int read_magic() {
    std::array<char, 4> magic{};
    if (file_bytes_ < 4)
      throw Error(path_ + ": is not a netCDF file: it is only " + std::to_string(file_bytes_) +
                  " bytes long; check the name");
    read_raw(magic.data(), 4);
    const int version = magic[3];
    if (std::memcmp(magic.data(), "CDF", 3) != 0 ||
        (version != 1 && version != 2 && version != 5)) {
      throw Error(path_ +
                  ": is not a netCDF classic file (it does not begin with 'CDF'); check the name");
    }
    return version;
  }

  std::string read_name() {
    const std::int64_t length = read_count();
    need(length);
    std::string name(static_cast<std::size_t>(length), '\0');
    read_raw(name.data(), length);
    skip(pad_to_four(length) - length);
    return name;
  }

  // The count of a list that is absent (two zeros) or begins with `tag`.
  std::int64_t read_list(std::int64_t tag) {
    const std::int64_t found = read_tag();
    const std::int64_t count = read_count();
    if (found != tag && !(found == 0 && count == 0)) fail("unknown tag in the header");
    return count;
  }

  static std::int64_t type_bytes(std::int64_t type) {
    constexpr std::array<std::int64_t, 12> kBytes{0, 1, 1, 2, 4, 4, 8, 1, 2, 4, 8, 8};
    return type >= 1 && type < 12 ? kBytes[static_cast<std::size_t>(type)] : 0;
  }

  std::int64_t read_type() {
    const std::int64_t bytes = type_bytes(read_tag());
    if (bytes == 0) fail("unknown type in the header");
    return bytes;
  }

  void read_dimensions() {
    const std::int64_t count = read_list(kDimensionTag);
    for (std::int64_t i = 0; i < count; ++i) {
      read_name();
      dimensions_.push_back(read_count());
    }
  }

  void skip_attributes() {
    const std::int64_t count = read_list(kAttributeTag);
    for (std::int64_t i = 0; i < count; ++i) {
      read_name();
      const std::int64_t bytes = read_type();
      skip(pad_to_four(saturating_product(read_count(), bytes)));
    }
  }

  void read_variables(NetcdfLayout& layout) {
    const std::int64_t count = read_list(kVariableTag);
    for (std::int64_t i = 0; i < count; ++i) {
      NetcdfLayout::Variable variable;
      variable.name = read_name();
      std::int64_t values = 1;
      const std::int64_t rank = read_count();
      for (std::int64_t d = 0; d < rank; ++d) {
        const std::int64_t id = read_count();
        if (id >= std::ssize(dimensions_)) fail("unknown dimension in the header");
        const std::int64_t length = dimensions_[static_cast<std::size_t>(id)];
        if (length == 0 && d == 0) {
          variable.is_record = true;
        } else {
          values = saturating_product(values, length);
        }
      }
      skip_attributes();
      const std::int64_t value_bytes = read_type();
      read_count();  // "vsize": redundant, and too small for large variables
      variable.begin = read_offset();
      variable.bytes = saturating_product(values, value_bytes);
      layout.variables.push_back(variable);
    }
  }

  void finish(NetcdfLayout& layout) const {
    std::int64_t record_variables = 0, end = layout.header_bytes;
    for (const auto& variable : layout.variables) {
      if (variable.begin < layout.header_bytes) fail("a variable overlaps the header");
      if (variable.is_record) {
        if (record_variables++ == 0) layout.record_begin = variable.begin;
        layout.record_begin = std::min(layout.record_begin, variable.begin);
        layout.record_bytes = saturating_sum(layout.record_bytes, pad_to_four(variable.bytes));
      } else {
        end = std::max(end, saturating_sum(variable.begin, pad_to_four(variable.bytes)));
      }
    }
    if (record_variables == 1) {  // a lone record variable is stored without padding
      const auto lone = std::find_if(layout.variables.begin(), layout.variables.end(),
                                     [](const auto& variable) { return variable.is_record; });
      layout.record_bytes = lone->bytes;
    }
    if (file_bytes_ < end) {
      throw Error(path_ + ": is truncated: " + std::to_string(file_bytes_) +
                  " bytes, its header promises " + std::to_string(end) +
                  "; it was not written to the end, use another");
    }
    count_records(layout, end);
  }

  void count_records(NetcdfLayout& layout, std::int64_t end) const {
    layout.found_bytes = file_bytes_;
    layout.promised_bytes = end;
    if (layout.record_bytes == 0 || layout.promised_records == 0) return;
    layout.promised_bytes = saturating_sum(
        layout.record_begin, saturating_product(layout.promised_records, layout.record_bytes));
    const std::int64_t stored = std::max<std::int64_t>(0, file_bytes_ - layout.record_begin);
    layout.found_records = std::min(layout.promised_records, stored / layout.record_bytes);
  }

  std::string path_;
  std::int64_t file_bytes_;
  std::ifstream stream_;
  std::int64_t position_ = 0;
  int version_ = 0;
  std::vector<std::int64_t> dimensions_;
};

}  // namespace

const NetcdfLayout::Variable* NetcdfLayout::find(const std::string& name) const {
  const auto found = std::find_if(variables.begin(), variables.end(),
                                  [&](const Variable& variable) { return variable.name == name; });
  return found == variables.end() ? nullptr : &*found;
}

NetcdfLayout read_netcdf_layout(const std::string& path) { return HeaderReader(path).read(); }

void truncate_records(const std::string& path, std::int64_t records) {
  const NetcdfLayout layout = read_netcdf_layout(path);
  if (layout.found_records < records) {
    throw Error(path + ": has " + std::to_string(layout.found_records) + " records, " +
                std::to_string(records) +
                " are needed to continue; it is not the file of that run, or it was changed since");
  }
  // First the count, then the tail: between the two the file is valid, only longer than needed.
  RecordFile file(path, layout);
  file.set_records(records);
  file.set_length(records);
  file.close();
  sync_file(path);
}

}  // namespace cleave::io
