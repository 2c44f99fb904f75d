#include "core/cell_list.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/error.hpp"
#include "core/tensor.hpp"

namespace cleave {

namespace {

constexpr double kTolerance = 1e-6;  // of the square of the radius
// Cells are a little wider than the radius, so that rounding of a particle's cell moves no pair
// within the radius further apart than one cell.
constexpr double kWider = 1 + 1e-5;
// Cells for each particle at most: bodies that fill little of their bounding box get wider cells.
constexpr double kCellsPerParticle = 2;

using Cell = std::array<std::int64_t, 3>;

// Particles sorted into the cells of a box around them.
class CellGrid {
 public:
  CellGrid(const double* X, std::int64_t n, double radius) : X_(X) {
    std::array<double, 3> extent{};
    for (std::size_t k = 0; k < 3; ++k) {
      double low = X[k], high = X[k];
      for (std::int64_t i = 0; i < n; ++i) {
        const double c = X[kVector * i + static_cast<std::int64_t>(k)];
        low = std::fmin(low, c);
        high = std::fmax(high, c);
      }
      low_[k] = low;
      extent[k] = high - low;
    }
    double edge = radius * kWider;
    const double most = kCellsPerParticle * static_cast<double>(n) + 8;
    while (cells_of(extent, edge) > most) edge *= 1.25;
    inverse_ = 1 / edge;
    for (std::size_t k = 0; k < 3; ++k)
      shape_[k] = static_cast<std::int64_t>(extent[k] * inverse_) + 1;
    sort(n);
  }

  // f(p) for every particle of the cell of i and of the cells around it.
  template <class F>
  void for_near(std::int64_t i, const F& f) const {
    const Cell at = cell(i);
    Cell first, last;
    for (std::size_t k = 0; k < 3; ++k) {
      first[k] = std::max<std::int64_t>(at[k] - 1, 0);
      last[k] = std::min(at[k] + 1, shape_[k] - 1);
    }
    for (std::int64_t z = first[2]; z <= last[2]; ++z)
      for (std::int64_t y = first[1]; y <= last[1]; ++y) {
        const auto from = begin_[place({first[0], y, z})], to = begin_[place({last[0], y, z}) + 1];
        for (auto k = from; k < to; ++k) f(particle_[static_cast<std::size_t>(k)]);
      }
  }

 private:
  static double cells_of(const std::array<double, 3>& extent, double edge) {
    return (std::floor(extent[0] / edge) + 1) * (std::floor(extent[1] / edge) + 1) *
           (std::floor(extent[2] / edge) + 1);
  }
  Cell cell(std::int64_t i) const {
    Cell c;
    for (std::size_t k = 0; k < 3; ++k) {
      const double along = (X_[kVector * i + static_cast<std::int64_t>(k)] - low_[k]) * inverse_;
      c[k] = std::min(static_cast<std::int64_t>(along), shape_[k] - 1);
    }
    return c;
  }
  std::size_t place(const Cell& c) const {
    return static_cast<std::size_t>((c[2] * shape_[1] + c[1]) * shape_[0] + c[0]);
  }
  void sort(std::int64_t n) {
    begin_.assign(static_cast<std::size_t>(shape_[0] * shape_[1] * shape_[2]) + 1, 0);
    for (std::int64_t i = 0; i < n; ++i) ++begin_[place(cell(i)) + 1];
    for (std::size_t c = 1; c < begin_.size(); ++c) begin_[c] += begin_[c - 1];
    std::vector<std::int64_t> next(begin_.begin(), begin_.end() - 1);
    particle_.resize(static_cast<std::size_t>(n));
    for (std::int64_t i = 0; i < n; ++i) {
      particle_[static_cast<std::size_t>(next[place(cell(i))]++)] = static_cast<std::int32_t>(i);
    }
  }

  const double* X_;
  std::array<double, 3> low_{};
  double inverse_ = 0;
  Cell shape_{};
  std::vector<std::int64_t> begin_;     // (cells+1)
  std::vector<std::int32_t> particle_;  // (n) by cell, ascending inside
};

// Rows are symmetric and sorted: visited in order, the half-bonds (i,p) arrive at row p in its order.
void fill_reverse(NeighbourRows& rows) {
  rows.reverse.resize(rows.neighbour.size());
  std::vector<std::int32_t> next(rows.row_begin.begin(), rows.row_begin.end() - 1);
  for (std::size_t b = 0; b < rows.neighbour.size(); ++b) {
    rows.reverse[b] = next[static_cast<std::size_t>(rows.neighbour[b])]++;
  }
}

}  // namespace

double square_reach(double radius, Radius rule) {
  return radius * radius * (rule == Radius::open ? 1 - kTolerance : 1 + kTolerance);
}

NeighbourRows neighbours_within(const double* X, std::int64_t n, double radius, Radius rule,
                                const std::string& owner, std::int64_t most,
                                ReverseHalves reverse) {
  const CellGrid grid(X, n, radius);
  const double limit = square_reach(radius, rule);
  const auto for_row = [&](std::int64_t i, const auto& f) {
    grid.for_near(i, [&](std::int32_t p) {
      const Vec<3> d = difference<3>(X, i, p);
      if (p != i && dot(d, d) < limit) f(p);
    });
  };
  // Counted first: the rows are large, and too large ones must not be stored to be refused.
  NeighbourRows rows;
  rows.row_begin.assign(static_cast<std::size_t>(n) + 1, 0);
  std::int64_t count = 0;
  for (std::int64_t i = 0; i < n; ++i) {
    for_row(i, [&](std::int32_t) { ++count; });
    if (count > most) {
      throw Error(CLEAVE_BAD_ARGUMENT,
                  text(owner, " has more than 2^31 half-bonds within the radius ", radius,
                       " [m] of its particles (", count / (i + 1),
                       " for each so far); use a smaller radius, or split it into bodies"));
    }
    rows.row_begin[static_cast<std::size_t>(i) + 1] = static_cast<std::int32_t>(count);
  }
  rows.neighbour.resize(static_cast<std::size_t>(count));
  for (std::int64_t i = 0; i < n; ++i) {
    const auto first = rows.neighbour.begin() + rows.row_begin[static_cast<std::size_t>(i)];
    auto next = first;
    for_row(i, [&](std::int32_t p) { *next++ = p; });
    std::sort(first, next);
  }
  if (reverse == ReverseHalves::listed) fill_reverse(rows);
  return rows;
}

}  // namespace cleave
