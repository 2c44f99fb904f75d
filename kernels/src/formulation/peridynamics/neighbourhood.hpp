// The points of a peridynamic body in the reference configuration: volumes, and for each point its
// neighbours within the horizon. It knows geometry only, nothing of forces or of broken bonds.  [PD hood]
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/cell_list.hpp"
#include "core/tensor.hpp"
#include "model/body.hpp"

namespace cleave::peridynamics {

class Neighbourhood {
 public:
  // Volumes as given, or the shares of the simplices. `dimension` 1 is a bar of that section [m2]. Throws
  // for points and horizons that cannot be used.
  void build(Body& body, int dimension, double horizon, double section);

  // Half-bonds of point i are first(i) <= b < last(i); those with a higher neighbour begin at upper(i).
  std::int32_t first(std::int64_t i) const { return rows.row_begin[static_cast<std::size_t>(i)]; }
  std::int32_t last(std::int64_t i) const {
    return rows.row_begin[static_cast<std::size_t>(i) + 1];
  }
  std::int32_t upper(std::int64_t i) const {
    return last(i) -
           (bond_begin[static_cast<std::size_t>(i) + 1] - bond_begin[static_cast<std::size_t>(i)]);
  }
  std::int32_t count(std::int64_t i) const { return last(i) - first(i); }
  std::int32_t neighbour(std::int32_t half) const {
    return rows.neighbour[static_cast<std::size_t>(half)];
  }
  // Place of (i,p) in row i; -1 if they are no neighbours.
  std::int32_t find_half(std::int64_t i, std::int64_t p) const;
  // Bonds are numbered by their first, then their second end.
  std::int32_t bond_of_upper(std::int64_t i, std::int32_t half) const {
    return bond_begin[static_cast<std::size_t>(i)] + (half - upper(i));
  }
  std::int32_t first_end(std::int32_t bond) const;
  // f(bond, i, p, half of i) in the order of bonds first <= b < last.
  template <class F>
  void for_bonds(std::int64_t first_bond, std::int64_t last_bond, const F& f) const {
    if (first_bond >= last_bond) return;
    std::int64_t i = first_end(static_cast<std::int32_t>(first_bond));
    for (std::int64_t bond = first_bond; bond < last_bond; ++bond) {
      while (bond >= bond_begin[static_cast<std::size_t>(i) + 1]) ++i;
      const auto half =
          static_cast<std::int32_t>(upper(i) + (bond - bond_begin[static_cast<std::size_t>(i)]));
      f(static_cast<std::int32_t>(bond), i, neighbour(half), half);
    }
  }

  bool adjacent(std::int64_t i, std::int64_t p) const {
    const Vec<3> d = difference<3>(X, i, p);
    return dot(d, d) < square_limit;
  }
  double length(std::int64_t i, std::int64_t p) const {
    const Vec<3> d = difference<3>(X, i, p);
    return std::sqrt(dot(d, d));
  }
  std::int64_t half_bonds() const { return static_cast<std::int64_t>(rows.neighbour.size()); }
  std::int64_t bonds() const { return bond_begin.back(); }
  std::int32_t most_neighbours() const;
  std::int64_t bytes() const;

  int dimension = 3;  // 1 to 3
  std::int64_t points = 0, simplices = 0;
  double horizon = 0, square_limit = 0;  // [m], [m2]
  double spacing = 0;                    // (mean volume)^(1/dimension) [m]
  double section = 1;                    // of a bar [m2]; else 1
  const double* X = nullptr;             // (3,n)
  const double* volume = nullptr;        // (n)
  NeighbourRows rows;                    // without `reverse`
  std::vector<std::int32_t> bond_begin;  // (n+1) bonds by their first end

 private:
  void take_volumes(Body& body);
  void check_horizon(const Body& body) const;
  void check_distances(const Body& body) const;
};

}  // namespace cleave::peridynamics
