// Plane stress of a law that is known in three dimensions: the stretch F33 for which P33 vanishes, by
// Newton with the law's own derivative and step halving. One point at a time.
#pragma once

#include <algorithm>
#include <cmath>

#include "core/tangent.hpp"

namespace cleave {

// Relative to the largest component of H: what round-off leaves of a Newton step.
inline constexpr double kThicknessStep = 2e-15, kThicknessStall = 1e-10;
inline constexpr int kThicknessIterations = 60;

struct ThicknessTrial {
  bool valid = false;
  double p33 = 0;    // [Pa]
  double slope = 0;  // dP33/dF33 [Pa], at fixed history before the step
};

// Changes h33 = F33 - 1, given as a first guess, until trial(h33) has P33 = 0. `size`: largest
// component of the in-plane H and of what else makes P33. False if there is no answer.
template <class Trial>
bool solve_thickness(const Trial& trial, double size, double& h33) {
  ThicknessTrial at = trial(h33);
  if (!at.valid) {  // the guess belongs to another state
    h33 = 0;
    at = trial(h33);
  }
  if (!at.valid) return false;
  for (int n = 0; n < kThicknessIterations; ++n) {
    if (at.p33 == 0) return true;
    if (!(at.slope > 0)) return false;
    double step = -at.p33 / at.slope;
    const double scale = std::max(size, std::fabs(h33));
    if (std::fabs(step) <= kThicknessStep * scale) return true;
    const bool last_digits = std::fabs(step) <= kThicknessStall * scale;
    ThicknessTrial next;
    bool better = false;
    for (int halving = 0; halving < 30 && !better; ++halving) {
      next = trial(h33 + step);
      better = next.valid && std::fabs(next.p33) < std::fabs(at.p33);
      if (!better && last_digits) return true;
      if (!better) step *= 0.5;
    }
    if (!better) return false;
    h33 += step;
    at = next;
  }
  return false;
}

// dP/dF in the plane with P33 = 0 kept.
inline void condense(const Tangent<3>& solid, Tangent<2>& plane) {
  for (int i = 0; i < 2; ++i)
    for (int j = 0; j < 2; ++j)
      for (int k = 0; k < 2; ++k)
        for (int l = 0; l < 2; ++l)
          plane(i, j, k, l) =
              solid(i, j, k, l) - solid(i, j, 2, 2) * solid(2, 2, k, l) / solid(2, 2, 2, 2);
}

// The in-plane part: plane strain.
inline void restrict_to_plane(const Tangent<3>& solid, Tangent<2>& plane) {
  for (int i = 0; i < 2; ++i)
    for (int j = 0; j < 2; ++j)
      for (int k = 0; k < 2; ++k)
        for (int l = 0; l < 2; ++l) plane(i, j, k, l) = solid(i, j, k, l);
}

}  // namespace cleave
