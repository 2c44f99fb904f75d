// Exodus II files as meshes: element blocks, node sets and side sets become groups. Results in the
// file (variables over time) are not read.
//
// The variables are read through netCDF: the Exodus library trusts the sizes in a file, which a
// damaged one must not make it do.
#include "io/exodus_mesh.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "io/error.hpp"
#include "io/exodus_mesh_input.hpp"
#include "io/exodus_mesh_trial.hpp"
#include "io/mesh_builder.hpp"
#include "io/netcdf_layout.hpp"

namespace cleave::io {
namespace {

enum class Shape { sphere, bar, triangle, tetrahedron, other };

struct Block {
  Shape shape = Shape::other;
  std::string type;        // as in the file
  std::int64_t first = 0;  // number of its first element in the file, 0-based
  std::int64_t count = 0;
  std::vector<std::int64_t> nodes;  // 0-based; empty if skipped
};

struct Reader {
  const NetcdfInput& file;
  MeshBuilder& builder;
  int dimension = 3;
  std::int64_t node_count = 0;
  std::vector<Block> blocks;
};

std::string numbered(const char* name, std::size_t number) { return name + std::to_string(number); }

std::string upper_case(std::string text) {
  for (char& c : text)
    if (c >= 'a' && c <= 'z') c = static_cast<char>(c - 'a' + 'A');
  return text;
}

std::int64_t corners(Shape shape) {
  switch (shape) {
    case Shape::sphere:
      return 1;
    case Shape::bar:
      return 2;
    case Shape::triangle:
      return 3;
    case Shape::tetrahedron:
      return 4;
    case Shape::other:
      break;
  }
  return 0;
}

// Types are told by the beginning of their name; "TRI3", "triangle" and "TRI" are the same.
Shape shape_of(const std::string& type, std::int64_t nodes_per_element) {
  const std::string name = upper_case(type);
  const auto begins = [&](std::initializer_list<const char*> words) {
    return std::any_of(words.begin(), words.end(),
                       [&](const char* w) { return name.starts_with(w); });
  };
  if (begins({"SPH", "CIR", "POINT"})) return Shape::sphere;
  if (begins({"BAR", "BEA", "TRU", "EDG", "LIN", "ROD"})) return Shape::bar;
  if (begins({"TET"})) return Shape::tetrahedron;
  if (begins({"TRI"}) || (begins({"SHE"}) && nodes_per_element == 3)) return Shape::triangle;
  return Shape::other;
}

void read_points(Reader& reader) {
  const NetcdfInput& file = reader.file;
  const auto n = static_cast<std::size_t>(reader.node_count);
  const auto dimension = static_cast<std::size_t>(reader.dimension);
  std::vector<double>& points = reader.builder.points();
  const auto place = [&](std::span<const double> values, std::size_t axis) {
    if (values.size() != n) file.fail("the coordinates are not one for each of the nodes");
    points.resize(3 * n, 0.0);
    for (std::size_t i = 0; i < n; ++i) {
      if (!std::isfinite(values[i]))
        file.fail("coordinate " + std::string(1, static_cast<char>('x' + axis)) + " of node " +
                  std::to_string(i + 1) + " is not finite");
      points[3 * i + axis] = values[i];
    }
  };
  if (file.has_variable("coord")) {  // older files: one array (dimension, node)
    const std::vector<double> all = file.reals("coord");
    if (all.size() != dimension * n) file.fail("the coordinates are not one for each of the nodes");
    for (std::size_t axis = 0; axis < dimension; ++axis)
      place(std::span(all).subspan(axis * n, n), axis);
  } else {
    constexpr std::array<const char*, 3> kNames = {"coordx", "coordy", "coordz"};
    for (std::size_t axis = 0; axis < dimension; ++axis) place(file.reals(kNames[axis]), axis);
  }

  std::vector<std::int64_t>& ids = reader.builder.point_ids();
  if (file.has_variable("node_num_map")) ids = file.integers("node_num_map");
  if (ids.size() == n) return;
  ids.resize(n);
  for (std::size_t i = 0; i < n; ++i) ids[i] = static_cast<std::int64_t>(i) + 1;
}

// Names of blocks or sets: from the file, else prefix and id.
std::vector<std::string> read_names(const NetcdfInput& file, const char* names, const char* ids,
                                    const char* prefix, std::int64_t count) {
  std::vector<std::string> found;
  if (file.has_variable(names)) found = file.texts(names);
  std::vector<std::int64_t> numbers;
  if (file.has_variable(ids)) numbers = file.integers(ids);
  found.resize(static_cast<std::size_t>(count));
  for (std::size_t i = 0; i < found.size(); ++i)
    if (found[i].empty())
      found[i] = prefix +
                 std::to_string(i < numbers.size() ? numbers[i] : static_cast<std::int64_t>(i) + 1);
  return found;
}

// 1-based numbers of the file to indices.
std::vector<std::int64_t> read_nodes(const Reader& reader, const std::string& variable) {
  std::vector<std::int64_t> nodes = reader.file.integers(variable);
  for (std::int64_t& node : nodes) {
    if (node < 1 || node > reader.node_count)
      reader.file.fail("variable " + variable + " refers to node " + std::to_string(node) +
                       ", the file has nodes 1 to " + std::to_string(reader.node_count));
    --node;
  }
  return nodes;
}

// How many blocks or sets there are; each has an entry in the status array, which bounds the
// number.
std::int64_t entry_count(const NetcdfInput& file, const char* dimension, const char* status) {
  const std::int64_t count = file.dimension(dimension).value_or(0);
  if (count > 0 && (file.shape(status) != std::vector<std::int64_t>{count}))
    file.fail("dimension " + std::string(dimension) + " and variable " + status + " do not agree");
  return count;
}

void append_cells(MeshBuilder& builder, const std::string& name, CellKind kind,
                  const std::vector<std::int64_t>& nodes) {
  CellBlock& cells = builder.block(kind);
  const std::int64_t first = cells.count();
  cells.nodes.insert(cells.nodes.end(), nodes.begin(), nodes.end());
  builder.add_cells(builder.group(name, static_cast<int>(kind) - 1), first, cells.count());
}

void add_block(MeshBuilder& builder, const Block& block, const std::string& name) {
  if (block.shape != Shape::sphere)
    return append_cells(builder, name, static_cast<CellKind>(corners(block.shape)), block.nodes);
  const MeshBuilder::Group group = builder.group(name, 0);
  for (const std::int64_t node : block.nodes) builder.add_node(group, node);
}

void read_block(Reader& reader, std::size_t number, const std::string& name) {
  const NetcdfInput& file = reader.file;
  Block block;
  if (!reader.blocks.empty()) block.first = reader.blocks.back().first + reader.blocks.back().count;
  block.count = file.dimension(numbered("num_el_in_blk", number)).value_or(0);
  const std::string connect = numbered("connect", number);
  if (block.count > 0) {
    block.type = file.text_attribute(connect, "elem_type");
    const std::vector<std::int64_t> shape = file.shape(connect);
    const std::int64_t nodes_per_element = shape.size() == 2 ? shape[1] : 0;
    block.shape = shape_of(block.type, nodes_per_element);
    const std::int64_t expected = corners(block.shape);
    if (block.shape == Shape::other) {
      reader.builder.skip(block.type.empty() ? "element without type" : block.type, block.count);
    } else if (nodes_per_element != expected) {
      file.fail("block \"" + name + "\": elements " + block.type + " with " +
                std::to_string(nodes_per_element) +
                " nodes; only first-order elements (here with " + std::to_string(expected) +
                ") can be read: mesh again with first order");
    } else {
      if (shape[0] != block.count) file.fail("variable " + connect + " has the wrong length");
      block.nodes = read_nodes(reader, connect);
      add_block(reader.builder, block, name);
    }
  }
  reader.blocks.push_back(std::move(block));
}

void read_node_set(Reader& reader, std::size_t number, const std::string& name) {
  const MeshBuilder::Group group = reader.builder.group(name, 0);
  const std::string variable = numbered("node_ns", number);
  if (!reader.file.has_variable(variable)) return;  // an empty set has none
  for (const std::int64_t node : read_nodes(reader, variable)) reader.builder.add_node(group, node);
}

// Corners of side `side` (1-based) of an element, as positions in the element; empty if the side
// does not exist. A triangle in space has its two faces as sides 1 and 2, then its edges.
std::vector<std::size_t> side_corners(Shape shape, int dimension, std::int64_t side) {
  static const std::vector<std::vector<std::size_t>> kEdges = {{0, 1}, {1, 2}, {2, 0}};
  static const std::vector<std::vector<std::size_t>> kShell = {
      {0, 1, 2}, {0, 2, 1}, {0, 1}, {1, 2}, {2, 0}};
  static const std::vector<std::vector<std::size_t>> kFaces = {
      {0, 1, 3}, {1, 2, 3}, {0, 3, 2}, {0, 2, 1}};
  static const std::vector<std::vector<std::size_t>> kNone;
  const auto& sides = shape == Shape::tetrahedron                  ? kFaces
                      : shape == Shape::triangle && dimension == 3 ? kShell
                      : shape == Shape::triangle                   ? kEdges
                                                                   : kNone;
  if (side < 1 || side > static_cast<std::int64_t>(sides.size())) return {};
  return sides[static_cast<std::size_t>(side) - 1];
}

// The facets of a side set by their number of corners. Sides of elements that are skipped, of bars
// and of spheres are left out.
struct Facets {
  std::vector<std::int64_t> edges, triangles;
};

Facets read_facets(const Reader& reader, std::size_t number, const std::string& name) {
  const NetcdfInput& file = reader.file;
  Facets facets;
  if (!file.has_variable(numbered("elem_ss", number))) return facets;  // an empty set has none
  const std::vector<std::int64_t> elements = file.integers(numbered("elem_ss", number));
  const std::vector<std::int64_t> sides = file.integers(numbered("side_ss", number));
  if (elements.size() != sides.size())
    file.fail("side set \"" + name + "\" has " + std::to_string(elements.size()) +
              " elements and " + std::to_string(sides.size()) + " sides");
  for (std::size_t i = 0; i < elements.size(); ++i) {
    const std::int64_t element = elements[i] - 1;
    const auto after = std::upper_bound(
        reader.blocks.begin(), reader.blocks.end(), element,
        [](std::int64_t value, const Block& block) { return value < block.first; });
    const bool exists = element >= 0 && after != reader.blocks.begin() &&
                        element < std::prev(after)->first + std::prev(after)->count;
    if (!exists)
      file.fail("side set \"" + name + "\" refers to element " + std::to_string(elements[i]) +
                ", which the file does not have");
    const Block& block = *std::prev(after);
    if (block.shape != Shape::triangle && block.shape != Shape::tetrahedron) continue;
    const std::vector<std::size_t> positions =
        side_corners(block.shape, reader.dimension, sides[i]);
    if (positions.empty())
      file.fail("side set \"" + name + "\": element " + std::to_string(elements[i]) + " (" +
                block.type + ") has no side " + std::to_string(sides[i]));
    const auto begin = static_cast<std::size_t>((element - block.first) * corners(block.shape));
    std::vector<std::int64_t>& list = positions.size() == 2 ? facets.edges : facets.triangles;
    for (const std::size_t k : positions) list.push_back(block.nodes[begin + k]);
  }
  return facets;
}

void read_side_set(Reader& reader, std::size_t number, const std::string& name) {
  const Facets facets = read_facets(reader, number, name);
  const bool is_empty = facets.edges.empty() && facets.triangles.empty();
  if (!facets.edges.empty() || (is_empty && reader.dimension < 3))
    append_cells(reader.builder, name, CellKind::line, facets.edges);
  if (!facets.triangles.empty() || (is_empty && reader.dimension == 3))
    append_cells(reader.builder, name, CellKind::triangle, facets.triangles);
}

Reader open(const NetcdfInput& file, MeshBuilder& builder) {
  const auto dimension = file.dimension("num_dim"), nodes = file.dimension("num_nodes");
  if (!dimension || !nodes || !file.dimension("num_el_blk"))
    file.fail("a netCDF file, but not an Exodus mesh with nodes and element blocks");
  if (*dimension < 1 || *dimension > 3)
    file.fail("an Exodus mesh of dimension " + std::to_string(*dimension) + ", not 1 to 3");
  return Reader{file, builder, static_cast<int>(*dimension), *nodes, {}};
}

Mesh read(const std::string& path, std::size_t file_size) {
  const NetcdfInput file(path, file_size);
  MeshBuilder builder(path);
  Reader reader = open(file, builder);
  read_points(reader);

  const std::int64_t blocks = entry_count(file, "num_el_blk", "eb_status");
  const auto block_names = read_names(file, "eb_names", "eb_prop1", "block_", blocks);
  for (std::size_t i = 0; i < block_names.size(); ++i) read_block(reader, i + 1, block_names[i]);

  const std::int64_t node_sets = entry_count(file, "num_node_sets", "ns_status");
  const auto node_set_names = read_names(file, "ns_names", "ns_prop1", "nodeset_", node_sets);
  for (std::size_t i = 0; i < node_set_names.size(); ++i)
    read_node_set(reader, i + 1, node_set_names[i]);

  const std::int64_t side_sets = entry_count(file, "num_side_sets", "ss_status");
  const auto side_set_names = read_names(file, "ss_names", "ss_prop1", "sideset_", side_sets);
  for (std::size_t i = 0; i < side_set_names.size(); ++i)
    read_side_set(reader, i + 1, side_set_names[i]);
  return builder.finish();
}

}  // namespace

Mesh read_exodus_mesh(const std::string& path, NetcdfForm form, std::size_t file_size) {
  if (form == NetcdfForm::classic) {
    read_netcdf_layout(path);  // refuses a truncated file
    return read(path, file_size);
  }
  // A sound file takes 0.01 s a megabyte.
  const unsigned long cpu_seconds = 60 + file_size / 1000000;
  const Trial trial = try_in_child([&] { read(path, file_size); }, cpu_seconds);
  if (trial.crashed)
    throw Error(path +
                ": a netCDF-4 file so damaged that the HDF5 library fails on it or does not come "
                "to an end; write it again");
  if (!trial.error.empty()) throw Error(trial.error);
  return read(path, file_size);
}

}  // namespace cleave::io
