// Bond-based peridynamics: central forces between all points within the horizon, linear in the stretch.
//                                                                                           [PD bond]
#pragma once

#include "formulation/peridynamics/formulation.hpp"

namespace cleave::bond_pd {

class BondPeridynamics final : public peridynamics::Peridynamic {
 public:
  const char* name() const override { return "bond_pd"; }

 private:
  void prepare(Body& body) override;
  void find_rates(const Body& body, std::span<double> rates) const override;
  void act(Body& body, ThreadTeam& team) override;
  peridynamics::PointEnergy point_energy(const Body& body, std::int64_t i,
                                         int worker) const override;
  Mat<3> point_stress(const Body& body, std::int64_t i, int worker) const override;

  // c of a bond [N m-6].                                                           [PD bond, interface]
  double constant(std::int64_t i, std::int64_t p) const;
  // Force of a bond over its stretch [N].
  double weight(std::int64_t i, std::int64_t p) const {
    return constant(i, p) * hood_.volume[i] * hood_.volume[p];
  }

  std::vector<double> constants_;  // of each material
  peridynamics::Interface interface_ = peridynamics::Interface::series;
  std::vector<double> share_;  // (n) several materials only: 1/(2c), or c/2
};

}  // namespace cleave::bond_pd
