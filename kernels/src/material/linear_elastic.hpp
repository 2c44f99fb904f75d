// Hooke's law on the symmetric displacement gradient, P = sigma: small strains and small rotations
// only. It is not objective: a rotation is a strain to it. For comparison with linear solutions; svk
// is the same at small strain and turns with the body.
#pragma once

#include <array>
#include <cmath>
#include <span>

#include "core/field.hpp"
#include "core/parameter.hpp"
#include "core/tangent.hpp"
#include "core/tensor.hpp"
#include "material/kinematics.hpp"

namespace cleave {

class LinearElastic {
 public:
  static constexpr std::array kParameters = {
      required_parameter("rho", "kg m-3", kPositive, "mass density in the reference configuration"),
      required_parameter("E", "Pa", kPositive, "Young's modulus"),
      required_parameter("nu", "1", Range{-1.0, 0.5, true, true}, "Poisson's ratio"),
  };
  static constexpr std::array<FieldSpec, 0> kHistory{};

  LinearElastic(std::span<const double> p, Kinematics kinematics)
      : density_(p[0]),
        youngs_(p[1]),
        nu_(p[2]),
        mu_(p[1] / (2 * (1 + p[2]))),
        lambda_(
            p[1] * p[2] /
            (kinematics == CLEAVE_PLANE_STRESS ? 1 - p[2] * p[2] : (1 + p[2]) * (1 - 2 * p[2]))),
        kinematics_(kinematics) {}

  double density() const { return density_; }
  double youngs_modulus() const { return youngs_; }
  double shear_modulus() const { return mu_; }
  double wave_speed() const { return std::sqrt((lambda_ + 2 * mu_) / density_); }

  // sigma = lambda tr(eps) I + 2 mu eps                                              [LE 1]
  template <int D>
  Response<Mat<D>> respond(const Mat<D>& h, const History&, const Increment&) const {
    Mat<D> e;
    double trace = 0;
    for (int i = 0; i < D; ++i) {
      trace += h(i, i);
      for (int j = 0; j < D; ++j) e(i, j) = 0.5 * (h(i, j) + h(j, i));
    }
    Response<Mat<D>> r;
    for (int i = 0; i < D; ++i)
      for (int j = 0; j < D; ++j)
        r.stress(i, j) = 2 * mu_ * e(i, j) + (i == j ? lambda_ * trace : 0.0);
    r.stress_33 = kinematics_ == CLEAVE_PLANE_STRAIN ? lambda_ * trace : 0.0;
    r.energy = 0.5 * lambda_ * trace * trace + mu_ * contract(e, e);
    return r;
  }

  template <int D>
  bool tangent(const Mat<D>&, const History&, const Increment&, Tangent<D>& a) const {
    for (int i = 0; i < D; ++i)
      for (int j = 0; j < D; ++j)
        for (int k = 0; k < D; ++k)
          for (int l = 0; l < D; ++l)
            a(i, j, k, l) = (i == j && k == l ? lambda_ : 0.0) +
                            mu_ * ((i == k && j == l ? 1.0 : 0.0) + (i == l && j == k ? 1.0 : 0.0));
    return true;
  }

  // F33 in two dimensions.
  double thickness_stretch(const Mat<2>& h, const History&) const {
    return kinematics_ == CLEAVE_PLANE_STRAIN ? 1.0 : 1 - nu_ / (1 - nu_) * (h(0, 0) + h(1, 1));
  }

 private:
  double density_, youngs_, nu_, mu_, lambda_;
  Kinematics kinematics_;
};

}  // namespace cleave
