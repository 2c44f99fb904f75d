// Lattices cut to simple shapes and split into simplices.
//
// Every lattice is a set of integer triples (i, j, k) with a step length for each axis: neighbours,
// parity and simplices are integer arithmetic, and the order of points is that of three loops. A
// row of points along x in a convex shape is an interval, so that a table of rows finds any point.
#include "io/lattice.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <new>
#include <numbers>
#include <optional>
#include <vector>

#include "io/error.hpp"
#include "io/lattice_cut.hpp"

namespace cleave::io {
namespace {

constexpr double kFit =
    1e-6;  // what counts as fitting, relative to the spacing (faces) or the edge
constexpr double kMostPoints = 2147483648.0;  // 2^31

using Triple = std::array<std::int64_t, 3>;

struct Pattern {
  int dimension = 3;
  std::array<double, 3> step{};  // in units of the nearest-neighbour distance
  std::int64_t stride = 1;       // of points along a row
  double density = 1;            // points per integer triple
};

Pattern pattern_of(LatticeKind kind) {
  const double bcc = 1 / std::numbers::sqrt3, fcc = 1 / std::numbers::sqrt2;  // half a cube edge
  switch (kind) {
    case LatticeKind::square:
      return {2, {1, 1, 1}, 1, 1};
    case LatticeKind::hexagonal:
      return {2, {0.5, std::numbers::sqrt3 / 2, 1}, 2, 0.5};
    case LatticeKind::cubic:
      return {3, {1, 1, 1}, 1, 1};
    case LatticeKind::bcc:
      return {3, {bcc, bcc, bcc}, 2, 0.25};
    case LatticeKind::fcc:
      return {3, {fcc, fcc, fcc}, 2, 0.5};
  }
  throw Error("the kind of the lattice is unknown");
}

bool is_odd(std::int64_t n) { return (n & 1) != 0; }

bool is_point(LatticeKind kind, const Triple& p) {
  switch (kind) {
    case LatticeKind::hexagonal:
      return !is_odd(p[0] + p[1]);
    case LatticeKind::bcc:
      return is_odd(p[0]) == is_odd(p[1]) && is_odd(p[1]) == is_odd(p[2]);
    case LatticeKind::fcc:
      return !is_odd(p[0] + p[1] + p[2]);
    default:
      return true;
  }
}

Triple plus(const Triple& a, const Triple& b) { return {a[0] + b[0], a[1] + b[1], a[2] + b[2]}; }

// Corners relative to the point the simplex belongs to; the first is (0,0,0).
using Simplex = std::vector<Triple>;

std::int64_t orientation(const Simplex& s) {
  const Triple &a = s[1], &b = s[2];
  if (s.size() == 3) return a[0] * b[1] - a[1] * b[0];
  const Triple& c = s[3];
  return a[0] * (b[1] * c[2] - b[2] * c[1]) - a[1] * (b[0] * c[2] - b[2] * c[0]) +
         a[2] * (b[0] * c[1] - b[1] * c[0]);
}

// The six tetrahedra around the main diagonal of the cell of three primitive vectors.
std::vector<Simplex> kuhn_split(const std::array<Triple, 3>& vectors) {
  std::vector<Simplex> result;
  std::array<std::size_t, 3> order = {0, 1, 2};
  do {
    Simplex s = {{0, 0, 0}};
    for (const std::size_t k : order) s.push_back(plus(s.back(), vectors[k]));
    if (orientation(s) < 0) std::swap(s[2], s[3]);
    result.push_back(std::move(s));
  } while (std::next_permutation(order.begin(), order.end()));
  return result;
}

// The simplices that belong to an even and to an odd point (the sum of its integers); the same but
// for the square lattice, where cells with diagonals / and \ alternate.
struct Split {
  std::vector<Simplex> even, odd;
};

// bcc and fcc: primitive vectors that enclose right or obtuse angles with each other and with minus
// their sum. Then the split is a Delaunay triangulation, the main diagonal is a nearest-neighbour
// bond, and the edges are 1 and 1.15 (bcc) or 1 and 1.41 (fcc) spacings long. The rhombohedron of
// fcc with angles of 60 degrees would have edges of 1.73.
Split split_of(LatticeKind kind) {
  const auto same = [](const std::vector<Simplex>& s) { return Split{s, s}; };
  switch (kind) {
    case LatticeKind::square:
      return {{{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}},
               {{0, 0, 0}, {1, 1, 0}, {0, 1, 0}},
               {{0, 0, 0}, {0, 1, 0}, {-1, 1, 0}}},
              {{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}}};
    case LatticeKind::hexagonal:
      return same({{{0, 0, 0}, {2, 0, 0}, {1, 1, 0}}, {{0, 0, 0}, {1, 1, 0}, {-1, 1, 0}}});
    case LatticeKind::cubic:
      return same(kuhn_split({{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}}));
    case LatticeKind::bcc:
      return same(kuhn_split({{{-1, 1, 1}, {1, -1, 1}, {1, 1, -1}}}));
    case LatticeKind::fcc:
      return same(kuhn_split({{{1, 1, 0}, {-1, 1, 0}, {0, -1, 1}}}));
  }
  return {};
}

std::string number(double value) {
  constexpr int kDigits = 9;
  std::array<char, 32> text{};
  const auto end = std::to_chars(text.data(), text.data() + text.size(), value,
                                 std::chars_format::general, kDigits);
  return {text.data(), end.ptr};
}

void require_positive(const char* what, double value) {
  if (!(value > 0) || !std::isfinite(value))
    throw Error("lattice: " + std::string(what) + " is " + number(value) +
                "; it must be given and greater than zero");
}

// The axes of a shape and how far it reaches along them from the origin, in steps.
class Shape {
 public:
  Shape(const LatticeSpec& spec, const Pattern& pattern) : spec_(spec), pattern_(pattern) {
    for (std::size_t k = 0; k < 3; ++k) step_[k] = pattern.step[k] * spec.spacing;
    if (spec.shape == ShapeKind::block) reach_of_block();
    if (spec.shape == ShapeKind::cylinder) reach_of_cylinder();
    if (spec.shape == ShapeKind::sphere) reach_of_sphere();
    check_size();
  }

