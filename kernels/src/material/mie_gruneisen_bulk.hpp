// Pressure of a shocked solid or fluid: equation of state of Mie and Grueneisen on a linear shock
// Hugoniot Us = c0 + s up, with internal energy and shock viscosity. For one phase: no melting, no
// gas; rho Gamma = rho0 Gamma0.
//
//   p = A + Gamma0 E ,  eta = 1 - J ,  E: energy per reference volume                       [MG 1]
//   A = rho0 c0^2 eta (1 - Gamma0 eta/2)/(1 - s eta)^2, in expansion rho0 c0^2 eta
//   E1 = E0 - (p0+q0+p1+q1)/2 (J1-J0) + deviatoric work, solved exactly                       [MG 2]
//   q = rho l (Q1^2 l d^2 + Q2 c0 |d|) ,  d = ln(J1/J0)/dt < 0                                [MG 3]
//
// All of the work becomes E. E is split into what is stored and what has been dissipated (plastic work
// and q), so that stored and dissipated energies add up to E, whatever part of it heats.
#pragma once

#include <cmath>

#include "material/log_strain_plasticity.hpp"
#include "material/point_history.hpp"

namespace cleave {

// The properties, in the order of the class below.
struct ShockProperties {
  double density, sound_speed, slope, gruneisen, least_pressure, quadratic, linear;
};
constexpr ParameterSpec density_parameter() {
  return required_parameter("rho", "kg m-3", kPositive,
                            "mass density in the reference configuration");
}
inline constexpr std::array kShockParameters = {
    density_parameter(),
    required_parameter(
        "c0", "m s-1", kPositive,
        "speed of weak shocks: bulk sound speed at rest; rho c0^2 is the bulk modulus", "[MG 1]"),
    required_parameter("s", "1", kNotNegative, "slope of the shock speed over the particle speed",
                       "[MG 1]"),
    real_parameter("Gamma0", "1", kNotNegative, 0.0, "Grueneisen coefficient", "[MG 1]"),
    real_parameter("p_min", "Pa", Range{-kUnbounded, 0.0, false, false}, -1e30,
                   "least pressure: tension beyond it is cut off; the default is never reached",
                   "[MG 4]"),
    real_parameter("Q1", "1", kNotNegative, 1.5, "shock viscosity, quadratic", "[MG 3]"),
    real_parameter("Q2", "1", kNotNegative, 0.06, "shock viscosity, linear", "[MG 3]"),
};

class MieGruneisenBulk {
 public:
  static constexpr bool kBounded = true, kFollowsVolume = false, kStiffens = true;
  static constexpr bool kUsesLength = true;
  static constexpr std::array kMemory = {
      point_history("internal_energy", 1, "J m-3", true,
                    "internal energy per reference volume, without what the shear stores"),
      point_history("dissipated_energy", 1, "J m-3", false,
                    "plastic work and work of the shock viscosity in it"),
      point_history("eos_pressure", 1, "Pa", false, "pressure without shock viscosity"),
      point_history("shock_pressure", 1, "Pa", true, "shock viscosity q"),
      point_history("volume_change", 1, "1", false, "J - 1 of the last update"),
  };
  enum Memory : std::size_t { kEnergy, kDissipated, kPressure, kShock, kChange };

  explicit MieGruneisenBulk(const ShockProperties& p)
      : property_(p), modulus_(p.density * p.sound_speed * p.sound_speed) {}

  double modulus() const { return modulus_; }

  // Whether there is an answer: eta below 0.99/s, and a step that [MG 2] can do.
  template <class R, class M>
  MaskOf<R> admits(const Volume<R>& v, const M& memory) const {
    const R eta = R(0.0) - v.change;
    return (property_.slope * eta < kLargestEta) & (memory[kChange] > -1.0) &
           (denominator(v, memory) > kLeastDenominator);
  }

  template <class R, class M>
  Spherical<R> respond(const Volume<R>& given, M& memory, const Setting<R>& setting) const {
    const MaskOf<R> ok = admits(given, memory);
    Volume<R> v = given;  // without lanes that would trap
    v.change = select(ok, given.change, R(0.0));
    const R ratio = select(ok, given.ratio, R(1.0));
    const R step = select(ok, given.change - memory[kChange], R(0.0));
    const R q = viscosity(step, ratio, setting);
    const R before = memory[kPressure] + memory[kShock];
    // Without p1: what is left of the energy equation.
    const R energy = (memory[kEnergy] - 0.5 * ((before + q) * step)) + v.plastic;
    const R gamma(property_.gruneisen);
    const R cold = cold_pressure(v.change);
    // The energy of the shear heats too.
    const R free =
        (cold + gamma * (energy + v.shear_energy)) / select(ok, denominator(v, memory), R(1.0));
    const R least = select(v.failed, R(0.0), R(property_.least_pressure));
    const R pressure = larger(free, least);
    const R stored_and_lost = energy - 0.5 * (pressure * step);

    Spherical<R> out;
    out.viscous = R(0.0) - 0.5 * ((memory[kShock] + q) * step);
    R lost = (memory[kDissipated] + v.plastic) + out.viscous;
    // Torn apart: what the tension had stored is lost.
    const R remains = stored_and_lost - lost;
    out.released = select(v.failed & (pressure > free), remains, R(0.0));
    lost = lost + out.released;
    out.energy = stored_and_lost - lost;
    out.stress = R(0.0) - ratio * (pressure + q);
    memory[kEnergy] = stored_and_lost;
    memory[kDissipated] = lost;
    memory[kPressure] = pressure;
    memory[kShock] = q;
    memory[kChange] = v.change;
    return out;
  }

