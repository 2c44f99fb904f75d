#include "formulation/lps/lps.hpp"

#include <cmath>

namespace cleave::lps {

using peridynamics::BondMotion;
using peridynamics::Influence;
using peridynamics::PairArrays;
using peridynamics::PointEnergy;

double LinearPeridynamicSolid::influence(double length) const {
  if (influence_ == Influence::inverse_distance) return hood_.horizon / length;
  if (influence_ == Influence::constant) return 1;
  return 1 - length / (hood_.horizon * (1 + 1e-6));  // not negative on the horizon
}

void LinearPeridynamicSolid::prepare(Body& body) {
  if (dimension_ == 1) {
    throw Error(CLEAVE_UNSUPPORTED,
                text("group peridynamics of ", body.label(),
                     ": a bar (section > 0) has no state-based form; use bond_pd or cpd"));
  }
  influence_ = static_cast<Influence>(body.group("peridynamics").choice("influence"));
  const auto n = static_cast<std::size_t>(hood_.points);
  for (auto* list : {&weighted_, &alpha_, &volumetric_, &spread_, &extension_, &square_})
    list->assign(n, 0.0);
  for (std::size_t i = 0; i < n; ++i) {
    const auto point = static_cast<std::int64_t>(i);
    for (auto b = hood_.first(point); b < hood_.last(point); ++b) {
      const double L = hood_.length(point, hood_.neighbour(b));
      weighted_[i] += influence(L) * L * L * hood_.volume[hood_.neighbour(b)];
    }
    if (weighted_[i] > 0)
      alpha_[i] = dimension_ * (dimension_ + 2) * elastic(point).mu / weighted_[i];
    left_[i] = hood_.volume[i];
  }
}

// Sums run over the bonds that carry, m stays that of all: with r = m(carrying)/m the exact derivative of
// the energy has T = d theta/m (kappa - (d+2) mu/d (2 - r)).
void LinearPeridynamicSolid::reconnect(std::int64_t i) {
  const auto at = static_cast<std::size_t>(i);
  if (!(weighted_[at] > 0)) return;
  double carrying = 0;
  for_carrying(i, [&](std::int32_t p, std::int32_t) {
    const double L = hood_.length(i, p);
    carrying += influence(L) * L * L * hood_.volume[p];
  });
  const double d = dimension_;
  volumetric_[at] = d / weighted_[at] *
                    (elastic(i).bulk_in(dimension_) -
                     (d + 2) * elastic(i).mu / d * (2 - carrying / weighted_[at]));
}

// W_i <= 1/2 max(alpha, d^2 kappa/m) sum omega e^2 v, so the bonds of that stiffness bound the body.
void LinearPeridynamicSolid::find_rates(const Body& body, std::span<double> rates) const {
  const auto stiffness = [&](std::int64_t i) {
    const auto at = static_cast<std::size_t>(i);
    const double kappa = elastic(i).bulk_in(dimension_);
    return weighted_[at] > 0
               ? std::fmax(alpha_[at], dimension_ * dimension_ * kappa / weighted_[at])
               : 0.0;
  };
  const auto weight = [&](std::int64_t i, std::int64_t p) {
    const double L = hood_.length(i, p);
    return L * hood_.volume[i] * hood_.volume[p] * influence(L) * (stiffness(i) + stiffness(p));
  };
  pair_rates(body, weight, rates);
}

double LinearPeridynamicSolid::energy_density(std::int64_t i, const State& s) const {
  const auto at = static_cast<std::size_t>(i);
  return 0.5 * (alpha_[at] * s.square +
                s.dilatation * s.dilatation * volumetric_[at] * weighted_[at] / dimension_);
}

void LinearPeridynamicSolid::act(Body& body, ThreadTeam& team) {
  PairArrays arrays = pair_arrays(body);
  arrays.influence = static_cast<std::int32_t>(influence_);
  arrays.alpha = alpha_.data();
  arrays.spread = spread_.data();
  arrays.extension = extension_.data();
  arrays.square = square_.data();
  for_blocks(team, hood_.points, [&](std::int64_t, std::int64_t first, std::int64_t last) {
    kernels().extension(arrays, first, last);
    for (auto i = static_cast<std::size_t>(first); i < static_cast<std::size_t>(last); ++i) {
      State s;
      if (weighted_[i] > 0) s.dilatation = dimension_ * extension_[i] / weighted_[i];
      s.square = square_[i];
      spread_[i] = volumetric_[i] * s.dilatation;
      body.point.energy[i] = energy_density(static_cast<std::int64_t>(i), s);
    }
  });
  for_blocks(team, hood_.points, [&](std::int64_t, std::int64_t first, std::int64_t last) {
    kernels().state(arrays, first, last);
  });
}

LinearPeridynamicSolid::State LinearPeridynamicSolid::state_of(const Body& body,
                                                               std::int64_t i) const {
  State s;
  for_carrying(i, [&](std::int32_t p, std::int32_t) {
    const BondMotion m = bond_motion(hood_, body, i, p);
    const double e = m.l - m.L, weight = influence(m.L) * hood_.volume[p];
    s.dilatation += weight * m.L * e;
    s.square += weight * e * e;
  });
  const double m = weighted_[static_cast<std::size_t>(i)];
  s.dilatation = m > 0 ? dimension_ * s.dilatation / m : 0.0;
  return s;
}

PointEnergy LinearPeridynamicSolid::point_energy(const Body& body, std::int64_t i, int) const {
  const auto at = static_cast<std::size_t>(i);
  const State s = state_of(body, i);
  PointEnergy sum;
  sum.energy = hood_.volume[i] * energy_density(i, s);
  for_carrying(i, [&](std::int32_t p, std::int32_t) {
    const BondMotion m = bond_motion(hood_, body, i, p);
    const double force = alpha_[at] * (m.l - m.L) + volumetric_[at] * s.dilatation * m.L;
    sum.rate += hood_.volume[i] * hood_.volume[p] * influence(m.L) * force * m.rate;
  });
  return sum;
}

// P_i = sum_j t_ij n (x) X_ij v_j
Mat<3> LinearPeridynamicSolid::point_stress(const Body& body, std::int64_t i, int) const {
  const auto at = static_cast<std::size_t>(i);
  const State s = state_of(body, i);
  Mat<3> stress;
  for_carrying(i, [&](std::int32_t p, std::int32_t) {
    const BondMotion m = bond_motion(hood_, body, i, p);
    const double force = alpha_[at] * (m.l - m.L) + volumetric_[at] * s.dilatation * m.L;
    Vec<3> pull = m.direction;
    for (int k = 0; k < 3; ++k) pull[k] *= influence(m.L) * force * hood_.volume[p];
    add_dyad(stress, pull, difference<3>(hood_.X, i, p));
  });
  return stress;
}

std::int64_t LinearPeridynamicSolid::bytes() const {
  return Peridynamic::bytes() +
         static_cast<std::int64_t>(6 * weighted_.capacity() * sizeof(double));
}

}  // namespace cleave::lps
