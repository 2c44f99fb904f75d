// The largest eigenvalue of M^-1 K for a diagonal M and a symmetric K that is known by its products
// only: what limits the step of explicit integration. A few Lanczos steps; not an eigen-solver.
#pragma once

#include <functional>
#include <span>

namespace cleave {

// [out] the second argument: M^-1 K times the first
using Product = std::function<void(std::span<const double>, std::span<double>)>;

// An estimate from below. [in] mass: M, one entry for each unknown, zero for those left out
double largest_eigenvalue(std::span<const double> mass, const Product& multiply, int steps);

// Largest eigenvalue of the symmetric tridiagonal matrix with this diagonal and the squares of the
// entries beside it (one fewer).
double largest_of_tridiagonal(std::span<const double> diagonal, std::span<const double> square);

}  // namespace cleave
