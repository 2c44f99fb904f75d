// Gmsh mesh files, MSH 2.2 and 4.1: what the readers of the two versions share. Internal to io.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "io/mesh.hpp"
#include "io/mesh_builder.hpp"
#include "io/mesh_bytes.hpp"

namespace cleave::io::gmsh {

using EntityKey = std::pair<int, std::int64_t>;  // dimension, tag

// First-order elements; a file with others is refused.
struct ElementType {
  int number = 0;  // in the file format
  const char* name = "";
  int dimension = 0;
  int nodes = 0;
  bool is_simplex = false;
};

// One file being read.
struct File {
  MeshBytes bytes;
  MeshBuilder builder;
  NodeNumbers numbers;  // of the nodes read so far
  bool has_nodes = false, has_elements = false;
  std::map<EntityKey, std::string> physical_names;
  std::map<EntityKey, std::vector<std::int64_t>> entity_physicals;  // MSH 4.1
  std::array<std::int64_t, 8> last_skipped{};

  File(const std::string& path, std::string_view data) : bytes(path, data), builder(path) {}
};

// The type of that number; refuses higher orders and unknown ones.
const ElementType& element_type(const File& file, std::int64_t number);
// The group of a physical tag; a negative tag (reversed orientation) is the same group.
MeshBuilder::Group physical_group(File& file, int dimension, std::int64_t tag);
// Reads node numbers until the element is complete and adds it. Returns its index in its block, the
// index of the node for a point element, or -1 if its kind is skipped.
std::int64_t read_element(File& file, const ElementType& type, std::int64_t element_number);
// Makes room for elements that are announced, as far as the rest of the file can hold them.
void expect_elements(File& file, const ElementType& type, std::int64_t count);
void add_to_group(File& file, MeshBuilder::Group group, const ElementType& type,
                  std::int64_t index);
// Reads a node number and checks its sign.
std::int64_t checked_node_number(const File& file, std::int64_t number);

void read_nodes_2(File& file);
void read_elements_2(File& file);

void read_entities_4(File& file);
void read_partitioned_entities_4(File& file);
void read_nodes_4(File& file);
void read_elements_4(File& file);

// data: the file's content, beginning with $MeshFormat, $Comments or, in version 1, $NOD.
Mesh read(const std::string& path, std::string_view data);

}  // namespace cleave::io::gmsh
