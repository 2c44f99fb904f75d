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
#include "material/lane_point.hpp"

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

  static constexpr int kLaneHistory = 0;
  static constexpr bool kAnswersByState = true;
  static constexpr bool kUsesLength = false;
  bool in_lanes() const { return true; }

  // sigma = lambda tr(eps) I + 2 mu eps                                              [LE 1]
  template <class R>
  CLEAVE_INLINE void update(LanePoint<R, 0>& point, const Setting<R>&) const {
    const Full<R>& h = point.h;
    const Symmetric<R> e = {
        h.xx, h.yy, h.zz, 0.5 * (h.xy + h.yx), 0.5 * (h.yz + h.zy), 0.5 * (h.zx + h.xz)};
    const R sum = trace(e);
    const Symmetric<R> s = plus_spherical(scaled(R(2 * mu_), e), lambda_ * sum);
    point.p = {s.xx, s.xy, s.zx, s.xy, s.yy, s.yz, s.zx, s.yz, s.zz};
    if (kinematics_ == CLEAVE_PLANE_STRESS) point.p.zz = R(0.0);
    point.energy = (0.5 * lambda_) * (sum * sum) + mu_ * squared_norm(e);
    point.valid = R(0.0) <= R(0.0);
  }
  template <int D>
  Response<Mat<D>> respond(const Mat<D>& h, const History&, const Increment&) const {
    return respond_by_update<D>(*this, embed(h), {});
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
