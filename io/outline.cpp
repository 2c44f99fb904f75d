// A simplex is in every bin that its box touches; a point looks at those of its bin.
#include "io/outline.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "io/error.hpp"

namespace cleave::io {
namespace {

using Vector = std::array<double, 3>;

Vector from_to(const double* a, const double* b) { return {b[0] - a[0], b[1] - a[1], b[2] - a[2]}; }
double dot(const Vector& a, const Vector& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
Vector cross(const Vector& a, const Vector& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

}  // namespace

Outline::Outline(const Mesh& mesh, int dimension, double margin)
    : mesh_(mesh),
      cells_(dimension == 2 ? mesh.triangles : mesh.tetrahedra),
      dimension_(dimension),
      margin_(margin) {
  if (cells_.count() == 0)
    throw Error(mesh.path + ": there are no " + (dimension == 2 ? "triangles" : "tetrahedra") +
                " in the mesh, which the lattice is to be cut to");
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  lower_.fill(kInfinity);
  upper_.fill(-kInfinity);
  for (const std::int64_t node : cells_.nodes)
    for (std::size_t k = 0; k < 3; ++k) {
      const double x = mesh.points[3 * static_cast<std::size_t>(node) + k];
      lower_[k] = std::min(lower_[k], x);
      upper_[k] = std::max(upper_[k], x);
    }
  const double along = std::pow(static_cast<double>(cells_.count()), 1.0 / dimension);
  for (std::size_t k = 0; k < static_cast<std::size_t>(dimension); ++k)
    bins_[k] = std::max<std::int64_t>(1, std::llround(along));
  first_.assign(static_cast<std::size_t>(bins_[0] * bins_[1] * bins_[2]) + 1, 0);
  for (std::int64_t s = 0; s < cells_.count(); ++s)
    for_each_bin(bins_of(s), [&](std::size_t bin) { ++first_[bin + 1]; });
  for (std::size_t bin = 1; bin < first_.size(); ++bin) first_[bin] += first_[bin - 1];
  simplices_.resize(static_cast<std::size_t>(first_.back()));
  std::vector<std::int64_t> next(first_.begin(), first_.end() - 1);
  for (std::int64_t s = 0; s < cells_.count(); ++s)
    for_each_bin(bins_of(s),
                 [&](std::size_t bin) { simplices_[static_cast<std::size_t>(next[bin]++)] = s; });
}

const double* Outline::corner(std::int64_t simplex, int a) const {
  const std::int64_t node = cells_.nodes[static_cast<std::size_t>(simplex * (dimension_ + 1) + a)];
  return &mesh_.points[3 * static_cast<std::size_t>(node)];
}

std::int64_t Outline::bin_along(std::size_t axis, double x) const {
  const double width = upper_[axis] - lower_[axis];
  if (!(width > 0)) return 0;
  const double part = std::clamp((x - lower_[axis]) / width, 0.0, 1.0);
  return std::min(bins_[axis] - 1,
                  static_cast<std::int64_t>(part * static_cast<double>(bins_[axis])));
}

Outline::Box Outline::bins_of(std::int64_t simplex) const {
  Box box{};
  for (std::size_t k = 0; k < static_cast<std::size_t>(dimension_); ++k) {
    double low = corner(simplex, 0)[k], high = low;
    for (int a = 1; a <= dimension_; ++a) {
      low = std::min(low, corner(simplex, a)[k]);
      high = std::max(high, corner(simplex, a)[k]);
    }
    box[0][k] = bin_along(k, low - margin_);
    box[1][k] = bin_along(k, high + margin_);
  }
  return box;
}

template <class Visit>
void Outline::for_each_bin(const Box& box, const Visit& visit) const {
  for (std::int64_t k = box[0][2]; k <= box[1][2]; ++k)
    for (std::int64_t j = box[0][1]; j <= box[1][1]; ++j)
      for (std::int64_t i = box[0][0]; i <= box[1][0]; ++i)
        visit(static_cast<std::size_t>((k * bins_[1] + j) * bins_[0] + i));
}

// Not beyond the facet opposite to any corner.
bool Outline::is_in(const double* x, std::int64_t simplex) const {
  const int corners = dimension_ + 1;
  for (int a = 0; a < corners; ++a) {
    const double* p = corner(simplex, (a + 1) % corners);
    const Vector along = from_to(p, corner(simplex, (a + 2) % corners));
    const Vector normal = dimension_ == 2
                              ? Vector{-along[1], along[0], 0}
                              : cross(along, from_to(p, corner(simplex, (a + 3) % corners)));
    const double side = dot(normal, from_to(p, corner(simplex, a)));
    const double distance = dot(normal, from_to(p, x)) / std::sqrt(dot(normal, normal));
    if (!((side > 0 ? distance : -distance) >= -margin_)) return false;
  }
  return true;
}

bool Outline::contains(const double* x) const {
  std::array<std::int64_t, 3> at{};
  for (std::size_t k = 0; k < static_cast<std::size_t>(dimension_); ++k) {
    if (!(x[k] >= lower_[k] - margin_ && x[k] <= upper_[k] + margin_)) return false;
    at[k] = bin_along(k, x[k]);
  }
  const auto bin = static_cast<std::size_t>((at[2] * bins_[1] + at[1]) * bins_[0] + at[0]);
  return std::any_of(simplices_.begin() + first_[bin], simplices_.begin() + first_[bin + 1],
                     [&](std::int64_t simplex) { return is_in(x, simplex); });
}

}  // namespace cleave::io
