// The bond network of a body: simplices, bonds between their corners, bond vectors. It knows
// geometry and which simplices are alive, and nothing of stress.
#pragma once

#include <cstdint>
#include <vector>

#include "core/gradient_operator.hpp"
#include "core/thread_team.hpp"
#include "formulation/cbm/bonds.hpp"
#include "model/body.hpp"

namespace cleave::cbm {

enum BondStatus : std::int32_t { kIntact = 0, kBroken = 1, kInert = 2 };

class Network {
 public:
  static constexpr std::int64_t kStride = 4;  // of `corners`

  // Finds the bonds, allocates the fields of simplices and bonds, fills those of lifetime setup
  // except critical strains, and builds all rows. Throws BAD_SIMPLEX.
  void build(Body& body);
  // Rows of all particles from the live simplices, and bond lengths.
  void rebuild(const Body& body, ThreadTeam& team);
  // Row of one particle: bond vectors, weights, averaging volume.
  template <int D>
  void rebuild_row_of(std::int64_t i) {
    rebuild_row<D>(X, corners, kStride, alive, incidence, row_begin.data(), neighbour.data(), i,
                   zeta, volume);
    for (std::int32_t b = row_begin[static_cast<std::size_t>(i)];
         b < row_begin[static_cast<std::size_t>(i + 1)]; ++b) {
      weight[b] =
          dot(load_vector<D>(zeta, b), difference<D>(X, i, neighbour[static_cast<std::size_t>(b)]));
    }
  }
  // f(simplex) for every live simplex that has both ends of the bond.
  template <class F>
  void for_live_simplices(std::int32_t bond, int corner_count, const F& f) const {
    const std::int32_t i = ends[2 * bond], p = ends[2 * bond + 1];
    for (auto k = incidence.begin[static_cast<std::size_t>(i)];
         k < incidence.begin[static_cast<std::size_t>(i) + 1]; ++k) {
      const std::int32_t s = incidence.simplex[static_cast<std::size_t>(k)];
      if (alive[s] == 0) continue;
      for (int a = 0; a < corner_count; ++a) {
        if (corners[kStride * s + a] == p) f(s);
      }
    }
  }
  bool on_live_simplex(std::int32_t bond, int corner_count) const;
  // Undirected bond between two particles, or -1.
  std::int32_t find_bond(std::int64_t i, std::int64_t p) const;

  GradientOperator gradient() const {
    return {row_begin.data(), neighbour.data(), reverse.data(), zeta, volume};
  }
  std::int64_t bytes() const;

  std::int64_t simplices = 0, bonds = 0;
  Incidence incidence;
  std::vector<std::int32_t> row_begin, neighbour, reverse;
  std::vector<std::int32_t> bond_of_half;  // (h) undirected bond of a half-bond

  // Into the body's fields.
  const double* X = nullptr;
  std::int32_t *corners = nullptr, *alive = nullptr;  // (4,m), (m)
  std::int32_t *ends = nullptr, *status = nullptr;    // (2,b), (b)
  double *length = nullptr, *critical = nullptr;      // (b) [m], (b) [1]
  double *zeta = nullptr, *weight = nullptr;          // (3,h) [m2], (h) [m3]
  double* volume = nullptr;                           // (n) [m3]

 private:
  void check_simplices(const Body& body) const;
  void make_rows(const Body& body);
  void make_bonds();
};

}  // namespace cleave::cbm