  std::int64_t low(std::size_t axis) const { return two_sided_[axis] ? -high(axis) : 0; }
  std::int64_t high(std::size_t axis) const { return static_cast<std::int64_t>(reach_[axis]); }

  bool contains(const Triple& p) const {
    if (spec_.shape == ShapeKind::block) return true;
    double square = 0;
    for (std::size_t k = 0; k < 3; ++k)
      if (two_sided_[k]) square += std::pow(static_cast<double>(p[k]) * step_[k], 2);
    const double radius = spec_.radius + kFit * spec_.spacing;
    return square <= radius * radius;
  }

  // The edges of a fitted block are as given to the last bit.
  double coordinate(std::size_t axis, std::int64_t n) const {
    const double along = fitted_[axis] ? spec_.size[axis] * (static_cast<double>(n) / reach_[axis])
                                       : static_cast<double>(n) * step_[axis];
    return spec_.origin[axis] + along;
  }

 private:
  std::size_t dimension() const { return static_cast<std::size_t>(pattern_.dimension); }

  void set_reach(std::size_t axis, double length, bool two_sided) {
    reach_[axis] = std::floor(length / step_[axis] + kFit);
    two_sided_[axis] = two_sided;
  }

  void reach_of_block() {
    constexpr std::array<const char*, 3> kEdges = {"the size along x", "the size along y",
                                                   "the size along z"};
    for (std::size_t k = 0; k < dimension(); ++k) {
      require_positive(kEdges[k], spec_.size[k]);
      set_reach(k, spec_.size[k], false);
      fitted_[k] = pattern_.stride == 1;  // square and cubic
      if (fitted_[k]) fit(k, kEdges[k]);
    }
  }

  void fit(std::size_t axis, const char* edge) {
    const double ratio = spec_.size[axis] / spec_.spacing;
    reach_[axis] = std::round(ratio);
    if (reach_[axis] >= 1 && std::abs(ratio - reach_[axis]) <= kFit * ratio) return;
    const double below = std::floor(ratio);
    throw Error("lattice: " + std::string(edge) + ", " + number(spec_.size[axis]) +
                ", is not a multiple of the spacing " + number(spec_.spacing) +
                "; the nearest sizes are " +
                (below >= 1 ? number(below * spec_.spacing) + " and " : "") +
                number((below + 1) * spec_.spacing));
  }

