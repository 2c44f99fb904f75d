// Elasticity of dense rubber after P.J. Blatz and W.L. Ko (1962): for large strains and moderate
// compression. In two dimensions plane strain only.
//
//   W = mu/2 (tr(F^T F) - 3 + (J^(-2 b) - 1)/b),   P = mu (F - J^(-2 b) F^-T),   b = nu/(1 - 2 nu)
#pragma once

#include <array>
#include <cmath>
#include <span>

#include "core/field.hpp"
#include "core/parameter.hpp"
#include "core/tensor.hpp"
#include "material/kinematics.hpp"

namespace cleave {

class BlatzKo {
 public:
  static constexpr std::array kParameters = {
      required_parameter("rho", "kg m-3", kPositive, "mass density in the reference configuration"),
      required_parameter("E", "Pa", kPositive, "Young's modulus at small strain"),
      required_parameter("nu", "1", Range{0.0, 0.5, true, true}, "Poisson's ratio at small strain"),
  };
  static constexpr std::array<FieldSpec, 0> kHistory{};  // elastic: nothing to remember

  BlatzKo(std::span<const double> p, Kinematics kinematics)
      : density_(p[0]),
        youngs_(p[1]),
        mu_(p[1] / (2 * (1 + p[2]))),
        exponent_(p[2] / (1 - 2 * p[2])),
        supported_(kinematics != CLEAVE_PLANE_STRESS) {}

  double density() const { return density_; }
  double youngs_modulus() const { return youngs_; }
  double shear_modulus() const { return mu_; }
  double wave_speed() const { return std::sqrt(2 * mu_ * (1 + exponent_) / density_); }

  // h = F - I. An answer that is not valid stops the run with the particle's number.
  template <int D>
  Response<Mat<D>> respond(const Mat<D>& h, const History&, const Increment&) const {
    const Mat<D> f = plus_identity(h);
    const double j = determinant(f);
    Response<Mat<D>> r;
    r.valid = supported_ && j > 0;
    if (!r.valid) return r;
    const Mat<D> cof = cofactor(f);  // J F^-T
    const double power = std::pow(j, -2 * exponent_);
    for (int a = 0; a < D; ++a)
      for (int b = 0; b < D; ++b) r.stress(a, b) = mu_ * (f(a, b) - power / j * cof(a, b));
    r.stress_33 = D == 2 ? mu_ * (1 - power) : 0.0;
    r.energy = 0.5 * mu_ * (contract(f, f) - D + (power - 1) / exponent_);
    return r;
  }

  // F33 in two dimensions.
  double thickness_stretch(const Mat<2>&, const History&) const { return 1.0; }

 private:
  double density_, youngs_, mu_, exponent_;
  bool supported_;
};

}  // namespace cleave
