#include "command/export_grid.hpp"

#include <algorithm>
#include <array>
#include <optional>
#include <string_view>

#include "deck/deck.hpp"

namespace cleave::driver {
namespace {

// A component of an array, and where it is in the file; nowhere: it is zero.
struct Slot {
  std::string component;
  std::optional<std::size_t> variable;
};

std::optional<std::size_t> variable_of(const ExportField& field, std::string_view component) {
  const auto at = std::find(field.components.begin(), field.components.end(), component);
  if (at == field.components.end()) return std::nullopt;
  return field.variables[static_cast<std::size_t>(at - field.components.begin())];
}

bool has_all(const ExportField& field, std::initializer_list<const char*> components) {
  return std::all_of(components.begin(), components.end(),
                     [&](const char* c) { return variable_of(field, c).has_value(); });
}

std::vector<Slot> slots(const ExportField& field, std::initializer_list<const char*> order) {
  std::vector<Slot> list;
  for (const char* component : order) {
    auto variable = variable_of(field, component);
    list.push_back({component, variable});
  }
  return list;
}

// Vectors and tensors as VTK and ParaView order them; anything else as it is in the file. What a plane
// result leaves out (z, xz, yz) is zero there.
std::vector<Slot> vtk_order(const ExportField& field) {
  if (has_all(field, {"x", "y"})) return slots(field, {"x", "y", "z"});
  if (has_all(field, {"xx", "yy", "zz", "xy", "yx"})) {
    return slots(field, {"xx", "xy", "xz", "yx", "yy", "yz", "zx", "zy", "zz"});
  }
  if (has_all(field, {"xx", "yy", "zz", "xy"}) && !variable_of(field, "zx") &&
      !variable_of(field, "zy")) {
    return slots(field, {"xx", "yy", "zz", "xy", "yz", "xz"});
  }
  std::vector<Slot> list;
  for (std::size_t c = 0; c < field.variables.size(); ++c) {
    list.push_back({field.components.empty() ? "" : field.components[c], field.variables[c]});
  }
  return list;
}

// rows: where the values of each tuple are in a variable.
io::VtuArray joined(const ExportField& field, const std::vector<std::vector<double>>& variables,
                    const std::vector<std::size_t>& rows) {
  const std::vector<Slot> order = vtk_order(field);
  io::VtuArray array{field.name, field.units, {}, {}};
  std::vector<double> values(rows.size() * order.size(), 0.0);
  for (std::size_t c = 0; c < order.size(); ++c) {
    if (order.size() > 1) array.components.push_back(order[c].component);
    if (!order[c].variable) continue;
    const std::vector<double>& variable = variables[*order[c].variable];
    for (std::size_t i = 0; i < rows.size(); ++i) {
      values[i * order.size() + c] = variable[rows[i]];
    }
  }
  array.values = std::move(values);
  return array;
}

std::vector<double> positions(const std::vector<double>& points,
                              const std::vector<std::size_t>& rows) {
  std::vector<double> chosen;
  chosen.reserve(3 * rows.size());
  for (const std::size_t p : rows) {
    for (std::size_t axis = 0; axis < 3; ++axis) chosen.push_back(points[3 * p + axis]);
  }
  return chosen;
}

void add_once(std::vector<io::VtuArray>& arrays, io::VtuArray array) {
  const auto same = [&](const io::VtuArray& other) { return other.name == array.name; };
  if (std::none_of(arrays.begin(), arrays.end(), same)) arrays.push_back(std::move(array));
}

// `always`: the one field that is there whether it was chosen or not.
void add_fields(std::vector<io::VtuArray>& arrays, const std::vector<ExportField>& chosen,
                const std::vector<io::ResultVariable>& all, const std::string& always,
                const std::vector<std::vector<double>>& variables,
                const std::vector<std::size_t>& rows) {
  for (const ExportField& field : joined_fields(all)) {
    if (field.name == always) add_once(arrays, joined(field, variables, rows));
  }
  for (const ExportField& field : chosen) add_once(arrays, joined(field, variables, rows));
}

io::VtkCell cell_type(const ExportData& data, const io::StoredBlock& block) {
  struct Known {
    std::string_view begin;  // of the Exodus name
    std::int64_t corners;
    io::VtkCell cell;
  };
  constexpr std::array kKnown = {
      Known{"SPH", 1, io::VtkCell::vertex},
      Known{"BAR", 2, io::VtkCell::line},
      Known{"TRI", 3, io::VtkCell::triangle},
      Known{"TET", 4, io::VtkCell::tetrahedron},
      Known{"TRI", 6, io::VtkCell::quadratic_triangle},
  };
  for (const Known& known : kKnown) {
    if (block.type.starts_with(known.begin) && block.corners == known.corners) return known.cell;
  }
  throw DeckError(data.results.path + ": block \"" + block.name + "\" consists of " + block.type +
                  " with " + std::to_string(block.corners) +
                  " nodes, which is not exported as vtu; use --format csv, or --block for another");
}

// Point of the grid for each point of the file.
std::vector<std::int64_t> numbering(const ExportData& data) {
  std::vector<std::int64_t> numbers(data.results.point_ids.size(), -1);
  for (std::size_t i = 0; i < data.particles.size(); ++i) {
    numbers[data.particles[i]] = static_cast<std::int64_t>(i);
  }
  return numbers;
}

void add_cells(io::VtuGrid& grid, const ExportData& data) {
  const std::vector<std::int64_t> numbers = numbering(data);
  std::vector<std::optional<io::VtkCell>> types(data.results.blocks.size());
  for (const ExportElement& element : data.elements) {
    auto& type = types[element.block];
    if (!type) type = cell_type(data, data.results.blocks[element.block]);
    for (const std::int64_t node : data.nodes(element)) {
      grid.connectivity.push_back(numbers[static_cast<std::size_t>(node)]);
    }
    grid.offsets.push_back(std::ssize(grid.connectivity));
    grid.types.push_back(*type);
  }
}

void add_vertices(io::VtuGrid& grid, std::size_t count) {
  for (std::size_t i = 0; i < count; ++i) {
    grid.connectivity.push_back(static_cast<std::int64_t>(i));
    grid.offsets.push_back(static_cast<std::int64_t>(i) + 1);
    grid.types.push_back(io::VtkCell::vertex);
  }
}

void add_cell_data(io::VtuGrid& grid, const ExportData& data) {
  std::vector<std::int64_t> ids, blocks;
  std::vector<std::size_t> rows;
  for (const ExportElement& element : data.elements) {
    ids.push_back(static_cast<std::int64_t>(element.in_file) + 1);
    blocks.push_back(static_cast<std::int64_t>(element.block) + 1);
    rows.push_back(element.in_file);
  }
  grid.cell_data = {{"id", "", {}, std::move(ids)}, {"block", "", {}, std::move(blocks)}};
  add_fields(grid.cell_data, data.fields.element, data.results.element, "status", data.element,
             rows);
}

void add_point_data(io::VtuGrid& grid, const ExportData& data) {
  std::vector<std::int64_t> ids;
  for (const std::size_t p : data.particles) ids.push_back(data.results.point_ids[p]);
  grid.point_data.push_back({"id", "", {}, std::move(ids)});
  grid.point_data.push_back({"reference_position",
                             data.length_units,
                             {"x", "y", "z"},
                             positions(data.results.points, data.particles)});
  add_fields(grid.point_data, data.fields.nodal, data.results.nodal, "displacement", data.nodal,
             data.particles);
}

}  // namespace

io::VtuGrid export_grid(const ExportData& data, Configuration configuration) {
  io::VtuGrid grid;
  grid.time = data.time;
  const bool current = configuration == Configuration::current;
  grid.points = positions(current ? data.current : data.results.points, data.particles);
  add_point_data(grid, data);
  if (data.results.blocks.empty()) {
    add_vertices(grid, data.particles.size());
  } else {
    add_cells(grid, data);
    add_cell_data(grid, data);
  }
  return grid;
}

}  // namespace cleave::driver
