#include "io/results_read.hpp"

#include <array>
#include <numeric>

#include "io/error.hpp"
#include "io/exodus_variables.hpp"
#include "io/netcdf_layout.hpp"

namespace cleave::io {
namespace {

std::string nodal_name(std::size_t variable) {
  return "vals_nod_var" + std::to_string(variable + 1);
}

std::string element_name(std::size_t variable, std::size_t block) {
  return "vals_elem_var" + std::to_string(variable + 1) + "eb" + std::to_string(block + 1);
}

std::vector<double> read_axis(const NetcdfFile& file, const StoredResults& results,
                              const std::string& name, std::int64_t count) {
  const int variable = find_variable(file, results.path, name, NC_DOUBLE, std::array{count});
  std::vector<double> values(static_cast<std::size_t>(count));
  file.check(nc_get_var_double(file.id(), variable, values.data()), "read '" + name + "'");
  return values;
}

std::vector<std::int64_t> read_integers(const NetcdfFile& file, const StoredResults& results,
                                        const std::string& name,
                                        std::span<const std::int64_t> lengths) {
  const int variable = find_variable(file, results.path, name, NC_INT, lengths);
  std::int64_t size = 1;
  for (const std::int64_t length : lengths) size *= length;
  std::vector<int> values(static_cast<std::size_t>(size));
  file.check(nc_get_var_int(file.id(), variable, values.data()), "read '" + name + "'");
  return {values.begin(), values.end()};
}

void read_points(const NetcdfFile& file, StoredResults& results, std::int64_t count) {
  constexpr std::array kAxes = {"coordx", "coordy", "coordz"};
  for (std::size_t axis = 0; axis < static_cast<std::size_t>(results.dimension); ++axis) {
    const std::vector<double> values = read_axis(file, results, kAxes[axis], count);
    results.points.resize(3 * values.size(), 0.0);
    for (std::size_t i = 0; i < values.size(); ++i) results.points[3 * i + axis] = values[i];
  }
  if (has_variable(file, "node_num_map")) {
    results.point_ids = read_integers(file, results, "node_num_map", std::array{count});
  } else {
    results.point_ids.resize(static_cast<std::size_t>(count));
    std::iota(results.point_ids.begin(), results.point_ids.end(), 1);
  }
}

void check_nodes(const StoredResults& results, StoredBlock& block, const std::string& variable) {
  const std::int64_t points = results.point_count();
  for (std::int64_t& node : block.nodes) {
    if (node < 1 || node > points) {
      throw Error(results.path + ": '" + variable + "' refers to node " + std::to_string(node) +
                  ", the file has nodes 1 to " + std::to_string(points) + "; it is damaged");
    }
    --node;
  }
}

void read_blocks(const NetcdfFile& file, StoredResults& results) {
  const std::vector<std::string> names = read_names(file, results.path, "num_el_blk", "eb_names");
  for (std::size_t b = 0; b < names.size(); ++b) {
    const std::string number = std::to_string(b + 1), connect = "connect" + number;
    StoredBlock block;
    block.name = names[b].empty() ? "block_" + number : names[b];
    block.corners = length_of(file, "num_nod_per_el" + number);
    const std::array lengths{length_of(file, "num_el_in_blk" + number), block.corners};
    block.nodes = read_integers(file, results, connect, lengths);
    block.type = text_or_empty(file, file.variable(connect), "elem_type").c_str();
    check_nodes(results, block, connect);
    results.blocks.push_back(std::move(block));
  }
}

std::vector<ResultVariable> read_variables(const NetcdfFile& file, const StoredResults& results,
                                           const std::string& count_name,
                                           const std::string& names_name,
                                           std::string (*stored_as)(std::size_t)) {
  std::vector<ResultVariable> variables;
  for (const std::string& name : read_names(file, results.path, count_name, names_name)) {
    const int id = file.variable(stored_as(variables.size()));
    variables.push_back(
        {name, text_or_empty(file, id, "units"), text_or_empty(file, id, "long_name")});
  }
  return variables;
}

// Reads the parts of one frame of an open file.
class FrameReader {
 public:
  FrameReader(const NetcdfFile& file, const std::string& path, std::int64_t frame)
      : file_(file), path_(path), frame_(static_cast<std::size_t>(frame)) {}

