// Bonds between points on a square or cubic lattice: which carry, as bits, and their forces, each bond once.
// It knows nothing of constants and of damage beyond weights and bits.
//
// The lattice is cut into slabs across its second longest axis, as thick as bonds reach. A slab gives forces to
// itself and to the next, so that every other slab is done at the same time and then the rest: each sum has
// one order for any number of threads.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <span>
#include <vector>

#include "core/aligned.hpp"
#include "core/thread_team.hpp"
#include "formulation/peridynamics/damage.hpp"
#include "formulation/peridynamics/lattice.hpp"
#include "formulation/peridynamics/lattice_pair_kernels.hpp"

namespace cleave::peridynamics {

// Force of a bond over its stretch, w_ij of pair_kernels.hpp; (n) each.
struct PairWeights {
  PairForm form;
  const double *left, *right, *alpha;
};

class LatticePairs {
 public:
  // False where the bonds are not those of whole shells of the lattice: a horizon that ends within 1e-6 of a
  // shell. Then nothing is kept. Displacements have `directions` components, 2 or 3.
  bool setup(const Neighbourhood& hood, const Lattice& lattice, int directions);
  // limit (n): stretch up to which no bond of a point breaks.
  void weigh(const Neighbourhood& hood, const PairWeights& weights, const double* limit);
  bool active() const { return !rows_.empty(); }

  // Which bonds of a point carry.
  void connect(const Neighbourhood& hood, const Damage& damage, std::int64_t i);
  // u (3,n) of these points [m], for what follows.
  void take(const double* u, std::int64_t first, std::int64_t last);
  // Sets force (3,n) [N] and energy (n) [J m-3].
  void act(ThreadTeam& team, double* force, double* energy);
  // 1 for both ends of every bond that carries and is beyond the limit of one end, or a little less; else 0.
  void flag_stretched(ThreadTeam& team, std::vector<char>& flag);
  std::int64_t bytes() const;

 private:
  using Cell = std::array<std::int32_t, 3>;  // along the fast, middle and slow axis
  struct Row {
    std::int32_t list, steps;
  };
  // Numbers of a place, each in a line of its own behind the others of its row.
  enum Line { kU = 0, kRight = 3, kForce = 4, kEnergy = 7, kReach = 8, kAlpha = 9, kLines = 10 };

  void list_steps(double limit);
  void list_rows();
  void list_inside(const Cell& faces);  // faces: distances to them, up to the reach
  // there: of each place, whether a point is.
  bool find_bonds(const Neighbourhood& hood, const std::vector<char>& there);
  void find_whole(std::int64_t eight);
  std::int64_t row_of(std::int64_t place) const { return place / stride_; }
  std::int64_t eight_of(std::int64_t place) const;
  Cell cell_of(std::int64_t place) const;
  std::size_t step_at(const Cell& step) const;  // in number_
  std::int64_t place_of(const Cell& cell) const;
  PairRows arrays();
  template <class F>
  void for_rows(ThreadTeam& team, const F& f) const;

  double spacing_ = 0;
  int directions_ = 3;
  int form_ = 0;
  std::array<std::size_t, 3> axis_{};  // the longest axis of the lattice is the fast one
  Cell shape_{};
  std::int32_t reach_ = 0, before_ = 0, width_ = 0, eights_ = 0;  // cells; eights of a row
  std::int64_t stride_ = 0;                                       // of rows
  std::vector<PairStep> steps_;
  std::vector<Cell> cells_;           // of steps_
  std::vector<std::int32_t> number_;  // of a step, -1: not ahead, too far
  std::vector<std::int32_t> lists_;   // steps that stay in the body, of rows
  std::vector<Row> rows_;
  AlignedReals values_;  // kLines lines a row; forces and energies are zero between sums
  std::vector<std::int64_t> place_;   // (n)
  std::vector<double> outer_, half_;  // (n) weight of the sums; the same for the energy per volume
  std::vector<std::uint8_t> carries_;
  std::vector<char> whole_, damaged_;  // (eights); (n)
};

}  // namespace cleave::peridynamics