  void reach_of_cylinder() {
    if (dimension() == 2)
      throw Error(
          "lattice: a cylinder needs a lattice in space (cubic, bcc, fcc); for a disc take the "
          "shape sphere");
    if (spec_.axis < 0 || spec_.axis > 2)
      throw Error("lattice: the axis of a cylinder is 0, 1 or 2, not " +
                  std::to_string(spec_.axis));
    require_positive("the radius", spec_.radius);
    require_positive("the height", spec_.height);
    for (std::size_t k = 0; k < 3; ++k) {
      const bool is_axis = k == static_cast<std::size_t>(spec_.axis);
      set_reach(k, is_axis ? spec_.height : spec_.radius, !is_axis);
    }
  }

  void reach_of_sphere() {
    require_positive("the radius", spec_.radius);
    for (std::size_t k = 0; k < dimension(); ++k) set_reach(k, spec_.radius, true);
  }

  void check_size() const {
    double points = pattern_.density;
    for (std::size_t k = 0; k < dimension(); ++k) points *= (two_sided_[k] ? 2 : 1) * reach_[k] + 1;
    if (spec_.shape != ShapeKind::block) {
      const bool is_ball = spec_.shape == ShapeKind::sphere && pattern_.dimension == 3;
      points *= std::numbers::pi / (is_ball ? 6 : 4);  // of the box around it
    }
    if (!(points <= kMostPoints))
      throw Error("lattice: about " + number(points) + " points, more than the " +
                  number(kMostPoints) + " that are possible; is the spacing " +
                  number(spec_.spacing) + " in the right unit?");
  }

  const LatticeSpec& spec_;
  const Pattern& pattern_;
  std::array<double, 3> step_{}, reach_{};
  std::array<bool, 3> two_sided_{}, fitted_{};
};

// All lattice points in the shape, numbered along x, then y, then z.
class Rows {
 public:
  Rows(LatticeKind kind, const Shape& shape, std::int64_t stride) : stride_(stride) {
    for (std::size_t k = 0; k < 3; ++k) {
      low_[k] = shape.low(k);
      high_[k] = shape.high(k);
    }
    rows_.reserve(static_cast<std::size_t>((high_[1] - low_[1] + 1) * (high_[2] - low_[2] + 1)));
    for (std::int64_t k = low_[2]; k <= high_[2]; ++k)
      for (std::int64_t j = low_[1]; j <= high_[1]; ++j) add_row(kind, shape, j, k);
  }

  std::int64_t count() const { return count_; }

  std::optional<std::int64_t> find(const Triple& p) const {
    if (p[1] < low_[1] || p[1] > high_[1] || p[2] < low_[2] || p[2] > high_[2]) return std::nullopt;
    const Row& row = rows_[static_cast<std::size_t>((p[2] - low_[2]) * (high_[1] - low_[1] + 1) +
                                                    (p[1] - low_[1]))];
    if (p[0] < row.first || p[0] > row.last) return std::nullopt;
    return row.begin + (p[0] - row.first) / stride_;
  }

  // Calls visit(triple) for every point in order.
  template <class Visit>
  void for_each(Visit visit) const {
    std::size_t row = 0;
    for (std::int64_t k = low_[2]; k <= high_[2]; ++k)
      for (std::int64_t j = low_[1]; j <= high_[1]; ++j, ++row)
        for (std::int64_t i = rows_[row].first; i <= rows_[row].last; i += stride_)
          visit(Triple{i, j, k});
  }

 private:
  struct Row {
    std::int64_t first = 0, last = -1, begin = 0;
  };

  void add_row(LatticeKind kind, const Shape& shape, std::int64_t j, std::int64_t k) {
    Row row{0, -1, count_};
    for (std::int64_t i = low_[0]; i <= high_[0]; ++i) {
      if (!is_point(kind, {i, j, k}) || !shape.contains({i, j, k})) continue;
      if (row.last < row.first) row.first = i;
      row.last = i;
      ++count_;
    }
    rows_.push_back(row);
  }

