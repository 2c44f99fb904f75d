// What total-Lagrangian SPH and correspondence peridynamics have in common: everything but the
// weight of a pair. Gradients, stresses and forces go through the one gradient operator; added to
// them are the hourglass penalty and the artificial viscosity of bonds. No fracture.
#pragma once

#include <vector>

#include "core/blocks.hpp"
#include "core/thread_team.hpp"
#include "formulation/cbm/parameters.hpp"
#include "formulation/common/stress_points.hpp"
#include "formulation/common/viscosity.hpp"
#include "formulation/meshless/hourglass.hpp"
#include "formulation/meshless/kernel_gradient.hpp"

namespace cleave::meshless {

class KernelMethod : public Formulation {
 public:
  void setup(Body& body, ThreadTeam& team) override;
  void rebuild(Body& body, ThreadTeam& team) override;
  double stable_step(const Body&) const override { return stable_step_; }
  const GradientOperator* gradient_operator(ThreadTeam&) override { return &operator_; }
  bool has_gradient_operator() const override { return true; }
  std::string static_obstacle(const Body& body) const override;
  void stiffness_bound(const Body& body, ThreadTeam& team, std::span<double> bound) override;
  std::string relaxation_obstacle(const Body& body) const override;

  bool break_bonds(Body&, const Clock&, ThreadTeam&) override { return false; }
  bool break_most_critical(Body&, const Clock&, ThreadTeam&, Breaking) override { return true; }
  void deform(Body& body, const Clock& clock, ThreadTeam& team) override;
  void forces(Body& body, ThreadTeam& team) override;
  void precrack(Body& body, std::span<const std::int64_t> pairs) override;

  StoredEnergy stored_energy(const Body& body) const override;
  double hourglass_energy(const Body& body) const override;
  void count(const Body& body, cleave_counts& counts) const override;
  bool derive(const Body&, std::string_view, std::int64_t, std::int64_t, double*) const override {
    return false;
  }
  std::int64_t bytes() const override;

 protected:
  // The kernel radius r [m] of group kernel, whatever its meaning. Throws if it is missing.
  static double kernel_radius(const Body& body);
  // Options of the method, and its weight of a pair.
  virtual Kernel make_kernel(const Body& body) const = 0;

 private:
  std::vector<double> setup_viscosity(const Body& body);
  template <int D>
  void forces_in(Body& body, ThreadTeam& team);

  KernelGradient gradient_;
  GradientOperator operator_;
  StressPoints points_;
  Hourglass hourglass_;
  ViscosityForm viscosity_ = ViscosityForm::none;
  BondRate<std::int32_t> bond_rate_;
  std::vector<double> bond_weight_;  // (h) of the frozen viscosity [m3]
  double stable_step_ = 0;           // [s] of the undeformed body
  double dt_ = 0;                    // of the step being done
  BlockSums<1> power_;
};

}  // namespace cleave::meshless
