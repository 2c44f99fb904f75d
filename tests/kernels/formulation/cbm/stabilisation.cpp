// Hourglass modes: the averaged gradients do not see them, the stabilisation and the diagnostic do.
#include <gtest/gtest.h>

#include <cmath>

#include "support/bonds.hpp"
#include "support/model.hpp"

namespace cleave::test {
namespace {

constexpr double kMu = 3.24e9 / (2 * 1.35);  // of the test material

std::size_t at(std::int64_t i) { return static_cast<std::size_t>(i); }

Case case_of(int dimension) {
  return {CLEAVE_FORMULATION_cbm, CLEAVE_MATERIAL_svk,
          dimension == 2 ? CLEAVE_PLANE_STRAIN : CLEAVE_3D};
}

struct Deformed {
  Deformed(const SimplexMesh& mesh, const std::vector<double>& u,
           const std::vector<Setting>& settings) {
    model.add(case_of(mesh.dimension), mesh, settings);
    model.setup();
    model.put("displacement", u);
    model.initialise();
  }
  double stored() const {
    const cleave_energies e = model.energies();
    return e.elastic + e.stabilisation;
  }
  Model model;
};

std::vector<Setting> form(const char* name, double alpha = 0.3) {
  return {{"stabilisation", "form", 0, name}, {"stabilisation", "alpha", alpha}};
}

class Stabilisation : public testing::TestWithParam<int> {
 protected:
  static SimplexMesh mesh() { return patch(GetParam(), GetParam() == 2 ? 6 : 3, 1.0, 0.2, 51); }
};

TEST_P(Stabilisation, AffineMotionFeelsNothingOfIt) {
  const SimplexMesh m = mesh();
  const double A[3][3] = {{0.05, -0.02, 0.01}, {0.03, 0.04, -0.02}, {0.02, 0.01, -0.03}};
  std::vector<double> u(m.X.size(), 0.0);
  const std::size_t d = at(m.dimension);
  for (std::size_t i = 0; i < u.size() / 3; ++i)
    for (std::size_t r = 0; r < d; ++r)
      for (std::size_t c = 0; c < d; ++c) u[3 * i + r] += A[r][c] * m.X[3 * i + c];
  const Deformed plain(m, u, {}), deviation(m, u, form("deviation")), blend(m, u, form("blend"));
  const auto f = plain.model.real("internal_force");
  double size = 0;
  for (const double c : f) size = std::fmax(size, std::fabs(c));
  for (const Deformed* other : {&deviation, &blend}) {
    const auto g = other->model.real("internal_force");
    for (std::size_t k = 0; k < f.size(); ++k)
      EXPECT_NEAR(g[k], f[k], 1e-12 * size);  // measured 4e-16
    EXPECT_NEAR(other->stored(), plain.stored(), 1e-13 * plain.stored());
  }
  EXPECT_LT(deviation.model.energies().stabilisation, 1e-25 * plain.stored());
  EXPECT_NEAR(blend.model.energies().stabilisation, 0.3 * plain.stored(), 1e-12 * plain.stored());
}

// Force is minus the gradient of stored energy, also after deletions.
TEST_P(Stabilisation, ForceIsMinusTheEnergyGradient) {
  const SimplexMesh m = mesh();
  const auto u = random_vectors(m, 0.05, 6);
  for (const char* name : {"deviation", "blend"}) {
    const auto deform = [&](Model& model, const std::vector<double>& displacement) {
      model.add(case_of(m.dimension), m, form(name));
      model.setup();
      const std::vector<int64_t> cut = {0, 1};
      ok(cleave_body_precrack(model, 0, 1, cut.data()));
      model.put("displacement", displacement);
      model.initialise();
      return model.energies().elastic + model.energies().stabilisation;
    };
    Model model;
    deform(model, u);
    const auto f = model.real("internal_force");
    double size = 0;
    for (const double c : f) size = std::fmax(size, std::fabs(c));
    for (const std::int64_t i : {1, 9, 25, 40}) {
      for (int k = 0; k < m.dimension; ++k) {
        const std::size_t c = at(3 * i + k);
        double energy[2];
        for (int side = 0; side < 2; ++side) {
          auto w = u;
          w[c] += side == 0 ? -1e-5 : 1e-5;
          Model moved;
          energy[side] = deform(moved, w);
        }
        EXPECT_NEAR(f[c], -(energy[1] - energy[0]) / 2e-5, 1e-8 * size) << name;  // measured 4e-10
      }
    }
  }
}

// E_hg = sum_L Omega_L mu |F_L - mean F_i|^2, and the deviation form's energy is alpha of it.
TEST_P(Stabilisation, DiagnosticIsItsDefinition) {
  const SimplexMesh m = mesh();
  const auto u = random_vectors(m, 0.05, 7);
  const Bonds bonds(m);
  const auto H = bonds.gradient(u);
  const int n = m.dimension + 1;
  double expected = 0;
  for (std::int64_t s = 0; s < m.simplex_count(); ++s) {
    const ReferenceSimplex L = reference_simplex(m, s);
    const std::int64_t* corner = &m.simplices[at(n * s)];
    for (int r = 0; r < m.dimension; ++r)
      for (int c = 0; c < m.dimension; ++c) {
        double deviation = 0;
        for (int a = 0; a < n; ++a) {
          deviation += u[at(3 * corner[a] + r)] * L.gradient[at(a)][at(c)] -
                       H[at(9 * corner[a] + r + 3 * c)] / n;
        }
        expected += L.volume * kMu * deviation * deviation;
      }
  }
  const Deformed plain(m, u, {}), stabilised(m, u, form("deviation", 0.3));
  EXPECT_NEAR(plain.model.energies().hourglass, expected, 1e-13 * expected);  // measured 7e-17
  EXPECT_EQ(plain.model.energies().stabilisation, 0);
  EXPECT_NEAR(stabilised.model.energies().stabilisation, 0.3 * expected, 1e-12 * expected);
  EXPECT_NEAR(stabilised.model.energies().elastic, plain.model.energies().elastic,
              1e-12 * expected);
}

INSTANTIATE_TEST_SUITE_P(Dimensions, Stabilisation, testing::Values(2, 3),
                         [](const auto& shape) { return std::to_string(shape.param) + "d"; });

// Zone-boundary mode of the triangular lattice, phases (0, pi): rows move to and fro. Inner
// particles have F = I; all elastic energy is that of the rim.
struct ZoneBoundary {
  ZoneBoundary() : mesh(triangular_lattice(kColumns, kRows, 1.0, 0.0, 1)), u(mesh.X.size(), 0.0) {
    for (std::size_t i = 0; i < u.size() / 3; ++i) {
      u[3 * i] = (i / kColumns) % 2 == 0 ? kSize : -kSize;
      u[3 * i + 1] = 0.5 * u[3 * i];
    }
  }
  static bool inner(std::size_t i) {
    const std::size_t column = i % kColumns, row = i / kColumns;
    return column > 0 && column < kColumns - 1 && row > 0 && row < kRows - 1;
  }
  static constexpr int kColumns = 14, kRows = 14;
  static constexpr double kSize = 1e-3;
  SimplexMesh mesh;
  std::vector<double> u;
};

TEST(ZoneBoundaryMode, IsInvisibleToParticlesAndVisibleToTheDiagnostic) {
  const ZoneBoundary mode;
  const Deformed plain(mode.mesh, mode.u, {});
  const auto H = plain.model.real("displacement_gradient"),
             energy = plain.model.real("strain_energy_density");
  double rim = 0;
  for (std::size_t i = 0; i < energy.size(); ++i) {
    if (mode.inner(i)) {
      for (std::size_t k = 0; k < 9; ++k) EXPECT_NEAR(H[9 * i + k], 0, 1e-17);  // of 2e-3
      EXPECT_NEAR(energy[i], 0, 1e-20 * kMu);
    } else {
      rim = std::fmax(rim, energy[i]);
    }
  }
  EXPECT_GT(rim, 1e-7 * kMu);  // boundary particles do see it
  // Away from the rim every triangle has |H_L|^2 = |2 u|^2 / (3/4): by hand for the inner ones.
  const double square = 4 * 1.25 * ZoneBoundary::kSize * ZoneBoundary::kSize / 0.75;
  const double inner_triangles = 2.0 * 11 * 11 * std::sqrt(3.0) / 4;
  EXPECT_GT(plain.model.energies().hourglass, inner_triangles * kMu * square);
}

TEST(ZoneBoundaryMode, IsOpposedByBothForms) {
  const ZoneBoundary mode;
  const Deformed plain(mode.mesh, mode.u, {});
  for (const auto& f : plain.model.real("internal_force")) ASSERT_TRUE(std::isfinite(f));
  const std::size_t middle = 7 * ZoneBoundary::kColumns + 7;
  EXPECT_NEAR(plain.model.real("internal_force")[3 * middle], 0, 1e-12 * kMu);
  for (const char* name : {"deviation", "blend"}) {
    const Deformed stabilised(mode.mesh, mode.u, form(name, 0.05));
    const double pull =
        stabilised.model.real("internal_force")[3 * middle] * (mode.u[3 * middle] > 0 ? 1 : -1);
    EXPECT_LT(pull, -0.05 * kMu * ZoneBoundary::kSize) << name;  // back to where it came from
    EXPECT_GT(stabilised.model.energies().stabilisation, 0.04 * plain.model.energies().hourglass)
        << name;
  }
}

}  // namespace
}  // namespace cleave::test
