// The cubic spline against quadrature and differences.
#include "formulation/tlsph/kernel.hpp"

#include <gtest/gtest.h>

namespace cleave::test {
namespace {

using tlsph::CubicSpline;

// Integral over all space by Simpson's rule: exact for the polynomials of both pieces up to rounding.
double integral(const CubicSpline& w, int dimension, int power) {
  constexpr int panels = 2000;
  const double sphere = dimension == 1   ? 2
                        : dimension == 2 ? 2 * std::numbers::pi
                                         : 4 * std::numbers::pi;
  const double step = 2 * w.radius() / panels;
  double sum = 0;
  for (int k = 0; k <= panels; ++k) {
    const double x = k * step, weight = k == 0 || k == panels ? 1 : (k % 2 == 1 ? 4 : 2);
    sum += weight * w.value(x) * std::pow(x, dimension - 1 + power);
  }
  return sphere * sum * step / 3;
}

TEST(CubicSpline, IntegratesToOne) {
  for (const int d : {1, 2, 3})
    for (const double r : {1e-6, 0.55, 40.0})
      EXPECT_NEAR(integral(CubicSpline(d, r), d, 0), 1, 1e-12) << d;  // measured 2e-13
}

// Integral of -w' |X| over d is that of w: the moment matrix of a full neighbourhood is the unit one.
TEST(CubicSpline, SlopeIsTheDerivative) {
  for (const int d : {1, 2, 3}) {
    const CubicSpline w(d, 0.7);
    for (const double x : {0.05, 0.3, 0.69, 0.71, 1.0, 1.35, 1.45}) {
      const double step = 1e-6;
      EXPECT_NEAR(w.slope(x), (w.value(x + step) - w.value(x - step)) / (2 * step),
                  1e-8 * w.value(0) / 0.7);  // measured 6e-11
    }
    EXPECT_EQ(w.slope(0), 0);
  }
}

TEST(CubicSpline, IsContinuousAndEndsAtTwoRadii) {
  const CubicSpline w(2, 3.0);
  for (const double knot : {3.0, 6.0}) {
    const double below = knot * (1 - 1e-15), above = knot * (1 + 1e-15);
    EXPECT_NEAR(w.value(below), w.value(above), 1e-14 * w.value(0));
    EXPECT_NEAR(w.slope(below), w.slope(above), 1e-14 * w.value(0));
  }
  EXPECT_EQ(w.value(6.0), 0);
  EXPECT_EQ(w.slope(7.0), 0);
  EXPECT_DOUBLE_EQ(w.value(0), 10 / (7 * std::numbers::pi * 9));
}

}  // namespace
}  // namespace cleave::test
