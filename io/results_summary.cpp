// What an Exodus results file holds, read with netCDF alone: a foreign or damaged file must give
// a message, and the Exodus library trusts what it reads.
#include <algorithm>
#include <array>

#include "io/error.hpp"
#include "io/netcdf_file.hpp"
#include "io/netcdf_layout.hpp"
#include "io/results.hpp"

namespace cleave::io {
namespace {

// The length of a dimension; 0 if the file does not have it (Exodus leaves out what is empty).
std::int64_t length_of(const NetcdfFile& file, const std::string& name) {
  int dimension = -1;
  const int status = nc_inq_dimid(file.id(), name.c_str(), &dimension);
  if (status == NC_EBADDIM) return 0;
  file.check(status, "read the dimension '" + name + "'");
  std::size_t length = 0;
  file.check(nc_inq_dimlen(file.id(), dimension, &length), "read the dimension '" + name + "'");
  return static_cast<std::int64_t>(length);
}

// The variable `name` if it has the type and lengths expected; throws otherwise.
int find_variable(const NetcdfFile& file, const std::string& path, const std::string& name,
                  nc_type type, std::span<const std::int64_t> lengths) {
  const std::string operation = "read '" + name + "'";
  int variable = -1, rank = 0;
  nc_type found = NC_NAT;
  file.check(nc_inq_varid(file.id(), name.c_str(), &variable), operation);
  file.check(nc_inq_varndims(file.id(), variable, &rank), operation);
  file.check(nc_inq_vartype(file.id(), variable, &found), operation);
  bool as_expected = rank == std::ssize(lengths) && found == type;
  if (as_expected) {
    std::vector<int> dimensions(lengths.size());
    file.check(nc_inq_vardimid(file.id(), variable, dimensions.data()), operation);
    for (std::size_t i = 0; i < lengths.size(); ++i) {
      std::size_t length = 0;
      file.check(nc_inq_dimlen(file.id(), dimensions[i], &length), operation);
      as_expected = as_expected && static_cast<std::int64_t>(length) == lengths[i];
    }
  }
  if (!as_expected) {
    throw Error(
        path + ": '" + name +
        "' is not as in an Exodus results file; the file is damaged, or Cleave did not write it");
  }
  return variable;
}

std::vector<std::string> read_names(const NetcdfFile& file, const std::string& path,
                                    const std::string& count_name,
                                    const std::string& variable_name) {
  const std::int64_t count = length_of(file, count_name), length = length_of(file, "len_name");
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
  const int variable =
      find_variable(file, path, "time_whole", NC_DOUBLE, std::array{length_of(file, "time_step")});
  const auto count = static_cast<std::size_t>(complete);
  std::vector<double> times(count);
  const std::size_t start = 0;
  if (count > 0) {
    file.check(nc_get_vara_double(file.id(), variable, &start, &count, times.data()),
               "read the times");
  }
  return times;
}

}  // namespace

ResultSummary summarise_results(const std::string& path) {
  const NetcdfLayout layout = read_netcdf_layout(path);
  const NetcdfFile file = NetcdfFile::open(path, NetcdfFile::Access::read);
  ResultSummary summary;
  summary.points = length_of(file, "num_nodes");
  summary.dimension = static_cast<int>(length_of(file, "num_dim"));
  if (summary.points == 0 || summary.dimension < 1 || summary.dimension > 3) {
    throw Error(path + ": is a netCDF file, but not an Exodus results file; check the name");
  }
  summary.title = file.text(NC_GLOBAL, "title").c_str();  // stored with its end mark
  summary.elements = length_of(file, "num_elem");
  summary.times = read_times(file, path, layout.found_records);
  summary.nodal = read_names(file, path, "num_nod_var", "name_nod_var");
  summary.element = read_names(file, path, "num_elem_var", "name_elem_var");
  summary.global = read_names(file, path, "num_glo_var", "name_glo_var");
  return summary;
}

}  // namespace cleave::io
