// The cubic spline kernel of smoothed particle hydrodynamics, in one to three dimensions.  [SPH 27]
//
// q = |X|/r with the kernel radius r; the support is 2 r. Only the function of a distance; how it
// weighs gradients is in formulation/meshless.
#pragma once

#include <cmath>
#include <numbers>

namespace cleave::tlsph {

// w(q) without its constant.
constexpr double spline_shape(double q) {
  if (q >= 2) return 0;
  if (q <= 1) return 1 + q * q * (0.75 * q - 1.5);
  return 0.25 * (2 - q) * (2 - q) * (2 - q);
}

// dw/dq without the constant.
constexpr double spline_slope(double q) {
  if (q >= 2) return 0;
  if (q <= 1) return q * (2.25 * q - 3);
  return -0.75 * (2 - q) * (2 - q);
}

class CubicSpline {
 public:
  static constexpr double kSupport = 2;  // in kernel radii

  CubicSpline(int dimension, double radius)
      : radius_(radius), constant_(normalisation(dimension, radius)) {}

  double radius() const { return radius_; }
  double value(double distance) const { return constant_ * spline_shape(distance / radius_); }
  // dw/d|X| = w'(q)/r
  double slope(double distance) const {
    return constant_ * spline_slope(distance / radius_) / radius_;
  }

 private:
  static double normalisation(int dimension, double r) {
    if (dimension == 1) return 2 / (3 * r);
    if (dimension == 2) return 10 / (7 * std::numbers::pi * r * r);
    return 1 / (std::numbers::pi * r * r * r);
  }
  double radius_, constant_;  // [m], [m-d]
};

}  // namespace cleave::tlsph
