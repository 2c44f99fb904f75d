// Geometry of one simplex, and which simplices meet at a particle.
#pragma once

#include <cstdint>
#include <vector>

#include "core/error.hpp"
#include "core/tensor.hpp"

namespace cleave {

template <int D>
struct SimplexGeometry {
  double volume;           // > 0 whatever the orientation
  Vec<D> gradient[D + 1];  // grad_X N_a; sum over a is zero
};

// X_a - X_0 in columns.
template <int D, class Index>
Mat<D> simplex_edges(const double* X, const Index* nodes) {
  Mat<D> edges;
  for (int a = 0; a < D; ++a) {
    const Vec<D> e = difference<D>(X, nodes[0], nodes[a + 1]);
    for (int k = 0; k < D; ++k) edges(k, a) = e[k];
  }
  return edges;
}

template <int D>
double volume_of_edges(double det) {
  return (det < 0 ? -det : det) / (D == 2 ? 2.0 : 6.0);
}

template <int D, class Index>
double simplex_volume(const double* X, const Index* nodes) {
  return volume_of_edges<D>(determinant(simplex_edges<D>(X, nodes)));
}

// [CBM 4-7]: constant gradients of the linear shape functions. Nodes may be in any orientation; the
// gradients do not depend on it. Volume zero: gradients are not finite; check with is_degenerate.
template <int D, class Index>
SimplexGeometry<D> simplex_geometry(const double* X, const Index* nodes) {
  const Mat<D> edges = simplex_edges<D>(X, nodes);
  const double det = determinant(edges);
  const Mat<D> cof = cofactor(edges);  // det * edges^-T: column a is det * gradient of node a+1
  SimplexGeometry<D> s;
  s.volume = volume_of_edges<D>(det);
  const double inverse = 1 / det;
  for (int k = 0; k < D; ++k) {
    double sum = 0;
    for (int a = 0; a < D; ++a) {
      s.gradient[a + 1][k] = cof(k, a) * inverse;
      sum += s.gradient[a + 1][k];
    }
    s.gradient[0][k] = -sum;
  }
  return s;
}

// Volume below 1e-12 of that of a cube on the longest edge: beyond that the gradients have no
// digits left.
inline constexpr double kDegenerate = 1e-12;
template <int D, class Index>
bool is_degenerate(const double* X, const Index* nodes) {
  double longest = 0;
  for (int a = 0; a <= D; ++a)
    for (int b = 0; b < a; ++b) {
      const Vec<D> e = difference<D>(X, nodes[a], nodes[b]);
      longest = std::fmax(longest, dot(e, e));
    }
  const double volume = std::fabs(determinant(simplex_edges<D>(X, nodes)));
  return !(volume > kDegenerate * std::pow(longest, 0.5 * D));
}

// Compressed lists: simplices of every particle, in ascending order.
struct Incidence {
  std::vector<std::int64_t> begin;    // (n+1)
  std::vector<std::int32_t> simplex;  // (m (D+1))
};

// [in] simplices (stride,m), the first `corners` of each are particles, counted from 0
// [in] base: what the caller counts from, for messages
template <class Index>
Incidence make_incidence(std::int64_t particles, std::int64_t count, const Index* simplices,
                         int corners, int stride, std::int64_t base = 0) {
  Incidence in;
  in.begin.assign(static_cast<std::size_t>(particles) + 1, 0);
  for (std::int64_t s = 0; s < count; ++s) {
    for (int a = 0; a < corners; ++a) {
      const auto i = static_cast<std::int64_t>(simplices[stride * s + a]);
      if (i < 0 || i >= particles) {
        throw Error(CLEAVE_BAD_SIMPLEX,
                    text("simplex ", s + base, " refers to particle ", i + base, "; particles are ",
                         base, " to ", particles - 1 + base));
      }
      ++in.begin[static_cast<std::size_t>(i + 1)];
    }
  }
  for (std::size_t i = 1; i < in.begin.size(); ++i) in.begin[i] += in.begin[i - 1];
  in.simplex.resize(static_cast<std::size_t>(count * corners));
  std::vector<std::int64_t> next(in.begin.begin(), in.begin.end() - 1);
  for (std::int64_t s = 0; s < count; ++s) {
    for (int a = 0; a < corners; ++a) {
      const auto i = static_cast<std::size_t>(simplices[stride * s + a]);
      in.simplex[static_cast<std::size_t>(next[i]++)] = static_cast<std::int32_t>(s);
    }
  }
  return in;
}

}  // namespace cleave
