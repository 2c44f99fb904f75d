#include "io/lattice_cut.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <string>
#include <vector>

#include "io/error.hpp"
#include "io/outline.hpp"

namespace cleave::io {
namespace {

constexpr double kFit = 1e-6;  // of the spacing
constexpr double kEnd = 0.5;   // of the spacing: points of an end

using Vector = std::array<double, 3>;
using Axes = std::array<Vector, 3>;

double dot(const Vector& a, const Vector& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

bool is_plane(const LatticeSpec& spec) {
  return spec.lattice == LatticeKind::square || spec.lattice == LatticeKind::hexagonal;
}

std::string shown(const Vector& a) {
  return "(" + std::to_string(a[0]) + ", " + std::to_string(a[1]) + ", " + std::to_string(a[2]) +
         ")";
}

// Unit vectors; y in the plane of both, in two dimensions a quarter turn from x.
Axes axes_of(const LatticeSpec& spec) {
  const double length = std::sqrt(dot(spec.x_axis, spec.x_axis));
  if (!(length > 0) || !std::isfinite(length) || (is_plane(spec) && spec.x_axis[2] != 0))
    throw Error("lattice: x_axis is " + shown(spec.x_axis) + "; allowed: a direction" +
                (is_plane(spec) ? " in the plane, with z = 0" : ""));
  Axes axes{};
  for (std::size_t k = 0; k < 3; ++k) axes[0][k] = spec.x_axis[k] / length;
  const auto& x = axes[0];
  if (is_plane(spec)) return {x, {-x[1], x[0], 0}, {0, 0, 1}};
  Vector y = spec.y_axis;
  const double along = dot(x, y), given = std::sqrt(dot(y, y));
  for (std::size_t k = 0; k < 3; ++k) y[k] -= along * x[k];
  const double across = std::sqrt(dot(y, y));
  if (!(across > kFit * given) || !std::isfinite(given))
    throw Error("lattice: x_axis " + shown(spec.x_axis) + " and y_axis " + shown(spec.y_axis) +
                " are parallel; give another y_axis");
  for (double& entry : y) entry /= across;
  return {x, y, {x[1] * y[2] - x[2] * y[1], x[2] * y[0] - x[0] * y[2], x[0] * y[1] - x[1] * y[0]}};
}

// Middle and box of the shape, and whether a point is in it.
class Shape {
 public:
  explicit Shape(const LatticeSpec& spec) : spec_(spec) {
    if (is_plane(spec) && spec.shape == ShapeKind::cylinder)
      throw Error(
          "lattice: a cylinder needs a lattice in space (cubic, bcc, fcc); for a disc take the "
          "shape sphere");
    for (std::size_t k = 0; k < dimension(); ++k) {
      const bool is_axis = k == static_cast<std::size_t>(spec.axis);
      const bool round =
          spec.shape == ShapeKind::sphere || (spec.shape == ShapeKind::cylinder && !is_axis);
      const double length = spec.shape == ShapeKind::block ? spec.size[k] : spec.height;
      if (!((round ? spec.radius : length) > 0))
        throw Error("lattice: the shape has no extent along " + std::string(1, "xyz"[k]) +
                    "; size, radius and height of the shape must be greater than zero");
      lower_[k] = spec.origin[k] - (round ? spec.radius : 0);
      upper_[k] = spec.origin[k] + (round ? spec.radius : length);
    }
  }

  Vector middle() const {
    Vector sum{};
    for (std::size_t k = 0; k < 3; ++k) sum[k] = 0.5 * (lower_[k] + upper_[k]);
    return sum;
  }
  // From the middle to the farthest point of the box.
  double reach() const {
    double square = 0;
    for (std::size_t k = 0; k < 3; ++k) square += std::pow(0.5 * (upper_[k] - lower_[k]), 2);
    return std::sqrt(square);
  }
  bool contains(const double* x) const {
    const double margin = kFit * spec_.spacing;
    double square = 0;
    for (std::size_t k = 0; k < dimension(); ++k) {
      if (!(x[k] >= lower_[k] - margin && x[k] <= upper_[k] + margin)) return false;
      if (spec_.shape != ShapeKind::cylinder || k != static_cast<std::size_t>(spec_.axis))
        square += std::pow(x[k] - spec_.origin[k], 2);
    }
    return spec_.shape == ShapeKind::block || square <= std::pow(spec_.radius + margin, 2);
  }
  std::size_t dimension() const { return is_plane(spec_) ? 2 : 3; }
  bool has_face(std::size_t axis) const {
    return spec_.shape == ShapeKind::block ||
           (spec_.shape == ShapeKind::cylinder && axis == static_cast<std::size_t>(spec_.axis));
  }

 private:
  const LatticeSpec& spec_;
  Vector lower_{}, upper_{};
};

CellBlock& simplices_of(Mesh& mesh) {
  return mesh.tetrahedra.nodes.empty() ? mesh.triangles : mesh.tetrahedra;
}

// Keeps the simplices that `keeps` says and their points; their only group is "all" then.
template <class Keeps>
void keep(Mesh& mesh, const Keeps& keeps) {
  CellBlock& cells = simplices_of(mesh);
  const auto corners = static_cast<std::size_t>(cells.kind);
  std::vector<std::int64_t> nodes;
  for (std::size_t s = 0; s + corners <= cells.nodes.size(); s += corners)
    if (keeps(&cells.nodes[s]))
      nodes.insert(nodes.end(), cells.nodes.begin() + static_cast<std::ptrdiff_t>(s),
                   cells.nodes.begin() + static_cast<std::ptrdiff_t>(s + corners));
  std::vector<std::int64_t> number(static_cast<std::size_t>(mesh.point_count()), -1);
  for (const std::int64_t node : nodes) number[static_cast<std::size_t>(node)] = 0;
  std::size_t count = 0;
  for (std::size_t i = 0; i < number.size(); ++i) {
    if (number[i] < 0) continue;
    for (std::size_t k = 0; k < 3; ++k) mesh.points[3 * count + k] = mesh.points[3 * i + k];
    number[i] = static_cast<std::int64_t>(count++);
  }
  mesh.points.resize(3 * count);
  mesh.point_ids.resize(count);
  std::iota(mesh.point_ids.begin(), mesh.point_ids.end(), std::int64_t{1});
  for (std::int64_t& node : nodes) node = number[static_cast<std::size_t>(node)];
  cells.nodes = std::move(nodes);
  MeshGroup all{"all", static_cast<int>(corners) - 1, {}, {}};
  all.nodes.resize(count);
  all.cells.resize(static_cast<std::size_t>(cells.count()));
  std::iota(all.nodes.begin(), all.nodes.end(), std::int64_t{0});
  std::iota(all.cells.begin(), all.cells.end(), std::int64_t{0});
  mesh.groups = {std::move(all)};
}

// Points at both ends along an axis, before the group "all".
void add_ends(std::size_t axis, double spacing, Mesh& mesh) {
  double lower = mesh.points[axis], upper = lower;
  for (std::size_t i = axis; i < mesh.points.size(); i += 3) {
    lower = std::min(lower, mesh.points[i]);
    upper = std::max(upper, mesh.points[i]);
  }
  for (const bool high : {true, false}) {
    MeshGroup end{std::string(1, "xyz"[axis]) + (high ? "max" : "min"), 0, {}, {}};
    for (std::int64_t i = 0; i < mesh.point_count(); ++i) {
      const double x = mesh.points[3 * static_cast<std::size_t>(i) + axis];
      if ((high ? upper - x : x - lower) <= kEnd * spacing) end.nodes.push_back(i);
    }
    mesh.groups.insert(mesh.groups.end() - 1, std::move(end));
  }
}

}  // namespace

Mesh make_turned_lattice(const LatticeSpec& spec) {
  const Axes axes = axes_of(spec);
  const Shape shape(spec);
  LatticeSpec whole = spec;
  whole.shape = ShapeKind::sphere;
  whole.origin = {0, 0, 0};
  whole.radius = shape.reach() + spec.spacing;
  whole.x_axis = {1, 0, 0};
  whole.y_axis = {0, 1, 0};
  Mesh mesh = make_lattice(whole);
  const Vector middle = shape.middle();
  for (std::size_t i = 0; i < mesh.points.size(); i += 3) {
    const Vector x{mesh.points[i], mesh.points[i + 1], mesh.points[i + 2]};
    for (std::size_t k = 0; k < 3; ++k)
      mesh.points[i + k] = middle[k] + x[0] * axes[0][k] + x[1] * axes[1][k] + x[2] * axes[2][k];
  }
  std::vector<char> inside;
  for (std::size_t i = 0; i < mesh.points.size(); i += 3)
    inside.push_back(shape.contains(&mesh.points[i]) ? 1 : 0);
  const auto corners = static_cast<std::ptrdiff_t>(simplices_of(mesh).kind);
  keep(mesh, [&](const std::int64_t* v) {
    return std::all_of(v, v + corners,
                       [&](std::int64_t i) { return inside[static_cast<std::size_t>(i)] != 0; });
  });
  if (mesh.point_count() == 0)
    throw Error("lattice: not one cell fits into the shape; make the spacing smaller");
  for (std::size_t axis = 0; axis < shape.dimension(); ++axis)
    if (shape.has_face(axis)) add_ends(axis, spec.spacing, mesh);
  return mesh;
}

void cut_to_outline(const Mesh& outline, double spacing, Mesh& lattice) {
  const auto corners = static_cast<std::size_t>(simplices_of(lattice).kind);
  const Outline within(outline, static_cast<int>(corners) - 1, kFit * spacing);
  std::vector<char> inside;
  for (std::size_t i = 0; i < lattice.points.size(); i += 3)
    inside.push_back(within.contains(&lattice.points[i]) ? 1 : 0);
  keep(lattice, [&](const std::int64_t* v) {
    Vector centre{};
    for (std::size_t a = 0; a < corners; ++a) {
      const auto i = static_cast<std::size_t>(v[a]);
      if (inside[i] == 0) return false;
      for (std::size_t k = 0; k < 3; ++k)
        centre[k] += lattice.points[3 * i + k] / static_cast<double>(corners);
    }
    return within.contains(centre.data());
  });
  if (lattice.point_count() == 0)
    throw Error("lattice: not one of its cells lies within the mesh " + outline.path +
                "; are both in the same place and unit, and is the spacing small enough?");
  for (std::size_t axis = 0; axis + 1 < corners; ++axis) add_ends(axis, spacing, lattice);
}

LatticeSpec around(LatticeSpec spec, const Mesh& outline) {
  const int dimension = is_plane(spec) ? 2 : 3;
  const Outline within(outline, dimension, 0);
  spec.shape = ShapeKind::block;
  spec.origin = within.lower();
  for (std::size_t k = 0; k < static_cast<std::size_t>(dimension); ++k) {
    const double count = std::ceil((within.upper()[k] - within.lower()[k]) / spec.spacing - kFit);
    spec.size[k] = std::max(1.0, count) * spec.spacing;
  }
  if (dimension == 2) spec.origin[2] = 0;
  return spec;
}

}  // namespace cleave::io
