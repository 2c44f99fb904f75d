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
#include "material/lane_point.hpp"

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

  static constexpr int kLaneHistory = 0;
  static constexpr bool kAnswersByState = true;
  static constexpr bool kUsesLength = false;
  bool in_lanes() const { return true; }

  // S = lambda tr(E) I + 2 mu E,  P = F S.                                       [CBM 31]
  // Invalid in plane stress when 1 + 2 E_33 <= 0: the thickness would vanish.
  template <class R>
  CLEAVE_INLINE void update(LanePoint<R, 0>& point, const Setting<R>&) const {
    const Full<R>& h = point.h;
    const Symmetric<R> e = green_lagrange(h);
    const R in_plane = trace(e);
    const Symmetric<R> s = plus_spherical(scaled(R(2 * mu_), e), lambda_ * in_plane);
    const Full<R> f = {1.0 + h.xx, h.xy, h.xz, h.yx, 1.0 + h.yy, h.yz, h.zx, h.zy, 1.0 + h.zz};
    point.p = multiply(f, s);
    point.energy = (0.5 * lambda_) * (in_plane * in_plane) + mu_ * squared_norm(e);
    point.valid = R(0.0) <= R(0.0);
    if (kinematics_ == CLEAVE_PLANE_STRESS) {
      point.p.zz = R(0.0);
      point.valid = 1.0 + 2.0 * strain_33(in_plane) > 0.0;
    }
  }
  template <int D>
  Response<Mat<D>> respond(const Mat<D>& h, const History&, const Increment&) const {
    return respond_by_update<D>(*this, embed(h), {});
  }

  // A_ijkl = dP_ij/dF_kl = delta_ik S_jl + lambda F_ij F_kl + mu (F_il F_kj + delta_jl (F F^T)_ik)
  template <int D>
  bool tangent(const Mat<D>& h, const History&, const Increment&, Tangent<D>& a) const {
    const Symmetric<double> strain = green_lagrange(embed(h));
    const Mat<3> e = components(strain);
    const Mat<D> f = plus_identity(h);
    const double sum = trace(strain);
    for (int i = 0; i < D; ++i)
      for (int k = 0; k < D; ++k) {
        double ff = 0;
        for (int m = 0; m < D; ++m) ff += f(i, m) * f(k, m);
        for (int j = 0; j < D; ++j)
          for (int l = 0; l < D; ++l) {
            const double s = 2 * mu_ * e(j, l) + (j == l ? lambda_ * sum : 0.0);
            a(i, j, k, l) = lambda_ * f(i, j) * f(k, l) +
                            mu_ * (f(i, l) * f(k, j) + (j == l ? ff : 0.0)) + (i == k ? s : 0.0);
          }
      }
    return kinematics_ != CLEAVE_PLANE_STRESS || 1 + 2 * strain_33(sum) > 0;
  }

  // F_33 in two dimensions.
  double thickness_stretch(const Mat<2>& h, const History&) const {
    if (kinematics_ == CLEAVE_PLANE_STRAIN) return 1.0;
    return std::sqrt(std::fmax(0.0, 1 + 2 * strain_33(trace(green_lagrange(embed(h))))));
  }

 private:
  template <class R>
  R strain_33(const R& in_plane_trace) const {
    return (-nu_ / (1 - nu_)) * in_plane_trace;
  }

  double density_, youngs_, nu_, mu_ = 0, lambda_ = 0;
  Kinematics kinematics_;
};

}  // namespace cleave