  // d tau_m / d ln J of the step, with the work of the deviator held.
  template <class M>
  double modulus(const Volume<double>& v, const M& memory, const Setting<double>& setting) const;

  // c^2 = J^2 (dp/deta + Gamma0 p)/rho0 + (4/3) G/rho0, and the viscosity as it limits an explicit
  // step: sqrt(c^2 + Qc^2) + Qc with Qc = Q1^2 l |d| + Q2 c. `shear`: 4 G/3.
  template <class M>
  double wave_speed_ratio(const M& memory, double shear) const {
    const double j = 1 + memory[kChange], rho = property_.density;
    const double bulk = cold_slope(memory[kChange]) + property_.gruneisen * memory[kPressure];
    const double c = std::sqrt(std::fmax(0.0, j * j * bulk) / rho + shear / rho);
    const double l = property_.linear * property_.sound_speed,
                 q2 = property_.quadratic * property_.quadratic;
    // Q1^2 l |d| from q = rho0/J (Q1^2 (l d)^2 + Q2 c0 l |d|)
    const double quadratic =
        0.5 * (std::sqrt(l * l + 4 * q2 * std::fmax(0.0, memory[kShock]) * j / rho) - l);
    const double qc = quadratic + property_.linear * c;
    return (std::sqrt(c * c + qc * qc) + qc) / std::sqrt((modulus_ + shear) / rho);
  }

  // dA/deta
  double cold_slope(double change) const {
    const double eta = -change, g = property_.gruneisen, s = property_.slope;
    if (!(eta >= 0)) return modulus_;
    const double left = 1 - s * eta, square = left * left;
    return modulus_ *
           ((1 + s * eta) / (square * left) * (1 - 0.5 * g * eta) - 0.5 * g * eta / square);
  }

 private:
  static constexpr double kLargestEta = 0.99;        // of s eta
  static constexpr double kLeastDenominator = 0.05;  // a step of the volume by 1.9/Gamma0

  template <class R, class M>
  R denominator(const Volume<R>& v, const M& memory) const {
    return 1.0 + (0.5 * property_.gruneisen) * (v.change - memory[kChange]);
  }
  template <class R>
  R cold_pressure(const R& change) const {
    const R eta = R(0.0) - change, left = 1.0 - property_.slope * larger(eta, R(0.0));
    const R compressed = (1.0 - (0.5 * property_.gruneisen) * eta) / (left * left);
    return modulus_ * (eta * select(eta > 0.0, compressed, R(1.0)));
  }
  // [MG 3]; 0 in expansion and without a size of the step
  template <class R>
  R viscosity(const R& step, const R& ratio, const Setting<R>& setting) const {
    if (!(setting.dt > 0)) return R(0.0);
    const MaskOf<R> shrinks = step < 0.0;
    const R rate =
        log_one_plus(select(shrinks, step, R(0.0)) / (ratio - select(shrinks, step, R(0.0)))) /
        setting.dt;
    const R speed = absolute(setting.length * rate);
    const R factor = (property_.quadratic * property_.quadratic) * speed +
                     property_.linear * property_.sound_speed;
    return (property_.density / ratio) * (speed * factor);
  }

  ShockProperties property_;
  double modulus_;  // rho0 c0^2
};

template <class M>
double MieGruneisenBulk::modulus(const Volume<double>& v, const M& memory,
                                 const Setting<double>& setting) const {
  M after = memory;
  const double stress = respond(v, after, setting).stress;
  const double pressure = after[kPressure], q = after[kShock];
  const double least = v.failed ? 0.0 : property_.least_pressure;
  double slope = 0;  // -dp/dJ
  if (pressure > least) {
    slope = (cold_slope(v.change) +
             property_.gruneisen * 0.5 * (memory[kPressure] + memory[kShock] + q + pressure)) /
            denominator(v, memory);
  }
  const double step = v.change - memory[kChange];
  if (step < 0 && setting.dt > 0) {  // dq/dJ at l, with ln(J/J0)
    const double speed =
        setting.length * std::fabs(log_one_plus(step / (v.ratio - step))) / setting.dt;
    const double q1 = property_.quadratic * property_.quadratic;
    slope += q / v.ratio + property_.density / v.ratio *
                               (2 * q1 * speed + property_.linear * property_.sound_speed) *
                               setting.length / (setting.dt * v.ratio);
  }
  return stress + v.ratio * v.ratio * slope;
}

// The elasticity of a solid under shock, for log_strain_law.hpp.
class MieGruneisenElasticity {
 public:
  using Bulk = MieGruneisenBulk;
  static constexpr auto kParameters = joined(
      kShockParameters, std::array{required_parameter("G", "Pa", kPositive, "shear modulus")});

  explicit MieGruneisenElasticity(std::span<const double> p)
      : property_{p[0], p[1], p[2], p[3], p[4], p[5], p[6]}, shear_(p[7]) {}
  double density() const { return property_.density; }
  double youngs_modulus() const {
    return 9 * bulk_modulus() * shear_ / (3 * bulk_modulus() + shear_);
  }
  double shear_modulus() const { return shear_; }
  double bulk_modulus() const { return bulk().modulus(); }
  Bulk bulk() const { return Bulk(property_); }

 private:
  ShockProperties property_;
  double shear_;
};

}  // namespace cleave
