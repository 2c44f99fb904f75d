// Array calls are the model's kernels: the same bits in its order CLEAVE_ORDER_ROWS, also from several threads on disjoint ranges.
#include <cmath>
#include <limits>
#include <thread>

#include "support/bonds.hpp"
#include "support/model.hpp"

namespace cleave::test {
namespace {

const std::vector<double> kProperties = {1190, 3.24e9, 0.35};

class ArrayCalls : public testing::TestWithParam<int32_t> {
 protected:
  int dimension() const { return GetParam() == CLEAVE_3D ? 3 : 2; }
  SimplexMesh mesh() const { return patch(dimension(), dimension() == 2 ? 20 : 8, 0.01, 0.15, 91); }
  Case plate() const { return {CLEAVE_FORMULATION_cbm, CLEAVE_MATERIAL_svk, GetParam()}; }
};

TEST_P(ArrayCalls, HaveTheBitsOfTheModelAfterBreaking) {
  const SimplexMesh m = mesh();
  const double beta = 0.3, length = 0.01;
  Model model;
  ok(cleave_model_set_order(model, CLEAVE_ORDER_ROWS));
  model.add(plate(), m,
            {{"fracture", "critical_strain", 0.02},
             {"viscosity", "beta", beta},
             {"viscosity", "length", length}});
  model.setup();
  auto v = random_vectors(m, 4.0, 5);
  for (std::size_t i = 0; i < v.size() / 3; ++i) v[3 * i] += 1000 * m.X[3 * i];
  model.put("velocity", v);
  model.initialise();
  const double dt = 0.4 * model.stable_step();
  for (int n = 0; n < 120; ++n) model.step(dt);
  ASSERT_GT(model.counts().broken, 5);

  const auto alive = model.integer("simplex_alive");
  const Bonds b(m, std::vector<std::int32_t>(alive.begin(), alive.end()));
  EXPECT_EQ(model.real("bond_vector"), b.zeta);
  EXPECT_EQ(model.real("volume"), b.volume);
  EXPECT_EQ(model.real("bond_weight"), b.weights());
  const auto H = b.gradient(model.real("displacement"));
  EXPECT_EQ(model.real("displacement_gradient"), H);
  auto s = stress(CLEAVE_MATERIAL_svk, GetParam(), kProperties, H);
  EXPECT_EQ(model.real("first_piola_kirchhoff_stress"), s.P);
  EXPECT_EQ(model.real("strain_energy_density"), s.energy);
  EXPECT_EQ(model.real("internal_force"), b.force(s.P));
}

// Before the second half of the kick has touched the velocity: at the start.
TEST_P(ArrayCalls, ViscosityHasTheBitsOfTheModel) {
  const SimplexMesh m = mesh();
  Model model;
  ok(cleave_model_set_order(model, CLEAVE_ORDER_ROWS));
  const double beta = 0.3, length = 0.01;
  model.add(plate(), m, {{"viscosity", "beta", beta}, {"viscosity", "length", length}});
  model.setup();
  const auto v = random_vectors(m, 4.0, 5);
  model.put("velocity", v);
  model.put("displacement", random_vectors(m, 1e-3, 6));
  model.initialise();
  const Bonds b(m);
  double c0 = 0;
  ok(cleave_material_wave_speed(CLEAVE_MATERIAL_svk, GetParam(), 3, kProperties.data(), &c0));
  std::vector<double> f(v.size(), 0.0);
  const auto w = b.weights(), x = model.real("position"), J = model.real("volume_ratio");
  const cleave_network net = b.network();
  ok(cleave_bond_viscosity(&net, 0, m.particles(), w.data(), x.data(), v.data(), J.data(),
                           beta * kProperties[0] * c0, length, f.data()));
  const auto g = model.real("viscous_force");
  EXPECT_NE(g, std::vector<double>(g.size(), 0.0));
  EXPECT_EQ(f, g);
}

TEST_P(ArrayCalls, DisjointRangesFromSeveralThreadsGiveTheSerialBits) {
  const SimplexMesh m = mesh();
  const Bonds b(m, random_deletions(m, 0.1, 4));
  const auto u = random_vectors(m, 5e-4, 7), v = random_vectors(m, 1.0, 8);
  const auto H = b.gradient(u);
  const auto s = stress(CLEAVE_MATERIAL_svk, GetParam(), kProperties, H);
  const auto f = b.force(s.P);
  const auto w = b.weights();
  std::vector<double> x = m.X, J(b.volume.size(), 1.0), viscous(f.size(), 0.0);
  for (std::size_t k = 0; k < x.size(); ++k) x[k] += u[k];
  const int64_t n = m.particles();
  const cleave_network net = b.network();
  const auto viscosity = [&](int64_t first, int64_t last, std::vector<double>& out) {
    ok(cleave_bond_viscosity(&net, first, last, w.data(), x.data(), v.data(), J.data(), 2.0, 0.01,
                             out.data()));
  };
  viscosity(0, n, viscous);

  std::vector<double> H2(H.size(), 9.0), P2(H.size(), 9.0), energy2(b.volume.size(), 9.0),
      f2(f.size(), 0.0), viscous2(f.size(), 0.0);
  const auto in_threads = [&](const auto& work) {
    std::vector<std::thread> threads;
    for (int64_t t = 0; t < 4; ++t)
      threads.emplace_back([&, t] { work(t * n / 4, (t + 1) * n / 4); });
    for (auto& t : threads) t.join();
  };
  in_threads([&](int64_t first, int64_t last) {
    ok(cleave_displacement_gradient(&net, first, last, u.data(), H2.data()));
    ok(cleave_material_stress(CLEAVE_MATERIAL_svk, GetParam(), 3, kProperties.data(), first, last,
                              H2.data(), nullptr, P2.data(), energy2.data(), nullptr));
  });
  in_threads([&](int64_t first, int64_t last) {
    ok(cleave_bond_force(&net, first, last, P2.data(), f2.data()));
    viscosity(first, last, viscous2);
  });
  EXPECT_EQ(H2, H);
  EXPECT_EQ(P2, s.P);
  EXPECT_EQ(energy2, s.energy);
  EXPECT_EQ(f2, f);
  EXPECT_EQ(viscous2, viscous);
}

TEST_P(ArrayCalls, TouchOnlyTheRowsOfTheirRange) {
  const SimplexMesh m = mesh();
  const Bonds b(m);
  const auto u = random_vectors(m, 5e-4, 7);
  const auto H = b.gradient(u);
  const auto s = stress(CLEAVE_MATERIAL_svk, GetParam(), kProperties, H);
  const std::size_t n = b.volume.size();
  const int64_t first = 20, last = 50;
  std::vector<double> H2(9 * n, 7.0), P2(9 * n, 7.0), energy2(n, 7.0), f(3 * n, 7.0);
  std::vector<int32_t> failed(n, 7);
  const cleave_network net = b.network();
  ok(cleave_displacement_gradient(&net, first, last, u.data(), H2.data()));
  ok(cleave_material_stress(CLEAVE_MATERIAL_svk, GetParam(), 3, kProperties.data(), first, last,
                            H.data(), nullptr, P2.data(), energy2.data(), failed.data()));
  const auto w = b.weights();
  ok(cleave_bond_viscosity(&net, first, last, w.data(), m.X.data(), u.data(), b.volume.data(),
                           100.0, 0.01, f.data()));
  for (std::size_t i = 0; i < n; ++i) {
    const bool inside = static_cast<int64_t>(i) >= first && static_cast<int64_t>(i) < last;
    EXPECT_EQ(energy2[i], inside ? s.energy[i] : 7.0);
    EXPECT_EQ(failed[i], inside ? 0 : 7);
    EXPECT_EQ(f[3 * i] == 7.0, !inside);
    for (std::size_t k = 9 * i; k < 9 * i + 9; ++k) {
      EXPECT_EQ(H2[k], inside ? H[k] : 7.0);
      EXPECT_EQ(P2[k], inside ? s.P[k] : 7.0);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Kinematics, ArrayCalls,
                         testing::Values(CLEAVE_3D, CLEAVE_PLANE_STRAIN, CLEAVE_PLANE_STRESS),
                         [](const auto& which) {
                           return std::string(which.param == CLEAVE_3D ? "3d"
                                              : which.param == CLEAVE_PLANE_STRAIN
                                                  ? "plane_strain"
                                                  : "plane_stress");
                         });

TEST(ArrayCall, StressGoesOnPastPointsWithoutAnswerAndMarksThem) {
  // Points 0 and 2 ordinary, point 1 stretched until the plate would have no thickness.
  std::vector<double> H(27, 0.0), P(27, 5.0), energy(3, 5.0);
  H[0] = H[18] = 0.1;
  H[9] = H[9 + 4] = 1.0;
  std::vector<int32_t> failed(3, 5);
  EXPECT_EQ(cleave_material_stress(CLEAVE_MATERIAL_svk, CLEAVE_PLANE_STRESS, 3, kProperties.data(),
                                   0, 3, H.data(), nullptr, P.data(), energy.data(), failed.data()),
            CLEAVE_BAD_JACOBIAN);
  EXPECT_NE(last_message().find("point 1"), std::string::npos) << last_message();
  EXPECT_EQ(failed, (std::vector<int32_t>{0, 1, 0}));
  for (std::size_t k = 0; k < 9; ++k) {
    EXPECT_EQ(P[9 + k], 0);
    EXPECT_EQ(P[k], P[18 + k]);
  }
  EXPECT_GT(P[0], 0);
  EXPECT_EQ(energy[1], 0);
  EXPECT_EQ(energy[0], energy[2]);
}

TEST(ArrayCall, RowsThatDoNotFitTheSimplicesAreRefused) {
  const SimplexMesh mesh = patch(2, 3, 1.0, 0.1, 92);
  Bonds b(mesh);
  auto rows = b.row_begin;
  ++rows[4];
  cleave_network net = b.network();
  net.row_begin = rows.data();
  EXPECT_EQ(
      cleave_cbm_bonds(&net, mesh.X.data(), mesh.simplex_count(), mesh.simplices.data(), nullptr),
      CLEAVE_BAD_ARGUMENT);
  EXPECT_NE(last_message().find("cleave_cbm_count_bonds"), std::string::npos) << last_message();
}

TEST(ArrayCall, BadSimplicesAreRefused) {
  SimplexMesh mesh = patch(2, 3, 1.0, 0.1, 92);
  Bonds b(mesh);
  const cleave_network net = b.network();
  const auto bonds = [&](const SimplexMesh& m) {
    return cleave_cbm_bonds(&net, m.X.data(), m.simplex_count(), m.simplices.data(), nullptr);
  };
  SimplexMesh outside = mesh;
  outside.simplices[2] = 16;
  EXPECT_EQ(cleave_cbm_count_bonds(&net, outside.simplex_count(), outside.simplices.data()),
            CLEAVE_BAD_SIMPLEX);
  EXPECT_EQ(bonds(outside), CLEAVE_BAD_SIMPLEX);
  EXPECT_NE(last_message().find("simplex 0 refers to particle 16"), std::string::npos);
  SimplexMesh not_finite = mesh;
  not_finite.X[3] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(bonds(not_finite), CLEAVE_BAD_SIMPLEX);
  EXPECT_NE(last_message().find("degenerate"), std::string::npos) << last_message();
}

TEST(ArrayCall, ParticlesWithoutSimplexHaveEmptyRows) {
  SimplexMesh mesh = patch(2, 2, 1.0, 0.1, 93);
  mesh.X.insert(mesh.X.end(), {9, 9, 0});
  const Bonds b(mesh);
  EXPECT_EQ(b.row_begin[9], b.row_begin[10]);
  EXPECT_EQ(b.volume[9], 0);
  const auto H = b.gradient(std::vector<double>(30, 1.0));
  for (std::size_t k = 81; k < 90; ++k) EXPECT_EQ(H[k], 0);
}

TEST(ArrayCall, RampGivesWhatIsAskedFor) {
  double u = -1, v = -1, a = -1;
  ok(cleave_ramp(CLEAVE_RAMP_DISPLACEMENT, 2.0, 4.0, 2.0, &u, &v, &a));
  EXPECT_DOUBLE_EQ(u, 1);             // half way
  EXPECT_DOUBLE_EQ(v, 15.0 / 8 / 2);  // 15 u/(8 tau)
  EXPECT_NEAR(a, 0, 1e-15);
  ok(cleave_ramp(CLEAVE_RAMP_VELOCITY, 2.0, 4.0, 2.0, nullptr, nullptr, &a));
  EXPECT_DOUBLE_EQ(a, 0.75);  // 3 v/(2 tau)
  ok(cleave_ramp(CLEAVE_RAMP_VELOCITY, 2.0, 0.0, 2.0, &u, nullptr, nullptr));
  EXPECT_DOUBLE_EQ(u, 4);
}

}  // namespace
}  // namespace cleave::test
