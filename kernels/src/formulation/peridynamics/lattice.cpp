#include "formulation/peridynamics/lattice.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace cleave::peridynamics {

namespace {

constexpr double kOff = 1e-6;  // of the spacing
constexpr double kLeastFilled = 0.125;

}  // namespace

Lattice find_lattice(const Neighbourhood& hood) {
  double nearest = std::numeric_limits<double>::infinity();
  for (auto b = hood.first(0); b < hood.last(0); ++b)
    nearest = std::fmin(nearest, hood.length(0, hood.neighbour(b)));
  if (!std::isfinite(nearest)) return {};
  std::array<double, 3> low{}, extent{};
  for (std::size_t k = 0; k < 3; ++k) {
    double high = hood.X[k];
    low[k] = high;
    for (std::int64_t i = 1; i < hood.points; ++i) {
      const double x = hood.X[kVector * i + static_cast<std::int64_t>(k)];
      low[k] = std::fmin(low[k], x);
      high = std::fmax(high, x);
    }
    extent[k] = high - low[k];
  }
  const double longest = *std::max_element(extent.begin(), extent.end());
  Lattice lattice;
  const double cells = std::round(longest / nearest);
  if (!(cells >= 1)) return {};
  const double spacing = longest / cells;
  double box = 1;
  for (std::size_t k = 0; k < 3; ++k) {
    lattice.shape[k] = static_cast<std::int32_t>(std::round(extent[k] / spacing)) + 1;
    box *= lattice.shape[k];
  }
  if (static_cast<double>(hood.points) < kLeastFilled * box) return {};
  std::vector<char> taken(static_cast<std::size_t>(box), 0);
  lattice.cell.resize(static_cast<std::size_t>(3 * hood.points));
  for (std::int64_t i = 0; i < hood.points; ++i) {
    std::size_t place = 0;
    for (std::size_t k = 3; k-- > 0;) {
      const double at = (hood.X[kVector * i + static_cast<std::int64_t>(k)] - low[k]) / spacing;
      const double nearest_cell = std::round(at);
      if (std::fabs(at - nearest_cell) > kOff) return {};
      lattice.cell[static_cast<std::size_t>(3 * i) + k] = static_cast<std::int32_t>(nearest_cell);
      place = place * static_cast<std::size_t>(lattice.shape[k]) +
              static_cast<std::size_t>(nearest_cell);
    }
    if (taken[place] != 0) return {};
    taken[place] = 1;
  }
  lattice.spacing = spacing;
  return lattice;
}

std::array<std::size_t, 3> axes_by_length(const Lattice& lattice) {
  std::array<std::size_t, 3> axes{0, 1, 2};
  std::stable_sort(axes.begin(), axes.end(), [&](std::size_t a, std::size_t b) {
    return lattice.shape[a] > lattice.shape[b];
  });
  return axes;
}

std::int64_t full_neighbours(const Neighbourhood& hood, double spacing) {
  const double limit = hood.square_limit / (spacing * spacing);
  const auto reach = static_cast<std::int64_t>(std::sqrt(limit)) + 1;
  const std::int64_t along[3] = {reach, hood.dimension > 1 ? reach : 0,
                                 hood.dimension > 2 ? reach : 0};
  std::int64_t count = -1;
  for (std::int64_t z = -along[2]; z <= along[2]; ++z)
    for (std::int64_t y = -along[1]; y <= along[1]; ++y)
      for (std::int64_t x = -along[0]; x <= along[0]; ++x)
        count += static_cast<double>(x * x + y * y + z * z) < limit ? 1 : 0;
  return count;
}

}  // namespace cleave::peridynamics
