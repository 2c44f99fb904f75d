#include "mesh_support.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <iterator>

#include "io/error.hpp"

namespace cleave::io::testing {
namespace {

using Vector = std::array<double, 3>;

Vector point(const Mesh& mesh, std::int64_t node) {
  const auto i = 3 * static_cast<std::size_t>(node);
  return {mesh.points.at(i), mesh.points.at(i + 1), mesh.points.at(i + 2)};
}
Vector minus(const Vector& a, const Vector& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
Vector cross(const Vector& a, const Vector& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
double dot(const Vector& a, const Vector& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

const CellBlock& block_of(const Mesh& mesh, int dimension) {
  return dimension == 1 ? mesh.lines : dimension == 2 ? mesh.triangles : mesh.tetrahedra;
}

}  // namespace

std::string gmsh_file(const std::string& name) { return std::string(MESH_DIR) + "/" + name; }

std::string scratch_path(const std::string& name) {
  const auto* info = ::testing::UnitTest::GetInstance()->current_test_info();
  return std::string(SCRATCH_DIR) + "/" + info->test_suite_name() + "_" + info->name() + "_" +
         std::to_string(getpid()) + "_" + name;
}

std::string read_bytes(const std::string& path) {
  std::ifstream stream(path, std::ios::binary);
  EXPECT_TRUE(stream) << path;
  return {std::istreambuf_iterator<char>(stream), {}};
}

void write_bytes(const std::string& path, const std::string& bytes) {
  std::ofstream stream(path, std::ios::binary);
  stream.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  ASSERT_TRUE(stream) << path;
}

LatticeSpec lattice_block(LatticeKind lattice, std::array<double, 3> size, double spacing) {
  LatticeSpec spec;
  spec.lattice = lattice;
  spec.spacing = spacing;
  spec.size = size;
  spec.origin = {-1, 2, 0.5};
  return spec;
}

double distance(const Mesh& mesh, std::int64_t a, std::int64_t b) {
  double square = 0;
  for (std::size_t k = 0; k < 3; ++k)
    square += std::pow(mesh.points[3 * static_cast<std::size_t>(a) + k] -
                           mesh.points[3 * static_cast<std::size_t>(b) + k],
                       2);
  return std::sqrt(square);
}

double measure(const Mesh& mesh, const CellBlock& block, std::int64_t cell) {
  const auto corners = static_cast<std::int64_t>(block.kind);
  std::array<Vector, 4> x{};
  for (std::int64_t k = 0; k < corners; ++k)
    x[static_cast<std::size_t>(k)] =
        point(mesh, block.nodes.at(static_cast<std::size_t>(cell * corners + k)));
  const Vector a = minus(x[1], x[0]), b = minus(x[2], x[0]), c = minus(x[3], x[0]);
  if (block.kind == CellKind::line) return std::sqrt(dot(a, a));
  if (block.kind == CellKind::tetrahedron) return dot(cross(a, b), c) / 6;
  const Vector n = cross(a, b);
  return std::copysign(std::sqrt(dot(n, n)) / 2, n[2] != 0 ? n[2] : 1.0);
}

double total_measure(const Mesh& mesh, const CellBlock& block) {
  double sum = 0;
  for (std::int64_t cell = 0; cell < block.count(); ++cell)
    sum += std::abs(measure(mesh, block, cell));
  return sum;
}

double group_measure(const Mesh& mesh, const std::string& name) {
  const MeshGroup* group = mesh.find_group(name);
  if (group == nullptr) return std::nan("");
  double sum = 0;
  for (const std::int64_t cell : group->cells)
    sum += std::abs(measure(mesh, block_of(mesh, group->dimension), cell));
  return sum;
}

std::string error_of(const std::function<void()>& action) {
  try {
    action();
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

void expect_error(const std::function<void()>& action, const std::vector<std::string>& parts) {
  const std::string message = error_of(action);
  EXPECT_FALSE(message.empty()) << "no error was thrown";
  for (const std::string& part : parts)
    EXPECT_NE(message.find(part), std::string::npos) << "\"" << part << "\" is not in: " << message;
}

void expect_same(const Mesh& a, const Mesh& b) {
  EXPECT_EQ(a.point_ids, b.point_ids);
  ASSERT_EQ(a.points.size(), b.points.size());
  double largest = 0;
  for (const double x : a.points) largest = std::max(largest, std::abs(x));
  // Text files carry 16 digits. Measured: 2.2e-16.
  for (std::size_t i = 0; i < a.points.size(); ++i)
    EXPECT_NEAR(a.points[i], b.points[i], 1e-15 * largest);
  EXPECT_EQ(a.triangles.nodes, b.triangles.nodes);
  EXPECT_EQ(a.tetrahedra.nodes, b.tetrahedra.nodes);
  ASSERT_EQ(a.groups.size(), b.groups.size());
  for (std::size_t i = 0; i < a.groups.size(); ++i) {
    const MeshGroup &g = a.groups[i], &h = b.groups[i];
    EXPECT_EQ(g.name, h.name);
    EXPECT_EQ(g.dimension, h.dimension) << g.name;
    EXPECT_EQ(g.nodes, h.nodes) << g.name;
    EXPECT_EQ(g.cells.size(), h.cells.size()) << g.name;
    if (g.dimension != 1) {
      EXPECT_EQ(g.cells, h.cells) << g.name;
    }
    if (g.dimension == 1) {
      EXPECT_DOUBLE_EQ(group_measure(a, g.name), group_measure(b, g.name));
    }
  }
}

}  // namespace cleave::io::testing
