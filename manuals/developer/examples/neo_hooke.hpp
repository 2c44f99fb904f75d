// Compressible neo-Hookean elasticity: for rubber and large strains. Resists collapse, so it is
// fit for compression. In two dimensions plane strain only.
//
//   W = mu/2 (tr(F^T F) - 3 - 2 ln J) + lambda/2 (ln J)^2,   P = mu (F - F^-T) + lambda ln J F^-T
#pragma once

#include <array>
#include <cmath>
#include <span>

#include "core/field.hpp"
#include "core/parameter.hpp"
#include "core/tensor.hpp"
#include "material/kinematics.hpp"

namespace cleave {

class NeoHooke {
 public:
  static constexpr std::array kParameters = {
      required_parameter("rho", "kg m-3", kPositive, "mass density in the reference configuration"),
      required_parameter("E", "Pa", kPositive, "Young's modulus at small strain"),
      required_parameter("nu", "1", Range{-1.0, 0.5, true, true},
                         "Poisson's ratio at small strain"),
  };
  static constexpr std::array<FieldSpec, 0> kHistory{};  // elastic: nothing to remember

  NeoHooke(std::span<const double> p, Kinematics kinematics)
      : density_(p[0]),
        youngs_(p[1]),
        mu_(p[1] / (2 * (1 + p[2]))),
        lambda_(p[1] * p[2] / ((1 + p[2]) * (1 - 2 * p[2]))),
        supported_(kinematics != CLEAVE_PLANE_STRESS) {}

  double density() const { return density_; }
  double youngs_modulus() const { return youngs_; }
  double shear_modulus() const { return mu_; }
  double wave_speed() const { return std::sqrt((lambda_ + 2 * mu_) / density_); }

  // h = F - I. An answer that is not valid stops the run with the particle's number.
  template <int D>
  Response<Mat<D>> respond(const Mat<D>& h, const History&, const Increment&) const {
    const Mat<D> f = plus_identity(h);
    const double j = determinant(f);
    Response<Mat<D>> r;
    r.valid = supported_ && j > 0;
    if (!r.valid) return r;
    const Mat<D> cof = cofactor(f);  // J F^-T
    const double log_j = std::log(j);
    for (int a = 0; a < D; ++a)
      for (int b = 0; b < D; ++b)
        r.stress(a, b) = mu_ * f(a, b) + (lambda_ * log_j - mu_) / j * cof(a, b);
    r.stress_33 = D == 2 ? lambda_ * log_j : 0.0;
    r.energy = 0.5 * mu_ * (contract(f, f) - D - 2 * log_j) + 0.5 * lambda_ * log_j * log_j;
    return r;
  }

  // F33 in two dimensions.
  double thickness_stretch(const Mat<2>&, const History&) const { return 1.0; }

 private:
  double density_, youngs_, mu_, lambda_;
  bool supported_;
};

}  // namespace cleave
