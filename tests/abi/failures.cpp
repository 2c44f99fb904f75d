// A run that goes wrong: the message names field or law, particle, step and time, and the process
// lives on.
#include <cmath>

#include "support/bonds.hpp"
#include "support/model.hpp"

namespace cleave::test {
namespace {

constexpr double kStep = 1e-7;

// Runs until the first error; the number of the step at which it came.
int run_to_failure(Model& model, int32_t& status) {
  for (int n = 1; n <= 200; ++n) {
    status = cleave_model_advance(model, kStep, n * kStep);
    if (status == CLEAVE_OK) status = cleave_model_update(model);
    if (status != CLEAVE_OK) return n;
  }
  return 0;
}

void expect_message(const char* what, int64_t particle, int step) {
  for (const std::string& part :
       {std::string("body 0 'patch'"), std::string(what), "particle " + std::to_string(particle),
        "step " + std::to_string(step), std::string("time ")})
    EXPECT_NE(last_message().find(part), std::string::npos) << part << " in: " << last_message();
}

void build(Model& model, int32_t kinematics, const std::vector<double>* velocity = nullptr) {
  const int d = kinematics == CLEAVE_3D ? 3 : 2;
  const SimplexMesh mesh = patch(d, 3, 0.01, 0.1, 101);
  model.add({CLEAVE_FORMULATION_cbm, CLEAVE_MATERIAL_svk, kinematics}, mesh);
  model.setup();
  if (velocity != nullptr) model.put("velocity", *velocity);
}

TEST(Failure, OverflowIsFoundInTheStepThatMakesIt) {
  for (const int32_t kinematics : {CLEAVE_3D, CLEAVE_PLANE_STRAIN}) {
    Model model;
    std::vector<double> v(kinematics == CLEAVE_3D ? 3 * 64 : 3 * 16, 0.0);
    v[3 * 5] = 1e150;
    build(model, kinematics, &v);
    model.initialise();
    int32_t status = CLEAVE_OK;
    const int step = run_to_failure(model, status);
    EXPECT_EQ(status, CLEAVE_NOT_FINITE);
    EXPECT_GT(step, 0);
    EXPECT_NE(last_message().find("field "), std::string::npos) << last_message();
    EXPECT_NE(last_message().find("step " + std::to_string(step)), std::string::npos)
        << last_message();
    EXPECT_NE(last_message().find("time "), std::string::npos) << last_message();
    EXPECT_NE(last_message().find("particle "), std::string::npos) << last_message();
  }
}

TEST(Failure, FieldAndParticleAreNamed) {
  const struct {
    const char* field;
    double value;
  } table[] = {
      {"external_force", std::nan("")}, {"velocity", INFINITY}, {"velocity", std::nan("")}};
  for (const auto& t : table) {
    Model model;
    build(model, CLEAVE_3D);
    auto values = model.real(t.field);
    values[3 * 17 + 2] = t.value;
    model.put(t.field, values);
    model.initialise();
    int32_t status = CLEAVE_OK;
    const int step = run_to_failure(model, status);
    EXPECT_EQ(status, CLEAVE_NOT_FINITE) << t.field;
    // A velocity is seen as the displacement that it makes.
    expect_message(
        t.field == std::string("velocity") ? "field displacement" : "field external_force", 17,
        step);
    EXPECT_EQ(step, 1);
  }
}

TEST(Failure, LawWithoutAnswerNamesParticleStepAndTime) {
  Model model;
  std::vector<double> v(3 * 16, 0.0);
  for (std::size_t i = 0; i < 16; ++i) {  // pulled apart in both directions
    v[3 * i] = 3e3 * static_cast<double>(i % 4);
    v[3 * i + 1] = 3e3 * static_cast<double>(i / 4);
  }
  build(model, CLEAVE_PLANE_STRESS, &v);
  model.initialise();
  int32_t status = CLEAVE_OK;
  const int step = run_to_failure(model, status);
  EXPECT_EQ(status, CLEAVE_BAD_JACOBIAN);
  EXPECT_GT(step, 1);
  for (const std::string& part : {std::string("law svk has no answer at particle "),
                                  "step " + std::to_string(step), std::string("time ")})
    EXPECT_NE(last_message().find(part), std::string::npos) << part << " in: " << last_message();
  // The model can still be read, so that a host can save it.
  EXPECT_EQ(model.real("displacement").size(), 48u);
  int64_t n = 0;
  double time = 0;
  ok(cleave_model_clock(model, &n, &time));
  EXPECT_EQ(n, step);
}

TEST(Failure, StartOutsideTheRangeOfTheLawIsRefused) {
  Model model;
  build(model, CLEAVE_PLANE_STRESS);
  auto u = model.real("reference_position");  // twice as long and wide
  model.put("displacement", u);
  EXPECT_EQ(cleave_model_initialise(model, 0.0), CLEAVE_BAD_JACOBIAN);
  for (double& c : u) c *= 0.01;
  model.put("displacement", u);
  model.initialise();  // repaired
}

TEST(Failure, InvertedParticlesAreCountedNotRefused) {
  Model model;
  build(model, CLEAVE_PLANE_STRAIN);
  auto u = model.real("reference_position");
  for (std::size_t i = 0; i < u.size() / 3; ++i) {  // mirrored: det F = -1
    u[3 * i] *= -2;
    u[3 * i + 1] = 0;
  }
  model.put("displacement", u);
  model.initialise();
  EXPECT_EQ(model.counts().inverted, 16);
  for (const double c : model.real("internal_force")) EXPECT_TRUE(std::isfinite(c));
  for (const double c : model.real("cauchy_stress")) EXPECT_EQ(c, 0);
}

}  // namespace
}  // namespace cleave::test
