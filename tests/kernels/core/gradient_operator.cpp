// The two sparse products: deformation gradient and internal force, on jittered meshes with and
// without deleted simplices.
#include "core/gradient_operator.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "support/bonds.hpp"

namespace cleave::test {
namespace {

std::size_t at(std::int64_t i) { return static_cast<std::size_t>(i); }

struct Shape {
  int dimension;
  double deleted;  // share of simplices
};
class GradientOperatorOf : public testing::TestWithParam<Shape> {
 protected:
  static Bonds bonds() {
    const auto [d, deleted] = GetParam();
    const SimplexMesh mesh = patch(d, d == 2 ? 9 : 5, 1.0, 0.2, 21);
    return Bonds(mesh, random_deletions(mesh, deleted, 5));
  }
  static std::vector<double> random_tensors(const Bonds& b, unsigned seed) {
    Random random(seed);
    std::vector<double> t(9 * b.volume.size());
    for (double& c : t) c = random();
    return t;
  }
};

// F = A for x = A X + b, also for very large A, on every particle with a live simplex.
TEST_P(GradientOperatorOf, AffineMotionIsExact) {
  const Bonds b = bonds();
  const double A[3][3] = {{0.7, -2.1, 0.4}, {1.3, 0.2, -0.9}, {0.5, 1.1, -1.7}};
  const std::size_t d = at(b.mesh.dimension);
  std::vector<double> u(b.mesh.X.size(), 0.0);
  for (std::size_t i = 0; i < b.volume.size(); ++i)
    for (std::size_t r = 0; r < d; ++r) {
      u[3 * i + r] = 3.0 + static_cast<double>(r);
      for (std::size_t c = 0; c < d; ++c) u[3 * i + r] += A[r][c] * b.mesh.X[3 * i + c];
    }
  const auto H = b.gradient(u);
  int checked = 0;
  for (std::size_t i = 0; i < b.volume.size(); ++i) {
    for (std::size_t r = 0; r < 3; ++r)
      for (std::size_t c = 0; c < 3; ++c) {
        const bool given = r < d && c < d && b.volume[i] > 0;
        EXPECT_NEAR(H[9 * i + r + 3 * c], given ? A[r][c] : 0.0, 1e-13);  // measured 4e-15
      }
    checked += b.volume[i] > 0 ? 1 : 0;
  }
  EXPECT_GT(checked, 50);
}

// F_i is the volume average of the gradients of the live simplices around i.
TEST_P(GradientOperatorOf, IsTheVolumeAverageOfTheSimplices) {
  const Bonds b = bonds();
  const auto u = random_vectors(b.mesh, 0.3, 8);
  const auto H = b.gradient(u);
  std::vector<double> sum(H.size(), 0.0), volume(b.volume.size(), 0.0);
  const int n = b.mesh.dimension + 1;
  for (std::int64_t s = 0; s < b.mesh.simplex_count(); ++s) {
    if (b.alive[at(s)] == 0) continue;
    const ReferenceSimplex L = reference_simplex(b.mesh, s);
    const std::int64_t* corner = &b.mesh.simplices[at(n * s)];
    for (int i = 0; i < n; ++i) {
      volume[at(corner[i])] += L.volume / n;
      for (int a = 0; a < n; ++a)
        for (int r = 0; r < 3; ++r)
          for (int c = 0; c < 3; ++c) {
            sum[at(9 * corner[i] + r + 3 * c)] +=
                L.volume / n * u[at(3 * corner[a] + r)] * L.gradient[at(a)][at(c)];
          }
    }
  }
  for (std::size_t i = 0; i < volume.size(); ++i) {
    EXPECT_NEAR(b.volume[i], volume[i], 1e-14);  // measured 4e-16
    if (volume[i] == 0) continue;
    for (std::size_t k = 0; k < 9; ++k)
      EXPECT_NEAR(H[9 * i + k], sum[9 * i + k] / volume[i], 1e-14);  // measured 3e-16
  }
}

// [CBM 18, 19] bond by bond.
TEST_P(GradientOperatorOf, ForceIsTheSumOverPairs) {
  const Bonds b = bonds();
  const auto P = random_tensors(b, 4), f = b.force(P);
  std::vector<double> g(f.size(), 0.0);
  for (std::int64_t i = 0; i < b.mesh.particles(); ++i)
    for (std::int64_t half = b.row_begin[at(i)]; half < b.row_begin[at(i + 1)]; ++half) {
      const std::int64_t p = b.neighbour[at(half)], back = b.reverse[at(half)];
      for (int r = 0; r < b.mesh.dimension; ++r)
        for (int c = 0; c < b.mesh.dimension; ++c) {
          g[at(3 * i + r)] += P[at(9 * i + r + 3 * c)] * b.zeta[at(3 * half + c)] -
                              P[at(9 * p + r + 3 * c)] * b.zeta[at(3 * back + c)];
        }
    }
  for (std::size_t k = 0; k < f.size(); ++k) EXPECT_NEAR(f[k], g[k], 1e-13);  // measured 7e-16
}

// sum x (x) f = - sum Omega F P^T for the force ON particles and any stress, and no net force.
TEST_P(GradientOperatorOf, Virial) {
  const Bonds b = bonds();
  const auto P = random_tensors(b, 6), f = b.force(P), u = random_vectors(b.mesh, 0.3, 9),
             H = b.gradient(u);
  const std::size_t d = at(b.mesh.dimension);
  for (std::size_t r = 0; r < d; ++r) {
    double total = 0, size = 0;
    for (std::size_t i = 0; i < b.volume.size(); ++i) {
      total += f[3 * i + r];
      size += std::fabs(f[3 * i + r]);
    }
    EXPECT_NEAR(total, 0, 1e-14 * size);  // measured 6e-17
    for (std::size_t c = 0; c < d; ++c) {
      double outer = 0, inner = 0, scale = 0;
      for (std::size_t i = 0; i < b.volume.size(); ++i) {
        outer += (b.mesh.X[3 * i + r] + u[3 * i + r]) * f[3 * i + c];
        scale += std::fabs((b.mesh.X[3 * i + r] + u[3 * i + r]) * f[3 * i + c]);
        for (std::size_t k = 0; k < d; ++k) {
          const double F = H[9 * i + r + 3 * k] + (r == k && b.volume[i] > 0 ? 1.0 : 0.0);
          inner += b.volume[i] * F * P[9 * i + c + 3 * k];
        }
      }
      EXPECT_NEAR(outer, -inner, 1e-14 * scale);  // measured 9e-17
    }
  }
}

// Rows of a range are the rows of the whole, and the rest is left alone.
TEST_P(GradientOperatorOf, RangeTouchesOnlyItsRows) {
  const Bonds b = bonds();
  const auto P = random_tensors(b, 7), whole = b.force(P);
  std::vector<double> f(whole.size(), 0.0);
  const std::int64_t first = 11, last = 37;
  const cleave_network net = b.network();
  ASSERT_EQ(cleave_bond_force(&net, first, last, P.data(), f.data()), CLEAVE_OK);
  for (std::int64_t k = 0; k < static_cast<std::int64_t>(f.size()); ++k) {
    EXPECT_EQ(f[at(k)], k >= 3 * first && k < 3 * last ? whole[at(k)] : 0.0);
  }
}

INSTANTIATE_TEST_SUITE_P(Meshes, GradientOperatorOf,
                         testing::Values(Shape{2, 0.0}, Shape{2, 0.3}, Shape{3, 0.0},
                                         Shape{3, 0.3}),
                         [](const auto& shape) {
                           return std::to_string(shape.param.dimension) +
                                  (shape.param.deleted > 0 ? "d_after_deletions" : "d");
                         });

}  // namespace
}  // namespace cleave::test
