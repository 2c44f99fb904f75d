// St Venant-Kirchhoff elasticity: linear in the Green-Lagrange strain. For small strains and any
// rotation. Not for impact: it softens in compression (nominal stress turns at stretch 1/sqrt(3))
// and does not resist inversion.
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

class StVenantKirchhoff {
 public:
  static constexpr std::array kParameters = {
      required_parameter("rho", "kg m-3", kPositive, "mass density in the reference configuration"),
      required_parameter("E", "Pa", kPositive, "Young's modulus"),
      required_parameter("nu", "1", Range{-1.0, 0.5, true, true}, "Poisson's ratio"),
  };
  static constexpr std::array<FieldSpec, 0> kHistory{};

  StVenantKirchhoff(std::span<const double> p, Kinematics kinematics)
      : density_(p[0]), youngs_(p[1]), nu_(p[2]), kinematics_(kinematics) {
    mu_ = youngs_ / (2 * (1 + nu_));
    // Plane stress: E_33 = -nu/(1-nu) tr E turns lambda into E nu/(1-nu^2); exact for this law.
    lambda_ = kinematics == CLEAVE_PLANE_STRESS ? youngs_ * nu_ / (1 - nu_ * nu_)
                                                : youngs_ * nu_ / ((1 + nu_) * (1 - 2 * nu_));
  }

  double density() const { return density_; }
  double youngs_modulus() const { return youngs_; }
  double shear_modulus() const { return mu_; }
  double wave_speed() const { return std::sqrt((lambda_ + 2 * mu_) / density_); }

  // S = lambda tr(E) I + 2 mu E,  P = F S.                                       [CBM 31]
  // Invalid in plane stress when 1 + 2 E_33 <= 0: the thickness would vanish.
  template <int D>
  Response<Mat<D>> respond(const Mat<D>& h, const History&, const Increment&) const {
    const Mat<D> e = green_lagrange(h);
    double trace = 0;
    for (int i = 0; i < D; ++i) trace += e(i, i);
    Mat<D> s;
    for (int i = 0; i < D; ++i)
      for (int j = 0; j < D; ++j) s(i, j) = 2 * mu_ * e(i, j) + (i == j ? lambda_ * trace : 0.0);
    Response<Mat<D>> r;
    r.stress = multiply(plus_identity(h), s);
    r.stress_33 = kinematics_ == CLEAVE_PLANE_STRAIN ? lambda_ * trace : 0.0;
    r.energy = 0.5 * lambda_ * trace * trace + mu_ * contract(e, e);
    r.valid = kinematics_ != CLEAVE_PLANE_STRESS || 1 + 2 * strain_33(trace) > 0;
    return r;
  }

  // A_ijkl = dP_ij/dF_kl = delta_ik S_jl + lambda F_ij F_kl + mu (F_il F_kj + delta_jl (F F^T)_ik)
  template <int D>
  bool tangent(const Mat<D>& h, const History&, const Increment&, Tangent<D>& a) const {
    const Mat<D> e = green_lagrange(h), f = plus_identity(h);
    double trace = 0;
    for (int i = 0; i < D; ++i) trace += e(i, i);
    for (int i = 0; i < D; ++i)
      for (int k = 0; k < D; ++k) {
        double ff = 0;
        for (int m = 0; m < D; ++m) ff += f(i, m) * f(k, m);
        for (int j = 0; j < D; ++j)
          for (int l = 0; l < D; ++l) {
            const double s = 2 * mu_ * e(j, l) + (j == l ? lambda_ * trace : 0.0);
            a(i, j, k, l) = lambda_ * f(i, j) * f(k, l) +
                            mu_ * (f(i, l) * f(k, j) + (j == l ? ff : 0.0)) + (i == k ? s : 0.0);
          }
      }
    return kinematics_ != CLEAVE_PLANE_STRESS || 1 + 2 * strain_33(trace) > 0;
  }

  // F_33 in two dimensions.
  double thickness_stretch(const Mat<2>& h, const History&) const {
    if (kinematics_ == CLEAVE_PLANE_STRAIN) return 1.0;
    const Mat<2> e = green_lagrange(h);
    return std::sqrt(std::fmax(0.0, 1 + 2 * strain_33(e(0, 0) + e(1, 1))));
  }

 private:
  // E = (H + H^T + H^T H) / 2: full accuracy for small H.
  template <int D>
  static Mat<D> green_lagrange(const Mat<D>& h) {
    Mat<D> e;
    for (int i = 0; i < D; ++i)
      for (int j = 0; j < D; ++j) {
        double hh = 0;
        for (int k = 0; k < D; ++k) hh += h(k, i) * h(k, j);
        e(i, j) = 0.5 * (h(i, j) + h(j, i) + hh);
      }
    return e;
  }
  double strain_33(double in_plane_trace) const { return -nu_ / (1 - nu_) * in_plane_trace; }

  double density_, youngs_, nu_, mu_ = 0, lambda_ = 0;
  Kinematics kinematics_;
};

}  // namespace cleave
