// Three-neighbour sums over points on a cubic lattice: one list of shapes for all points, eight points at
// a time; cells without a point are masked.
//
// The lattice is cut into fixed tiles. A tile sums its tetrahedra in arrays of its own, which reach as far
// as the horizon, and each point then takes the parts of all tiles in their order: the same bits for any
// number of threads.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "core/aligned.hpp"
#include "core/tensor.hpp"
#include "core/thread_team.hpp"
#include "formulation/cpd/lattice_bonds.hpp"
#include "formulation/cpd/lattice_kernels.hpp"
#include "formulation/peridynamics/damage.hpp"
#include "formulation/peridynamics/lattice.hpp"

namespace cleave::cpd {

class LatticeCliques {
 public:
  // False where the list of shapes would be too long; then nothing is kept.
  bool setup(const peridynamics::Neighbourhood& hood, const peridynamics::Lattice& lattice,
             bool signed_volume);
  bool active() const { return !tiles_.empty(); }
  // Tetrahedra that a point with all its neighbours is the first of.
  std::int64_t shapes() const { return static_cast<std::int64_t>(ahead_.thirds.size()); }

  void expect_workers(int workers);
  // [in] u (3,n) displacement [m]   [out] sums (4,n): - sum of g G_i [m2], sum of 1/2 |V| g^2 [m3], of the
  // tetrahedra whose three bonds at the point carry
  // weight (n): conservative weights W; then the sums are weighed, and of the energy each member has a quarter,
  // as those of CloudCliques. NULL: plain.
  void sum(const double* u, const double* weight, ThreadTeam& team, double* sums);
  // Which bonds of a point carry.
  void connect(const peridynamics::Neighbourhood& hood, const peridynamics::Damage& damage,
               std::int64_t i);
  // For the listed points, eight or fewer: sum of g (G_j (x) X_ij + ...) [m3] with the bonds that carry.  [PD stress]
  void stress_sums(const peridynamics::Neighbourhood& hood, const peridynamics::Damage& damage,
                   std::span<const std::int32_t> points, const double* u, int worker,
                   Mat<3>* sums) const;
  std::int64_t bytes() const;

 private:
  using Cell = std::array<std::int32_t, 3>;  // along the fast, middle and slow axis
  struct Tile {
    std::int32_t middle, slow, slows;  // first own row; own rows along the slow axis
    AlignedReals f[3], e;              // its sums, own rows and those it reaches
    std::vector<char> eights;          // of each own eight, what is there
  };
  struct Part {  // a row in a tile
    std::int32_t tile, row;
  };
  struct Scratch {
    AlignedReals x[3], there, weight, bench, around;
    std::vector<std::uint8_t> carries;
  };
  // Members, and the shapes that they make with the first point.
  struct ShapeList {
    std::vector<Cell> members;
    std::vector<ShapePair> pairs;
    std::vector<ShapeThird> thirds;
    bool make(std::vector<Cell> cells, double limit);
  };

  bool list_shapes(double limit);
  Shapes shapes_of(const ShapeList& list) const;
  void make_tiles();
  void sort_eights(Tile& tile) const;
  void take_places(const Tile& tile, const double* u, const double* weight, Scratch& scratch) const;
  void sum_tile(Tile& tile, const double* u, const double* weight, Scratch& scratch) const;
  // Where the neighbours of the points are whose bonds carry, on the bench of the worker.
  void lay_around(const peridynamics::Neighbourhood& hood, const peridynamics::Damage& damage,
                  std::span<const std::int32_t> points, const double* u, AlignedReals& bench) const;
  std::int32_t point_at(std::int32_t fast, std::int32_t middle, std::int32_t slow) const;
  std::int32_t side() const { return 2 * reach_ + 1; }
  std::size_t place_of(const Cell& from_point) const;  // in member_at_
  Cell row_start(const Tile& tile, std::int32_t row) const;
  std::int64_t local_rows(const Tile& tile) const;

  double spacing_ = 0;
  bool signed_volume_ = false;
  std::array<std::size_t, 3> axis_{};  // the longest axis of the lattice is the fast one
  Cell shape_{};
  std::int32_t reach_ = 0, width_ = 0;   // cells; row length with what it reaches
  std::vector<std::int32_t> point_;      // of each cell, or -1
  std::vector<Cell> cell_;               // of each point
  ShapeList ahead_, around_;             // of later points, in the order of cells; of all
  std::vector<std::int32_t> distance_;   // of the members ahead in the arrays of a tile
  std::vector<std::int32_t> member_at_;  // around, by cell from the point: slow, middle, fast
  std::vector<double> volume_, inverse_;
  std::int32_t largest_volume_ = 0;
  LatticeBonds bonds_;
  std::vector<Tile> tiles_;
  std::vector<Part> parts_;               // of each row, in the order of tiles
  std::vector<std::int32_t> part_begin_;  // (rows+1)
  AlignedReals around_cells_;             // (3,members) of around_
  mutable std::vector<Scratch> scratch_;  // of each worker
};

}  // namespace cleave::cpd
