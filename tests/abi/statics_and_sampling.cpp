// The functions of statics and of interpolation, misused: NULL, ranges, sizes, order; and what an error
// leaves behind.
#include <cmath>
#include <limits>

#include "abi/arguments.hpp"

namespace cleave::test {
namespace {

TEST_F(Arguments, NullIsRefusedByStaticsAndSampling) {
  const double X[3] = {0.5, 0.5, 0.5};
  double weight[4] = {1, 0, 0, 0};
  int64_t simplex = 0;
  expect_refused(
      {{"cleave_static_options_init", "'options'",
        [] { return cleave_static_options_init(nullptr); }},
       {"cleave_model_solve_static", "'model'",
        [] { return cleave_model_solve_static(nullptr, 0, nullptr, nullptr); }},
       {"cleave_relaxation_options_init", "'options'",
        [] { return cleave_relaxation_options_init(nullptr); }},
       {"cleave_model_relax", "'model'",
        [] { return cleave_model_relax(nullptr, 0, nullptr, nullptr); }},
       {"cleave_model_relax_cancel", "'model'", [] { return cleave_model_relax_cancel(nullptr); }},
       {"cleave_body_locate", "'model'",
        [&] { return cleave_body_locate(nullptr, 0, 1, X, &simplex, weight); }},
       {"cleave_body_locate", "'X'",
        [&] { return cleave_body_locate(ready, 0, 1, nullptr, &simplex, weight); }},
       {"cleave_body_locate", "'simplex'",
        [&] { return cleave_body_locate(ready, 0, 1, X, nullptr, weight); }},
       {"cleave_body_locate", "'weight'",
        [&] { return cleave_body_locate(ready, 0, 1, X, &simplex, nullptr); }},
       {"cleave_field_interpolate", "'model'",
        [&] { return cleave_field_interpolate(nullptr, 0, "mass", 1, &simplex, weight, &real); }},
       {"cleave_field_interpolate", "'name'",
        [&] { return cleave_field_interpolate(ready, 0, nullptr, 1, &simplex, weight, &real); }},
       {"cleave_field_interpolate", "'simplex'",
        [&] { return cleave_field_interpolate(ready, 0, "mass", 1, nullptr, weight, &real); }},
       {"cleave_field_interpolate", "'weight'",
        [&] { return cleave_field_interpolate(ready, 0, "mass", 1, &simplex, nullptr, &real); }},
       {"cleave_field_interpolate", "'values'",
        [&] { return cleave_field_interpolate(ready, 0, "mass", 1, &simplex, weight, nullptr); }}},
      CLEAVE_NULL_ARGUMENT);
}

TEST_F(Arguments, SamplingRefusesWhatHasNoValueAtAPoint) {
  const double X[3] = {0.5, 0.5, 0.5};
  double weight[4] = {1, 0, 0, 0};
  int64_t simplex = 0;
  const int64_t below = -2;
  expect_refused(
      {{"cleave_body_locate", "count is -1",
        [&] { return cleave_body_locate(ready, 0, -1, X, &simplex, weight); }},
       {"cleave_body_locate", "body 1",
        [&] { return cleave_body_locate(ready, 1, 1, X, &simplex, weight); }},
       {"cleave_field_interpolate", "count is -1",
        [&] { return cleave_field_interpolate(ready, 0, "mass", -1, &simplex, weight, &real); }},
       {"cleave_field_interpolate", "no value at a point",
        [&] {
          return cleave_field_interpolate(ready, 0, "critical_strain", 1, &simplex, weight, &real);
        }},
       {"cleave_field_interpolate", "no value at a point",
        [&] { return cleave_field_interpolate(ready, 0, "ledger", 1, &simplex, weight, &real); }}},
      CLEAVE_BAD_ARGUMENT);
  expect_refused(
      {{"cleave_field_interpolate", "simplex 48 of point 0 does not exist",
        [&] { return cleave_field_interpolate(ready, 0, "mass", 1, &m, weight, &real); }},
       {"cleave_field_interpolate", "simplex -2",
        [&] { return cleave_field_interpolate(ready, 0, "mass", 1, &below, weight, &real); }}},
      CLEAVE_BAD_RANGE);
  expect_refused({{"cleave_field_interpolate", "integers",
                   [&] {
                     return cleave_field_interpolate(ready, 0, "simplex_alive", 1, &simplex, weight,
                                                     &real);
                   }}},
                 CLEAVE_WRONG_TYPE);
  expect_refused(
      {{"cleave_field_interpolate", "velocity",
        [&] { return cleave_field_interpolate(ready, 0, "speed", 1, &simplex, weight, &real); }}},
      CLEAVE_UNKNOWN_NAME);
  for (const double bad : {std::nan(""), std::numeric_limits<double>::infinity()}) {
    const double Y[3] = {0.5, bad, 0.5};
    expect_refused({{"cleave_body_locate", "point 0",
                     [&] { return cleave_body_locate(ready, 0, 1, Y, &simplex, weight); }}},
                   CLEAVE_NOT_FINITE);
  }
  // Nothing asked, nothing needed; far away is outside, not an error.
  ok(cleave_body_locate(ready, 0, 0, nullptr, nullptr, nullptr));
  ok(cleave_field_interpolate(ready, 0, "mass", 0, nullptr, nullptr, nullptr));
  const double far_away[3] = {1e300, -1e300, 0.5};
  ok(cleave_body_locate(ready, 0, 1, far_away, &simplex, weight));
  EXPECT_EQ(simplex, -1);
  double velocity[3] = {7, 7, 7};
  ok(cleave_field_interpolate(ready, 0, "velocity", 1, &simplex, weight, velocity));
  for (const double v : velocity) EXPECT_EQ(v, 0.0);
}

TEST_F(Arguments, StaticsAndSamplingHaveTheirPlaceInTheOrder) {
  const double X[3] = {0.5, 0.5, 0.5};
  double weight[4] = {1, 0, 0, 0};
  int64_t simplex = 0;
  expect_refused(
      {{"cleave_body_locate", "cleave_model_setup",
        [&] { return cleave_body_locate(fresh, 0, 1, X, &simplex, weight); }},
       {"cleave_field_interpolate", "cleave_model_setup",
        [&] { return cleave_field_interpolate(fresh, 0, "mass", 1, &simplex, weight, &real); }},
       {"cleave_model_solve_static", "cleave_model_initialise",
        [&] { return cleave_model_solve_static(fresh, 1, nullptr, nullptr); }},
       {"cleave_model_solve_static", "cleave_model_initialise",
        [&] { return cleave_model_solve_static(ready, 1, nullptr, nullptr); }},
       {"cleave_model_relax", "cleave_model_initialise",
        [&] { return cleave_model_relax(fresh, 1, nullptr, nullptr); }},
       {"cleave_model_relax", "cleave_model_initialise",
        [&] { return cleave_model_relax(ready, 1, nullptr, nullptr); }},
       {"cleave_model_relax_cancel", "nothing is being relaxed",
        [&] { return cleave_model_relax_cancel(ready); }}},
      CLEAVE_WRONG_ORDER);
  ready.initialise();
  ok(cleave_model_advance(ready, 1e-9, 1e-9));
  expect_refused({{"cleave_model_solve_static", "between two steps",
                   [&] { return cleave_model_solve_static(ready, 1, nullptr, nullptr); }},
                  {"cleave_model_relax", "between two steps",
                   [&] { return cleave_model_relax(ready, 1, nullptr, nullptr); }}},
                 CLEAVE_WRONG_ORDER);
}

// A held block of finite elements: solvable.
class StaticCall : public testing::Test {
 protected:
  StaticCall() {
    const SimplexMesh mesh = patch(2, 3, 1.0, 0.1, 5);
    model.add({CLEAVE_FORMULATION_fem, CLEAVE_MATERIAL_svk, CLEAVE_PLANE_STRAIN}, mesh);
    const int64_t particle[3] = {0, 0, 1};
    const int32_t direction[3] = {0, 1, 1};
    const int32_t motion[3] = {CLEAVE_MOTION_EXACT, CLEAVE_MOTION_EXACT, CLEAVE_MOTION_EXACT};
    ok(cleave_body_prescribe(model, 0, 3, particle, direction, motion));
    model.setup();
    model.initialise();
    const double u[3] = {0, 0, 1e-3};
    ok(cleave_body_motion(model, 0, 3, u, nullptr));
    ok(cleave_static_options_init(&options));
  }
  int64_t steps() {
    int64_t step = 0;
    double time = 0;
    ok(cleave_model_clock(model, &step, &time));
    return step;
  }
  Model model;
  cleave_static_options options{};
};

TEST_F(StaticCall, OptionsHaveDefaultsAndASize) {
  EXPECT_EQ(options.size, static_cast<int64_t>(sizeof options));
  EXPECT_EQ(options.tolerance, 1e-9);
  EXPECT_EQ(options.max_iterations, 25);
  cleave_static_options wrong = options;
  for (const int64_t size : {int64_t{0}, int64_t{4096}}) {
    wrong.size = size;
    cleave_static_report report{};
    report.size = size;
    expect_refused({{"cleave_model_solve_static", "cleave_static_options_init",
                     [&] { return cleave_model_solve_static(model, 1, &wrong, nullptr); }},
                    {"cleave_model_solve_static", "'report'",
                     [&] { return cleave_model_solve_static(model, 1, &options, &report); }}},
                   CLEAVE_ABI_MISMATCH);
  }
  EXPECT_EQ(steps(), 0);  // refused before anything moved
}

TEST_F(StaticCall, NumbersOutsideTheirRangeAreRefused) {
  for (const double tolerance : {0.0, -1.0, std::nan("")}) {
    cleave_static_options wrong = options;
    wrong.tolerance = tolerance;
    expect_refused({{"cleave_model_solve_static", "tolerance is",
                     [&] { return cleave_model_solve_static(model, 1, &wrong, nullptr); }}},
                   CLEAVE_BAD_ARGUMENT);
  }
  cleave_static_options wrong = options;
  wrong.max_iterations = 0;
  expect_refused({{"cleave_model_solve_static", "max_iterations 0",
                   [&] { return cleave_model_solve_static(model, 1, &wrong, nullptr); }}},
                 CLEAVE_BAD_ARGUMENT);
  EXPECT_EQ(steps(), 0);
}

TEST_F(StaticCall, ReportsWhatItDid) {
  cleave_static_report report{};
  report.size = sizeof report;
  ok(cleave_model_solve_static(model, 2.5, &options, &report));
  EXPECT_EQ(report.size, static_cast<int64_t>(sizeof report));
  EXPECT_EQ(report.unknowns, 2 * 16 - 3);
  EXPECT_GE(report.iterations, 1);
  EXPECT_LE(report.residual, options.tolerance);
  int64_t step = 0;
  double time = 0;
  ok(cleave_model_clock(model, &step, &time));
  EXPECT_EQ(step, 1);
  EXPECT_EQ(time, 2.5);
  for (const double v : model.real("velocity")) EXPECT_EQ(v, 0.0);
}

TEST_F(StaticCall, RelaxationRefusesWhatIsOutOfRange) {
  cleave_relaxation_options relaxation{};
  ok(cleave_relaxation_options_init(&relaxation));
  EXPECT_EQ(relaxation.size, static_cast<int64_t>(sizeof relaxation));
  EXPECT_EQ(relaxation.tolerance, 1e-6);
  EXPECT_EQ(relaxation.max_iterations, 100000);
  EXPECT_EQ(relaxation.slice, 0);
  EXPECT_EQ(relaxation.breaking, CLEAVE_BREAKING_ALL);
  cleave_relaxation_options bad = relaxation;
  const auto refused = [&](const char* part) {
    expect_refused(
        {{"cleave_model_relax", part, [&] { return cleave_model_relax(model, 1, &bad, nullptr); }}},
        CLEAVE_BAD_ARGUMENT);
    bad = relaxation;
  };
  bad.tolerance = std::nan("");
  refused("tolerance is nan");
  bad.max_iterations = 0;
  refused("max_iterations 0");
  bad.slice = -1;
  refused("slice -1");
  bad.breaking = 4;
  refused("CLEAVE_BREAKING_ONE");
  bad.size = 8;
  cleave_relaxation_report report{};
  report.size = 4096;
  expect_refused({{"cleave_model_relax", "cleave_relaxation_options_init",
                   [&] { return cleave_model_relax(model, 1, &bad, nullptr); }},
                  {"cleave_model_relax", "'report'",
                   [&] { return cleave_model_relax(model, 1, &relaxation, &report); }}},
                 CLEAVE_ABI_MISMATCH);
  EXPECT_EQ(steps(), 0);
  report.size = sizeof report;
  ok(cleave_model_relax(model, 2.5, &relaxation, &report));
  EXPECT_EQ(report.unknowns, 2 * 16 - 3);
  EXPECT_EQ(report.finished, 1);
  EXPECT_EQ(steps(), 1);
}

}  // namespace
}  // namespace cleave::test
