// The step in blocks against the step by rows, which is that of the array calls and is tested by itself:
// the same motion, forces, energies and broken bonds but for rounding, for every law, with all that a block
// does: breaking, viscosity, prescribed motion, forces from outside. Bits depend neither on threads nor on
// when the host looks. The meshes make several blocks.
#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

#include "support/model.hpp"

namespace cleave::test {
namespace {

constexpr double kSpacing = 0.01;

struct BlockCase {
  Case body;
  bool breaking, local_length;
};

class Blocks : public testing::TestWithParam<BlockCase> {};

SimplexMesh block_mesh(const BlockCase& c) {
  return dimension_of(c.body) == 2 ? patch(2, 24, kSpacing, 0.2, 5) : patch(3, 8, kSpacing, 0.2, 5);
}

// Step and ends of every broken bond.
std::vector<std::array<std::int64_t, 3>> broken_bonds(cleave_model* model) {
  std::vector<std::array<std::int64_t, 3>> list;
  int64_t count = 0;
  ok(cleave_body_event_count(model, 0, &count));
  for (int64_t k = 0; k < count; ++k) {
    cleave_event e{};
    e.size = sizeof e;
    ok(cleave_body_event_get(model, 0, k, &e));
    list.push_back({e.step, e.first, e.second});
  }
  return list;
}

struct Pull {
  Pull(const BlockCase& c, const SimplexMesh& m, int32_t order, int32_t threads = 1) : mesh(m) {
    ok(cleave_model_set_order(model, order));
    ok(cleave_model_set_threads(model, threads));
    std::vector<Setting> settings = {{"viscosity", "beta", 0.4}};
    if (c.local_length) {
      settings.push_back({"viscosity", "length_mode", 0, "local"});
    } else {
      settings.push_back({"viscosity", "length", kSpacing});
    }
    if (c.breaking) settings.push_back({"fracture", "critical_strain", 0.02});
    model.add(c.body, mesh, settings);
    // The left face is held in x, the corner in all directions, and one particle is driven.
    for (int64_t i = 0; i < mesh.particles(); ++i) {
      const double* X = &mesh.X[static_cast<std::size_t>(3 * i)];
      if (X[0] > 1e-6) continue;
      for (int32_t d = 0; d < (X[1] < 1e-6 ? mesh.dimension : 1); ++d) {
        particle.push_back(i);
        direction.push_back(d);
        motion.push_back(i % 2 == 0 ? CLEAVE_MOTION_EXACT : CLEAVE_MOTION_ACCELERATION);
      }
    }
    ok(cleave_body_prescribe(model, 0, static_cast<int64_t>(particle.size()), particle.data(),
                             direction.data(), motion.data()));
    model.setup();
    auto v = random_vectors(mesh, 2.0, 6);
    for (std::size_t i = 0; i < v.size() / 3; ++i) v[3 * i] += 1000 * mesh.X[3 * i];
    model.put("velocity", v);
    auto f = random_vectors(mesh, 2.0, 7);
    for (std::size_t i = 0; i < f.size() / 3; ++i) f[3 * i + 1] += 10;
    model.put("external_force", f);
    model.initialise();
  }
  void steps(int count, double dt) {
    for (int n = 0; n < count; ++n) {
      const double t = ++done * dt;
      const std::vector<double> u(particle.size(), 1e-6 * t), a(particle.size(), 3.0);
      ok(cleave_body_motion(model, 0, static_cast<int64_t>(u.size()), u.data(), nullptr));
      ok(cleave_model_advance(model, dt, t));
      ok(cleave_body_motion(model, 0, static_cast<int64_t>(u.size()), nullptr, a.data()));
      ok(cleave_model_update(model));
    }
  }
  std::vector<std::array<int64_t, 3>> events() const { return broken_bonds(model); }
  static std::vector<double> random_vectors(const SimplexMesh& m, double size, unsigned seed) {
    Random random(seed);
    std::vector<double> v(m.X.size(), 0.0);
    for (std::size_t k = 0; k < v.size(); ++k)
      if (static_cast<int>(k % 3) < m.dimension) v[k] = size * random();
    return v;
  }
  SimplexMesh mesh;
  Model model;
  std::vector<int64_t> particle;
  std::vector<int32_t> direction, motion;
  int done = 0;
};

double largest(const std::vector<double>& v) {
  double size = 0;
  for (const double x : v) size = std::fmax(size, std::fabs(x));
  return size;
}

void expect_close(const Pull& a, const Pull& b, const char* name, double allowed) {
  const auto x = a.model.real(name), y = b.model.real(name);
  const double size = largest(y);
  double off = 0;
  for (std::size_t k = 0; k < x.size(); ++k) off = std::fmax(off, std::fabs(x[k] - y[k]));
  EXPECT_LE(off, allowed * size) << name << " of size " << size;
}

// Explicit steps amplify rounding a little: measured 9e-14 in 60 steps.
TEST_P(Blocks, AgreeWithRows) {
  const SimplexMesh m = block_mesh(GetParam());
  Pull blocks(GetParam(), m, CLEAVE_ORDER_BLOCKS), rows(GetParam(), m, CLEAVE_ORDER_ROWS);
  const double dt = 0.5 * rows.model.stable_step();
  blocks.steps(60, dt);
  rows.steps(60, dt);
  EXPECT_EQ(blocks.events(), rows.events());
  EXPECT_EQ(blocks.model.counts().inert, rows.model.counts().inert);
  if (GetParam().breaking) {
    EXPECT_GT(rows.events().size(), 5u);
  }
  for (const char* name : {"displacement", "velocity", "acceleration", "internal_force",
                           "viscous_force", "first_piola_kirchhoff_stress", "volume_ratio",
                           "strain_energy_density", "displacement_gradient", "damage"})
    expect_close(blocks, rows, name, 1e-11);
  const cleave_energies e = blocks.model.energies(), f = rows.model.energies();
  const double size = 1e-10 * (f.kinetic + f.elastic);
  EXPECT_NEAR(e.kinetic, f.kinetic, size);
  EXPECT_NEAR(e.elastic, f.elastic, size);
  EXPECT_NEAR(e.plastic, f.plastic, size);
  EXPECT_NEAR(e.viscous, f.viscous, size);
  EXPECT_NEAR(e.external, f.external, size);
  EXPECT_NEAR(e.reaction, f.reaction, size);
  EXPECT_NEAR(e.internal, f.internal, size);
  EXPECT_NEAR(e.fracture, f.fracture, size);
}

// All stored fields; the host looks at one of the two runs in every step, and puts back what it saw.
TEST_P(Blocks, BitsDependNeitherOnThreadsNorOnLooking) {
  const SimplexMesh m = block_mesh(GetParam());
  Pull one(GetParam(), m, CLEAVE_ORDER_BLOCKS, 1), three(GetParam(), m, CLEAVE_ORDER_BLOCKS, 3);
  const double dt = 0.5 * one.model.stable_step();
  one.steps(40, dt);
  for (int n = 0; n < 40; ++n) {
    three.steps(1, dt);
    static_cast<void>(three.model.energies());
    three.model.put("velocity", three.model.real("velocity"));
    if (n % 10 == 5) three.model.put("external_force", three.model.real("external_force"));
  }
  int64_t count = 0;
  ok(cleave_field_count(one.model, 0, &count));
  for (int64_t k = 0; k < count; ++k) {
    cleave_field f{};
    f.size = sizeof f;
    ok(cleave_field_get(one.model, 0, k, &f));
    if (f.type == CLEAVE_REAL) {
      EXPECT_EQ(one.model.real(f.name), three.model.real(f.name)) << f.name;
    } else {
      EXPECT_EQ(one.model.integer(f.name), three.model.integer(f.name)) << f.name;
    }
  }
  EXPECT_EQ(one.events(), three.events());
}

using Motion = void (*)(double x, double y, double* v);

std::vector<std::array<std::int64_t, 3>> bonds_broken_by(std::int32_t order, Motion motion) {
  const SimplexMesh m = patch(2, 24, kSpacing, 0.2, 5);
  Model model;
  ok(cleave_model_set_order(model, order));
  model.add({CLEAVE_FORMULATION_cbm, CLEAVE_MATERIAL_svk, CLEAVE_PLANE_STRAIN}, m,
            {{"fracture", "critical_strain", 0.01}});
  model.setup();
  std::vector<double> v(m.X.size(), 0.0);
  for (std::size_t i = 0; i < v.size() / 3; ++i)
    motion(m.X[3 * i] - 0.12, m.X[3 * i + 1] - 0.12, &v[3 * i]);
  model.put("velocity", v);
  model.initialise();
  const double dt = 0.4 * model.stable_step();
  for (int n = 0; n < 200; ++n) model.step(dt);
  return broken_bonds(model);
}

// A body that flies and spins fast without straining is looked at rarely; what breaks it at last is found in
// the step in which it happens all the same.
TEST(BlockSearch, FindsEveryBondInItsStepWhileTheBodySpins) {
  const Motion motion = [](double x, double y, double* v) {
    v[0] = 500 - 400 * y + (x > 0.1 ? 25 : 0);
    v[1] = 400 * x;
  };
  const auto rows = bonds_broken_by(CLEAVE_ORDER_ROWS, motion);
  EXPECT_GT(rows.size(), 20u);
  EXPECT_EQ(bonds_broken_by(CLEAVE_ORDER_BLOCKS, motion), rows);
}

// Two halves that fly apart: bonds grow as fast as the bound allows, over ten steps and more.
TEST(BlockSearch, FindsEveryBondInItsStepWhileHalvesPart) {
  for (const Motion motion :
       {Motion([](double x, double, double*v) { v[0] = x > 0.005 ? 60 : 0; }),
        Motion([](double, double y, double*v) { v[1] = y > 0.005 ? 25 : -25; })}) {
    const auto rows = bonds_broken_by(CLEAVE_ORDER_ROWS, motion);
    EXPECT_GT(rows.size(), 20u);
    EXPECT_EQ(bonds_broken_by(CLEAVE_ORDER_BLOCKS, motion), rows);
  }
}

std::vector<BlockCase> block_cases() {
  std::vector<BlockCase> cases;
  for (const int32_t kinematics : {CLEAVE_3D, CLEAVE_PLANE_STRAIN, CLEAVE_PLANE_STRESS}) {
    cleave_table_entry e{};
    e.size = sizeof e;
    for (int64_t k = 0; cleave_table_get(CLEAVE_TABLE_MATERIAL, k, &e) == CLEAVE_OK; ++k) {
      if (!offered(e.value, kinematics)) continue;
      const Case body{CLEAVE_FORMULATION_cbm, e.value, kinematics};
      cases.push_back({body, k % 2 == 0, k % 3 == 0});
      if (e.value == CLEAVE_MATERIAL_svk) cases.push_back({body, false, false});
    }
  }
  return cases;
}

std::string block_case_name(const testing::TestParamInfo<BlockCase>& info) {
  const Case& c = info.param.body;
  return law_name(c.material) +
         (c.kinematics == CLEAVE_3D             ? "_3d"
          : c.kinematics == CLEAVE_PLANE_STRAIN ? "_plane_strain"
                                                : "_plane_stress") +
         (info.param.breaking ? "_breaking" : "");
}

INSTANTIATE_TEST_SUITE_P(Laws, Blocks, testing::ValuesIn(block_cases()), block_case_name);

}  // namespace
}  // namespace cleave::test
