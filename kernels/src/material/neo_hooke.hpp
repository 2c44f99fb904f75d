// Compressible neo-Hookean elasticity: for rubber and large strains. Resists collapse, so it is fit
// for compression; not for nearly incompressible rubber in low-order elements, which lock.
//
//   W = mu/2 (tr B - 3 - 2 ln J) + lambda/2 (ln J)^2 ,  tau = mu (B - I) + lambda ln J I      [NH 1]
//
// Everything is formed from H = F - I, so that small strains keep their digits.
#pragma once

#include <array>
#include <cmath>
#include <span>

#include "core/elementary.hpp"
#include "core/field.hpp"
#include "core/parameter.hpp"
#include "core/symmetric.hpp"
#include "material/kinematics.hpp"
#include "material/lane_point.hpp"
#include "material/plane_stress.hpp"

namespace cleave {

// x - ln(1+x) > 0 with all digits for small x, x > -1; given ln(1+x).
template <class R>
CLEAVE_INLINE R minus_log_one_plus(const R& x, const R& logarithm) {
  const MaskOf<R> near = absolute(x) < 0.25;
  if (!any(near)) return x - logarithm;
  // x - 2 artanh s with s = x/(2+x), and x - 2s = s x; |s| < 0.15
  const R small = select(near, x, R(0.0)), s = small / (2.0 + small), z = s * s;
  R tail(2.0 / 21);
  for (int n = 19; n >= 3; n -= 2) tail = 2.0 / n + z * tail;
  return select(near, s * (small - z * tail), x - logarithm);
}

class NeoHooke {
 public:
  static constexpr std::array kParameters = {
      required_parameter("rho", "kg m-3", kPositive, "mass density in the reference configuration"),
      required_parameter("E", "Pa", kPositive, "Young's modulus at small strain", "[NH 1]"),
      required_parameter("nu", "1", Range{-1.0, 0.5, true, true}, "Poisson's ratio at small strain",
                         "[NH 1]"),
  };
  static constexpr std::array<FieldSpec, 0> kHistory{};

  NeoHooke(std::span<const double> p, Kinematics kinematics)
      : density_(p[0]),
        youngs_(p[1]),
        mu_(p[1] / (2 * (1 + p[2]))),
        lambda_(p[1] * p[2] / ((1 + p[2]) * (1 - 2 * p[2]))),
        kinematics_(kinematics) {}

  double density() const { return density_; }
  double youngs_modulus() const { return youngs_; }
  double shear_modulus() const { return mu_; }
  double wave_speed() const {
    const double plane_wave = lambda_ + 2 * mu_;
    const double modulus =
        kinematics_ == CLEAVE_PLANE_STRESS ? 4 * mu_ * (1 - mu_ / plane_wave) : plane_wave;
    return std::sqrt(modulus / density_);
  }

  static constexpr int kLaneHistory = 0;
  static constexpr bool kAnswersByState = true;
  static constexpr bool kUsesLength = false;
  // Plane stress has an outer iteration and is done point by point.
  bool in_lanes() const { return kinematics_ != CLEAVE_PLANE_STRESS; }

  // Invalid where det F <= 0 or F is not finite.
  template <class R>
  CLEAVE_INLINE void update(LanePoint<R, 0>& point, const Setting<R>&) const {
    point.valid = R(0.0) <= R(0.0);
    if (any_reaches_two(join_bits(point.h))) refuse_extreme(point);
    Full<R>& h = point.h;
    const State<R> s = state_of(h, upright_cofactor(h, point.valid));
    point.p = multiply(scaled(1.0 / s.ratio, s.tau), s.cofactor);
    // tr B - 3 - 2 ln J = |H|^2 - 2 (J-1 - tr H) + 2 (J-1 - ln J)
    const R second =
        ((h.xx * h.yy - h.xy * h.yx) + (h.yy * h.zz - h.yz * h.zy)) + (h.zz * h.xx - h.zx * h.xz);
    const R third = (h.xx * (h.yy * h.zz - h.yz * h.zy) - h.xy * (h.yx * h.zz - h.yz * h.zx)) +
                    h.xz * (h.yx * h.zy - h.yy * h.zx);
    point.energy = mu_ * ((0.5 * squared_norm(h) - (second + third)) +
                          minus_log_one_plus(s.change, s.log_ratio)) +
                   (0.5 * lambda_) * (s.log_ratio * s.log_ratio);
  }
  template <int D>
  Response<Mat<D>> respond(const Mat<D>& h, const History&, const Increment&) const {
    Full<double> full = embed(h);
    if (!in_lanes() && !find_thickness(full)) {
      Response<Mat<D>> none;
      none.valid = false;
      return none;
    }
    Response<Mat<D>> r = respond_by_update<D>(*this, full, {});
    if (!in_lanes()) r.stress_33 = 0;  // what the iteration leaves
    return r;
  }

