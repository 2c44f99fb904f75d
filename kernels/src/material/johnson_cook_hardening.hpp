// Yield stress and failure of Johnson and Cook: strain, rate and temperature as three factors.
//   sigma_y = (A + B e^n)(1 + C ln max(rate*, 1))(1 - T*^m) ,  tau_y = J sigma_y             [JC 1]
// The rate is that of the step, dg/dt; without a size of the step (dt = 0) there is no effect of the
// rate. Temperature and damage are frozen over the step and moved at its end. The temperature is that of
// the plastic work alone: compression by a shock does not heat here.
//   G.R. Johnson, W.H. Cook, 7th Int. Symp. on Ballistics (1983); Eng. Fract. Mech. 21 (1985) 31
#pragma once

#include "material/hardening.hpp"
#include "material/point_history.hpp"

namespace cleave {

class JohnsonCookHardening {
 public:
  static constexpr bool kSmooth = false, kCauchy = true, kFails = true;
  static constexpr std::array kParameters = {
      required_parameter("A", "Pa", kPositive, "yield stress (Cauchy) at eps_p = 0", "[JC 1]"),
      required_parameter("B", "Pa", kNotNegative, "hardening modulus", "[JC 1]"),
      required_parameter("n", "1", Range{0.0, 1.0, true, false}, "hardening exponent", "[JC 1]"),
      real_parameter("C", "1", kNotNegative, 0.0, "rate coefficient; 0: no effect of the rate",
                     "[JC 1]"),
      real_parameter("eps_dot_0", "s-1", kNotNegative, 0.0,
                     "reference rate of plastic strain; needed with C or D4", "[JC 1]"),
      real_parameter("m", "1", kPositive, 1.0, "temperature exponent", "[JC 1]"),
      real_parameter("T_room", "K", kPositive, 293.0,
                     "temperature at the start, and of the given strength", "[JC 2]"),
      real_parameter("T_melt", "K", kNotNegative, 0.0,
                     "melting temperature, where the strength is gone; 0: no thermal softening",
                     "[JC 2]"),
      real_parameter("c_p", "J kg-1 K-1", kNotNegative, 0.0,
                     "specific heat; 0: plastic work does not heat", "[JC 3]"),
      real_parameter("chi", "1", Range{0.0, 1.0, false, false}, 0.9,
                     "part of the plastic work that heats (Taylor-Quinney)", "[JC 3]"),
      real_parameter("D1", "1", {}, 0.0, "failure strain, constant part; D1 = D2 = 0: no failure",
                     "[JC 4]"),
      real_parameter("D2", "1", {}, 0.0, "failure strain, factor of the triaxiality part",
                     "[JC 4]"),
      real_parameter("D3", "1", {}, 0.0,
                     "failure strain, exponent of the triaxiality (tension positive); usually < 0",
                     "[JC 4]"),
      real_parameter("D4", "1", {}, 0.0, "failure strain, coefficient of the rate", "[JC 4]"),
      real_parameter("D5", "1", {}, 0.0, "failure strain, coefficient of the temperature",
                     "[JC 4]"),
  };
  static constexpr const char* kDamage = "damage_johnson_cook";
  static constexpr std::array kMemory = {
      point_history("temperature_rise", 1, "K", true,
                    "temperature above T_room, by the heat of the plastic work"),
      point_history(kDamage, 1, "1", true,
                    "Johnson-Cook damage; 1: failed, carries no deviator and no tension"),
      point_history("failing_energy", 1, "J m-3", false,
                    "stored by the shear when the point failed; released in the next step"),
  };

  JohnsonCookHardening(std::span<const double> p, double density);

  // (1+e)^n grows: never below zero.
  double least_slope() const { return 0; }
  template <class R, class M>
  R lower_bound(const R&, const M& memory) const {
    if (!(inverse_melt_ > 0)) return select(failed(memory), R(0.0), R(kBelow * initial_));
    if (thermal_ < 1) return R(0.0);
    // x^m <= x
    const R left = initial_ * (kBelow - relative_temperature(memory));
    return select(failed(memory), R(0.0), larger(left, R(0.0)));
  }
  template <class M>
  auto failed(const M& memory) const {
    return memory[1] >= 1.0;
  }

