// Reads dimensions and variables of a netCDF file, each checked for size.
#include "io/exodus_mesh_input.hpp"

#include <netcdf.h>

#include <string_view>
#include <utility>

#include "io/error.hpp"

namespace cleave::io {
namespace {

// std::int64_t is one of the two, which one depends on the machine.
[[maybe_unused]] int get_all(int file, int variable, long* values) {
  return nc_get_var_long(file, variable, values);
}
[[maybe_unused]] int get_all(int file, int variable, long long* values) {
  return nc_get_var_longlong(file, variable, values);
}

}  // namespace

NetcdfInput::NetcdfInput(std::string path, std::size_t file_size)
    : path_(std::move(path)), file_size_(file_size) {
  if (const int status = nc_open(path_.c_str(), NC_NOWRITE, &id_); status != NC_NOERR)
    throw Error(path_ + ": not a readable netCDF file: " + nc_strerror(status) +
                "; the file is truncated or damaged, write it again");
}

NetcdfInput::~NetcdfInput() { nc_close(id_); }

void NetcdfInput::fail(const std::string& what) const { throw Error(path_ + ": " + what); }

void NetcdfInput::check(int status, const std::string& variable) const {
  if (status != NC_NOERR) fail("variable " + variable + " cannot be read: " + nc_strerror(status));
}

std::optional<std::int64_t> NetcdfInput::dimension(const std::string& name) const {
  int dimension = 0;
  std::size_t length = 0;
  if (nc_inq_dimid(id_, name.c_str(), &dimension) != NC_NOERR ||
      nc_inq_dimlen(id_, dimension, &length) != NC_NOERR)
    return std::nullopt;
  if (length > most_values())
    fail("dimension " + name + " is longer than the file can hold: it is damaged");
  return static_cast<std::int64_t>(length);
}

int NetcdfInput::variable_id(const std::string& name) const {
  int variable = -1;
  return nc_inq_varid(id_, name.c_str(), &variable) == NC_NOERR ? variable : -1;
}

bool NetcdfInput::has_variable(const std::string& name) const { return variable_id(name) >= 0; }

int NetcdfInput::require(const std::string& name) const {
  const int variable = variable_id(name);
  if (variable < 0) fail("variable " + name + " is missing: the Exodus file is incomplete");
  return variable;
}

std::vector<std::int64_t> NetcdfInput::shape(const std::string& variable) const {
  const int id = require(variable);
  int rank = 0;
  check(nc_inq_varndims(id_, id, &rank), variable);
  std::vector<int> dimensions(static_cast<std::size_t>(rank));
  check(nc_inq_vardimid(id_, id, dimensions.data()), variable);
  std::vector<std::int64_t> lengths;
  for (const int dimension : dimensions) {
    std::size_t length = 0;
    check(nc_inq_dimlen(id_, dimension, &length), variable);
    lengths.push_back(static_cast<std::int64_t>(length));
  }
  return lengths;
}

std::size_t NetcdfInput::most_values() const {
  // No compression of netCDF-4 exceeds that of deflate, 1032 to 1; classic files are not
  // compressed.
  constexpr std::size_t kCompression = 1032;
  return file_size_ * kCompression;
}

std::size_t NetcdfInput::checked_size(const std::string& variable) const {
  const std::size_t most = most_values();
  std::size_t size = 1;
  for (const std::int64_t length : shape(variable)) {
    if (length > 0 && size > most / static_cast<std::size_t>(length))
      fail("variable " + variable + " claims more values than the file can hold: it is damaged");
    size *= static_cast<std::size_t>(length);
  }
  return size;
}

std::vector<std::int64_t> NetcdfInput::integers(const std::string& variable) const {
  const int id = require(variable);
  std::vector<std::int64_t> values(checked_size(variable));
  check(get_all(id_, id, values.data()), variable);
  return values;
}

std::vector<double> NetcdfInput::reals(const std::string& variable) const {
  const int id = require(variable);
  std::vector<double> values(checked_size(variable));
  check(nc_get_var_double(id_, id, values.data()), variable);
  return values;
}

std::vector<std::string> NetcdfInput::texts(const std::string& variable) const {
  const int id = require(variable);
  const std::vector<std::int64_t> lengths = shape(variable);
  if (lengths.size() != 2) fail("variable " + variable + " should be a table of characters");
  std::string all(checked_size(variable), '\0');
  check(nc_get_var_text(id_, id, all.data()), variable);
  const auto width = static_cast<std::size_t>(lengths[1]);
  std::vector<std::string> rows;
  for (std::size_t row = 0; row < static_cast<std::size_t>(lengths[0]); ++row) {
    std::string_view text(all.data() + row * width, width);
    text = text.substr(0, text.find('\0'));
    while (!text.empty() && text.back() == ' ') text.remove_suffix(1);
    rows.emplace_back(text);
  }
  return rows;
}

std::string NetcdfInput::text_attribute(const std::string& variable,
                                        const std::string& attribute) const {
  const int id = require(variable);
  nc_type type = NC_NAT;
  std::size_t length = 0;
  if (nc_inq_att(id_, id, attribute.c_str(), &type, &length) != NC_NOERR || type != NC_CHAR)
    return "";
  constexpr std::size_t kLongest = 4096;
  if (length > kLongest) return "";
  std::string text(length, '\0');
  check(nc_get_att_text(id_, id, attribute.c_str(), text.data()), variable);
  return text.substr(0, text.find('\0'));
}

}  // namespace cleave::io
