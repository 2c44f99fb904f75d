#include "command/export_table.hpp"

#include <algorithm>
#include <array>

#include "deck/deck.hpp"
#include "io/csv.hpp"

namespace cleave::driver {
namespace {

// Lines on their way to the sink, in large pieces.
class Lines {
 public:
  explicit Lines(const TextSink& sink) : sink_(sink) {}
  void header(const std::vector<io::Column>& columns) { text_ += io::csv_header(columns); }
  void integer(std::int64_t value) { number(static_cast<double>(value), true); }
  void real(double value) { number(value, false); }
  void word(const std::string& text) { text_ += io::csv_field(text) + ','; }
  void gap() { text_ += ','; }
  void end_line() {
    constexpr std::size_t kPieceBytes = std::size_t{1} << 22;
    text_.back() = '\n';  // in place of the last comma
    if (text_.size() > kPieceBytes) flush();
  }
  void flush() {
    sink_(text_);
    text_.clear();
  }

 private:
  void number(double value, bool is_integer) {
    io::append_csv_number(text_, value, is_integer);
    text_ += ',';
  }
  const TextSink& sink_;
  std::string text_;
};

void add_positions(std::vector<io::Column>& columns, const std::string& units) {
  for (const char* axis : {"X", "Y", "Z", "x", "y", "z"}) columns.push_back({axis, units, ""});
}

void add_fields(std::vector<io::Column>& columns, const std::vector<ExportField>& fields) {
  for (const ExportField& field : fields) {
    for (std::size_t c = 0; c < field.variables.size(); ++c) {
      columns.push_back({field.column(c), field.units, ""});
    }
  }
}

// All values of the fields in the order of their columns.
std::vector<const std::vector<double>*> values_of(
    const std::vector<ExportField>& fields, const std::vector<std::vector<double>>& variables) {
  std::vector<const std::vector<double>*> values;
  for (const ExportField& field : fields) {
    for (const std::size_t variable : field.variables) values.push_back(&variables[variable]);
  }
  return values;
}

std::array<double, 3> centroid(const std::vector<double>& points,
                               std::span<const std::int64_t> nodes) {
  std::array<double, 3> sum{};
  for (const std::int64_t node : nodes) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      sum[axis] += points[3 * static_cast<std::size_t>(node) + axis];
    }
  }
  for (double& x : sum) x /= static_cast<double>(nodes.size());
  return sum;
}

std::size_t most_corners(const ExportData& data) {
  std::size_t most = 0;
  for (const ExportElement& element : data.elements) {
    most = std::max(most, data.nodes(element).size());
  }
  return most;
}

}  // namespace

void write_particle_table(const ExportData& data, const TextSink& sink) {
  std::vector<io::Column> columns{{"id", "1", "", true}};
  add_positions(columns, data.length_units);
  add_fields(columns, data.fields.nodal);
  const auto values = values_of(data.fields.nodal, data.nodal);
  Lines lines(sink);
  lines.header(columns);
  for (const std::size_t p : data.particles) {
    lines.integer(data.results.point_ids[p]);
    for (std::size_t axis = 0; axis < 3; ++axis) lines.real(data.results.points[3 * p + axis]);
    for (std::size_t axis = 0; axis < 3; ++axis) lines.real(data.current[3 * p + axis]);
    for (const std::vector<double>* variable : values) lines.real((*variable)[p]);
    lines.end_line();
  }
  lines.flush();
}

void write_element_table(const ExportData& data, const TextSink& sink) {
  if (data.elements.empty()) {
    throw DeckError(data.results.path +
                    ": there are no elements to export; leave out --on elements or --alive");
  }
  const std::size_t corners = most_corners(data);
  std::vector<io::Column> columns{{"id", "1", "", true}, {"block", "-", ""}};
  add_positions(columns, data.length_units);
  for (std::size_t c = 0; c < corners; ++c) {
    columns.push_back({"node_" + std::to_string(c + 1), "1", "", true});
  }
  add_fields(columns, data.fields.element);
  const auto values = values_of(data.fields.element, data.element);
  Lines lines(sink);
  lines.header(columns);
  for (const ExportElement& element : data.elements) {
    const auto nodes = data.nodes(element);
    lines.integer(static_cast<std::int64_t>(element.in_file) + 1);
    lines.word(data.results.blocks[element.block].name);
    for (const double x : centroid(data.results.points, nodes)) lines.real(x);
    for (const double x : centroid(data.current, nodes)) lines.real(x);
    for (const std::int64_t node : nodes) {
      lines.integer(data.results.point_ids[static_cast<std::size_t>(node)]);
    }
    for (std::size_t c = nodes.size(); c < corners; ++c) lines.gap();
    for (const std::vector<double>* variable : values) lines.real((*variable)[element.in_file]);
    lines.end_line();
  }
  lines.flush();
}

}  // namespace cleave::driver
