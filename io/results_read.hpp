// Exodus II results read back: what a run wrote, frame by frame.
//
// A value: between calls no file is open, so a result can be read while the run that writes it goes on.
// For files as Cleave writes them (results.hpp). Meshes to compute with are read by mesh.hpp, which
// knows the variants of other programs.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "io/results.hpp"

namespace cleave::io {

struct StoredBlock {
  std::string name;
  std::string type;  // Exodus: "TRI3", "TRI6", "TETRA", "SPHERE", "BAR2"
  std::int64_t corners = 0;
  std::vector<std::int64_t> nodes;  // (corners, n) 0-based, over all nodes of the file
  std::int64_t count() const { return corners > 0 ? std::ssize(nodes) / corners : 0; }
};

struct ResultFrame {
  double time = 0;
  std::vector<std::vector<double>> nodal;    // [v] is (n points)
  std::vector<std::vector<double>> element;  // [v] is (n elements of all blocks in order)
  std::vector<double> global;
};

struct StoredResults {
  std::string path, title;
  int dimension = 3;
  std::vector<double> times;   // of the complete frames
  std::vector<double> points;  // (3, n) reference position; z is 0 in a file of dimension 2
  std::vector<std::int64_t> point_ids;  // (n)
  std::vector<StoredBlock> blocks;
  std::vector<ResultVariable> nodal, element;
  std::vector<std::string> global;       // names
  std::vector<std::string> information;  // records as in the file

  std::int64_t point_count() const { return std::ssize(points) / 3; }
  std::int64_t element_count() const;
  // Frame `frame`, counted from 0. Throws io::Error if it is not in the file.
  ResultFrame read_frame(std::int64_t frame) const;
  // Only these variables (indices into nodal and element), in the order given.
  ResultFrame read_frame(std::int64_t frame, std::span<const std::size_t> nodal_chosen,
                         std::span<const std::size_t> element_chosen) const;
};

// Throws io::Error if the file is not a result (netCDF classic, as Cleave writes it) or damaged.
StoredResults read_results(const std::string& path);

}  // namespace cleave::io
