// Bond vectors and averaging volumes: the identities of the theory chapter, on jittered meshes with
// and without deleted simplices, against geometry computed another way.
#include "support/bonds.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "support/model.hpp"

namespace cleave::test {
namespace {

std::size_t at(std::int64_t i) { return static_cast<std::size_t>(i); }

struct Shape {
  int dimension;
  double deleted;
};
class BondVectors : public testing::TestWithParam<Shape> {
 protected:
  static Bonds bonds() {
    const auto [d, deleted] = GetParam();
    const SimplexMesh mesh = patch(d, d == 2 ? 12 : 6, 1.0, 0.2, 31);
    return Bonds(mesh, random_deletions(mesh, deleted, 13));
  }
  // f(i, p, half, live) over all half-bonds; live: a live simplex has both ends.
  template <class F>
  static void for_half_bonds(const Bonds& b, const F& f) {
    for (std::int64_t i = 0; i < b.mesh.particles(); ++i)
      for (std::int64_t half = b.row_begin[at(i)]; half < b.row_begin[at(i + 1)]; ++half)
        f(i, b.neighbour[at(half)], half);
  }
};

TEST_P(BondVectors, RowsAreSortedAndReverseIsAnInvolution) {
  const Bonds b = bonds();
  for_half_bonds(b, [&](std::int64_t i, std::int64_t p, std::int64_t half) {
    ASSERT_NE(p, i);
    if (half > b.row_begin[at(i)]) {
      EXPECT_LT(b.neighbour[at(half - 1)], p);
    }
    const std::int64_t back = b.reverse[at(half)];
    EXPECT_EQ(b.neighbour[at(back)], i);
    EXPECT_EQ(b.reverse[at(back)], half);
    EXPECT_TRUE(b.row_begin[at(p)] <= back && back < b.row_begin[at(p + 1)]);
  });
}

// [CBM 4-7] as printed: psi = (Omega_L/n) M^-1 X_ia with M = sum_b X_ib (x) X_ib, corners b of L.
TEST_P(BondVectors, EqualThePublishedFormWithTheMomentMatrix) {
  const Bonds b = bonds();
  const int n = b.mesh.dimension + 1;
  std::map<std::pair<std::int64_t, std::int64_t>, std::array<double, 3>> zeta;
  for (std::int64_t s = 0; s < b.mesh.simplex_count(); ++s) {
    if (b.alive[at(s)] == 0) continue;
    const double volume = reference_simplex(b.mesh, s).volume;
    const std::int64_t* corner = &b.mesh.simplices[at(n * s)];
    const auto X = [&](int i, int a, std::size_t k) {
      return b.mesh.X[3 * at(corner[a]) + k] - b.mesh.X[3 * at(corner[i]) + k];
    };
    for (int i = 0; i < n; ++i) {
      Matrix3 M{};
      if (b.mesh.dimension == 2) M[2][2] = 1;
      for (int a = 0; a < n; ++a)
        for (std::size_t r = 0; r < 3; ++r)
          for (std::size_t c = 0; c < 3; ++c) M[r][c] += X(i, a, r) * X(i, a, c);
      const Matrix3 inv = inverse(M);
      for (int a = 0; a < n; ++a) {
        if (a == i) continue;
        auto& z = zeta[{corner[i], corner[a]}];
        for (std::size_t r = 0; r < 3; ++r)
          for (std::size_t c = 0; c < 3; ++c) z[r] += volume / n * inv[r][c] * X(i, a, c);
      }
    }
  }
  for_half_bonds(b, [&](std::int64_t i, std::int64_t p, std::int64_t half) {
    const auto found = zeta.find({i, p});
    for (std::size_t k = 0; k < 3; ++k) {
      const double expected = found == zeta.end() ? 0.0 : found->second[k];
      EXPECT_NEAR(b.zeta[at(3 * half) + k], expected, 1e-14);  // measured 4e-16
    }
  });
}

TEST_P(BondVectors, ProjectionOnTheBondIsItsShareOfVolume) {
  const Bonds b = bonds();
  const int n = b.mesh.dimension + 1;
  std::map<std::pair<std::int64_t, std::int64_t>, double> share;
  for (std::int64_t s = 0; s < b.mesh.simplex_count(); ++s) {
    if (b.alive[at(s)] == 0) continue;
    const std::int64_t* corner = &b.mesh.simplices[at(n * s)];
    for (int i = 0; i < n; ++i)
      for (int a = 0; a < n; ++a)
        share[{corner[i], corner[a]}] += reference_simplex(b.mesh, s).volume / n;
  }
  const auto w = b.weights();
  std::vector<double> row_sum(b.volume.size(), 0.0);
  for_half_bonds(b, [&](std::int64_t i, std::int64_t p, std::int64_t half) {
    EXPECT_NEAR(w[at(half)], (share[{i, p}]), 1e-14);  // measured 1e-16
    row_sum[at(i)] += w[at(half)];
  });
  for (std::size_t i = 0; i < row_sum.size(); ++i)
    EXPECT_NEAR(row_sum[i], b.mesh.dimension * b.volume[i], 1e-13);  // measured 2e-15
}

TEST_P(BondVectors, InteriorRowsSumToZeroAndInteriorBondsAreAntisymmetric) {
  const Bonds b = bonds();
  const Boundary boundary(b.mesh, b.alive);
  std::vector<double> sum(b.mesh.X.size(), 0.0);
  int inside = 0, outside_differs = 0, bonds_inside = 0;
  for_half_bonds(b, [&](std::int64_t i, std::int64_t p, std::int64_t half) {
    double difference = 0;
    for (std::int64_t k = 0; k < 3; ++k) {
      sum[at(3 * i + k)] += b.zeta[at(3 * half + k)];
      difference = std::fmax(difference, std::fabs(b.zeta[at(3 * half + k)] +
                                                   b.zeta[at(3 * b.reverse[at(half)] + k)]));
    }
    if (boundary.bond(i, p)) {
      outside_differs += difference > 0.01 ? 1 : 0;
    } else {
      EXPECT_LT(difference, 1e-14);  // measured 1e-16
      ++bonds_inside;
    }
  });
  for (std::int64_t i = 0; i < b.mesh.particles(); ++i) {
    if (boundary.particle(i)) continue;
    for (std::int64_t k = 0; k < 3; ++k) EXPECT_NEAR(sum[at(3 * i + k)], 0, 1e-14);
    ++inside;
  }
  EXPECT_GT(inside, 0);
  EXPECT_GT(bonds_inside, 20);
  EXPECT_GT(outside_differs, 20);  // the identity is not true of everything
}

// 2 zeta_ip is the area vector of the face between i and p of the median-dual mesh: the line
// between the centroids of the two triangles at the bond, turned by a right angle towards p.
TEST(BondVectorsInThePlane, AreAreaVectorsOfTheMedianDual) {
  const Bonds b(patch(2, 12, 1.0, 0.2, 32));
  std::map<std::pair<std::int64_t, std::int64_t>, std::vector<std::array<double, 2>>> centroids;
  for (std::int64_t s = 0; s < b.mesh.simplex_count(); ++s) {
    const std::int64_t* c = &b.mesh.simplices[at(3 * s)];
    std::array<double, 2> middle{};
    for (int a = 0; a < 3; ++a)
      for (std::size_t k = 0; k < 2; ++k) middle[k] += b.mesh.X[3 * at(c[a]) + k] / 3;
    for (int i = 0; i < 3; ++i)
      for (int p = 0; p < 3; ++p) {
        if (i != p) centroids[{c[i], c[p]}].push_back(middle);
      }
  }
  int interior = 0;
  for (std::int64_t i = 0; i < b.mesh.particles(); ++i)
    for (std::int64_t half = b.row_begin[at(i)]; half < b.row_begin[at(i + 1)]; ++half) {
      const std::int64_t p = b.neighbour[at(half)];
      const auto& ends = centroids[{i, p}];
      if (ends.size() != 2) continue;
      ++interior;
      std::array<double, 2> area{ends[1][1] - ends[0][1], ends[0][0] - ends[1][0]};
      double towards = 0;
      for (std::size_t k = 0; k < 2; ++k)
        towards += area[k] * (b.mesh.X[3 * at(p) + k] - b.mesh.X[3 * at(i) + k]);
      for (std::size_t k = 0; k < 2; ++k) {
        EXPECT_NEAR(2 * b.zeta[at(3 * half) + k], towards > 0 ? area[k] : -area[k],
                    1e-14);  // measured 2e-15
      }
    }
  EXPECT_GT(interior, 500);
}

// Rows rebuilt deletion by deletion have the bits of rows built at once from the same survivors.
TEST_P(BondVectors, RebuiltRowsHaveTheBitsOfRowsBuiltAtOnce) {
  const int d = GetParam().dimension;
  const SimplexMesh mesh = patch(d, d == 2 ? 12 : 6, 1.0, 0.2, 33);
  Model model;
  model.add({CLEAVE_FORMULATION_cbm, CLEAVE_MATERIAL_svk, d == 2 ? CLEAVE_PLANE_STRESS : CLEAVE_3D},
            mesh);
  model.setup();
  const auto ends = model.integer("bond_ends");
  Random random(14);
  std::vector<int64_t> order;
  for (int cut = 0; cut < 60; ++cut) {
    const auto bond =
        static_cast<std::size_t>(0.5 * (1 + random()) * static_cast<double>(ends.size() / 2));
    ok(cleave_body_precrack(model, 0, 1, &ends[2 * bond]));
  }
  const auto alive = model.integer("simplex_alive");
  const Bonds at_once(mesh, std::vector<std::int32_t>(alive.begin(), alive.end()));
  EXPECT_LT(std::count(alive.begin(), alive.end(), 1), mesh.simplex_count());
  EXPECT_GT(std::count(alive.begin(), alive.end(), 1), 0);
  EXPECT_EQ(model.real("bond_vector"), at_once.zeta);
  EXPECT_EQ(model.real("volume"), at_once.volume);
}

TEST_P(BondVectors, DoNotDependOnTheOrientationOfSimplices) {
  const auto [d, deleted] = GetParam();
  SimplexMesh mesh = patch(d, 4, 1.0, 0.2, 34);
  const Bonds one(mesh, random_deletions(mesh, deleted, 1));
  for (std::int64_t s = 0; s < mesh.simplex_count(); ++s)
    std::swap(mesh.simplices[at((d + 1) * s)], mesh.simplices[at((d + 1) * s + 1)]);
  const Bonds other(mesh, one.alive);
  for (std::size_t k = 0; k < one.zeta.size(); ++k) EXPECT_NEAR(one.zeta[k], other.zeta[k], 1e-14);
  for (std::size_t i = 0; i < one.volume.size(); ++i)
    EXPECT_NEAR(one.volume[i], other.volume[i], 1e-14);
}

INSTANTIATE_TEST_SUITE_P(Meshes, BondVectors,
                         testing::Values(Shape{2, 0.0}, Shape{2, 0.15}, Shape{3, 0.0},
                                         Shape{3, 0.05}),
                         [](const auto& shape) {
                           return std::to_string(shape.param.dimension) +
                                  (shape.param.deleted > 0 ? "d_after_deletions" : "d");
                         });

// Sizes from micrometres to kilometres: nothing absolute decides what is degenerate.
TEST(Bonds, ScaleDoesNotMatterButFlatnessDoes) {
  for (const double h : {1e-9, 1e-3, 1e6}) {
    const Bonds b(patch(3, 2, h, 0.2, 35));
    double total = 0;
    for (const double v : b.volume) total += v;
    EXPECT_GT(total, 2 * h * h * h);
  }
  SimplexMesh flat;
  flat.X = {0, 0, 0, 1, 0, 0, 0.5, 1e-13, 0};
  flat.simplices = {0, 1, 2};
  EXPECT_THROW(Bonds{flat}, std::runtime_error);
  flat.X[7] = 1e-11;
  EXPECT_NO_THROW(Bonds{flat});
}

// Counts of the theory chapter: an inner particle of Kuhn cubes has 14 bonds and 24 tetrahedra, of
// a triangular lattice 6 bonds.
TEST(Bonds, InnerParticlesHaveTheKnownNumberOfNeighbours) {
  const Bonds cubes(patch(3, 4, 1.0, 0.1, 36));
  const std::int64_t middle = (2 * 5 + 2) * 5 + 2;
  EXPECT_EQ(cubes.row_begin[at(middle + 1)] - cubes.row_begin[at(middle)], 14);
  EXPECT_EQ(std::count(cubes.mesh.simplices.begin(), cubes.mesh.simplices.end(), middle), 24);
  const Bonds lattice(triangular_lattice(7, 7, 1.0, 0.0, 1));
  EXPECT_EQ(lattice.row_begin[25] - lattice.row_begin[24], 6);
  EXPECT_NEAR(lattice.volume[24], std::sqrt(0.75), 1e-15);
}

}  // namespace
}  // namespace cleave::test
