// The bonds of a simplex mesh: which particles are neighbours, bond vectors, averaging volumes.
#pragma once

#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

#include "formulation/common/simplices.hpp"

namespace cleave::cbm {

// Neighbours of particle i: all other corners of its simplices, sorted, without repeats.
template <class Index>
void collect_neighbours(const Incidence& incidence, const Index* simplices, int corners, int stride,
                        std::int64_t i, std::vector<Index>& out) {
  out.clear();
  for (auto k = incidence.begin[static_cast<std::size_t>(i)];
       k < incidence.begin[static_cast<std::size_t>(i + 1)]; ++k) {
    const Index* nodes = simplices + static_cast<std::int64_t>(stride) *
                                         incidence.simplex[static_cast<std::size_t>(k)];
    for (int a = 0; a < corners; ++a) {
      if (nodes[a] != static_cast<Index>(i)) out.push_back(nodes[a]);
    }
  }
  std::sort(out.begin(), out.end());
  out.erase(std::unique(out.begin(), out.end()), out.end());
}

// Index of the half-bond from i to p, or -1.
template <class Index, class Offset>
Offset find_half_bond(const Offset* row_begin, const Index* neighbour, std::int64_t i, Index p) {
  const Index* first = neighbour + row_begin[i];
  const Index* last = neighbour + row_begin[i + 1];
  const Index* at = std::lower_bound(first, last, p);
  return at != last && *at == p ? static_cast<Offset>(at - neighbour) : Offset{-1};
}

// Fills `reverse` of all half-bonds.
template <class Index, class Offset>
void fill_reverse(std::int64_t particles, const Offset* row_begin, const Index* neighbour,
                  Offset* reverse) {
  for (std::int64_t i = 0; i < particles; ++i) {
    for (Offset b = row_begin[i]; b < row_begin[i + 1]; ++b) {
      reverse[b] = find_half_bond(row_begin, neighbour, neighbour[b], static_cast<Index>(i));
    }
  }
}

// Row i from its live simplices, always summed in ascending order of simplices, so that a rebuilt
// row has the bits of one built at once:                                            [CBM 1, 4-9]
//   Omega_i = sum_L Omega_L/n,   zeta_ip = sum_L (Omega_L/n) g_p^L
// [in]  alive (m): 0 deleted; nullptr: all live      neighbours: of i, ascending
// [out] zeta (3,neighbours) [m2]      back (3,neighbours): zeta_pi as in row p; nullptr: not asked for
// Returns Omega_i [m3].
template <int D, class Index>
double sum_row(const double* X, const Index* simplices, int stride, const std::int32_t* alive,
               const Incidence& incidence, std::span<const Index> neighbours, std::int64_t i,
               double* zeta, double* back) {
  const auto size = static_cast<std::size_t>(kVector) * neighbours.size();
  std::fill_n(zeta, size, 0.0);
  if (back != nullptr) std::fill_n(back, size, 0.0);
  double volume = 0;
  for (auto k = incidence.begin[static_cast<std::size_t>(i)];
       k < incidence.begin[static_cast<std::size_t>(i + 1)]; ++k) {
    const std::int64_t s = incidence.simplex[static_cast<std::size_t>(k)];
    if (alive != nullptr && alive[s] == 0) continue;
    const Index* nodes = simplices + stride * s;
    const SimplexGeometry<D> geometry = simplex_geometry<D>(X, nodes);
    const double share = geometry.volume / (D + 1);
    volume += share;
    const int own = static_cast<int>(std::find(nodes, nodes + D, static_cast<Index>(i)) - nodes);
    for (int a = 0; a <= D; ++a) {
      if (a == own) continue;
      const auto b = kVector * (std::lower_bound(neighbours.begin(), neighbours.end(), nodes[a]) -
                                neighbours.begin());
      for (int c = 0; c < D; ++c) zeta[b + c] += share * geometry.gradient[a][c];
      if (back == nullptr) continue;
      for (int c = 0; c < D; ++c) back[b + c] += share * geometry.gradient[own][c];
    }
  }
  return volume;
}

}  // namespace cleave::cbm
