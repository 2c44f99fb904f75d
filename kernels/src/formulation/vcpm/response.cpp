// Forces, energies and critical bonds of all particles at the present positions; once for positions and bonds
// that are as before. What a single bond or cell has is in vcpm.cpp.                    [VCPM bond, 13]
#include <algorithm>

#include "core/instruction_set.hpp"
#include "formulation/vcpm/vcpm.hpp"

CLEAVE_DECLARE_KERNELS(cleave_call::CellKernels, kCellKernels)

namespace cleave::vcpm {

namespace {

static_assert(static_cast<int>(Criterion::force) == cleave_call::kCellForce &&
              static_cast<int>(Criterion::strain) == cleave_call::kCellStrain &&
              static_cast<int>(Criterion::energy) == cleave_call::kCellEnergy);

const CellKernels& cell_kernels() { return CLEAVE_KERNELS(kCellKernels).chosen(); }

std::size_t at(std::int64_t i) { return static_cast<std::size_t>(i); }

}  // namespace

CellArrays VolumeCompensatedParticles::cell_arrays() {
  CellArrays a{};
  a.row_begin = hood_.rows.row_begin.data();
  a.bond_begin = hood_.bond_begin.data();
  a.neighbour = hood_.rows.neighbour.data();
  a.intact = damage_.bits();
  a.length = length_.data();
  a.integrity = weight_.empty() ? nullptr : weight_.data();
  a.linear = geometry_ == Geometry::linear ? 1 : 0;
  a.now = a.linear == 1 ? shift_.data() : now_.data();
  a.reference = reference_.data();
  a.factor = factor_.data();
  a.pressure = pressure_.data();
  a.force = force_.data();
  a.energy = energy_.data();
  a.middle = lattice_.shells.size() > 1 ? lattice_.middle : kUnbounded;
  for (std::size_t s = 0; s < 2; ++s) {
    a.stiffness[s] = lattice_.shells[std::min(s, lattice_.shells.size() - 1)].stiffness;
    a.weight[s] = lattice_.shells[std::min(s, lattice_.shells.size() - 1)].weight;
  }
  a.cell = lattice_.cell;
  a.modulus = modulus_;
  a.criterion = static_cast<std::int32_t>(criterion_);
  a.limit = damage_.limit(0, 0);  // the same for all: no regions
  a.flag = damage_.active() ? critical_.data() : nullptr;
  return a;
}

// Of geometry 'linear'; whether they changed.
bool VolumeCompensatedParticles::take_shifts(const Body& body, ThreadTeam& team) {
  if (geometry_ != Geometry::linear) return false;
  for_blocks(team, hood_.points, [&](std::int64_t block, std::int64_t first, std::int64_t last) {
    shifted_[at(block)] = peridynamics::take_rows(body.point.u + kVector * first, last - first,
                                                  shift_.data() + 4 * first)
                              ? 1
                              : 0;
  });
  return std::find(shifted_.begin(), shifted_.end(), 1) != shifted_.end();
}

// Pressures, forces, energies and critical bonds, as far as positions and bonds have changed: a step asks twice,
// for the bonds that break and for the forces.
void VolumeCompensatedParticles::respond(const Body& body, ThreadTeam& team) {
  const bool moved = take_moved(), shifted = take_shifts(body, team);
  const CellArrays arrays = cell_arrays();
  if (!responded_ || moved || shifted || std::ssize(stale_) > hood_.points / 16) {
    for_blocks(team, hood_.points, [&](std::int64_t, std::int64_t first, std::int64_t last) {
      cell_kernels().pressures(arrays, first, last);
    });
    for_blocks(team, hood_.points, [&](std::int64_t, std::int64_t first, std::int64_t last) {
      cell_kernels().forces(arrays, first, last);
    });
  } else {
    respond_again(arrays);
  }
  responded_ = true;
  stale_.clear();
}

// The same where bonds have changed alone: a pressure goes to the forces of all neighbours.
void VolumeCompensatedParticles::respond_again(const CellArrays& arrays) {
  for (const std::int64_t i : stale_) cell_kernels().pressures(arrays, i, i + 1);
  for (const std::int64_t i : stale_) {
    cell_kernels().forces(arrays, i, i + 1);
    for (auto b = hood_.first(i); b < hood_.last(i); ++b) {
      const std::int64_t p = hood_.neighbour(b);
      cell_kernels().forces(arrays, p, p + 1);
    }
  }
}

void VolumeCompensatedParticles::flag_points(Body& body, ThreadTeam& team,
                                             std::vector<char>& flag) {
  respond(body, team);
  std::copy(critical_.begin(), critical_.end(), flag.begin());
}

void VolumeCompensatedParticles::act(Body& body, ThreadTeam& team) {
  respond(body, team);
  for_blocks(team, hood_.points, [&](std::int64_t, std::int64_t first, std::int64_t last) {
    std::copy(force_.begin() + kVector * first, force_.begin() + kVector * last,
              body.point.internal + kVector * first);
    std::copy(energy_.begin() + first, energy_.begin() + last, body.point.energy + first);
  });
}

}  // namespace cleave::vcpm
