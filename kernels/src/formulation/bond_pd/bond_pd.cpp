#include "formulation/bond_pd/bond_pd.hpp"

namespace cleave::bond_pd {

using peridynamics::Interface;
using peridynamics::KeptModulus;
using peridynamics::PairForm;
using peridynamics::PointEnergy;

void BondPeridynamics::prepare(Body& body) {
  const ParameterSet& options = body.group("peridynamics");
  interface_ = static_cast<Interface>(options.choice("interface"));
  constants_.clear();
  for (std::size_t k = 0; k < materials_.size(); ++k)
    constants_.push_back(peridynamics::bond_constant(
        body, k, materials_[k], reach(), static_cast<KeptModulus>(options.choice("modulus"))));
  const bool several = constants_.size() > 1;
  share_.assign(several ? left_.size() : 0, 0.0);
  for (std::size_t i = 0; i < left_.size(); ++i) {
    left_[i] = several ? hood_.volume[i] : constants_[0] * hood_.volume[i];
    now_[4 * i + 3] = hood_.volume[i];
    if (!several) continue;
    const double c = constants_[static_cast<std::size_t>(material_of_[i])];
    share_[i] = interface_ == Interface::series ? 0.5 / c : 0.5 * c;
  }
  if (!several) {
    weigh_pairs(PairForm::product);
  } else {
    weigh_pairs(interface_ == Interface::series ? PairForm::series : PairForm::mean, share_.data());
  }
}

double BondPeridynamics::constant(std::int64_t i, std::int64_t p) const {
  if (share_.empty()) return constants_[0];
  const double both = share_[static_cast<std::size_t>(i)] + share_[static_cast<std::size_t>(p)];
  return interface_ == Interface::series ? 1 / both : both;
}

void BondPeridynamics::find_rates(const Body& body, std::span<double> rates) const {
  pair_rates(
      body, [this](std::int64_t i, std::int64_t p) { return weight(i, p); }, rates);
}

void BondPeridynamics::act(Body& body, ThreadTeam& team) { act_by_pairs(body, team); }

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
    for (int k = 0; k < 3; ++k) pull[k] *= 0.5 * constant(i, p) * hood_.volume[p] * m.stretch;
    add_dyad(stress, pull, difference<3>(hood_.X, i, p));
  });
  return stress;
}

}  // namespace cleave::bond_pd
