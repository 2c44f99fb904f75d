// Gmsh mesh files: header, sections, physical names, element types.
#include "io/gmsh.hpp"

#include <algorithm>
#include <array>
#include <limits>

#include "io/error.hpp"

namespace cleave::io::gmsh {
namespace {

constexpr std::array<ElementType, 8> kFirstOrder = {{{1, "line", 1, 2, true},
                                                     {2, "triangle", 2, 3, true},
                                                     {3, "quadrangle", 2, 4, false},
                                                     {4, "tetrahedron", 3, 4, true},
                                                     {5, "hexahedron", 3, 8, false},
                                                     {6, "prism", 3, 6, false},
                                                     {7, "pyramid", 3, 5, false},
                                                     {15, "point", 0, 1, true}}};

// Types 8 to 33 and 36 to 133 of the format are higher orders of the eight; 34 and 35 are polygons.
constexpr int kFirstHigherOrder = 8, kPolygon = 34, kPolyhedron = 35, kLastHigherOrder = 133;

constexpr const char* kSaveAgain =
    "; write the mesh again with \"gmsh MESH -save -format msh41 -o NEW.msh\" (or, from the "
    "geometry, "
    "with the option -format msh41)";

enum class Version { v2, v4 };

// $MeshFormat: version, 0 for text or 1 for binary, width of a number.
Version read_format(File& file) {
  MeshBytes& bytes = file.bytes;
  bytes.set_section("$MeshFormat");
  const std::string version(bytes.word());
  if (version != "2.2" && version != "4.1")
    bytes.fail("MSH version \"" + version.substr(0, 16) + "\" cannot be read, only 2.2 and 4.1" +
               kSaveAgain);
  const std::int64_t is_binary = bytes.text_integer();
  if (is_binary != 0 && is_binary != 1)
    bytes.fail("the second number should be 0 (text) or 1 (binary), but is " +
               std::to_string(is_binary));
  const std::int64_t width = bytes.text_integer();
  // The width of real numbers in 2.2, of counts and node numbers in 4.1.
  const bool known = width == 8 || (version == "4.1" && width == 4);
  if (!known)
    bytes.fail("the data size should be 8" + std::string(version == "4.1" ? " or 4" : "") +
               ", but is " + std::to_string(width));
  bytes.line();
  if (is_binary == 1) {
    constexpr std::size_t kIntegerWidth = 4;  // everything but real numbers in 2.2
    bytes.set_binary(version == "2.2" ? kIntegerWidth : static_cast<std::size_t>(width));
    bytes.read_byte_order();
  }
  return version == "2.2" ? Version::v2 : Version::v4;
}

// dimension tag "name"; text in binary files, too.
void read_physical_names(File& file) {
  MeshBytes& bytes = file.bytes;
  const std::int64_t count = bytes.text_integer();
  bytes.check_count(count, 1, "names");
  for (std::int64_t i = 0; i < count; ++i) {
    const std::int64_t dimension = bytes.text_integer();
    if (dimension < 0 || dimension > 3)
      bytes.fail("the dimension of a physical group is 0 to 3, not " + std::to_string(dimension));
    const std::int64_t tag = bytes.text_integer();
    const std::string_view text = bytes.line();
    const std::size_t open = text.find('"'), close = text.rfind('"');
    if (open == std::string_view::npos || close <= open + 1)
      bytes.fail("expected a physical name in double quotes after its dimension and tag");
    const std::string name(text.substr(open + 1, close - open - 1));
    file.physical_names[{static_cast<int>(dimension), tag}] = name;
    file.builder.group(name, static_cast<int>(dimension));  // also if no element is in it
  }
}

void expect_end(MeshBytes& bytes, const std::string& section) {
  const std::string end = "$End" + section.substr(1);
  const std::string_view found = bytes.word();
  if (found == end) return;
  if (found.empty())
    bytes.fail("the file ends before " + end + ": it is truncated; write it again");
  bytes.fail("section " + section + " should end here with " + end +
             ": the counts at its beginning do not match its content");
}

void read_nodes(File& file, Version version) {
  version == Version::v2 ? read_nodes_2(file) : read_nodes_4(file);
  file.has_nodes = true;
  if (const std::int64_t twice = file.numbers.build(file.builder.point_ids()); twice >= 0)
    file.bytes.fail("node " + std::to_string(twice) + " occurs twice in section $Nodes");
}

void read_elements(File& file, Version version) {
  if (!file.has_nodes)
    file.bytes.fail("section $Elements stands before $Nodes; write the mesh again");
  version == Version::v2 ? read_elements_2(file) : read_elements_4(file);
  file.has_elements = true;
}

void read_section(File& file, Version version, const std::string& section) {
  MeshBytes& bytes = file.bytes;
  if (section == "$PhysicalNames") {
    read_physical_names(file);
  } else if (section == "$Nodes") {
    read_nodes(file, version);
  } else if (section == "$Elements") {
    read_elements(file, version);
  } else if (section == "$Entities" && version == Version::v4) {
    read_entities_4(file);
  } else if (section == "$PartitionedEntities" && version == Version::v4) {
    read_partitioned_entities_4(file);
  } else if (section == "$ParametricNodes") {
    bytes.fail(
        "nodes with parametric coordinates cannot be read; write the mesh again without "
        "(Mesh.SaveParametric = 0)");
  } else {
    bytes.skip_past("$End" + section.substr(1));
    return;
  }
  expect_end(bytes, section);
}

}  // namespace

const ElementType& element_type(const File& file, std::int64_t number) {
  for (const ElementType& type : kFirstOrder)
    if (type.number == number) return type;
  const bool higher_order = number >= kFirstHigherOrder && number <= kLastHigherOrder &&
                            number != kPolygon && number != kPolyhedron;
  if (higher_order)
    file.bytes.fail(
        "elements of type " + std::to_string(number) +
        " are of second or higher order, only first-order elements can be read; mesh again "
        "with order 1: \"gmsh -order 1 ...\", or Mesh.ElementOrder = 1 in the geometry");
  file.bytes.fail("element type " + std::to_string(number) +
                  " is not known; mesh again with triangles or tetrahedra");
}

MeshBuilder::Group physical_group(File& file, int dimension, std::int64_t tag) {
  constexpr std::int64_t kLargest = std::numeric_limits<std::int32_t>::max();
  if (tag > kLargest || tag < -kLargest)
    file.bytes.fail("a physical tag has at most 31 bits: " + std::to_string(tag));
  const std::int64_t positive = tag < 0 ? -tag : tag;
  const auto named = file.physical_names.find({dimension, positive});
  if (named != file.physical_names.end()) return file.builder.group(named->second, dimension);
  return file.builder.group(std::to_string(dimension) + ":" + std::to_string(positive), dimension);
}

std::int64_t checked_node_number(const File& file, std::int64_t number) {
  if (number < 0) file.bytes.fail("a node number must not be negative: " + std::to_string(number));
  return number;
}

void expect_elements(File& file, const ElementType& type, std::int64_t count) {
  if (!type.is_simplex || type.dimension == 0) return;
  const std::int64_t least = (file.bytes.binary() ? 4 : 2) * (type.nodes + 1);  // bytes of one
  const auto most = static_cast<std::int64_t>(file.bytes.remaining()) / least;
  file.builder.expect_cells(static_cast<CellKind>(type.nodes), std::min(count, most));
}

std::int64_t read_element(File& file, const ElementType& type, std::int64_t element_number) {
  std::array<std::int64_t, 8> nodes{};
  const auto used = static_cast<std::size_t>(type.nodes);
  for (std::size_t k = 0; k < used; ++k) {
    const std::int64_t number = file.bytes.size();
    nodes[k] = file.numbers.index(number);
    if (nodes[k] < 0)
      file.bytes.fail("element " + std::to_string(element_number) + " refers to node " +
                      std::to_string(number) + ", which is not in section $Nodes");
  }
  if (!type.is_simplex) {  // 2.2 repeats an element once more for every further physical group
    if (nodes != file.last_skipped) file.builder.skip(type.name, 1);
    file.last_skipped = nodes;
    return -1;
  }
  if (type.dimension == 0) return nodes[0];
  CellBlock& block = file.builder.block(static_cast<CellKind>(type.nodes));
  block.nodes.insert(block.nodes.end(), nodes.begin(), nodes.begin() + type.nodes);
  return block.count() - 1;
}

void add_to_group(File& file, MeshBuilder::Group group, const ElementType& type,
                  std::int64_t index) {
  if (index < 0) return;
  if (type.dimension == 0)
    file.builder.add_node(group, index);
  else
    file.builder.add_cells(group, index, index + 1);
}

Mesh read(const std::string& path, std::string_view data) {
  File file(path, data);
  MeshBytes& bytes = file.bytes;
  bool has_format = false;
  Version version = Version::v2;
  while (!bytes.at_end()) {
    const std::string section(bytes.word());
    if (section == "$NOD" || section == "$ELM")
      bytes.fail(std::string("MSH version 1 cannot be read, only 2.2 and 4.1") + kSaveAgain);
    if (section.front() != '$' || section.starts_with("$End"))
      bytes.fail("expected the beginning of a section, such as $Nodes");
    bytes.set_section(section);
    bytes.line();  // what follows may be binary
    if (section == "$MeshFormat") {
      if (has_format) bytes.fail("section $MeshFormat occurs twice");
      version = read_format(file);
      has_format = true;
      expect_end(bytes, section);
    } else if (!has_format && section != "$Comments") {
      bytes.fail("a mesh file begins with section $MeshFormat");
    } else {
      read_section(file, version, section);
    }
  }
  if (!file.has_nodes || !file.has_elements)
    bytes.fail(std::string("the file has no section ") + (file.has_nodes ? "$Elements" : "$Nodes") +
               ": it is truncated, or holds no mesh; write it again");
  return file.builder.finish();
}

}  // namespace cleave::io::gmsh
