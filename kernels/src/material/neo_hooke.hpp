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

// x - ln(1+x) > 0 with all digits for small x, x > -1.
inline double minus_log_one_plus(double x) {
  if (!(std::fabs(x) < 0.25)) return x - log_one_plus(x);
  // x - 2 artanh s with s = x/(2+x), and x - 2s = s x; |s| < 0.15
  const double s = x / (2 + x), z = s * s;
  double tail = 2.0 / 21;
  for (int n = 19; n >= 3; n -= 2) tail = 2.0 / n + z * tail;
  return s * (x - z * tail);
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

  // Invalid where det F <= 0 or F is not finite.
  template <int D>
  Response<Mat<D>> respond(const Mat<D>& h, const History&, const Increment&) const {
    Response<Mat<D>> r;
    Full<double> full = embed(h);
    r.valid = admissible(full);
    if (!r.valid) return r;
    const State s = state_of(full);
    r.stress = extract<D>(multiply(scaled(1 / s.ratio, s.tau), s.cofactor));
    r.stress_33 = kinematics_ == CLEAVE_PLANE_STRAIN ? s.tau.zz : 0.0;  // F33 = 1
    // tr B - 3 - 2 ln J = |H|^2 - 2 (J-1 - tr H) + 2 (J-1 - ln J)
    const double second = (full.xx * full.yy - full.xy * full.yx) +
                          (full.yy * full.zz - full.yz * full.zy) +
                          (full.zz * full.xx - full.zx * full.xz);
    const double third = full.xx * (full.yy * full.zz - full.yz * full.zy) -
                         full.xy * (full.yx * full.zz - full.yz * full.zx) +
                         full.xz * (full.yx * full.zy - full.yy * full.zx);
    r.energy =
        mu_ * ((0.5 * squared_norm(full) - (second + third)) + minus_log_one_plus(s.change)) +
        0.5 * lambda_ * s.log_ratio * s.log_ratio;
    return r;
  }

  // A_ijkl = mu delta_ik delta_jl + (mu - lambda ln J) Finv_li Finv_jk + lambda Finv_ji Finv_lk [NH 2]
  template <int D>
  bool tangent(const Mat<D>& h, const History&, const Increment&, Tangent<D>& a) const {
    Full<double> full = embed(h);
    if (!admissible(full)) return false;
    const State s = state_of(full);
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
  struct State {
    Full<double> cofactor;
    double change, ratio, log_ratio;
    Symmetric<double> tau;
  };
  State state_of(const Full<double>& h) const {
    const auto c = cofactor_of(h);
    State s{c.cofactor, c.volume_change, 1 + c.volume_change, log_one_plus(c.volume_change), {}};
    s.tau = plus_spherical(scaled(mu_, push_forward_minus_identity(h, Symmetric<double>{})),
                           lambda_ * s.log_ratio);
    return s;
  }
  static double squared_norm(const Full<double>& h) {
    return ((h.xx * h.xx + h.xy * h.xy) + (h.xz * h.xz + h.yx * h.yx)) +
           ((h.yy * h.yy + h.yz * h.yz) + (h.zx * h.zx + h.zy * h.zy)) + h.zz * h.zz;
  }

  // Whether there is an answer; in plane stress h33 is found on the way.
  bool admissible(Full<double>& h) const {
    double size = 0;
    for (const double x : {h.xx, h.xy, h.xz, h.yx, h.yy, h.yz, h.zx, h.zy, h.zz})
      size += std::fabs(x);
    if (!is_finite(size) || !(size < 1e60)) return false;  // products stay representable
    const double in_plane = cofactor_of(h).volume_change;
    if (!(in_plane > -1)) return false;
    if (kinematics_ != CLEAVE_PLANE_STRESS) return true;
    const auto trial = [&](double guess) {
      ThicknessTrial t;
      t.valid = guess > -1;
      if (!t.valid) return t;
      h.zz = guess;
      // tau33, which unlike P33 grows with F33 for nu >= 0.
      t.p33 = state_of(h).tau.zz;
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
