// Finite elements: T3, T6 with three Gauss points, tet4. The reference solutions that the particle
// methods are compared with; particles are nodes, the stress is evaluated at Gauss points, masses
// are lumped. Nothing breaks.
#pragma once

#include <vector>

#include "core/thread_team.hpp"
#include "formulation/common/stress_points.hpp"
#include "model/formulation.hpp"

namespace cleave::fem {

class FiniteElements final : public Formulation {
 public:
  const char* name() const override { return "fem"; }
  std::int64_t integration_points(const Body& body) const override;
  void setup(Body& body, ThreadTeam& team) override;
  void rebuild(Body& body, ThreadTeam& team) override;
  double stable_step(const Body& body) const override;
  const GradientOperator* gradient_operator(ThreadTeam&) override { return &operator_; }
  bool has_gradient_operator() const override { return true; }
  void stiffness_bound(const Body& body, ThreadTeam& team, std::span<double> bound) override;

  bool break_bonds(Body&, const Clock&, ThreadTeam&) override { return false; }
  bool break_most_critical(Body&, const Clock&, ThreadTeam&, Breaking) override { return true; }
  void deform(Body& body, const Clock& clock, ThreadTeam& team) override;
  void forces(Body& body, ThreadTeam& team) override;
  void precrack(Body& body, std::span<const std::int64_t> pairs) override;

  StoredEnergy stored_energy(const Body& body) const override;
  double hourglass_energy(const Body&) const override { return 0; }
  void count(const Body& body, cleave_counts& counts) const override;
  bool derive(const Body&, std::string_view, std::int64_t, std::int64_t, double*) const override {
    return false;
  }
  std::int64_t bytes() const override;

 private:
  template <class Element>
  void setup_elements(Body& body);
  template <class Element>
  double highest_frequency_squared(const Body& body) const;
  void make_columns(const Body& body);

  std::int64_t elements_ = 0;
  GradientOperator operator_;
  StressPoints points_;
  std::vector<std::int32_t> row_begin_, node_, origin_;
  std::vector<std::int32_t> column_begin_, column_point_, column_entry_;
  std::vector<double> zeta_;  // (3,h) Omega_q grad N_a [m2]
  double stable_step_ = 0;    // [s]
};

}  // namespace cleave::fem
