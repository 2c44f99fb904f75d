// Continuum-kinematics-based peridynamics: one-, two- and three-neighbour interactions that resist changes
// of length, area and volume.                                             [PD one, two, three, weights]
#pragma once

#include <vector>

#include "formulation/cpd/cloud_cliques.hpp"
#include "formulation/cpd/hood_numbers.hpp"
#include "formulation/cpd/lattice_cliques.hpp"
#include "formulation/peridynamics/formulation.hpp"

namespace cleave::cpd {

class ContinuumKinematicsPeridynamics final : public peridynamics::Peridynamic {
 public:
  const char* name() const override { return "cpd"; }
  std::int64_t bytes() const override;

 private:
  struct Constants {
    double one = 0, two = 0, three = 0;
  };
  void prepare(Body& body) override;
  void find_rates(const Body& body, std::span<double> rates) const override;
  void expect_workers(int workers) override;
  void reconnect(std::int64_t i) override {
    if (lattice_.active()) lattice_.connect(hood_, damage_, i);
  }
  void act(Body& body, ThreadTeam& team) override;
  peridynamics::PointEnergy point_energy(const Body& body, std::int64_t i,
                                         int worker) const override;
  Mat<3> point_stress(const Body& body, std::int64_t i, int worker) const override;
  void point_stresses(const Body& body, std::int64_t first, std::int64_t last, int worker,
                      Mat<3>* stress) const override;

  const Constants& constants(std::size_t i) const {
    return constants_[static_cast<std::size_t>(material_of_[i])];
  }
  bool any(double Constants::*constant) const;  // not zero in some material
  // Of one- and two-neighbour interactions, times the volume of the point.
  Mat<3> pairs_stress(const Body& body, std::int64_t i) const;
  void find_constants(const Body& body);
  void check_constants(const Body& body, std::size_t region) const;
  void weigh(const Body& body);
  double calibration(std::int64_t full) const;
  double hood_volume(std::int64_t i) const;

  void add_triangles(Body& body, ThreadTeam& team) const;
  void add_tetrahedra(Body& body, ThreadTeam& team);
  // The tetrahedra at a point whose three bonds carry, by themselves.
  ApexSums tetrahedra_at(const Body& body, std::int64_t i, int worker) const;
  // The star of the bonds of a point that carry; nullptr if it has no tetrahedron.
  const Star* carrying_star(const Body& body, std::int64_t i, int worker) const;
  // f(triangle, weight) for the triangles at i that carry; weight is that of the force on i.
  template <class F>
  void for_triangles(const double* x, std::int64_t i, const F& f) const;
  bool carries(std::int64_t i, std::int64_t p) const {
    return damage_.whole(i) || damage_.intact(hood_.find_half(i, p));
  }

  std::vector<Constants> constants_;  // of each material
  peridynamics::HoodVolume hood_form_ = peridynamics::HoodVolume::sum;
  bool conservative_ = false, signed_volume_ = false;
  double full_count_ = 0;             // neighbours of a full lattice neighbourhood, form sphere
  std::vector<HoodNumbers> numbers_;  // until set-up is done
  std::vector<double> two_, three_;   // (n) C2 v V_H^2/N2u, C3 v V_H^3/N3u
  std::vector<double> sums_;          // (4,n) of the tetrahedra
  CloudCliques cloud_;
  LatticeCliques lattice_;                    // active: instead of cloud_
  mutable std::vector<StarScratch> scratch_;  // of each worker
};

}  // namespace cleave::cpd
