// Three-neighbour sums over any cloud of points: every tetrahedron is found once, from the member that comes
// first in an order of blocks, and serves its four points. Nothing is kept of triples or tetrahedra.
//
// Points are cut into fixed blocks. A block adds what its tetrahedra give to later points of other blocks
// into slots of its own, and each point then takes its slots in the order of blocks: the same bits for any
// number of threads.
#pragma once

#include <cstdint>
#include <vector>

#include "core/thread_team.hpp"
#include "formulation/cpd/star.hpp"

namespace cleave::cpd {

class CloudCliques {
 public:
  void setup(const peridynamics::Neighbourhood& hood);

  struct Task {
    const double* x;  // (3,n) [m]
    bool signed_volume;
    const double* weight;  // (n), or NULL: plain sums
  };
  // [out] sums (4,n): - sum of g G_i and sum of 1/2 |V| g^2, times the weights if there are any
  void sum(const peridynamics::Neighbourhood& hood, const peridynamics::Damage& damage,
           const Task& task, ThreadTeam& team, std::vector<StarScratch>& scratch, double* sums);
  std::int64_t bytes() const;

 private:
  void sum_block(const peridynamics::Neighbourhood& hood, const peridynamics::Damage& damage,
                 const Task& task, std::int32_t block, StarScratch& scratch, double* sums);

  std::vector<std::int32_t> order_, begin_;  // points by blocks; (blocks+1)
  std::vector<std::int32_t> rank_;           // (n) place in order_
  std::vector<std::int32_t> slot_point_,
      slot_begin_;             // points of the slots of a block, ascending; (blocks+1)
  std::vector<double> slots_;  // (4, slots)
  std::vector<std::int32_t> incoming_, incoming_begin_;  // slots of a point in the order of blocks
};

}  // namespace cleave::cpd
