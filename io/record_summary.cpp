#include "io/record_summary.hpp"

#include <netcdf.h>

#include <algorithm>

#include "io/error.hpp"
#include "io/netcdf_file.hpp"
#include "io/netcdf_layout.hpp"

namespace cleave::io {
namespace {

Column read_column(const NetcdfFile& file, int variable) {
  nc_type type = NC_NAT;
  file.check(nc_inq_vartype(file.id(), variable, &type), "ask for the type of a column");
  return {file.variable_name(variable), file.text(variable, "units"),
          file.text(variable, "long_name"), type == NC_INT64};
}

double read_value(const NetcdfFile& file, int variable, std::int64_t record) {
  const auto at = static_cast<std::size_t>(record);
  double value = 0;
  file.check(nc_get_var1_double(file.id(), variable, &at, &value), "read a record");
  return value;
}

}  // namespace

RecordSummary summarise_records(const std::string& path) {
  const NetcdfLayout layout = read_netcdf_layout(path);
  for (const NetcdfLayout::Variable& variable : layout.variables)
    if (!variable.is_record) throw Error(path + ": is not a table of records");
  if (layout.variables.empty()) throw Error(path + ": is not a table of records: no columns");
  const NetcdfFile file = NetcdfFile::open(path);
  RecordSummary summary;
  // A kill while records are written can leave fewer than the header promises.
  summary.records = std::min(layout.promised_records, layout.found_records);
  for (int v = 0; v < static_cast<int>(layout.variables.size()); ++v) {
    summary.columns.push_back(read_column(file, v));
    if (summary.records == 0) continue;
    summary.first.push_back(read_value(file, v, 0));
    summary.last.push_back(read_value(file, v, summary.records - 1));
  }
  return summary;
}

}  // namespace cleave::io
