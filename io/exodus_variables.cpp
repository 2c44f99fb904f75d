#include "io/exodus_variables.hpp"

#include <array>

#include "io/error.hpp"

namespace cleave::io {
namespace {

struct Shape {
  nc_type type = NC_NAT;
  bool frames = false;                // its first dimension counts the frames
  std::vector<std::int64_t> lengths;  // of the other dimensions
  bool operator==(const Shape&) const = default;
};

Shape shape_of(const NetcdfFile& file, int variable, const std::string& operation) {
  int rank = 0, record = -1;
  Shape shape;
  file.check(nc_inq_unlimdim(file.id(), &record), operation);
  file.check(nc_inq_varndims(file.id(), variable, &rank), operation);
  file.check(nc_inq_vartype(file.id(), variable, &shape.type), operation);
  std::vector<int> dimensions(static_cast<std::size_t>(rank));
  file.check(nc_inq_vardimid(file.id(), variable, dimensions.data()), operation);
  for (const int dimension : dimensions) {
    std::size_t length = 0;
    file.check(nc_inq_dimlen(file.id(), dimension, &length), operation);
    const bool frames = dimension == record;
    if (frames) shape.frames = true;
    if (!frames) shape.lengths.push_back(static_cast<std::int64_t>(length));
  }
  return shape;
}

int find_shaped(const NetcdfFile& file, const std::string& path, const std::string& name,
                const Shape& expected) {
  const std::string operation = "read '" + name + "'";
  int variable = -1;
  file.check(nc_inq_varid(file.id(), name.c_str(), &variable), operation);
  if (shape_of(file, variable, operation) != expected) {
    throw Error(
        path + ": '" + name +
        "' is not as in an Exodus results file; the file is damaged, or Cleave did not write it");
  }
  return variable;
}

}  // namespace

std::int64_t length_of(const NetcdfFile& file, const std::string& name) {
  int dimension = -1;
  const int status = nc_inq_dimid(file.id(), name.c_str(), &dimension);
  if (status == NC_EBADDIM) return 0;
  file.check(status, "read the dimension '" + name + "'");
  std::size_t length = 0;
  file.check(nc_inq_dimlen(file.id(), dimension, &length), "read the dimension '" + name + "'");
  return static_cast<std::int64_t>(length);
}

bool has_variable(const NetcdfFile& file, const std::string& name) {
  int variable = -1;
  return nc_inq_varid(file.id(), name.c_str(), &variable) == NC_NOERR;
}

int find_variable(const NetcdfFile& file, const std::string& path, const std::string& name,
                  nc_type type, std::span<const std::int64_t> lengths) {
  const Shape expected{type, false, {lengths.begin(), lengths.end()}};
  return find_shaped(file, path, name, expected);
}

int find_frame_variable(const NetcdfFile& file, const std::string& path, const std::string& name,
                        std::span<const std::int64_t> lengths) {
  const Shape expected{NC_DOUBLE, true, {lengths.begin(), lengths.end()}};
  return find_shaped(file, path, name, expected);
}

std::vector<std::string> read_names(const NetcdfFile& file, const std::string& path,
                                    const std::string& count_name, const std::string& variable_name,
                                    const std::string& length_name) {
  const std::int64_t count = length_of(file, count_name), length = length_of(file, length_name);
  std::vector<std::string> names;
  if (count == 0) return names;
  const int variable = find_variable(file, path, variable_name, NC_CHAR, std::array{count, length});
  std::string all(static_cast<std::size_t>(count * length), '\0');
  file.check(nc_get_var_text(file.id(), variable, all.data()), "read '" + variable_name + "'");
  for (std::int64_t i = 0; i < count; ++i) {
    const std::string name =
        all.substr(static_cast<std::size_t>(i * length), static_cast<std::size_t>(length));
    names.emplace_back(name.c_str());  // to the end mark
  }
  return names;
}

std::vector<double> read_times(const NetcdfFile& file, const std::string& path,
                               std::int64_t complete) {
  const int variable = find_frame_variable(file, path, "time_whole", {});
  const auto count = static_cast<std::size_t>(complete);
  std::vector<double> times(count);
  const std::size_t start = 0;
  if (count > 0) {
    file.check(nc_get_vara_double(file.id(), variable, &start, &count, times.data()),
               "read the times");
  }
  return times;
}

std::string text_or_empty(const NetcdfFile& file, int variable, const std::string& name) {
  nc_type type = NC_NAT;
  std::size_t length = 0;
  const int status = nc_inq_att(file.id(), variable, name.c_str(), &type, &length);
  return status == NC_NOERR && type == NC_CHAR ? file.text(variable, name) : std::string();
}

}  // namespace cleave::io
