// Continuum Bond Method: a particle's deformation gradient is the volume average of the gradients
// of the live simplices around it; a bond that stretches too far takes its simplices with it.
#pragma once

#include <vector>

#include "formulation/cbm/fracture.hpp"
#include "formulation/cbm/network.hpp"
#include "formulation/cbm/stabilisation.hpp"
#include "formulation/common/stress_points.hpp"
#include "formulation/common/viscosity.hpp"

namespace cleave::cbm {

class ContinuumBondMethod final : public Formulation {
 public:
  const char* name() const override { return "cbm"; }
  void setup(Body& body) override;
  void rebuild(Body& body, int threads) override;
  double stable_step(const Body& body) const override;
  const GradientOperator* gradient_operator() const override { return &operator_; }
  std::string static_obstacle(const Body& body) const override;

  void break_bonds(Body& body, const Clock& clock, int threads) override;
  void deform(Body& body, const Clock& clock, int threads) override;
  void forces(Body& body, int threads) override;
  void precrack(Body& body, std::span<const std::int64_t> pairs) override;

  StoredEnergy stored_energy(const Body& body) const override;
  double hourglass_energy(const Body& body) const override;
  void count(const Body& body, cleave_counts& counts) const override;
  bool derive(const Body& body, std::string_view field, std::int64_t first, std::int64_t last,
              double* values) const override;
  std::int64_t bytes() const override;

 private:
  void setup_viscosity(const Body& body);
  template <int D>
  void forces_in(Body& body, int threads);

  Network network_;
  GradientOperator operator_;
  StressPoints points_;
  Fracture fracture_;
  Stabilisation stabilisation_;
  ViscosityForm viscosity_ = ViscosityForm::none;
  BondRate<std::int32_t> bond_rate_;
  double beta_ = 0;
  double shortest_ = 0, stable_length_ = 0;  // [m] of the intact body: do not change with damage
};

}  // namespace cleave::cbm
