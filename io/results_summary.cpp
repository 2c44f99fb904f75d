// What an Exodus results file holds, read with netCDF alone: a foreign or damaged file must give
// a message, and the Exodus library trusts what it reads.
#include "io/error.hpp"
#include "io/exodus_variables.hpp"
#include "io/netcdf_layout.hpp"
#include "io/results.hpp"

namespace cleave::io {

ResultSummary summarise_results(const std::string& path) {
  const NetcdfLayout layout = read_netcdf_layout(path);
  const NetcdfFile file = NetcdfFile::open(path);
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
