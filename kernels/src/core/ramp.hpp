// Smooth ramps of prescribed motion. s = t/tau; constant after tau; tau = 0 is a jump at t = 0.
#pragma once

namespace cleave {

struct Motion {
  double displacement = 0, velocity = 0, acceleration = 0;
};

// Displacement u*(6 s^5 - 15 s^4 + 10 s^3), at rest at both ends.                       [CBM 26]
constexpr Motion displacement_ramp(double value, double tau, double t) {
  if (t <= 0) return {};
  if (t >= tau) return {value, 0, 0};
  const double s = t / tau;
  return {value * s * s * s * ((6 * s - 15) * s + 10),
          value / tau * s * s * ((30 * s - 60) * s + 30),
          value / (tau * tau) * s * ((120 * s - 180) * s + 60)};
}

// Velocity v*(3 s^2 - 2 s^3), constant afterwards.                                      [CBM 30]
constexpr Motion velocity_ramp(double value, double tau, double t) {
  if (t <= 0) return {};
  if (t >= tau) return {value * (t - 0.5 * tau), value, 0};
  const double s = t / tau;
  return {value * tau * s * s * s * (1 - 0.5 * s), value * s * s * (3 - 2 * s),
          value / tau * 6 * s * (1 - s)};
}

}  // namespace cleave
