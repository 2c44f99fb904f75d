// ln(I+X) and exp(X)-I: the series against eigenvalues, each the inverse of the other, and the same
// bits whatever the other lanes need.
#include "core/tensor_functions.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>

#include "support/meshes.hpp"

namespace cleave::test {
namespace {

using Tensor = Symmetric<double>;

Tensor random_tensor(Random& random, int kind) {
  Tensor x{random(), random(), random(), random(), random(), random()};
  if (kind == 1) x = {x.xx, x.xx, x.zz, 0, 0, 0};                           // two equal
  if (kind == 2) x = {x.xx, x.xx, x.xx, 0, 0, 0};                           // three equal
  if (kind == 3) x = {x.xx, x.xx * (1 + 1e-12), x.zz, 1e-13 * x.xy, 0, 0};  // nearly
  return x;
}
Tensor deviator(const Tensor& x) { return plus_spherical(x, trace(x) / -3); }
double norm(const Tensor& x) { return std::sqrt(squared_norm(x)); }
double distance(const Tensor& a, const Tensor& b) { return norm(a + scaled(-1.0, b)); }

TEST(Jacobi, IsOrthonormalAndBackwardStableAtEveryGap) {
  Random random(71);
  double orthonormal = 0, backward = 0;
  for (int n = 0; n < 5000; ++n) {
    const Tensor x = random_tensor(random, n % 4);
    const Spectral e = spectral(x);
    for (int a = 0; a < 3; ++a)
      for (int b = 0; b < 3; ++b) {
        double dot = 0;
        for (int i = 0; i < 3; ++i) dot += e.vector[i][a] * e.vector[i][b];
        orthonormal = std::fmax(orthonormal, std::fabs(dot - (a == b ? 1 : 0)));
      }
    backward = std::fmax(backward, distance(assemble(e, e.value), x) / norm(x));
  }
  EXPECT_LT(orthonormal, 3e-15);
  EXPECT_LT(backward, 3e-15);
}

TEST(TensorFunctions, SeriesAndEigenvaluesAgree) {
  Random random(72);
  double of_log = 0, of_exp = 0, there_and_back = 0;
  for (int n = 0; n < 40000; ++n) {
    Tensor x = random_tensor(random, n % 5);
    const double size =
        n % 3 == 0 ? 0.25 * std::fabs(random()) : std::pow(10.0, -1 - 12 * std::fabs(random()));
    x = scaled(size / norm(x), x);
    if (norm(x) >= 0.25) continue;
    Tensor by_values;
    ASSERT_TRUE(log_by_eigenvalues(x, 20, by_values));
    of_log = std::fmax(of_log, distance(log_series(powers_of(x)), by_values) / norm(x));
    if (n % 5 == 2) continue;  // has no deviator
    x = scaled(2.3, deviator(x));
    of_exp = std::fmax(
        of_exp, distance(expm1_series(powers_of_deviator(x)), expm1_by_eigenvalues(x)) / norm(x));
    bool valid = true;
    there_and_back = std::fmax(there_and_back,
                               distance(log_of(expm1_of_deviator(x), 0.0, 20, valid), x) / norm(x));
    EXPECT_TRUE(valid);
  }
  EXPECT_LT(of_log, 4e-15);          // measured 1.9e-15
  EXPECT_LT(of_exp, 4e-15);          // measured 2.2e-15
  EXPECT_LT(there_and_back, 4e-15);  // measured 1.6e-15
}

TEST(TensorFunctions, SplitTheVolumeOffWithoutAChange) {
  Random random(73);
  for (int n = 0; n < 2000; ++n) {
    const Tensor shape = scaled(0.05, random_tensor(random, n % 4));
    const double ratio = std::exp(2 * random());  // det(I+X) near its square
    const double scale = std::pow(ratio, 2.0 / 3);
    const Tensor x = plus_spherical(scaled(scale, shape), scale - 1);
    bool valid = true;
    const Tensor split = log_of(x, ratio - 1, 20, valid);
    Tensor whole;
    ASSERT_TRUE(log_by_eigenvalues(x, 20, whole));
    EXPECT_TRUE(valid);
    EXPECT_LT(distance(split, whole), 4e-15 * (1 + norm(whole)));
  }
}

TEST(TensorFunctions, HaveNoLogarithmOutsideTheirRange) {
  bool valid = true;
  const Tensor none = log_of(Tensor{-1.0, 0, 0, 0, 0, 0}, 0.0, 20, valid);
  EXPECT_FALSE(valid);
  EXPECT_EQ(norm(none), 0);
  valid = true;
  log_of(Tensor{6e8, 0, 0, 0, 0, 0}, 1e4, 20, valid);  // ln b = 20.2
  EXPECT_FALSE(valid);
  valid = true;
  log_of(Tensor{4e8, 0, 0, 0, 0, 0}, 1e4, 20, valid);  // 19.8
  EXPECT_TRUE(valid);
}

template <int W>
void compare_lanes() {
  Random random(74);
  using P = Pack<W>;
  for (int n = 0; n < 4000; ++n) {
    Symmetric<P> x;
    Tensor one[W];
    double change[W];
    P changes;
    for (int l = 0; l < W; ++l) {
      one[l] = scaled(std::pow(10.0, -3 + 3.5 * random()), random_tensor(random, (n + l) % 4));
      change[l] = 0.3 * random();
      set_lane(x, l, one[l]);
      set_lane(changes, l, change[l]);
    }
    MaskOf<P> valid = P(0.0) <= P(0.0);
    const Symmetric<P> log = log_of(x, changes, 20.0, valid),
                       exp = expm1_of_deviator(scaled(P(0.1), x));
    for (int l = 0; l < W; ++l) {
      bool own = true;
      const Tensor log_alone = log_of(one[l], change[l], 20.0, own), log_here = lane(log, l);
      const Tensor exp_alone = expm1_of_deviator(scaled(0.1, one[l])), exp_here = lane(exp, l);
      EXPECT_EQ(std::memcmp(&log_alone, &log_here, sizeof(Tensor)), 0);
      EXPECT_EQ(std::memcmp(&exp_alone, &exp_here, sizeof(Tensor)), 0);
      EXPECT_EQ(own, lane(valid, l));
    }
  }
}

TEST(TensorFunctions, HaveTheBitsOfALoneLane) {
  compare_lanes<2>();
  compare_lanes<4>();
  compare_lanes<8>();
}

}  // namespace
}  // namespace cleave::test
