// The volume-compensated particle model: springs on a lattice, and for each particle an energy of the volume
// strain of its cell, which makes Poisson's ratio free.                                [VCPM bond, 13]
#pragma once

#include <vector>

#include "formulation/peridynamics/formulation.hpp"
#include "formulation/vcpm/cell_kernels.hpp"
#include "formulation/vcpm/lattice.hpp"
#include "formulation/vcpm/softening.hpp"
#include "model/stiffness_source.hpp"

namespace cleave::vcpm {

class VolumeCompensatedParticles final : public peridynamics::Peridynamic, private StiffnessSource {
 public:
  const char* name() const override { return "vcpm"; }
  bool takes_regions() const override { return false; }
  void setup(Body& body, ThreadTeam& team) override;
  void rebuild(Body& body, ThreadTeam& team) override;
  const StiffnessSource* stiffness() const override { return this; }
  std::string static_obstacle(const Body&) const override { return {}; }
  void release_loose(Body& body, const Clock& clock, ThreadTeam& team) override;
  std::string one_bond_obstacle(const Body& body) const override;
  bool derive(const Body& body, std::string_view field, std::int64_t first, std::int64_t last,
              double* values) const override;
  std::int64_t bytes() const override;

 private:
  void add_stiffness(const Body& body, StiffnessSink& sink) const override;
  bool holds(const Body& body, std::int64_t i) const override;
  bool constant_stiffness() const override {
    return geometry_ == Geometry::linear && !softening_.active();
  }
  std::int64_t broken_bonds() const override { return std::ssize(order_); }
  void add_stiffness_after(const Body& body, std::int64_t broken,
                           StiffnessSink& sink) const override;
  bool held_after(const Body& body, std::int64_t broken, std::int64_t i) const override;
  void stiffness_change(const Body& body, std::int64_t event,
                        StiffnessChange& change) const override;

  double lay_out(Body& body) override;
  void prepare(Body& body) override;
  std::vector<double> limits(const Body& body) override;
  void find_rates(const Body& body, std::span<double> rates) const override;
  void flag_points(Body& body, ThreadTeam& team, std::vector<char>& flag) override;
  double severity(const Body& body, std::int64_t i, std::int64_t p) const override;
  void reconnect(std::int64_t i) override;
  double integrity(std::int32_t half) const override;
  double kept_integrity(double strain) const override;
  void weaken(std::int32_t bond, double kept) override;
  double breaking_limit(std::int64_t i, std::int64_t p) const override;
  double add_released(std::int32_t bond, double energy) override;
  void act(Body& body, ThreadTeam& team) override;
  peridynamics::PointEnergy point_energy(const Body& body, std::int64_t i,
                                         int worker) const override;
  void broke(std::int32_t bond) override;
  double ratio(double severity, double limit) const override;
  Mat<3> point_stress(const Body& body, std::int64_t i, int worker) const override;

  // A bond as it is now.
  struct Bond {
    double elongation = 0;  // dL [m]
    Vec<3> direction;       // from i to p; zero where the ends coincide
    const Shell* shell = nullptr;
    double integrity = 1;  // g
  };
  Bond bond(const Body& body, std::int64_t i, std::int64_t p) const;  // as if it were intact
  Bond bond(const Body& body, std::int64_t i, std::int64_t p, std::int32_t half) const;
  // sum_p g w_ip dL_ip/2 over the bonds that carry, times the factor of the surface    [VCPM bond]
  double dilatation(const Body& body, std::int64_t i) const;
  // V T/2 theta_i times the factor of the surface: what a bond takes from its end i, over w
  double pressure(std::int64_t i, double dilatation) const;
  CellArrays cell_arrays();
  bool take_shifts(const Body& body, ThreadTeam& team);
  void respond(const Body& body, ThreadTeam& team);
  void respond_again(const CellArrays& arrays);
  double force(const Bond& b, std::int64_t i, std::int64_t p) const;  // F_ip [N]       [VCPM 13]
  void check_bonds(const Body& body) const;
  void number_broken();
  bool carried(std::int32_t bond, std::int64_t broken) const;
  // f(neighbour, half) for the bonds of i that carried when so many had broken.
  template <class F>
  void for_carried(std::int64_t i, std::int64_t broken, const F& f) const;
  template <class Carries>
  void add_parts(const Body& body, const Carries& carries, StiffnessSink& sink) const;
  StiffnessChange::Column volume_column(const Body& body, std::int64_t i,
                                        std::int64_t broken) const;
  bool is_loose(const Body& body, std::int64_t i) const;
  double bond_limit(const Body& body);

  Lattice lattice_;
  Geometry geometry_ = Geometry::finite;
  Criterion criterion_ = Criterion::force;
  double modulus_ = 0;               // T, in plane stress that of the plane [Pa]
  std::int32_t* event_ = nullptr;    // (bonds), the field
  std::vector<std::int32_t> order_;  // bonds in the order in which they broke
  std::vector<double> length_;       // (half-bonds, and 7 more) [m]
  AlignedReals shift_;               // (4,n) displacements, of geometry 'linear'
  std::vector<double> factor_;       // (n) of the surface
  // Of the positions and bonds that respond saw last.
  std::vector<double> pressure_, force_, energy_;  // (n), (3,n), (n)
  std::vector<char> critical_;                     // (n) a bond may be beyond its limit
  bool responded_ = false;
  std::vector<std::int32_t> stale_;  // particles that other bonds hold since then
  std::vector<char> shifted_;        // by block of points: shift_ has changed
  Softening softening_;
  double *integrity_ = nullptr, *released_ = nullptr;  // (bonds) the fields
  std::vector<double>
      weight_;  // (half-bonds, and 7 more) g, 0 where broken; empty without softening
};

}  // namespace cleave::vcpm
