// Looks for bonds that meet the criterion, and mostly does not look: a block whose bonds were far from
// breaking when it was last looked at cannot have a broken one before its particles have moved that far
// against each other. The bound is rigorous, rounding included, so that what is found, and when, does
// not depend on when was looked before.
#pragma once

#include <cstdint>
#include <vector>

#include "core/thread_team.hpp"
#include "formulation/cbm/block_kernels.hpp"
#include "formulation/cbm/block_network.hpp"

namespace cleave::cbm {

class BlockSearch {
 public:
  void setup(const BlockNetwork& blocks, bool active);
  // Every block is looked at next time.
  void forget();
  // Particles went on by dt v.
  void moved(const BlockNetwork& blocks, const std::vector<VelocityBox>& boxes, double dt);
  // Bonds that are intact and meet the criterion, ascending.      [in] by place: X, u (D,n)
  template <int D>
  const std::vector<std::int32_t>& find(const BlockNetwork& blocks, const Network& network,
                                        const double* X, const double* u, ThreadTeam& team);

 private:
  struct Margin {
    double slack = -1;  // [m] that the tightest bond may still grow by, when last looked at
    double travel = 0;  // [m] bound of what any bond has grown since
    double extent = 0;  // [m] largest coordinate, for rounding
    double steps = 0;   // since then
  };
  bool safe(const Margin& m) const;
  template <int D>
  void look(const Network& network, const BlockNetwork& blocks, const Block& block, const double* X,
            const double* u, double* x, Margin& margin, std::vector<std::int32_t>& found) const;

  bool active_ = false;
  std::vector<Margin> margins_;
  struct Worker {
    std::vector<double> x;            // positions of the particles of a block
    std::vector<std::int32_t> found;  // broken bonds
  };
  std::vector<Worker> workers_;
  std::vector<std::int32_t> broken_;
};

}  // namespace cleave::cbm
