// Yield stress as a function of the equivalent plastic strain, for the return mapping of
// log_strain_plasticity.hpp. A hardening is a small class; everything of a point comes in lanes (R =
// double or Pack) and may depend on the size of the step and on the point's memory, which are frozen
// over the step.
//
//   kParameters, kMemory         properties, and history variables of its own (scalars)
//   least_slope()                lower bound of h' for all strains [Pa]
//   lower_bound(e)               of the yield stress, cheap; 0 is allowed
//   start(e, memory, setting)    what is known before the flow: at least `yield` and `slope`
//   first_guess(start, phi, 3G)  of the increment x, not beyond the root if h is concave
//   kSmooth, bend(start, x, slope), third(start)  whether h''' exists, and then h''(e+x), given h'(e+x), and
//                                a bound of |h'''| from e on [Pa]
//   advance(start, x, rise, slope)  h(e+x) - h(e) without cancellation, and h'(e+x)
//   work(start, x, rise)         int of the yield stress from e to e+x [Pa], given h(e+x) - h(e)
//   finish(start, x, flow, memory)  what the flow makes of the memory
//   kCauchy                      whether the yield stress is J times a function of the strain, rate and
//                                memory, with J = setting.volume_ratio; lower_bound is without J
//   kFails, failed(memory)       whether points may fail, and which have: they carry no deviator, no
//                                tension, their yield stress is 0 and work() what that releases
#pragma once

#include <algorithm>
#include <array>
#include <span>

#include "core/elementary.hpp"
#include "core/error.hpp"
#include "core/field.hpp"
#include "core/parameter.hpp"
#include "material/lane_point.hpp"

namespace cleave {

// What a step of plastic flow was: for temperature and damage.
template <class R>
struct Flow {
  R work;               // [J m-3]
  R mean_stress;        // tr(tau)/3 [Pa]
  R equivalent_stress;  // of tau [Pa]
  R volume_ratio;       // J
  R shear_energy;       // stored at the end of the step [J m-3]
};

// For a hardening that only depends on the strain.
struct RateIndependent {
  static constexpr std::array<FieldSpec, 0> kMemory{};
  static constexpr const char* kDamage = nullptr;
  static constexpr bool kSmooth = false, kCauchy = false, kFails = false;
  template <class S, class R>
  R first_guess(const S& start, const R& phi, double three_g) const {
    return phi / (three_g + start.slope);
  }
  template <class S, class R, class M>
  void finish(const S&, const R&, const Flow<R>&, M&) const {}
};

// Linear and saturating:  tau_y = tau_y0 + h0 e + (tau_inf - tau_y0)(1 - exp(-alpha e)).
class VoceHardening : public RateIndependent {
 public:
  static constexpr bool kSmooth = true;
  static constexpr std::array kParameters = {
      required_parameter("tau_y0", "Pa", kPositive, "initial yield stress (Kirchhoff)"),
      required_parameter("tau_inf", "Pa", kPositive, "yield stress at saturation, without h0"),
      real_parameter("h0", "Pa", kNotNegative, 0.0, "linear hardening modulus"),
      real_parameter("alpha", "1", kNotNegative, 0.0, "rate of saturation in plastic strain"),
  };

  explicit VoceHardening(std::span<const double> p)
      : initial_(p[0]),
        range_(p[1] - p[0]),
        fall_(std::min(p[1] - p[0], 0.0)),
        linear_(p[2]),
        alpha_(p[3]),
        inverse_alpha_(p[3] > 0 ? 1 / p[3] : 0.0) {}

  double least_slope() const { return linear_ + std::min(0.0, range_ * alpha_); }
  template <class R, class M>
  R lower_bound(const R& e, const M&) const {
    return (initial_ + linear_ * e) + fall_;
  }

