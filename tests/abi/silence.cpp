// The library writes nothing on standard output or standard error, whatever happens.
#include <cmath>

#include "support/bonds.hpp"
#include "support/model.hpp"

namespace cleave::test {
namespace {

void good_run() {
  const SimplexMesh mesh = patch(2, 8, 0.01, 0.15, 121);
  Model model;
  model.add({CLEAVE_FORMULATION_cbm, CLEAVE_MATERIAL_svk, CLEAVE_PLANE_STRESS}, mesh,
            {{"fracture", "critical_strain", 0.02}});
  ok(cleave_model_set_threads(model, 2));
  model.setup();
  auto v = random_vectors(mesh, 4.0, 5);
  for (std::size_t i = 0; i < v.size() / 3; ++i) v[3 * i] += 1000 * mesh.X[3 * i];
  model.put("velocity", v);
  model.initialise();
  const double dt = 0.3 * model.stable_step();
  for (int n = 0; n < 100; ++n) model.step(dt);
  EXPECT_GT(model.counts().broken, 0);
}

void bad_calls() {
  cleave_model* none = nullptr;
  EXPECT_NE(cleave_model_create(-1, &none), CLEAVE_OK);
  EXPECT_NE(cleave_model_update(none), CLEAVE_OK);
  EXPECT_NE(cleave_cbm_count_bonds(nullptr, 0, nullptr), CLEAVE_OK);
  Model model;
  model.add({}, patch(3, 2, 0.01, 0.1, 122));
  EXPECT_NE(cleave_body_set_real(model, 0, "no", "such", 1), CLEAVE_OK);
  model.setup();
  auto v = model.real("velocity");
  v[4] = std::nan("");
  model.put("velocity", v);
  model.initialise();
  ok(cleave_model_advance(model, 1e-8, 1e-8));
  EXPECT_EQ(cleave_model_update(model), CLEAVE_NOT_FINITE);
}

TEST(Silence, NothingIsPrinted) {
  testing::internal::CaptureStdout();
  testing::internal::CaptureStderr();
  good_run();
  bad_calls();
  EXPECT_EQ(testing::internal::GetCapturedStdout(), "");
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
}

// More particles than memory: an answer, not an abort.
TEST(Silence, HugeCountsAreAnswered) {
#if defined(__SANITIZE_ADDRESS__)
  GTEST_SKIP() << "the sanitizer ends a process that asks for so much";
#endif
  int64_t rows[2] = {};
  for (const int64_t particles : {int64_t{1} << 45, int64_t{1} << 60, INT64_MAX}) {
    cleave_network net;
    ok(cleave_network_init(&net));
    net.particles = particles;
    net.row_begin = rows;
    const int32_t status = cleave_cbm_count_bonds(&net, 0, nullptr);
    EXPECT_EQ(status, CLEAVE_OUT_OF_MEMORY);
  }
}

}  // namespace
}  // namespace cleave::test
