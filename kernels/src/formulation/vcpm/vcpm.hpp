// The volume-compensated particle model: springs on a lattice, and for each particle an energy of the volume
// strain of its cell, which makes Poisson's ratio free.                                [VCPM bond, 13]
#pragma once

#include <vector>

#include "formulation/peridynamics/formulation.hpp"
#include "formulation/vcpm/lattice.hpp"

namespace cleave::vcpm {

class VolumeCompensatedParticles final : public peridynamics::Peridynamic {
 public:
  const char* name() const override { return "vcpm"; }
  bool takes_regions() const override { return false; }
  void setup(Body& body, ThreadTeam& team) override;
  void rebuild(Body& body, ThreadTeam& team) override;
  bool has_stiffness() const override { return true; }
  void add_stiffness(const Body& body, StiffnessSink& sink) const override;
  std::string static_obstacle(const Body&) const override { return {}; }
  bool constant_stiffness() const override { return geometry_ == Geometry::linear; }
  std::int64_t broken_bonds() const override { return std::ssize(order_); }
  void add_stiffness_after(const Body& body, std::int64_t broken,
                           StiffnessSink& sink) const override;
  bool held_after(const Body& body, std::int64_t broken, std::int64_t i) const override;
  void stiffness_change(const Body& body, std::int64_t event,
                        StiffnessChange& change) const override;
  void release_loose(Body& body, const Clock& clock, ThreadTeam& team) override;
  bool holds(const Body& body, std::int64_t i) const override;
  bool derive(const Body& body, std::string_view field, std::int64_t first, std::int64_t last,
              double* values) const override;
  std::int64_t bytes() const override;

 private:
  double lay_out(Body& body) override;
  void prepare(Body& body) override;
  std::vector<double> limits(const Body& body) override;
  void find_rates(const Body& body, std::span<double> rates) const override;
  void flag_points(Body& body, ThreadTeam& team, std::vector<char>& flag) override;
  double severity(const Body& body, std::int64_t i, std::int64_t p) const override;
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
  };
  Bond bond(const Body& body, std::int64_t i, std::int64_t p) const;
  // sum_p w_ip dL_ip/2 over the bonds that carry, times the factor of the surface      [VCPM bond]
  double dilatation(const Body& body, std::int64_t i) const;
  // V T/2 theta_i times the factor of the surface: what a bond takes from its end i, over w
  double pressure(std::int64_t i, double dilatation) const;
  void find_pressures(const Body& body, ThreadTeam& team);
  double force(const Bond& b, std::int64_t i, std::int64_t p) const;  // F_ip [N]       [VCPM 13]
  void check_bonds(const Body& body) const;
  void number_broken();
  bool carried(std::int32_t bond, std::int64_t broken) const;
  // f(neighbour) for the bonds of i that carried when so many had broken.
  template <class F>
  void for_carried(std::int64_t i, std::int64_t broken, const F& f) const;
  template <class Carries>
  void add_parts(const Body& body, const Carries& carries, StiffnessSink& sink) const;
  StiffnessChange::Column volume_column(const Body& body, std::int64_t i,
                                        std::int64_t broken) const;
  bool is_loose(const Body& body, std::int64_t i) const;

  Lattice lattice_;
  Geometry geometry_ = Geometry::finite;
  Criterion criterion_ = Criterion::force;
  double modulus_ = 0;               // T, in plane stress that of the plane [Pa]
  std::int32_t* event_ = nullptr;    // (bonds), the field
  std::vector<std::int32_t> order_;  // bonds in the order in which they broke
  std::vector<double> factor_;       // (n) of the surface
  std::vector<double> pressure_;     // (n) of the present positions
};

}  // namespace cleave::vcpm
