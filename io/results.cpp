// Frames of an Exodus results file: appended, counted, taken back.
#include "io/results.hpp"

#include <algorithm>

#include "io/error.hpp"
#include "io/exodus_definition.hpp"
#include "io/netcdf_layout.hpp"
#include "io/new_file.hpp"
#include "io/record_file.hpp"

namespace cleave::io {
namespace {

// The layout as it is in the file: without blocks and sets that have no members.
ResultLayout without_empty_parts(ResultLayout layout) {
  std::erase_if(layout.blocks, [](const ResultBlock& block) { return block.nodes.empty(); });
  std::erase_if(layout.node_sets, [](const MeshGroup& set) { return set.nodes.empty(); });
  return layout;
}

std::vector<std::string> names_of(const std::vector<ResultVariable>& variables) {
  std::vector<std::string> names;
  for (const ResultVariable& variable : variables) names.push_back(variable.name);
  return names;
}

}  // namespace

// Keeps the sizes only: the points and elements are in the file.
struct ResultsWriter::Impl {
  Impl(std::string file_path, const ResultLayout& layout)
      : path(std::move(file_path)),
        points(std::ssize(layout.point_ids)),
        nodal(names_of(layout.nodal)),
        element(names_of(layout.element)),
        global(names_of(layout.global)) {
    for (const ResultBlock& block : layout.blocks) {
      block_elements.push_back(std::ssize(block.nodes) / static_cast<int>(block.kind));
      elements += block_elements.back();
    }
  }

  std::string path;
  std::int64_t points = 0, elements = 0, frames = 0;
  std::vector<std::string> nodal, element, global;
  std::vector<std::int64_t> block_elements;

  void check_same(const ResultSummary& file) const;
  void check_values(const std::string& what, const std::vector<std::string>& names,
                    std::span<const std::vector<double>> values, std::int64_t count) const;
  void append(double time, std::span<const std::vector<double>> nodal_values,
              std::span<const std::vector<double>> element_values,
              std::span<const double> global_values) const;
};

void ResultsWriter::Impl::check_same(const ResultSummary& file) const {
  const auto refuse = [&](const std::string& what, const std::string& in_file,
                          const std::string& here) {
    throw Error(path + ": has " + in_file + " " + what + ", this run has " + here +
                "; continue with the deck that wrote it");
  };
  const auto join = [](const std::vector<std::string>& names) {
    std::string text;
    for (const std::string& name : names) text += (text.empty() ? "" : ", ") + name;
    return "'" + text + "'";
  };
  if (file.points != points) refuse("points", std::to_string(file.points), std::to_string(points));
  if (file.elements != elements) {
    refuse("elements", std::to_string(file.elements), std::to_string(elements));
  }
  if (file.nodal != nodal) refuse("as nodal variables", join(file.nodal), join(nodal));
  if (elements > 0 && file.element != element) {
    refuse("as element variables", join(file.element), join(element));
  }
  if (file.global != global) refuse("as global variables", join(file.global), join(global));
}

void ResultsWriter::Impl::check_values(const std::string& what,
                                       const std::vector<std::string>& names,
                                       std::span<const std::vector<double>> values,
                                       std::int64_t count) const {
  if (values.size() != names.size()) {
    throw Error(path + ": a frame has " + std::to_string(values.size()) + " " + what +
                " variables, the file has " + std::to_string(names.size()));
  }
  for (std::size_t v = 0; v < names.size(); ++v) {
    if (std::ssize(values[v]) != count) {
      throw Error(path + ": " + what + " variable '" + names[v] + "' has " +
                  std::to_string(values[v].size()) + " values, " + std::to_string(count) +
                  " are needed");
    }
  }
}

// The names are those of the Exodus II format. The library's own calls would count the frame before it is
// written, and a kill would leave a frame without values.
void ResultsWriter::Impl::append(double time, std::span<const std::vector<double>> nodal_values,
                                 std::span<const std::vector<double>> element_values,
                                 std::span<const double> global_values) const {
  const NetcdfLayout layout = read_netcdf_layout(path);
  RecordFile file(path, layout);
  const auto put = [&](const std::string& stored_as, std::int64_t count, const double* values) {
    const NetcdfLayout::Variable* variable = layout.find(stored_as);
    if (variable == nullptr || !variable->is_record || variable->bytes != 8 * count) {
      throw Error(path + ": has no '" + stored_as + "' of " + std::to_string(count) +
                  " values; the file was changed while the run wrote it");
    }
    file.write(layout.place(*variable, frames),
               std::span<const double>(values, static_cast<std::size_t>(count)));
  };
  put("time_whole", 1, &time);
  if (!global.empty()) put("vals_glo_var", std::ssize(global), global_values.data());
  for (std::size_t v = 0; v < nodal.size(); ++v) {
    put("vals_nod_var" + std::to_string(v + 1), points, nodal_values[v].data());
  }
  for (std::size_t v = 0; v < element.size(); ++v) {
    const double* values = element_values[v].data();
    for (std::size_t b = 0; b < block_elements.size(); ++b) {
      put("vals_elem_var" + std::to_string(v + 1) + "eb" + std::to_string(b + 1), block_elements[b],
          values);
      values += block_elements[b];
    }
  }
  file.set_length(frames + 1);
  file.set_records(frames + 1);
  file.close();
}

ResultsWriter ResultsWriter::create(const std::string& path, const ResultLayout& layout) {
  check_layout(path, layout);
  const ResultLayout stored = without_empty_parts(layout);
  NewFile file(path);
  write_exodus_definition(file.temporary_path(), stored);
  file.commit();
  return ResultsWriter(std::make_unique<Impl>(path, stored));
}

ResultsWriter ResultsWriter::reopen(const std::string& path, const ResultLayout& layout,
                                    std::int64_t frames) {
  check_layout(path, layout);
  auto impl = std::make_unique<Impl>(path, without_empty_parts(layout));
  impl->check_same(summarise_results(path));
  truncate_records(path, frames);
  impl->frames = frames;
  return ResultsWriter(std::move(impl));
}

ResultsWriter::ResultsWriter(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
ResultsWriter::ResultsWriter(ResultsWriter&&) noexcept = default;
ResultsWriter& ResultsWriter::operator=(ResultsWriter&&) noexcept = default;
ResultsWriter::~ResultsWriter() = default;

void ResultsWriter::write_frame(double time, std::span<const std::vector<double>> nodal,
                                std::span<const std::vector<double>> element,
                                std::span<const double> global) {
  Impl& file = *impl_;
  file.check_values("nodal", file.nodal, nodal, file.points);
  file.check_values("element", file.element, element, file.elements);
  if (global.size() != file.global.size()) {
    throw Error(file.path + ": a frame has " + std::to_string(global.size()) +
                " global values, the file has " + std::to_string(file.global.size()));
  }
  try {
    file.append(time, nodal, element, global);
  } catch (const Error&) {
    try {
      truncate_records(file.path, file.frames);
    } catch (const Error&) {  // the first error is the one to report
    }
    throw;
  }
  ++file.frames;
}

void ResultsWriter::sync() { sync_file(impl_->path); }

std::int64_t ResultsWriter::frames() const { return impl_->frames; }

}  // namespace cleave::io
