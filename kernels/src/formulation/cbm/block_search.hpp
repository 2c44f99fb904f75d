// Looks for bonds that meet the criterion, and mostly does not look: bonds of a particle that were far from
// breaking when they were last looked at cannot break before the particles of the block have moved that far
// against each other. The bound is rigorous, rounding included, so that what is found, and when, does
// not depend on when was looked before.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/aligned.hpp"
#include "core/thread_team.hpp"
#include "formulation/cbm/block_kernels.hpp"
#include "formulation/cbm/block_network.hpp"

namespace cleave::cbm {

// What is searched.     by place: X, u (D,n) and a number more
struct SearchBody {
  const BlockNetwork& blocks;
  const Network& network;
  const BlockKernels& kernels;
  int dimension;
  const double *X, *u;
};

class BlockSearch {
 public:
  void setup(const BlockNetwork& blocks, bool active);
  std::int64_t bytes() const;
  // From this state on; every bond is looked at next time.
  void start(const BlockNetwork& blocks, std::span<const double> X, std::span<const double> u);
  // A step begins, in which `advanced` is called for each block.
  void expect(const SearchBody& body, ThreadTeam& team);
  // The particles of block b went on by dt v, in a loop of the team. Blocks whose surroundings have all done so
  // are looked at right there, while their positions are in the core's cache.
  void advanced(const SearchBody& body, const std::vector<VelocityBox>& boxes, double dt,
                std::int64_t b, int worker);
  // Bonds that are intact and met the criterion in this step, ascending.
  const std::vector<std::int32_t>& find(const SearchBody& body, ThreadTeam& team);

 private:
  struct Margin {
    double least = -1;  // [m] least slack of a row
    double travel = 0;  // [m] bound of what any bond has grown since the block was last looked at
    double extent = 0;  // [m] bound of coordinates and displacements, for rounding
    double steps = 0;   // since then
    double scale = 0;   // see LookArrays
    double used() const;
  };
  struct Worker {
    AlignedReals x;                   // positions of the particles of a block
    std::vector<std::int32_t> found;  // broken bonds
  };
  void widen(const BlockNetwork& blocks, const std::vector<VelocityBox>& boxes, double dt,
             std::size_t b);
  void look(const SearchBody& body, std::size_t b, Worker& worker);
  template <int D>
  static void find_in_row(const SearchBody& body, const Block& block, std::int32_t i,
                          Worker& worker);

  bool active_ = false;
  bool started_ = false;  // and no step has begun since
  std::vector<Margin> margins_;
  std::vector<float> slack_;  // (n) by place: how much the bonds of a row could still grow when its
                              // block was last looked at [m]
  std::vector<std::int32_t>
      waiting_;  // of a block: blocks around it, itself too, that have not advanced
  std::vector<Worker> workers_;
  std::vector<std::int32_t> broken_;
};

}  // namespace cleave::cbm
