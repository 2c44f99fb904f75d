// Puts a mesh together for the readers: node numbers to indices, repeated cells to one, cells and
// nodes to named groups. The result does not depend on the order of groups in the file.
#pragma once

#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "io/mesh.hpp"

namespace cleave::io {

// Node number in the file -> index. Consecutive numbers cost nothing, dense ones a table, sparse
// ones a binary search.
class NodeNumbers {
 public:
  // Returns a number that occurs twice, or -1.
  std::int64_t build(std::span<const std::int64_t> ids);
  std::int64_t index(std::int64_t id) const {  // -1 if there is no such node
    if (consecutive_) return id >= first_ && id - first_ < count_ ? id - first_ : -1;
    return lookup(id);
  }

 private:
  std::int64_t lookup(std::int64_t id) const;

  bool consecutive_ = true;
  std::int64_t first_ = 0, count_ = 0;
  std::vector<std::int64_t> table_;                            // index of node first_ + i, or -1
  std::vector<std::pair<std::int64_t, std::int64_t>> sorted_;  // (number, index)
};

class MeshBuilder {
 public:
  using Group = std::size_t;

  explicit MeshBuilder(std::string path) { mesh_.path = std::move(path); }

  std::vector<double>& points() { return mesh_.points; }
  std::vector<std::int64_t>& point_ids() { return mesh_.point_ids; }
  CellBlock& block(CellKind kind);
  // Makes room for cells that are about to follow.
  void expect_cells(CellKind kind, std::int64_t count);

  // The group of that name and dimension, made if there is none yet.
  Group group(const std::string& name, int dimension);
  // Cells first..last of the block of the group's dimension.
  void add_cells(Group group, std::int64_t first, std::int64_t last);
  void add_node(Group group, std::int64_t node) { members_[group].nodes.push_back(node); }
  void skip(const std::string& type, std::int64_t count) { skipped_[type] += count; }

  Mesh finish();

 private:
  // Cells as ranges: neighbours in a file are mostly in the same groups.
  struct Members {
    std::vector<std::pair<std::int64_t, std::int64_t>> ranges;
    std::vector<std::int64_t> nodes;
  };
  MeshGroup finish_group(const std::string& name, int dimension, Members& members,
                         std::span<const std::vector<std::int64_t>> new_index);

  Mesh mesh_;
  std::map<std::pair<int, std::string>, Group> group_numbers_;
  std::vector<Members> members_;
  std::map<std::string, std::int64_t> skipped_;
};

// Keeps the first of cells with the same corners. Returns the new index of every old cell; empty if
// no cell occurs twice. Linear in the number of cells.
std::vector<std::int64_t> remove_repeated_cells(CellBlock& block, std::int64_t point_count);

}  // namespace cleave::io
