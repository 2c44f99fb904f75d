// The elements of the reference solutions: triangles of three and six nodes, tetrahedra of four.
// Shape-function gradients and quadrature in natural coordinates; positive volumes for any
// orientation of the nodes.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>

#include "core/tensor.hpp"

namespace cleave::fem {

// Derivatives of the shape functions at one quadrature point, and its weight; the weights sum to
// the volume of the natural element (1/2 or 1/6).
template <int D, int N>
struct Quadrature {
  double weight;
  std::array<Vec<D>, N> derivative;
};

// Linear simplices: one point.
template <int D>
struct Linear {
  static constexpr int kDimension = D, kNodes = D + 1, kPoints = 1;
  static std::array<Quadrature<D, kNodes>, kPoints> quadrature() {
    Quadrature<D, kNodes> q{D == 2 ? 1.0 / 2 : 1.0 / 6, {}};
    for (int k = 0; k < D; ++k) {
      q.derivative[0][k] = -1;
      q.derivative[static_cast<std::size_t>(k + 1)][k] = 1;
    }
    return {q};
  }
  // Share of a node in the lumped mass of the element.
  static double mass_share(int) { return 1.0 / kNodes; }
};

// Six-node triangle: corners 1 2 3, middles of 12, 23, 31; three points, exact for quadratics.
struct Triangle6 {
  static constexpr int kDimension = 2, kNodes = 6, kPoints = 3;
  static std::array<Quadrature<2, kNodes>, kPoints> quadrature() {
    std::array<Quadrature<2, kNodes>, kPoints> all{};
    constexpr double place[3][2] = {{1.0 / 6, 1.0 / 6}, {2.0 / 3, 1.0 / 6}, {1.0 / 6, 2.0 / 3}};
    constexpr double slope[3][2] = {{-1, -1}, {1, 0}, {0, 1}};  // of the area coordinates L1 L2 L3
    for (std::size_t q = 0; q < 3; ++q) {
      const double area[3] = {1 - place[q][0] - place[q][1], place[q][0], place[q][1]};
      all[q].weight = 1.0 / 6;
      for (std::size_t a = 0; a < 3; ++a) {
        const std::size_t b = (a + 1) % 3;
        for (int k = 0; k < 2; ++k) {
          all[q].derivative[a][k] = (4 * area[a] - 1) * slope[a][k];  // N = L (2 L - 1)
          all[q].derivative[3 + a][k] =                               // N = 4 La Lb
              4 * (slope[a][k] * area[b] + area[a] * slope[b][k]);
        }
      }
    }
    return all;
  }
  // In proportion to the integral of N^2: 1/30 at corners, 8/45 at middles. Row sums would leave
  // the corners without mass.
  static double mass_share(int node) { return node < 3 ? 1.0 / 19 : 16.0 / 57; }
};

// Volume and shape-function gradients grad_X N_a at one quadrature point of one element.
template <int D, int N>
struct PointGeometry {
  double volume;  // > 0 unless the element is degenerate there
  std::array<Vec<D>, N> gradient;
};

template <int D, int N, class Index>
PointGeometry<D, N> point_geometry(const Quadrature<D, N>& q, const double* X, const Index* nodes) {
  Mat<D> jacobian;  // dX_i / dxi_j, from edges
  for (std::size_t a = 1; a < N; ++a)
    add_dyad(jacobian, difference<D>(X, nodes[0], nodes[a]), q.derivative[a]);
  const double det = determinant(jacobian);
  PointGeometry<D, N> g{q.weight * std::fabs(det), {}};
  if (det == 0) return g;
  const Mat<D> inverse_transposed = cofactor(jacobian);
  for (std::size_t a = 0; a < N; ++a) {
    g.gradient[a] = multiply(inverse_transposed, q.derivative[a]);
    for (int k = 0; k < D; ++k) g.gradient[a][k] /= det;
  }
  return g;
}

}  // namespace cleave::fem
