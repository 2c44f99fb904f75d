// J2 plasticity of metals at finite strain with a choice of hardening. Isotropic, independent of the
// rate; not for shocks (no equation of state), not for cyclic loads that need kinematic hardening.
#pragma once

#include "material/log_strain_law.hpp"
#include "material/table_hardening.hpp"

namespace cleave {

// Young's modulus and Poisson's ratio, with tau_m = kappa ln J by the class Volumetric.
template <class Volumetric>
class HenckyElasticity {
 public:
  using Bulk = Volumetric;
  static constexpr std::array kParameters = {
      required_parameter("rho", "kg m-3", kPositive, "mass density in the reference configuration"),
      required_parameter("E", "Pa", kPositive, "Young's modulus"),
      required_parameter("nu", "1", Range{-1.0, 0.5, true, true}, "Poisson's ratio"),
  };

  explicit HenckyElasticity(std::span<const double> p) : density_(p[0]), youngs_(p[1]), nu_(p[2]) {}
  double density() const { return density_; }
  double youngs_modulus() const { return youngs_; }
  double shear_modulus() const { return youngs_ / (2 * (1 + nu_)); }
  double bulk_modulus() const { return youngs_ / (3 * (1 - 2 * nu_)); }
  Bulk bulk() const { return Bulk(bulk_modulus()); }

 private:
  double density_, youngs_, nu_;
};

template <class Hardening>
using J2Plasticity = LogStrainLaw<Hardening, HenckyElasticity<LogarithmicBulk>>;
using J2Voce = J2Plasticity<VoceHardening>;
using J2Power = J2Plasticity<PowerHardening>;
using J2Table = J2Plasticity<TableHardening>;

}  // namespace cleave
