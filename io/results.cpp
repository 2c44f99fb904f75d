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

// Where the values go. The names are those of the Exodus II format. The library's own calls would count the
// frame before it is written, and a kill would leave a frame without values.
struct ResultsWriter::Frame::State {
  explicit State(Impl& results)
      : writer(results), layout(read_netcdf_layout(results.path)), file(results.path, layout) {}

  Impl& writer;
  NetcdfLayout layout;
  RecordFile file;
  std::int64_t missing = 0;  // values of points and elements that are not put yet
  bool finished = false;

  // Values first, first + 1, ... of the `count` of a variable.
  void put(const std::string& stored_as, std::int64_t count, std::int64_t first,
           std::span<const double> values) {
    const NetcdfLayout::Variable* variable = layout.find(stored_as);
    if (variable == nullptr || !variable->is_record || variable->bytes != 8 * count) {
      throw Error(writer.path + ": has no '" + stored_as + "' of " + std::to_string(count) +
                  " values; the file was changed while the run wrote it");
    }
    file.write(layout.place(*variable, writer.frames) + 8 * first, values);
  }

  void check_piece(const std::string& what, const std::vector<std::string>& names,
                   std::size_t variable, std::int64_t first, std::int64_t last,
                   std::int64_t count) const {
    if (variable >= names.size() || first < 0 || last > count) {
      throw Error(writer.path + ": a frame has no " + what + " values " + std::to_string(first) +
                  " to " + std::to_string(last) + " of variable " + std::to_string(variable) +
                  "; the file has " + std::to_string(names.size()) + " variables of " +
                  std::to_string(count) + " values");
    }
  }
};

ResultsWriter::Frame::Frame(std::unique_ptr<State> state) : state_(std::move(state)) {}

ResultsWriter::Frame::Frame(Frame&&) noexcept = default;

ResultsWriter::Frame::~Frame() {
  if (state_ == nullptr || state_->finished) return;
  try {
    truncate_records(state_->writer.path, state_->writer.frames);
  } catch (const Error&) {  // the error that ended the frame is the one to report
  }
}

void ResultsWriter::Frame::put_nodal(std::size_t variable, std::int64_t first,
                                     std::span<const double> values) {
  State& s = *state_;
  s.check_piece("nodal", s.writer.nodal, variable, first, first + std::ssize(values),
                s.writer.points);
  s.put("vals_nod_var" + std::to_string(variable + 1), s.writer.points, first, values);
  s.missing -= std::ssize(values);
}

void ResultsWriter::Frame::put_element(std::size_t variable, std::int64_t first,
                                       std::span<const double> values) {
  State& s = *state_;
  const std::int64_t last = first + std::ssize(values);
  s.check_piece("element", s.writer.element, variable, first, last, s.writer.elements);
  std::int64_t begin = 0;  // of the block
  for (std::size_t b = 0; b < s.writer.block_elements.size(); ++b) {
    const std::int64_t count = s.writer.block_elements[b];
    const std::int64_t from = std::max(first, begin), to = std::min(last, begin + count);
    if (from < to) {
      s.put("vals_elem_var" + std::to_string(variable + 1) + "eb" + std::to_string(b + 1), count,
            from - begin,
            values.subspan(static_cast<std::size_t>(from - first),
                           static_cast<std::size_t>(to - from)));
    }
    begin += count;
  }
  s.missing -= std::ssize(values);
}

void ResultsWriter::Frame::finish() {
  State& s = *state_;
  if (s.missing != 0) {
    throw Error(s.writer.path + ": a frame lacks " + std::to_string(s.missing) + " values");
  }
  s.file.set_length(s.writer.frames + 1);
  s.file.set_records(s.writer.frames + 1);
  s.file.close();
  s.finished = true;
  ++s.writer.frames;
}

ResultsWriter ResultsWriter::create(const std::string& path, ResultLayout layout) {
  check_layout(path, layout);
  const ResultLayout stored = without_empty_parts(std::move(layout));
  NewFile file(path);
  write_exodus_definition(file.temporary_path(), stored);
  file.commit();
  return ResultsWriter(std::make_unique<Impl>(path, stored));
}

ResultsWriter ResultsWriter::reopen(const std::string& path, ResultLayout layout,
                                    std::int64_t frames) {
  check_layout(path, layout);
  auto impl = std::make_unique<Impl>(path, without_empty_parts(std::move(layout)));
  impl->check_same(summarise_results(path));
  truncate_records(path, frames);
  impl->frames = frames;
  return ResultsWriter(std::move(impl));
}

ResultsWriter::ResultsWriter(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
ResultsWriter::ResultsWriter(ResultsWriter&&) noexcept = default;
ResultsWriter& ResultsWriter::operator=(ResultsWriter&&) noexcept = default;
ResultsWriter::~ResultsWriter() = default;

ResultsWriter::Frame ResultsWriter::begin_frame(double time, std::span<const double> global) {
  Impl& writer = *impl_;
  if (global.size() != writer.global.size()) {
    throw Error(writer.path + ": a frame has " + std::to_string(global.size()) +
                " global values, the file has " + std::to_string(writer.global.size()));
  }
  auto state = std::make_unique<Frame::State>(writer);
  state->missing =
      std::ssize(writer.nodal) * writer.points + std::ssize(writer.element) * writer.elements;
  Frame frame(std::move(state));
  frame.state_->put("time_whole", 1, 0, std::span(&time, 1));
  if (!global.empty()) frame.state_->put("vals_glo_var", std::ssize(global), 0, global);
  return frame;
}

void ResultsWriter::write_frame(double time, std::span<const std::vector<double>> nodal,
                                std::span<const std::vector<double>> element,
                                std::span<const double> global) {
  impl_->check_values("nodal", impl_->nodal, nodal, impl_->points);
  impl_->check_values("element", impl_->element, element, impl_->elements);
  Frame frame = begin_frame(time, global);
  for (std::size_t v = 0; v < nodal.size(); ++v) frame.put_nodal(v, 0, nodal[v]);
  for (std::size_t v = 0; v < element.size(); ++v) frame.put_element(v, 0, element[v]);
  frame.finish();
}

void ResultsWriter::sync() { sync_file(impl_->path); }

std::int64_t ResultsWriter::frames() const { return impl_->frames; }

}  // namespace cleave::io
