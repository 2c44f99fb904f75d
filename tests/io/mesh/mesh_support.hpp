// Shared by the tests of meshes: files, measures of cells, comparison.
#pragma once

#include <array>
#include <functional>
#include <string>
#include <vector>

#include "io/lattice.hpp"
#include "io/mesh.hpp"

namespace cleave::io::testing {

// A file made by the gmsh program when the tests were built.
std::string gmsh_file(const std::string& name);
// A name for a temporary file of this process and test.
std::string scratch_path(const std::string& name);
std::string read_bytes(const std::string& path);
void write_bytes(const std::string& path, const std::string& bytes);

// A block with its lowest corner at (-1, 2, 0.5).
LatticeSpec lattice_block(LatticeKind lattice, std::array<double, 3> size, double spacing);

// Of two points.
double distance(const Mesh& mesh, std::int64_t a, std::int64_t b);
// Signed; lengths are not.
double measure(const Mesh& mesh, const CellBlock& block, std::int64_t cell);
double total_measure(const Mesh& mesh, const CellBlock& block);  // of absolute values
double group_measure(const Mesh& mesh, const std::string& group);

// The message of the io::Error that `action` throws; "" if it throws none.
std::string error_of(const std::function<void()>& action);
// Fails the test unless all parts occur in the message.
void expect_error(const std::function<void()>& action, const std::vector<std::string>& parts);

// Points agree to the digits of text; numbers, cells and groups exactly (lines: by group).
void expect_same(const Mesh& a, const Mesh& b);

}  // namespace cleave::io::testing
