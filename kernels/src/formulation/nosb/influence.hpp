// Influence functions of correspondence peridynamics: how much a neighbour counts, by its distance.
//
// s = |X|/delta in the reference configuration, delta the horizon (the support, twice the kernel
// radius). Every function is scaled so that for a full horizon the moment matrix is the unit matrix:
// integral of omega |X|^2 = d, hence [omega] = m-(d+2). The gradient does not depend on the
// scale; the conservative penalty does, and means the same for all functions.     [SPH influence]
#pragma once

#include <cmath>
#include <initializer_list>
#include <numbers>

#include "formulation/tlsph/kernel.hpp"

namespace cleave::nosb {

// In the order of the choices of group kernel, after "default".
enum class Influence { constant, cone, spline, inverse_distance, gaussian, tlsph };

// Those that do not vanish at the horizon count particles at the horizon in.
constexpr bool vanishes_at_horizon(Influence form) {
  return form == Influence::cone || form == Influence::spline || form == Influence::tlsph;
}

// omega without its scale; s > 0.
inline double influence_shape(Influence form, double s) {
  switch (form) {
    case Influence::constant:
      return 1;
    case Influence::cone:
      return s < 1 ? 1 - s : 0.0;
    case Influence::spline:
      return tlsph::spline_shape(2 * s);
    case Influence::inverse_distance:
      return 1 / s;
    case Influence::gaussian:
      return std::exp(-4 * s * s);  // exp(-q^2), q = 2 s
    case Influence::tlsph:
      return -tlsph::spline_slope(2 * s) / s;
  }
  return 0;
}

class InfluenceFunction {
 public:
  InfluenceFunction(Influence form, int dimension, double horizon)
      : form_(form), horizon_(horizon), scale_(1) {
    const double sphere = (dimension == 2 ? 2 : 4) * std::numbers::pi;
    scale_ = dimension / (sphere * moment(form, dimension) * std::pow(horizon, dimension + 2));
  }
  double operator()(double distance) const {
    return scale_ * influence_shape(form_, distance / horizon_);
  }

 private:
  // Integral of shape(s) s^(d+1) over 0..1, by the three-point Gauss rule on panels that meet where
  // the spline's pieces do: exact for the polynomials up to degree 5, 1e-14 for the others.
  static double moment(Influence form, int dimension) {
    constexpr int panels = 64;
    const double width = 1.0 / panels, offset = std::sqrt(0.6);
    double sum = 0;
    for (int k = 0; k < panels; ++k) {
      for (const int side : {-1, 0, 1}) {
        const double s = width * (k + 0.5 * (1 + side * offset));
        sum += (side == 0 ? 8.0 : 5.0) / 18 * width * influence_shape(form, s) *
               std::pow(s, dimension + 1);
      }
    }
    return sum;
  }

  Influence form_;
  double horizon_, scale_;
};

}  // namespace cleave::nosb
