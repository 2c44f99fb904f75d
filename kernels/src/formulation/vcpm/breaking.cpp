// Bonds that break one after the other in statics: their numbers in that order, what each took from the stiffness, and
// particles that too few bonds hold.                                     [VCPM change, loose]
#include <cmath>
#include <vector>

#include "formulation/vcpm/vcpm.hpp"

namespace cleave::vcpm {

namespace {

std::size_t at(std::int64_t i) { return static_cast<std::size_t>(i); }

// Of the directions that hold a particle, the least of two or three eigenvalues over the sum, about: those of
// a lattice are 1/4 or 0.
constexpr double kFlat = 1e-6;

}  // namespace

void VolumeCompensatedParticles::broke(std::int32_t bond) {
  order_.push_back(bond);
  event_[bond] = static_cast<std::int32_t>(order_.size());
}

void VolumeCompensatedParticles::number_broken() {
  order_.clear();
  for (std::int64_t bond = 0; bond < hood_.bonds(); ++bond) {
    if (event_[bond] <= 0) continue;
    if (order_.size() < at(event_[bond])) order_.resize(at(event_[bond]));
    order_[at(event_[bond]) - 1] = static_cast<std::int32_t>(bond);
  }
}

bool VolumeCompensatedParticles::carried(std::int32_t bond, std::int64_t broken) const {
  const std::int32_t status = damage_.status(bond);
  return status == peridynamics::kIntact ||
         (status == peridynamics::kBroken && event_[bond] > broken);
}

template <class F>
void VolumeCompensatedParticles::for_carried(std::int64_t i, std::int64_t broken,
                                             const F& f) const {
  for (auto half = hood_.first(i); half < hood_.last(i); ++half) {
    const std::int32_t p = hood_.neighbour(half);
    const std::int32_t bond =
        p > i ? hood_.bond_of_upper(i, half) : hood_.bond_of_upper(p, hood_.find_half(p, i));
    if (carried(bond, broken)) f(p, half);
  }
}

bool VolumeCompensatedParticles::held_after(const Body&, std::int64_t broken,
                                            std::int64_t i) const {
  bool held = false;
  for_carried(i, broken, [&](std::int32_t, std::int32_t) { held = true; });
  return held;
}

// d theta_i/du, over i and its neighbours.
StiffnessChange::Column VolumeCompensatedParticles::volume_column(const Body& body, std::int64_t i,
                                                                  std::int64_t broken) const {
  StiffnessChange::Column column;
  column.particles.push_back(static_cast<std::int32_t>(i));
  column.values.assign(static_cast<std::size_t>(dimension_), 0.0);
  for_carried(i, broken, [&](std::int32_t p, std::int32_t half) {
    const Bond b = bond(body, i, p, half);
    const double share = 0.5 * factor_[at(i)] * b.shell->weight;
    column.particles.push_back(p);
    for (int k = 0; k < dimension_; ++k) {
      column.values[static_cast<std::size_t>(k)] -= share * b.direction[k];
      column.values.push_back(share * b.direction[k]);
    }
  });
  return column;
}

// With the elongation c^T u of the bond and s_i = d theta_i/du before, of which a_i c was its share:
//   - k/2 c c^T + V T ((s_i - a_i c)(s_i - a_i c)^T - s_i s_i^T), and the same for its other end.  [VCPM change]
void VolumeCompensatedParticles::stiffness_change(const Body& body, std::int64_t event,
                                                  StiffnessChange& change) const {
  change.columns.clear();
  const double scale = lattice_.cell * modulus_;
  hood_.for_bonds(
      order_[at(event - 1)], order_[at(event - 1)] + 1,
      [&](std::int32_t, std::int64_t i, std::int32_t p, std::int32_t half) {
        const Bond b = bond(body, i, p, half);
        StiffnessChange::Column elongation{{static_cast<std::int32_t>(i), p}, {}};
        for (const double sign : {-1.0, 1.0})
          for (int k = 0; k < dimension_; ++k) elongation.values.push_back(sign * b.direction[k]);
        change.columns.push_back(elongation);
        double own = -0.5 * b.shell->stiffness;
        std::vector<double> share;
        for (const std::int64_t end : {i, static_cast<std::int64_t>(p)}) {
          const double a = 0.5 * factor_[at(end)] * b.shell->weight;
          own += scale * a * a;
          if (scale == 0) continue;
          change.columns.push_back(volume_column(body, end, event - 1));
          share.push_back(-scale * a);
        }
        for (const std::int64_t end : {i, static_cast<std::int64_t>(p)}) {
          if (held_after(body, event, end)) continue;
          for (int k = 0; k < dimension_; ++k) {
            change.columns.push_back({{static_cast<std::int32_t>(end)},
                                      std::vector<double>(static_cast<std::size_t>(dimension_))});
            change.columns.back().values[static_cast<std::size_t>(k)] = 1;
          }
        }
        const std::size_t r = change.columns.size();
        change.weight.assign(r * r, 0.0);
        change.weight[0] = own;
        for (std::size_t k = 0; k < share.size(); ++k)
          change.weight[k + 1] = change.weight[r * (k + 1)] = share[k];
        for (std::size_t k = share.size() + 1; k < r; ++k)
          change.weight[r * k + k] = 0.5 * b.shell->stiffness;
      });
}

bool VolumeCompensatedParticles::is_loose(const Body& body, std::int64_t i) const {
  Mat<3> held;
  for (const auto& dof : body.prescribed)
    if (dof.particle == i) held(dof.direction, dof.direction) += 1;
  for_carrying(i, [&](std::int32_t p, std::int32_t half) {
    const Bond b = bond(body, i, p, half);
    add_dyad(held, b.direction, b.direction);
  });
  if (dimension_ == 2) held(2, 2) = 1;
  const double sum = held(0, 0) + held(1, 1) + (dimension_ == 2 ? 0.0 : held(2, 2));
  return !(determinant(held) > kFlat * std::pow(sum, dimension_));
}

// A bond that goes with its particle is below its limit.                              [VCPM loose]
void VolumeCompensatedParticles::release_loose(Body& body, const Clock& clock, ThreadTeam& team) {
  std::vector<std::int32_t> ends = touched_, bonds;
  while (!ends.empty()) {
    const std::int32_t i = ends.back();
    ends.pop_back();
    if (damage_.intact_count(i) == 0 || !is_loose(body, i)) continue;
    bonds.clear();
    for_carrying(i, [&](std::int32_t p, std::int32_t) {
      const std::int64_t a = std::min<std::int64_t>(i, p), b = std::max<std::int64_t>(i, p);
      bonds.push_back(hood_.bond_of_upper(a, hood_.find_half(a, b)));
      ends.push_back(p);
    });
    break_these(body, clock, team, bonds);
  }
}

}  // namespace cleave::vcpm