  template <class R>
  struct Start {
    R strain, yield, slope;
    R scale;           // J (1 - T*^m), 0 if failed
    R hardened;        // B e^n
    R release;         // energy of the shear that failing frees now
    R temperature;     // T*
    MaskOf<R> virgin;  // e = 0, or as good as
    double rate = 0;   // 1 / (dt eps_dot_0); 0: no effect of the rate
  };
  template <class R, class M>
  Start<R> start(const R& e, const M& memory, const Setting<R>& setting) const {
    Start<R> s;
    s.strain = e;
    s.release = memory[2];
    s.temperature = relative_temperature(memory);
    const R soft = inverse_melt_ > 0 ? 1.0 - power(s.temperature, thermal_) : R(1.0);
    s.scale = select(failed(memory), R(0.0), setting.volume_ratio * soft);
    s.hardened = modulus_ * power(e, exponent_);
    s.virgin = e < kLeast;
    s.yield = s.scale * (initial_ + s.hardened);
    s.slope = s.scale * (exponent_ * (s.hardened / select(s.virgin, R(1.0), e)));
    if (setting.dt * reference_rate_ > kLeast) s.rate = 1 / (setting.dt * reference_rate_);
    return s;
  }

  // The largest of three that are not beyond the root without an effect of the rate, which only
  // makes it smaller: the bracket takes care of that.
  template <class R>
  R first_guess(const Start<R>& s, const R& phi, double three_g) const {
    const R modulus = s.scale * modulus_;
    const MaskOf<R> hardens = modulus > 0.0;
    const R steep = power(phi / (2.0 * select(hardens, modulus, R(1.0))), 1 / exponent_);
    const R fresh = select(hardens, smaller(phi / (2 * three_g), steep), phi / three_g);
    return larger(fresh, select(s.virgin, fresh, phi / (three_g + s.slope)));
  }
  template <class R>
  void advance(const Start<R>& s, const R& x, R& rise, R& slope) const {
    const R growth = power_rise(s, x, exponent_, s.hardened), strain = s.strain + x;
    const MaskOf<R> moved = strain > 0.0;
    const R whole = (initial_ + s.hardened) + growth;
    R tangent = exponent_ * ((s.hardened + growth) / select(moved, strain, R(1.0)));
    R gain(0.0);  // of the factor of the rate over 1
    if (coefficient_ > 0 && s.rate > 0) {
      const R relative = s.rate * x;
      const MaskOf<R> fast = relative > 1.0;
      gain = coefficient_ * logarithm(select(fast, relative, R(1.0)));
      tangent = tangent * (1.0 + gain) +
                select(fast, coefficient_ * (whole / select(fast, x, R(1.0))), R(0.0));
    }
    rise = s.scale * (growth + whole * gain);
    slope = s.scale * tangent;
  }
  // int (A + B e^n) times the other factors, which hold for the whole step.
  template <class R>
  R work(const Start<R>& s, const R& x, const R&) const {
    const double k = exponent_ + 1;
    const R work = initial_ * x + power_rise(s, x, k, s.hardened * s.strain) / k;
    return s.scale * (work * (1.0 + coefficient_ * log_rate(s, x))) + s.release;
  }
  template <class R, class M>
  void finish(const Start<R>& s, const R& x, const Flow<R>& flow, M& memory) const {
    const MaskOf<R> whole = !failed(memory);
    memory[0] = memory[0] + select(whole, heating_ * flow.work, R(0.0));
    if (!fails_) return;
    const R strain = select(whole, failure_strain(s, x, flow), R(1.0));
    // A failure strain below the increment fails at once.
    const R least = select(x > 0.0, x, R(1.0));
    const R damage = memory[1] + select(whole, x / larger(strain, least), R(0.0));
    memory[1] = smaller(damage, R(1.0));
    memory[2] = select(whole & failed(memory), flow.shear_energy, R(0.0));
  }

