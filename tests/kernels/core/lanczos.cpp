// Largest eigenvalues against closed forms.
#include "core/lanczos.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>
#include <vector>

namespace cleave::test {
namespace {

// A chain of equal masses and springs, ends free: omega^2 = 4 k/m sin^2(pi j / 2n), j < n.
TEST(Lanczos, FindsTheLargestFrequencyOfAChain) {
  constexpr std::size_t n = 12;
  const double k = 7e9, m = 3e-4;
  const std::vector<double> mass(n, m);
  const auto chain = [&](std::span<const double> u, std::span<double> out) {
    for (std::size_t i = 0; i < n; ++i) {
      out[i] = 0;
      if (i > 0) out[i] += k / m * (u[i] - u[i - 1]);
      if (i + 1 < n) out[i] += k / m * (u[i] - u[i + 1]);
    }
  };
  const double s = std::sin(0.5 * std::numbers::pi * (n - 1) / n);
  const double exact = 4 * k / m * s * s;
  // As many steps as unknowns, and more than there is something left to find.
  EXPECT_NEAR(largest_eigenvalue(mass, chain, n), exact, 1e-12 * exact);  // measured 2e-16
  EXPECT_NEAR(largest_eigenvalue(mass, chain, 40), exact, 1e-12 * exact);
  const double few = largest_eigenvalue(mass, chain, 5);
  EXPECT_LT(few, exact);
  EXPECT_GT(few, 0.8 * exact);
}

TEST(Lanczos, LeavesOutUnknownsWithoutMass) {
  const std::vector<double> mass = {1, 0, 2};
  const auto coupled = [](std::span<const double> u, std::span<double> out) {
    out[0] = 3 * u[0] + 10 * u[1];
    out[1] = 100 * u[1] + 10 * u[0];
    out[2] = 5 * u[2];
  };
  EXPECT_NEAR(largest_eigenvalue(mass, coupled, 10), 5, 1e-13);
}

TEST(Lanczos, TridiagonalByHand) {
  const std::array<double, 2> diagonal = {1, 4};
  const std::array<double, 1> square = {4};
  EXPECT_NEAR(largest_of_tridiagonal(diagonal, square), 5, 1e-14);  // eigenvalues 0 and 5
  const std::array<double, 1> one = {-3};
  EXPECT_NEAR(largest_of_tridiagonal(one, {}), -3, 1e-14);
}

}  // namespace
}  // namespace cleave::test