  Triple low_{}, high_{};
  std::int64_t stride_ = 1, count_ = 0;
  std::vector<Row> rows_;
};

void add_cells(const Rows& rows, const Split& split, CellBlock& cells) {
  std::vector<std::int64_t> corners;
  rows.for_each([&](const Triple& p) {
    for (const Simplex& simplex : is_odd(p[0] + p[1] + p[2]) ? split.odd : split.even) {
      corners.clear();
      for (const Triple& offset : simplex) {
        const std::optional<std::int64_t> corner = rows.find(plus(p, offset));
        if (!corner) break;
        corners.push_back(*corner);
      }
      if (corners.size() == simplex.size())
        cells.nodes.insert(cells.nodes.end(), corners.begin(), corners.end());
    }
  });
}

// Points that have a simplex, in order; renumbers the corners of the cells.
void add_used_points(const Rows& rows, const Shape& shape, CellBlock& cells, Mesh& mesh) {
  std::vector<std::int64_t> index(static_cast<std::size_t>(rows.count()), -1);
  for (const std::int64_t node : cells.nodes) index[static_cast<std::size_t>(node)] = 0;
  std::size_t old = 0;
  rows.for_each([&](const Triple& p) {
    if (index[old] == 0) {
      index[old] = mesh.point_count();
      for (std::size_t k = 0; k < 3; ++k) mesh.points.push_back(shape.coordinate(k, p[k]));
      mesh.point_ids.push_back(mesh.point_count());
    }
    ++old;
  });
  for (std::int64_t& node : cells.nodes) node = index[static_cast<std::size_t>(node)];
}

std::vector<std::int64_t> points_at(const Mesh& mesh, std::size_t axis, double value,
                                    double tolerance) {
  std::vector<std::int64_t> nodes;
  for (std::int64_t i = 0; i < mesh.point_count(); ++i)
    if (std::abs(mesh.points[3 * static_cast<std::size_t>(i) + axis] - value) <= tolerance)
      nodes.push_back(i);
  return nodes;
}

std::vector<std::int64_t> numbers_to(std::int64_t count) {
  std::vector<std::int64_t> numbers(static_cast<std::size_t>(count));
  for (std::size_t i = 0; i < numbers.size(); ++i) numbers[i] = static_cast<std::int64_t>(i);
  return numbers;
}

void add_faces(const LatticeSpec& spec, std::size_t axis, Mesh& mesh) {
  const std::string letter(1, static_cast<char>('x' + axis));
  double low = mesh.points[axis], high = low;
  for (std::size_t i = axis; i < mesh.points.size(); i += 3) {
    low = std::min(low, mesh.points[i]);
    high = std::max(high, mesh.points[i]);
  }
  const double tolerance = kFit * spec.spacing / 2;
  mesh.groups.push_back({letter + "max", 0, points_at(mesh, axis, high, tolerance), {}});
  mesh.groups.push_back({letter + "min", 0, points_at(mesh, axis, low, tolerance), {}});
}

Mesh make(const LatticeSpec& spec) {
  require_positive("the spacing", spec.spacing);
  for (const double coordinate : spec.origin)
    if (!std::isfinite(coordinate)) throw Error("lattice: the origin is not finite");
  const Pattern pattern = pattern_of(spec.lattice);
  const Shape shape(spec, pattern);
  const Rows rows(spec.lattice, shape, pattern.stride);

  Mesh mesh;
  mesh.path = "(lattice)";
  CellBlock& cells = pattern.dimension == 2 ? mesh.triangles : mesh.tetrahedra;
  add_cells(rows, split_of(spec.lattice), cells);
  if (cells.nodes.empty())
    throw Error("lattice: not one cell fits into the shape; make the spacing, " +
                number(spec.spacing) + ", smaller than half the shape");
  add_used_points(rows, shape, cells, mesh);

  const bool is_block = spec.shape == ShapeKind::block;
  for (std::size_t axis = 0; axis < static_cast<std::size_t>(pattern.dimension); ++axis) {
    const bool is_base =
        spec.shape == ShapeKind::cylinder && axis == static_cast<std::size_t>(spec.axis);
    if (is_block || is_base) add_faces(spec, axis, mesh);
  }
  mesh.groups.push_back(
      {"all", pattern.dimension, numbers_to(mesh.point_count()), numbers_to(cells.count())});
  return mesh;
}

}  // namespace

Mesh make_lattice(const LatticeSpec& spec) {
  const LatticeSpec along;
  const bool is_turned = spec.x_axis != along.x_axis || spec.y_axis != along.y_axis;
  try {
    return is_turned ? make_turned_lattice(spec) : make(spec);
  } catch (const std::bad_alloc&) {
    throw Error(
        "lattice: there is not enough memory for its points and simplices; is the spacing " +
        number(spec.spacing) + " in the right unit?");
  }
}

}  // namespace cleave::io
