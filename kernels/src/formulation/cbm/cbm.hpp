// Continuum Bond Method: a particle's deformation gradient is the volume average of the gradients
// of the live simplices around it; a bond that stretches too far takes its simplices with it.
#pragma once

#include <memory>
#include <vector>

#include "core/thread_team.hpp"
#include "formulation/cbm/block_step.hpp"
#include "formulation/cbm/fracture.hpp"
#include "formulation/cbm/network.hpp"
#include "formulation/cbm/stabilisation.hpp"
#include "formulation/common/stress_points.hpp"
#include "formulation/common/viscosity.hpp"

namespace cleave::cbm {

class ContinuumBondMethod final : public Formulation {
 public:
  const char* name() const override { return "cbm"; }
  void setup(Body& body, ThreadTeam& team) override;
  void rebuild(Body& body, ThreadTeam& team) override;
  double stable_step(const Body& body) const override;
  const GradientOperator* gradient_operator(ThreadTeam& team) override;
  bool has_gradient_operator() const override { return true; }
  ResidentStep* resident() override { return blocks_.get(); }
  std::string static_obstacle(const Body& body) const override;
  void stiffness_bound(const Body& body, ThreadTeam& team, std::span<double> bound) override;

  bool break_bonds(Body& body, const Clock& clock, ThreadTeam& team) override;
  bool break_most_critical(Body& body, const Clock& clock, ThreadTeam& team,
                           Breaking which) override;
  void deform(Body& body, const Clock& clock, ThreadTeam& team) override;
  void forces(Body& body, ThreadTeam& team) override;
  void precrack(Body& body, std::span<const std::int64_t> pairs) override;

  StoredEnergy stored_energy(const Body& body) const override;
  double hourglass_energy(const Body& body) const override;
  void count(const Body& body, cleave_counts& counts) const override;
  bool derive(const Body& body, std::string_view field, std::int64_t first, std::int64_t last,
              double* values) const override;
  bool derive_integers(const Body& body, std::string_view field, std::int64_t first,
                       std::int64_t last, std::int64_t* values) const override;
  std::int64_t bytes() const override;

 private:
  void setup_viscosity(const Body& body);
  void setup_blocks(const Body& body, ThreadTeam& team);
  void keep_rows(ThreadTeam& team);
  template <int D>
  void forces_in(Body& body, ThreadTeam& team);

  Network network_;
  GradientOperator operator_;  // of kept rows
  StressPoints points_;
  Fracture fracture_;
  Stabilisation stabilisation_;
  ViscosityForm viscosity_ = ViscosityForm::none;
  bool local_lengths_ = false;  // of the viscosity: each bond's own
  BondRate<std::int32_t> bond_rate_;
  std::unique_ptr<BlockStep> blocks_;  // nullptr: the step goes by rows
  double beta_ = 0;
  double shortest_ = 0, stable_length_ = 0;  // [m] of the intact body: do not change with damage
};

}  // namespace cleave::cbm