  void read(const std::string& name, std::span<double> values) const {
    const std::array length{std::ssize(values)};
    const std::array<std::size_t, 2> start{frame_, 0}, extent{1, values.size()};
    const int variable = find_frame_variable(file_, path_, name, length);
    file_.check(
        nc_get_vara_double(file_.id(), variable, start.data(), extent.data(), values.data()),
        "read '" + name + "' of frame " + std::to_string(frame_ + 1));
  }

 private:
  const NetcdfFile& file_;
  const std::string& path_;
  std::size_t frame_;
};

}  // namespace

std::int64_t StoredResults::element_count() const {
  return std::accumulate(blocks.begin(), blocks.end(), std::int64_t{0},
                         [](std::int64_t sum, const StoredBlock& b) { return sum + b.count(); });
}

ResultFrame StoredResults::read_frame(std::int64_t frame) const {
  std::vector<std::size_t> all_nodal(nodal.size()), all_element(element.size());
  std::iota(all_nodal.begin(), all_nodal.end(), std::size_t{0});
  std::iota(all_element.begin(), all_element.end(), std::size_t{0});
  return read_frame(frame, all_nodal, all_element);
}

ResultFrame StoredResults::read_frame(std::int64_t frame, std::span<const std::size_t> nodal_chosen,
                                      std::span<const std::size_t> element_chosen) const {
  const std::int64_t found = read_netcdf_layout(path).found_records;
  if (frame < 0 || frame >= found) {
    throw Error(path + ": there is no frame " + std::to_string(frame + 1) + "; the file has " +
                std::to_string(found) + " complete frames, counted from 1");
  }
  const NetcdfFile file = NetcdfFile::open(path);
  const FrameReader reader(file, path, frame);
  ResultFrame values;
  const std::size_t record = static_cast<std::size_t>(frame), one = 1;
  file.check(nc_get_vara_double(file.id(), find_frame_variable(file, path, "time_whole", {}),
                                &record, &one, &values.time),
             "read the time");
  for (const std::size_t v : nodal_chosen) {
    values.nodal.emplace_back(point_ids.size());
    reader.read(nodal_name(v), values.nodal.back());
  }
  for (const std::size_t v : element_chosen) {
    std::vector<double>& all = values.element.emplace_back(element_count());
    std::span<double> rest = all;
    for (std::size_t b = 0; b < blocks.size(); ++b) {
      const auto count = static_cast<std::size_t>(blocks[b].count());
      reader.read(element_name(v, b), rest.first(count));
      rest = rest.subspan(count);
    }
  }
  values.global.resize(global.size());
  if (!global.empty()) reader.read("vals_glo_var", values.global);
  return values;
}

StoredResults read_results(const std::string& path) {
  const ResultSummary summary = summarise_results(path);
  const NetcdfFile file = NetcdfFile::open(path);
  StoredResults results;
  results.path = path;
  results.title = summary.title;
  results.dimension = summary.dimension;
  results.times = summary.times;
  results.global = summary.global;
  read_points(file, results, summary.points);
  read_blocks(file, results);
  results.nodal = read_variables(file, results, "num_nod_var", "name_nod_var", nodal_name);
  // All blocks hold all variables; the first one's say the units.
  results.element = read_variables(file, results, "num_elem_var", "name_elem_var",
                                   [](std::size_t v) { return element_name(v, 0); });
  results.information = read_names(file, path, "num_info", "info_records", "len_line");
  return results;
}

}  // namespace cleave::io