  // A_ijkl = mu delta_ik delta_jl + (mu - lambda ln J) Finv_li Finv_jk + lambda Finv_ji Finv_lk [NH 2]
  template <int D>
  bool tangent(const Mat<D>& h, const History&, const Increment&, Tangent<D>& a) const {
    Full<double> full = embed(h);
    if (!admissible(full)) return false;
    const State<double> s = state_of(full, cofactor_of(full));
    const Full<double>& c = s.cofactor;
    const double inverse[3][3] = {{c.xx / s.ratio, c.yx / s.ratio, c.zx / s.ratio},
                                  {c.xy / s.ratio, c.yy / s.ratio, c.zy / s.ratio},
                                  {c.xz / s.ratio, c.yz / s.ratio, c.zz / s.ratio}};
    Tangent<3> solid;
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j)
        for (int k = 0; k < 3; ++k)
          for (int l = 0; l < 3; ++l)
            solid(i, j, k, l) = (i == k && j == l ? mu_ : 0.0) +
                                (mu_ - lambda_ * s.log_ratio) * inverse[l][i] * inverse[j][k] +
                                lambda_ * inverse[j][i] * inverse[l][k];
    if constexpr (D == 3) {
      a = solid;
    } else if (kinematics_ == CLEAVE_PLANE_STRESS) {
      condense(solid, a);
    } else {
      restrict_to_plane(solid, a);
    }
    return true;
  }

  // F33 in two dimensions.
  double thickness_stretch(const Mat<2>& h, const History&) const {
    Full<double> full = embed(h);
    return admissible(full) ? 1 + full.zz : 1.0;
  }

 private:
  static constexpr double kLargestInput = 1e60;  // products stay representable

  template <class R>
  struct State {
    Full<R> cofactor;
    R change, ratio, log_ratio;
    Symmetric<R> tau;
  };
  template <class R>
  CLEAVE_INLINE State<R> state_of(const Full<R>& h, const Cofactor<R>& c) const {
    State<R> s{
        c.cofactor, c.volume_change, 1.0 + c.volume_change, log_one_plus(c.volume_change), {}};
    s.tau = plus_spherical(scaled(R(mu_), push_forward_minus_identity(h, Symmetric<R>{})),
                           lambda_ * s.log_ratio);
    return s;
  }
  template <class R>
  static R squared_norm(const Full<R>& h) {
    return ((h.xx * h.xx + h.xy * h.xy) + (h.xz * h.xz + h.yx * h.yx)) +
           ((h.yy * h.yy + h.yz * h.yz) + (h.zx * h.zx + h.zy * h.zy)) + h.zz * h.zz;
  }
  template <class R>
  [[gnu::noinline]] static void refuse_extreme(LanePoint<R, 0>& point) {
    R size = sum_of_sizes(point.h);
    point.valid = is_finite(size);
    size = select(point.valid, size, R(0.0));
    point.valid = point.valid & (size < kLargestInput);
    point.h = select(point.valid, point.h, Full<R>{});
  }

  // Whether there is an answer; in plane stress h33 is found on the way.
  bool admissible(Full<double>& h) const {
    const double size = sum_of_sizes(h);
    if (!is_finite(size) || !(size < kLargestInput)) return false;
    return in_lanes() ? cofactor_of(h).volume_change > -1 : find_thickness(h);
  }
  bool find_thickness(Full<double>& h) const {
    const double size = sum_of_sizes(h);
    if (!is_finite(size) || !(size < kLargestInput)) return false;
    if (!(cofactor_of(h).volume_change > -1)) return false;
    const auto trial = [&](double guess) {
      ThicknessTrial t;
      t.valid = guess > -1;
      if (!t.valid) return t;
      h.zz = guess;
      // tau33, which unlike P33 grows with F33 for nu >= 0.
      t.p33 = state_of(h, cofactor_of(h)).tau.zz;
      t.slope = 2 * mu_ * (1 + guess) + lambda_ / (1 + guess);
      return t;
    };
    double h33 = 0;
    if (!solve_thickness(trial, size, h33)) return false;
    h.zz = h33;
    return true;
  }

  double density_, youngs_, mu_, lambda_;
  Kinematics kinematics_;
};

}  // namespace cleave
