// Unstructured grids with fields for ParaView and VTK: the XML format ".vtu", one grid a file.
//
// Arrays stand in the file as base64, so that every bit of a double arrives; nothing is compressed.
// Knows cells and named arrays, nothing of results or physics.
#pragma once

#include <cstdint>
#include <string>
#include <variant>
#include <vector>

namespace cleave::io {

// Numbers of VTK (vtkCellType.h).
enum class VtkCell : std::uint8_t {
  vertex = 1,
  line = 3,
  triangle = 5,
  tetrahedron = 10,
  quadratic_triangle = 22,  // corners, then the middles of the edges 01, 12, 20
};

struct VtuArray {
  std::string name, units;
  std::vector<std::string> components;  // their names; empty for a scalar
  // (components, n). Three components are a vector, nine a tensor row by row: xx xy xz yx ...
  std::variant<std::vector<double>, std::vector<std::int64_t>> values;
};

struct VtuGrid {
  double time = 0;
  std::vector<double> points;              // (3, n)
  std::vector<std::int64_t> connectivity;  // 0-based points of all cells, one cell after the other
  std::vector<std::int64_t> offsets;       // end of each cell in connectivity
  std::vector<VtkCell> types;              // of each cell
  std::vector<VtuArray> point_data, cell_data;
};

// Under a temporary name until it is complete. Throws io::Error: sizes that contradict each other,
// disk full, ...
void write_vtu(const std::string& path, const VtuGrid& grid);

}  // namespace cleave::io
