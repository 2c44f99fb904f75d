// Exodus files written with the Exodus library, to be read back.
#pragma once

#include <string>
#include <vector>

namespace cleave::io::testing {

struct ExodusBlock {
  int id = 1;
  std::string name, type;
  int nodes_per_element = 3;
  std::vector<int> nodes;  // 1-based
};

struct ExodusSet {
  int id = 1;
  std::string name;
  std::vector<int> entries;  // nodes, or elements of a side set
  std::vector<int> sides;
};

struct ExodusContent {
  int dimension = 2;
  std::vector<double> x, y, z;
  std::vector<int> node_numbers;  // may be empty
  std::vector<ExodusBlock> blocks;
  std::vector<ExodusSet> node_sets, side_sets;
};

// mode: flags of ex_create.
void write_exodus(const std::string& path, int mode, const ExodusContent& content);

// A square of 2 x 2 cells: left column four triangles, right column two quadrangles, a bar between.
ExodusContent exodus_plate();
// Two tetrahedra that share a face, which is also a triangle element.
ExodusContent exodus_solid();

}  // namespace cleave::io::testing
