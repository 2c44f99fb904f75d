// exp, expm1 and log1p against long double, and the same bits in every lane.
#include "core/elementary.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "support/meshes.hpp"

namespace cleave::test {
namespace {

double ulps(double value, long double exact) {
  const double near = static_cast<double>(exact);
  const double unit =
      std::nextafter(std::fabs(near), std::numeric_limits<double>::infinity()) - std::fabs(near);
  return static_cast<double>(std::fabs(static_cast<long double>(value) - exact)) / unit;
}

TEST(Elementary, IsWithinTwoUnitsOfTheLastPlace) {
  Random random(61);
  double of_exp = 0, of_expm1 = 0, of_log = 0;
  for (int n = 0; n < 100000; ++n) {
    const double small = std::pow(10.0, -12 * std::fabs(random())) * random();
    const double x = n % 3 == 0 ? 600 * small : small;
    of_exp = std::fmax(of_exp, ulps(exponential(x), std::exp(static_cast<long double>(x))));
    if (x > -49) {
      of_expm1 = std::fmax(of_expm1,
                           ulps(exponential_minus_one(x), std::expm1(static_cast<long double>(x))));
    }
    double y = small;
    if (n % 2 == 1) y = std::pow(10.0, 8 * random());
    if (n % 7 == 0) y = -1 + std::pow(10.0, -15 * std::fabs(random()));
    if (y > -1)
      of_log = std::fmax(of_log, ulps(log_one_plus(y), std::log1p(static_cast<long double>(y))));
  }
  EXPECT_LT(of_exp, 1.5);    // measured 0.96
  EXPECT_LT(of_expm1, 2.5);  // measured 2.0
  EXPECT_LT(of_log, 1.5);    // measured 0.86
  EXPECT_EQ(exponential_minus_one(0.0), 0);
  EXPECT_EQ(log_one_plus(0.0), 0);
  EXPECT_EQ(exponential(0.0), 1);
  EXPECT_EQ(exponential_minus_one(-1e9), -1);
}

TEST(Elementary, PowersAreExpOfLog) {
  Random random(63);
  double of_log = 0, of_power = 0;
  for (int n = 0; n < 100000; ++n) {
    const double x = std::pow(10.0, (n % 2 == 0 ? 300.0 : 1.0) * random());
    of_log = std::fmax(of_log, ulps(logarithm(x), std::log(static_cast<long double>(x))));
    const double a = std::fabs(random()) * (n % 3 == 0 ? 1 : 2), size = a * std::fabs(std::log(x));
    if (size > 600 || !(a > 0)) continue;
    of_power = std::fmax(of_power, ulps(power(x, a), std::pow(static_cast<long double>(x),
                                                              static_cast<long double>(a))) /
                                       (2 + size));
  }
  EXPECT_LT(of_log, 1.5);    // measured 0.88
  EXPECT_LT(of_power, 2.5);  // measured 1.8
  EXPECT_EQ(logarithm(1.0), 0);
  EXPECT_EQ(power(1.0, 0.3), 1);
  EXPECT_EQ(power(0.0, 0.3), 0);
  EXPECT_EQ(power(1e-310, 0.3), 0);
}

template <int W>
void compare_lanes() {
  Random random(62);
  using P = Pack<W>;
  for (int n = 0; n < 5000; ++n) {
    double x[W];
    P all;
    for (int l = 0; l < W; ++l) {
      x[l] = std::pow(10.0, 8 * random()) * random();
      if (n % 5 == 0) x[l] = 0.2 * random();
      if (n % 11 == l) x[l] = l % 2 == 0 ? 0.0 : -0.0;
      set_lane(all, l, x[l]);
    }
    const P e = exponential(all), m = exponential_minus_one(all), s = square_root(absolute(all)),
            g = log_one_plus(absolute(all)), k = nearest_integer(all);
    const P o = logarithm(absolute(all) + 1e-9), w = power(absolute(all), 0.3);
    const auto finite = is_finite(all / absolute(all + 1e-300));
    for (int l = 0; l < W; ++l) {
      EXPECT_EQ(lane(e, l), exponential(x[l]));
      EXPECT_EQ(lane(m, l), exponential_minus_one(x[l]));
      EXPECT_EQ(std::signbit(lane(m, l)), std::signbit(exponential_minus_one(x[l])));
      EXPECT_EQ(lane(s, l), std::sqrt(std::fabs(x[l])));
      EXPECT_EQ(lane(g, l), log_one_plus(std::fabs(x[l])));
      EXPECT_EQ(lane(k, l), std::nearbyint(x[l]));
      EXPECT_EQ(lane(o, l), logarithm(std::fabs(x[l]) + 1e-9));
      EXPECT_EQ(lane(w, l), power(std::fabs(x[l]), 0.3));
      EXPECT_TRUE(lane(finite, l));
    }
  }
}

TEST(Lanes, HaveTheBitsOfDouble) {
  compare_lanes<2>();
  compare_lanes<4>();
  compare_lanes<8>();
}

TEST(Lanes, CompareAndSelectLaneByLane) {
  Random random(63);
  using P = Pack<4>;
  const double inf = std::numeric_limits<double>::infinity();
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (int n = 0; n < 200; ++n) {
    double x[4], y[4];
    P a, b;
    for (int l = 0; l < 4; ++l) {
      x[l] = random();
      y[l] = (n + l) % 3 == 0 ? x[l] : random();
      set_lane(a, l, x[l]);
      set_lane(b, l, y[l]);
    }
    const P less = select(a < b, a, b), both = select((a <= b) & !(a < b), P(1.0), -a);
    int below = 0;
    for (int l = 0; l < 4; ++l) {
      below += x[l] < y[l];
      EXPECT_EQ(lane(less, l), x[l] < y[l] ? x[l] : y[l]);
      EXPECT_EQ(lane(both, l), x[l] == y[l] ? 1.0 : -x[l]);
    }
    EXPECT_EQ(any(a < b), below > 0);
    EXPECT_EQ(all(a < b), below == 4);
    EXPECT_EQ(any((a > b) | (a < b)), !all((a <= b) & (a >= b)));
  }
  P odd(0.0);
  set_lane(odd, 1, nan);
  set_lane(odd, 2, -inf);
  const auto finite = is_finite(odd);
  for (int l = 0; l < 4; ++l) EXPECT_EQ(lane(finite, l), l == 0 || l == 3);
  EXPECT_FALSE(is_finite(nan) || is_finite(inf));
  EXPECT_TRUE(is_finite(1e308));
  EXPECT_TRUE(std::signbit(lane(P(-0.0), 3)));
}

}  // namespace
}  // namespace cleave::test