  template <class R>
  struct Start {
    R strain, yield, slope;
    R rest;  // (tau_inf - tau_y0) exp(-alpha e)
  };
  template <class R>
  R bend(const Start<R>&, const R&, const R& slope) const {
    return alpha_ * (linear_ - slope);
  }
  template <class R>
  R third(const Start<R>& s) const {
    return (alpha_ * alpha_ * alpha_) * absolute(s.rest);
  }
  // The root of r with h'' kept to second order.
  template <class R>
  R first_guess(const Start<R>& s, const R& phi, double three_g) const {
    const R inverse = 1.0 / (three_g + s.slope), x = phi * inverse;
    return x + (x * x) * (0.5 * alpha_ * alpha_) * (s.rest * inverse);
  }
  template <class R, class M>
  Start<R> start(const R& e, const M&, const Setting<R>&) const {
    const R decay = exponential_minus_one_wide(-alpha_ * e), rest = range_ * (1.0 + decay);
    return {e, (initial_ + linear_ * e) - range_ * decay, linear_ + alpha_ * rest, rest};
  }
  template <class R>
  void advance(const Start<R>& s, const R& x, R& rise, R& slope) const {
    const R decay = exponential_minus_one(-alpha_ * x);
    rise = linear_ * x - s.rest * decay;
    slope = linear_ + alpha_ * (s.rest * (1.0 + decay));
  }
  template <class R>
  R work(const Start<R>& s, const R& x, const R& rise) const {
    const R flat = (initial_ + linear_ * (s.strain + 0.5 * x)) * x;
    if (!(alpha_ > 0)) return flat;
    // rest (exp(-alpha x) - 1), from the rise where its cancellation is no loss beside the initial stress
    const R rest = linear_ <= alpha_ * initial_ ? linear_ * x - rise
                                                : s.rest * exponential_minus_one(-alpha_ * x);
    return flat + (range_ * x + rest * inverse_alpha_);
  }

 private:
  double initial_, range_, fall_, linear_, alpha_, inverse_alpha_;
};

// Power law:  tau_y = tau_y0 (1 + e/eps_0)^n.
class PowerHardening : public RateIndependent {
 public:
  static constexpr bool kSmooth = true;
  static constexpr std::array kParameters = {
      required_parameter("tau_y0", "Pa", kPositive, "initial yield stress (Kirchhoff)"),
      required_parameter("eps_0", "1", kPositive, "plastic strain that scales the power law"),
      required_parameter("n", "1", Range{0.0, 1.0, false, false}, "hardening exponent"),
  };

  explicit PowerHardening(std::span<const double> p)
      : initial_(p[0]), scale_(p[1]), exponent_(p[2]) {}

  double least_slope() const { return 0; }
  template <class R, class M>
  R lower_bound(const R&, const M&) const {
    return R(initial_);
  }

  template <class R>
  struct Start {
    R yield, slope, base;  // base = eps_0 + e
  };
  template <class R>
  R bend(const Start<R>& s, const R& x, const R& slope) const {
    return (exponent_ - 1) * slope / (s.base + x);
  }
  template <class R>
  R third(const Start<R>& s) const {
    return ((1 - exponent_) * (2 - exponent_)) * s.slope / (s.base * s.base);
  }
  template <class R, class M>
  Start<R> start(const R& e, const M&, const Setting<R>&) const {
    const R base = scale_ + e;
    // Not below initial_ by rounding, so that lower_bound holds.
    const R yield =
        initial_ + initial_ * exponential_minus_one(exponent_ * log_one_plus(e / scale_));
    return {yield, exponent_ * yield / base, base};
  }
  template <class R>
  void advance(const Start<R>& s, const R& x, R& rise, R& slope) const {
    const R growth = exponential_minus_one(exponent_ * log_one_plus(x / s.base));
    rise = s.yield * growth;
    slope = exponent_ * s.yield * (1.0 + growth) / (s.base + x);
  }
  template <class R>
  R work(const Start<R>& s, const R& x, const R& rise) const {
    return (s.yield * x + rise * (s.base + x)) / (exponent_ + 1);
  }

 private:
  double initial_, scale_, exponent_;
};

}  // namespace cleave
