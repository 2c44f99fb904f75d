#include "core/lanczos.hpp"

#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

namespace cleave {

namespace {

// Entries in (-1, 1), the same on every machine.
void fill_random(std::vector<double>& v) {
  std::uint64_t state = 0x9e3779b97f4a7c15ull;
  for (double& x : v) {
    state = state * 6364136223846793005ull + 1442695040888963407ull;
    x = static_cast<double>(static_cast<std::int64_t>(state >> 11) - (std::int64_t{1} << 52)) *
        0x1p-52;
  }
}

double inner(std::span<const double> mass, const std::vector<double>& a,
             const std::vector<double>& b) {
  double sum = 0;
  for (std::size_t k = 0; k < mass.size(); ++k) sum += mass[k] * a[k] * b[k];
  return sum;
}

// True if the tridiagonal matrix minus `shift` is negative definite.
bool all_below(std::span<const double> diagonal, std::span<const double> square, double shift) {
  double pivot = 0;
  for (std::size_t k = 0; k < diagonal.size(); ++k) {
    pivot = shift - diagonal[k] - (k == 0 ? 0.0 : square[k - 1] / pivot);
    if (!(pivot > 0)) return false;
  }
  return true;
}

}  // namespace

double largest_of_tridiagonal(std::span<const double> diagonal, std::span<const double> square) {
  const auto beside = [&](std::size_t k) { return k < square.size() ? std::sqrt(square[k]) : 0.0; };
  double low = -std::numeric_limits<double>::max(), high = low;
  for (std::size_t k = 0; k < diagonal.size(); ++k) {
    low = std::fmax(low, diagonal[k]);
    high = std::fmax(high, diagonal[k] + beside(k) + (k == 0 ? 0.0 : beside(k - 1)));
  }
  for (int halving = 0; halving < 60; ++halving) {
    const double middle = low + 0.5 * (high - low);
    (all_below(diagonal, square, middle) ? high : low) = middle;
  }
  return high;
}

double largest_eigenvalue(std::span<const double> mass, const Product& multiply, int steps) {
  std::vector<double> now(mass.size()), before(mass.size(), 0.0), next(mass.size());
  fill_random(now);
  const auto leave_out = [mass](std::vector<double>& v) {
    for (std::size_t k = 0; k < mass.size(); ++k) {
      if (!(mass[k] > 0)) v[k] = 0;
    }
  };
  leave_out(now);
  std::vector<double> diagonal, square;
  double size = std::sqrt(inner(mass, now, now)), largest = 0;
  for (int step = 0; step < steps && size > 0; ++step) {
    for (double& x : now) x /= size;
    multiply(now, next);
    leave_out(next);
    const double alpha = inner(mass, next, now);
    const double beta = step == 0 ? 0.0 : size;
    for (std::size_t k = 0; k < mass.size(); ++k) next[k] -= alpha * now[k] + beta * before[k];
    diagonal.push_back(alpha);
    if (step > 0) square.push_back(beta * beta);
    largest = std::fmax(largest, std::fabs(alpha));
    size = std::sqrt(inner(mass, next, next));
    // Nothing left but rounding: the vectors so far span what the start vector can reach.
    if (!(size > 1e-12 * largest)) break;
    before.swap(now);
    now.swap(next);
  }
  return diagonal.empty() ? 0.0 : largest_of_tridiagonal(diagonal, square);
}

}  // namespace cleave
