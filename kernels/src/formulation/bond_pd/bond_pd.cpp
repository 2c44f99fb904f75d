#include "formulation/bond_pd/bond_pd.hpp"

namespace cleave::bond_pd {

using peridynamics::KeptModulus;
using peridynamics::PairArrays;
using peridynamics::PointEnergy;

void BondPeridynamics::prepare(Body& body) {
  const ParameterSet& options = body.group("peridynamics");
  constant_ = peridynamics::bond_constant(body, elastic_, dimension_, hood_.horizon, hood_.section,
                                          static_cast<KeptModulus>(options.choice("modulus")));
  for (std::size_t i = 0; i < left_.size(); ++i) {
    left_[i] = constant_ * hood_.volume[i];
    now_[4 * i + 3] = hood_.volume[i];
  }
}

double BondPeridynamics::largest_rate(const Body& body) const {
  return pair_rate(body, [this](std::int64_t i, std::int64_t p) { return weight(i, p); });
}

void BondPeridynamics::act(Body& body, ThreadTeam& team) {
  const PairArrays arrays = pair_arrays(body);
  for_blocks(team, hood_.points, [&](std::int64_t, std::int64_t first, std::int64_t last) {
    kernels().product(arrays, first, last);
  });
}

PointEnergy BondPeridynamics::point_energy(const Body& body, std::int64_t i, int) const {
  PointEnergy sum;
  for_carrying(i, [&](std::int32_t p, std::int32_t) {
    const peridynamics::BondMotion m = peridynamics::bond_motion(hood_, body, i, p);
    sum.energy += 0.25 * weight(i, p) * m.stretch * m.stretch * m.L;
    sum.rate += 0.5 * weight(i, p) * m.stretch * m.rate;
  });
  return sum;
}

// P_i = 1/2 sum_j c s n (x) X_ij v_j
Mat<3> BondPeridynamics::point_stress(const Body& body, std::int64_t i, int) const {
  Mat<3> stress;
  for_carrying(i, [&](std::int32_t p, std::int32_t) {
    const peridynamics::BondMotion m = peridynamics::bond_motion(hood_, body, i, p);
    Vec<3> pull = m.direction;
    for (int k = 0; k < 3; ++k) pull[k] *= 0.5 * constant_ * hood_.volume[p] * m.stretch;
    add_dyad(stress, pull, difference<3>(hood_.X, i, p));
  });
  return stress;
}

}  // namespace cleave::bond_pd