  // eps_f                                                                            [JC 4]
  template <class R>
  R failure_strain(const Start<R>& s, const R& x, const Flow<R>& flow) const {
    const R equivalent =
        larger(flow.equivalent_stress, absolute(flow.mean_stress) / kLargestTriaxiality);
    const R safe = select(equivalent > 0.0, equivalent, R(1.0));
    const R triaxiality = smaller(flow.mean_stress / safe, R(1.5));
    const R shape =
        failure_[0] + failure_[1] * exponential(smaller(failure_[2] * triaxiality, R(200.0)));
    return shape * (1.0 + failure_[3] * log_rate(s, x)) * (1.0 + failure_[4] * s.temperature);
  }

 private:
  static constexpr double kBelow = 1 - 1e-12;  // rounding of start()
  static constexpr double kLeast = 1e-250;  // what has a reciprocal: of a strain, of dt eps_dot_0
  static constexpr double kFar = 1e6;
  static constexpr double kLargestTriaxiality = 1e6;  // where the deviator has gone

  template <class M>
  auto relative_temperature(const M& memory) const {
    using R = typename M::value_type;
    return smaller(larger(memory[0] * inverse_melt_, R(0.0)), R(1.0));
  }
  // ln max(rate*, 1)
  template <class R>
  R log_rate(const Start<R>& s, const R& x) const {
    if (!(s.rate > 0)) return R(0.0);
    return logarithm(larger(s.rate * x, R(1.0)));
  }
  // B ((e+x)^k - e^k), given older = B e^k, without the cancellation of a small x.
  template <class R>
  R power_rise(const Start<R>& s, const R& x, double k, const R& older) const {
    const MaskOf<R> far = x > kFar * s.strain;
    const R ratio = select(far, R(0.0), x) / select(s.virgin, R(1.0), s.strain);
    const R rise = older * exponential_minus_one(k * log_one_plus(ratio));
    if (!any(far)) return rise;
    return select(far, modulus_ * power(s.strain + x, k) - older, rise);
  }

  double initial_, modulus_, exponent_, coefficient_, reference_rate_, thermal_;
  double inverse_melt_ = 0;  // 1/(T_melt - T_room); 0: no thermal softening
  double heating_ = 0;       // [K m3 J-1]
  std::array<double, 5> failure_;
  bool fails_;
};

// Throws BAD_ARGUMENT for properties that do not fit together.
inline JohnsonCookHardening::JohnsonCookHardening(std::span<const double> p, double density)
    : initial_(p[0]),
      modulus_(p[1]),
      exponent_(p[2]),
      coefficient_(p[3]),
      reference_rate_(p[4]),
      thermal_(p[5]),
      failure_{p[10], p[11], p[12], p[13], p[14]},
      fails_(p[10] != 0 || p[11] != 0) {
  const double room = p[6], melt = p[7], heat = p[8];
  if (melt > 0 && !(melt > room)) {
    throw Error(CLEAVE_BAD_ARGUMENT, text("T_melt is ", melt, " and T_room ", room,
                                          "; allowed: T_melt > T_room, or 0 for no softening"));
  }
  if (!(reference_rate_ > 0) && (coefficient_ > 0 || failure_[3] != 0)) {
    throw Error(CLEAVE_BAD_ARGUMENT, text(coefficient_ > 0 ? "C" : "D4",
                                          " is given without eps_dot_0; give the reference rate, "
                                          "usually 1 per second, in the units of the deck"));
  }
  if (!fails_ && (failure_[2] != 0 || failure_[3] != 0 || failure_[4] != 0)) {
    throw Error(CLEAVE_BAD_ARGUMENT,
                "D3, D4 or D5 is given but D1 and D2 are 0, a failure strain of 0; give D1 or D2, "
                "or leave all five out for no failure");
  }
  if (melt > 0) inverse_melt_ = 1 / (melt - room);
  if (heat > 0) heating_ = p[9] / (density * heat);
}

}  // namespace cleave
