// The bond network of a body: simplices, the bonds between their corners, bond vectors. It knows
// geometry and which simplices are alive, and nothing of stress.
//
// Bond vectors follow from the live simplices. Who needs those of a particle forms them; who sweeps
// over all rows again and again has them kept.
#pragma once

#include <array>
#include <cstdint>
#include <span>
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
  // except critical strains, and the averaging volumes. Throws BAD_SIMPLEX.
  void build(Body& body, ThreadTeam& team);
  // Volumes, and rows if they are kept, from the live simplices.
  void rebuild(ThreadTeam& team);
  // The same for a few particles, after simplices were deleted.
  void rebuild(std::span<const std::int32_t> particles);

  // Rows of all particles, until they are dropped; nothing if they are kept already.
  void keep_rows(ThreadTeam& team);
  void drop_rows();
  bool keeps_rows() const { return keeps_rows_; }
  // Of kept rows; valid until they are dropped.
  GradientOperator gradient() const {
    return {row_begin.data(), neighbour.data(), rows_.reverse.data(), rows_.zeta.data(), volume};
  }
  const double* weights() const { return rows_.weight.data(); }           // (h) zeta_ip . X_ip [m3]
  const double* lengths() const { return rows_.length.data(); }           // (b) [m]
  const std::int32_t* bond_of_half() const { return rows_.bond.data(); }  // (h)

  // Forms the row of a particle; arrays as in sum_row.
  template <int D>
  double form_row(std::int64_t i, double* zeta, double* back) const {
    return sum_row<D>(X, corners, kStride, alive, incidence, neighbours(i), i, zeta, back);
  }
  // Ascending.
  std::span<const std::int32_t> neighbours(std::int64_t i) const {
    const std::int32_t* first = neighbour.data() + row_begin[static_cast<std::size_t>(i)];
    return {first, neighbour.data() + row_begin[static_cast<std::size_t>(i) + 1]};
  }
  // Those above i: the bonds first_bond[i] ... of which i is the first end.
  std::span<const std::int32_t> upper_neighbours(std::int64_t i) const {
    return neighbours(i).last(static_cast<std::size_t>(first_bond[static_cast<std::size_t>(i) + 1] -
                                                       first_bond[static_cast<std::size_t>(i)]));
  }
  // f(bond, i, p) of all bonds whose first end is first <= i < last, ascending.
  template <class F>
  void for_bonds(std::int64_t first, std::int64_t last, const F& f) const {
    for (std::int64_t i = first; i < last; ++i) {
      std::int32_t bond = first_bond[static_cast<std::size_t>(i)];
      for (const std::int32_t p : upper_neighbours(i)) f(bond++, static_cast<std::int32_t>(i), p);
    }
  }
  // f(simplex) for every live simplex that has both particles.
  template <class F>
  void for_live_simplices(std::int32_t i, std::int32_t p, int corner_count, const F& f) const {
    for (auto k = incidence.begin[static_cast<std::size_t>(i)];
         k < incidence.begin[static_cast<std::size_t>(i) + 1]; ++k) {
      const std::int32_t s = incidence.simplex[static_cast<std::size_t>(k)];
      if (alive[s] == 0) continue;
      for (int a = 0; a < corner_count; ++a) {
        if (corners[kStride * s + a] == p) f(s);
      }
    }
  }
  // First and second end of a bond.
  std::array<std::int32_t, 2> ends(std::int32_t bond) const;
  // Bond between two particles, or -1.
  std::int32_t find_bond(std::int64_t i, std::int64_t p) const;
  // Reference length [m]; zeta_ip . X_ip [m3].
  double length(std::int64_t i, std::int64_t p) const;
  double weight(std::int64_t i, std::int64_t p, const double* zeta) const;

  // Values of the derived fields of bonds and half-bonds.
  void copy_lengths(std::int64_t first, std::int64_t last, double* values) const;
  void copy_ends(std::int64_t first, std::int64_t last, std::int64_t* values) const;
  void copy_vectors(std::int64_t first, std::int64_t last, double* values) const;  // (3,...)
  void copy_weights(std::int64_t first, std::int64_t last, double* values) const;

  std::int32_t longest_row() const;
  std::int64_t bytes() const;

  std::int64_t simplices = 0, bonds = 0;
  int dimension = 3;
  Incidence incidence;
  std::vector<std::int32_t> row_begin, neighbour;  // (n+1), (h)
  std::vector<std::int32_t> first_bond;  // (n+1) bonds that particles before have as first end

  // Into the body's fields.
  const double* X = nullptr;
  std::int32_t *corners = nullptr, *alive = nullptr;  // (4,m), (m)
  std::int32_t* status = nullptr;                     // (b)
  double* critical = nullptr;                         // (b) [1]
  double* volume = nullptr;                           // (n) [m3]

 private:
  struct Rows {
    std::vector<std::int32_t> reverse, bond;  // (h)
    std::vector<double> zeta, weight;         // (3,h) [m2], (h) [m3]
    std::vector<double> length;               // (b) [m]
  };
  void check_simplices(const Body& body, ThreadTeam& team) const;
  void make_rows(const Body& body, ThreadTeam& team);
  template <int D>
  double live_volume(std::int64_t i) const;
  void rebuild_row(std::int64_t i);
  // f(half, i, p, zeta) of half-bonds first <= half < last.
  template <class F>
  void for_half_bonds(std::int64_t first, std::int64_t last, const F& f) const;

  Rows rows_;
  bool keeps_rows_ = false;
};

}  // namespace cleave::cbm
