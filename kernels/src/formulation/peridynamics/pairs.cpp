// How a peridynamic body has its bonds summed and searched: by the kernels for any cloud, or by those for lattices.
#include "core/instruction_set.hpp"
#include "formulation/peridynamics/formulation.hpp"

CLEAVE_DECLARE_KERNELS(cleave_call::PairKernels, kPairKernels)

namespace cleave::peridynamics {

void Peridynamic::share_stencil(const Body& body) {
  lattice_pairs_ = {};
  if (!use_lattice_ || !pair_form_) return;
  const Lattice lattice = find_lattice(hood_);
  if (!lattice.found() || !lattice_pairs_.setup(hood_, lattice, body.dimension())) return;
  std::vector<double> right(left_.size());
  for (std::size_t i = 0; i < right.size(); ++i) right[i] = now_[4 * i + 3];
  lattice_pairs_.weigh(hood_, {*pair_form_, left_.data(), right.data(), alpha_of_pairs_},
                       damage_.least_limits());
}

void Peridynamic::rewire(std::int64_t i) {
  if (lattice_pairs_.active()) lattice_pairs_.connect(hood_, damage_, i);
  reconnect(i);
}

const PairKernels& Peridynamic::kernels() const { return CLEAVE_KERNELS(kPairKernels).chosen(); }

PairArrays Peridynamic::pair_arrays(Body& body) const {
  PairArrays a{};
  a.row_begin = hood_.rows.row_begin.data();
  a.bond_begin = hood_.bond_begin.data();
  a.neighbour = hood_.rows.neighbour.data();
  a.intact = damage_.bits();
  a.now = now_.data();
  a.reference = reference_.data();
  a.left = left_.data();
  a.force = body.point.internal;
  a.energy = body.point.energy;
  a.horizon = hood_.horizon;
  return a;
}

void Peridynamic::act_by_pairs(Body& body, ThreadTeam& team) {
  if (lattice_pairs_.active()) {
    lattice_pairs_.act(team, body.point.internal, body.point.energy);
    return;
  }
  PairArrays arrays = pair_arrays(body);
  arrays.alpha = alpha_of_pairs_;
  const auto force = kernels().force[static_cast<int>(*pair_form_)];
  for_blocks(team, hood_.points, [&](std::int64_t, std::int64_t first, std::int64_t last) {
    force(arrays, first, last);
  });
}

void Peridynamic::flag_points(Body& body, ThreadTeam& team, std::vector<char>& flag) {
  if (lattice_pairs_.active()) {
    lattice_pairs_.flag_stretched(team, flag);
    return;
  }
  const PairArrays arrays = pair_arrays(body);
  for_blocks(team, hood_.points, [&](std::int64_t, std::int64_t first, std::int64_t last) {
    kernels().stretched(arrays, first, last, damage_.least_limits(), flag.data() + first);
  });
}

}  // namespace cleave::peridynamics
