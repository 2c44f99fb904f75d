// Points on lattices: the shared list of shapes gives the forces of any cloud, and the interactions of the
// published cases are counted exactly.
#include "formulation/peridynamics/clouds.hpp"

namespace cleave::test {
namespace {

std::vector<Setting> cpd_settings(double horizon, const std::string& stencil,
                                  const std::string& form) {
  return {{"peridynamics", "horizon", horizon},
          {"peridynamics", "stencil", 0, stencil},
          {"cpd", "three_nbr", 0, form}};
}

// A block with a corner, an edge and a hole taken out.
Cloud broken_block(int nx, int ny, int nz, double spacing) {
  const Cloud whole = lattice_cloud(nx, ny, nz, spacing);
  Cloud block{3, {}, {}};
  for (std::size_t i = 0; i < whole.size(); ++i) {
    const Point at = (1 / spacing) * whole.X[i];
    const bool corner = at[0] + at[1] + at[2] < 3.6;
    const bool slit = at[1] > 4 && at[1] < 5 && at[0] > 3;
    if (corner || slit || i == whole.size() / 2) continue;
    block.X.push_back(whole.X[i]);
    block.volume.push_back(whole.volume[i] * (at[2] < 1 ? 0.5 : 1));
  }
  return block;
}

TEST(PeridynamicLattice, SharedShapesGiveTheForcesOfACloud) {
  const double dx = 1.125;
  for (const auto& [nx, ny, nz] : {std::array{9, 7, 5}, std::array{5, 19, 6}, std::array{4, 6, 13}})
    for (const double reach : {1.75, 2.4, 3.015})
      for (const std::string form : {"paper", "signed"})
        for (const bool damaged : {false, true}) {
          if (reach > 3 && damaged) continue;  // slow in the cloud
          const Cloud cloud = broken_block(nx, ny, nz, dx);
          const auto u = random_field(cloud, 0.4 * dx, 3);
          std::vector<double> f[2];
          double energy[2];
          for (const bool lattice : {false, true}) {
            CloudBody body(CLEAVE_FORMULATION_cpd, CLEAVE_3D, cloud,
                           cpd_settings(reach * dx, lattice ? "lattice" : "never", form));
            if (damaged) body.damage(400, 5);
            f[lattice ? 1 : 0] = body.forces(u);
            energy[lattice ? 1 : 0] = body.model.energies().elastic;
          }
          EXPECT_LT(difference(f[1], f[0]), 1e-12) << nx << ' ' << reach << form;  // measured 2e-14
          EXPECT_NEAR(energy[1], energy[0], 1e-12 * energy[0]);
          EXPECT_GT(largest(f[0]), 0.0);
        }
}

TEST(PeridynamicLattice, ReferenceHasExactlyNoForce) {
  const Cloud cloud = broken_block(9, 10, 5, 0.1);
  CloudBody body(CLEAVE_FORMULATION_cpd, CLEAVE_3D, cloud,
                 cpd_settings(0.3015, "lattice", "paper"));
  EXPECT_EQ(largest(body.forces(std::vector<double>(3 * cloud.size(), 0.0))), 0.0);
}

double one_neighbour_interactions(int n) {
  const Cloud block = lattice_cloud(n, n, n / 10, 1.0 / n);
  CloudBody body(CLEAVE_FORMULATION_bond_pd, CLEAVE_3D, block,
                 {{"peridynamics", "horizon", 0.0675}}, 2.1e5, 0.25);
  EXPECT_EQ(2 * body.model.counts().bonds,
            static_cast<int64_t>(body.model.real("interactions")[0]));
  return body.model.real("interactions")[0];
}

// Table 1 of Partmann, Wieners, Weinberg; n = 80 to 100 are a validation case.
TEST(PeridynamicLattice, CountsOfTheBlockAreThePrintedOnes) {
  EXPECT_EQ(one_neighbour_interactions(40), 367896);
  EXPECT_EQ(one_neighbour_interactions(50), 1512716);
  EXPECT_EQ(one_neighbour_interactions(60), 3982968);
}

// 88 x 177 x 8 points, ordered, coplanar sets left out: a closed sum over the shapes.
TEST(PeridynamicLattice, CountsOfTheKalthoffPlateAreExact) {
  const double dx = 1.125;
  CloudBody body(CLEAVE_FORMULATION_cpd, CLEAVE_3D, lattice_cloud(88, 177, 8, dx),
                 {{"peridynamics", "horizon", 3.015 * dx}}, 190000, 0.3);
  const auto n = body.model.real("interactions");
  EXPECT_EQ(n[0], 12764988);
  EXPECT_EQ(n[1], 0);
  EXPECT_EQ(n[2], 19786146480);
  // Memory of the model, target 100 MB for the whole run: measured 165 MB.
  int64_t bytes = 0;
  ok(cleave_model_memory(body.model, &bytes));
  EXPECT_LT(bytes, 200e6);
}

}  // namespace
}  // namespace cleave::test
