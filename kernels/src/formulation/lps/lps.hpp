// Ordinary state-based peridynamics, linear peridynamic solid: the force of a bond depends on its extension
// and on the dilatation of both ends, so that Poisson's ratio is free.                      [PD lps]
#pragma once

#include <vector>

#include "formulation/peridynamics/formulation.hpp"

namespace cleave::lps {

class LinearPeridynamicSolid final : public peridynamics::Peridynamic {
 public:
  const char* name() const override { return "lps"; }
  std::int64_t bytes() const override;

 private:
  void prepare(Body& body) override;
  void find_rates(const Body& body, std::span<double> rates) const override;
  void reconnect(std::int64_t i) override;
  void act(Body& body, ThreadTeam& team) override;
  peridynamics::PointEnergy point_energy(const Body& body, std::int64_t i,
                                         int worker) const override;
  Mat<3> point_stress(const Body& body, std::int64_t i, int worker) const override;

  double influence(double length) const;
  // Dilatation and the sum of omega e^2 v of a point.
  struct State {
    double dilatation = 0, square = 0;
  };
  State state_of(const Body& body, std::int64_t i) const;
  double energy_density(std::int64_t i, const State& s) const;

  peridynamics::Influence influence_ = peridynamics::Influence::inverse_distance;
  std::vector<double> weighted_;            // (n) m = sum omega L^2 v of all bonds [m5]
  std::vector<double> alpha_;               // (n) d (d+2) mu / m
  std::vector<double> volumetric_;          // (n) b: T = b theta; changes where bonds break
  std::vector<double> spread_;              // (n) T of the step
  std::vector<double> extension_, square_;  // (n) sums of the step
};

}  // namespace cleave::lps
