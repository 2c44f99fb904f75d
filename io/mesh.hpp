// Meshes from files: points, cells and named groups, nothing of physics.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace cleave::io {

// Meshes are read with linear cells only; other cells are counted in `skipped` (second-order meshes are
// refused with a message that says how to mesh again). Results may also have six-node triangles.
enum class CellKind {  // value = nodes
  point = 1,
  line = 2,
  triangle = 3,
  tetrahedron = 4,
  triangle6 = 6  // corners, then the middles of edges 12, 23, 31
};

// No cell occurs twice: a file that repeats one (Gmsh 2.2 does, for every physical group it is in)
// gives it once, at its first place, with the corners in the order of the first.
struct CellBlock {
  CellKind kind = CellKind::point;
  std::vector<std::int64_t> nodes;  // (corners, n) 0-based indices into Mesh::points
  std::int64_t count() const {
    return static_cast<std::int64_t>(nodes.size()) / static_cast<int>(kind);
  }
};

// A named group: Gmsh physical group, Exodus block, node set or side set.
struct MeshGroup {
  std::string name;   // the name in the file; without one "<dim>:<tag>" (Gmsh), "block_<id>",
                      // "nodeset_<id>", "sideset_<id>" (Exodus)
  int dimension = 0;  // 0 points, 1 lines, 2 triangles, 3 tetrahedra
  std::vector<std::int64_t> nodes;  // sorted, unique, 0-based: all nodes of the group
  std::vector<std::int64_t> cells;  // sorted, unique, 0-based into the block of that dimension
                                    // (empty for points and node sets)
};

// Cells of the file that are not simplices.
struct SkippedCells {
  std::string type;  // "quadrangle", "HEX8", ...
  std::int64_t count = 0;
};

struct Mesh {
  std::string path;
  std::vector<double> points;           // (3, n), also those that no cell uses
  std::vector<std::int64_t> point_ids;  // (n) number in the file
  CellBlock lines{CellKind::line, {}};
  CellBlock triangles{CellKind::triangle, {}};
  CellBlock tetrahedra{CellKind::tetrahedron, {}};
  std::vector<MeshGroup> groups;      // sorted by dimension, then name; both together are unique
  std::vector<SkippedCells> skipped;  // sorted by type

  std::int64_t point_count() const { return static_cast<std::int64_t>(points.size()) / 3; }
  // The group called `name`; of several the one of highest dimension, unless `name` says the
  // dimension as in "1:left".  nullptr if absent.
  const MeshGroup* find_group(const std::string& name) const;
  // "24 quadrangle, 3 HEX8"; empty if nothing was skipped.
  std::string skipped_summary() const;
};

// Gmsh MSH 2.2 and 4.1 (ASCII and binary) and Exodus II, told apart by content, not by file name.
// Throws io::Error: cannot open, not a mesh, truncated (with line or byte), unsupported version
// (with what to do), node index out of range. Never crashes on garbage.
Mesh read_mesh(const std::string& path);

}  // namespace cleave::io
