// Neighbours of every particle within a radius, in the reference configuration: the rows of kernel
// methods. Cost linear in particles and neighbours. It knows distances only, nothing of weights.
//
// The rule. A pair belongs together if |X_ip|^2 < r^2 (1 - 1e-6) (radius open) or < r^2 (1 + 1e-6)
// (closed). Points of a lattice that lie on the radius are therefore decided alike, whatever the
// units and the rounding of the mesh file: left out of an open radius, taken into a closed one. The
// two particles of a pair evaluate the same expression, so rows are symmetric to the last bit.
#pragma once

#include <cstdint>
#include <limits>
#include <string>
#include <vector>

namespace cleave {

enum class Radius { open, closed };

// Half-bonds by particle; columns ascending in every row.
struct NeighbourRows {
  std::vector<std::int32_t> row_begin;  // (n+1)
  std::vector<std::int32_t> neighbour;  // (h)
  std::vector<std::int32_t>
      reverse;  // (h) place of (p,i) for the half-bond (i,p); empty if not wanted
};
enum class ReverseHalves { listed, left_out };

inline constexpr std::int64_t kMostHalfBonds = std::numeric_limits<std::int32_t>::max();

// The square of the distance below which a pair belongs together.
double square_reach(double radius, Radius rule);

// [in] X (3,n) [m], third component 0 in two dimensions; radius > 0 [m]; owner: for the message
// Throws BAD_ARGUMENT above `most` half-bonds.
NeighbourRows neighbours_within(const double* X, std::int64_t n, double radius, Radius rule,
                                const std::string& owner, std::int64_t most = kMostHalfBonds,
                                ReverseHalves reverse = ReverseHalves::listed);

}  // namespace cleave
