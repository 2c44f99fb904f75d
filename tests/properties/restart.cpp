// n+m steps equal n steps, restore in a new model, m steps: bitwise, in all fields, with deletions
// before and after the cut and unloading after damage.
#include "support/model.hpp"

namespace cleave::test {
namespace {

constexpr double kSpacing = 0.01;

class Restart : public testing::TestWithParam<Case> {
 protected:
  SimplexMesh mesh() const {
    const int d = dimension_of(GetParam());
    return solid(GetParam(), d == 2 ? 10 : 7, kSpacing, 0.15, 11);
  }
  void build(Model& model) const {
    model.add(GetParam(), mesh(),
              accepted(GetParam(), {{"fracture", "critical_strain", breaking_strain(GetParam())},
                                    {"viscosity", "beta", 0.3},
                                    {"viscosity", "length", kSpacing},
                                    {"stabilisation", "alpha", 0.03},
                                    {"hourglass", "psi", 0.1}}));
    model.setup();
  }
  // A body thrown apart: it breaks, then its pieces swing back.
  void start(Model& model) const {
    const SimplexMesh m = mesh();
    Random random(5);
    std::vector<double> v(m.X.size(), 0.0);
    for (std::size_t i = 0; i < v.size() / 3; ++i) {
      v[3 * i] = 12.0 * (m.X[3 * i] / kSpacing + random());
      v[3 * i + 1] = 8.0 * random();
    }
    model.put("velocity", v);
    model.initialise();
  }
  // Two steps to cut at, others for every case.
  static std::pair<int, int> cuts() {
    const auto& c = GetParam();
    Random random(static_cast<unsigned>(100 * c.formulation + 10 * c.material + c.kinematics));
    const auto between = [&random](int first, int last) {
      return first + static_cast<int>(0.5 * (1 + random()) * (last - first));
    };
    const int cut = between(36, 70);
    return {cut, between(cut + 1, 170)};
  }
};

void copy_state(const Model& from, Model& to) {
  int64_t count = 0;
  ok(cleave_field_count(from, 0, &count));
  for (int64_t k = 0; k < count; ++k) {
    cleave_field f{};
    f.size = sizeof f;
    ok(cleave_field_get(from, 0, k, &f));
    if (f.lifetime != CLEAVE_LIFETIME_SETUP && f.lifetime != CLEAVE_LIFETIME_STATE) continue;
    if (f.type == CLEAVE_REAL) {
      ok(cleave_field_put_real(to, 0, f.name, 0, f.count, from.real(f.name).data()));
    } else {
      ok(cleave_field_put_integer(to, 0, f.name, 0, f.count, from.integer(f.name).data()));
    }
  }
  int64_t step = 0;
  double time = 0;
  ok(cleave_model_clock(from, &step, &time));
  ok(cleave_model_restore(to, step, time));
}

void expect_same(const Model& a, const Model& b) {
  int64_t count = 0;
  ok(cleave_field_count(a, 0, &count));
  for (int64_t k = 0; k < count; ++k) {
    cleave_field f{};
    f.size = sizeof f;
    ok(cleave_field_get(a, 0, k, &f));
    if (f.type == CLEAVE_REAL) {
      EXPECT_EQ(a.real(f.name), b.real(f.name)) << f.name;
    } else {
      EXPECT_EQ(a.integer(f.name), b.integer(f.name)) << f.name;
    }
  }
}

TEST_P(Restart, IsBitwiseInAllFieldsTwice) {
  Model whole, first, second, third;
  for (Model* m : {&whole, &first, &second, &third}) build(*m);
  start(whole);
  start(first);
  const double dt = 0.4 * whole.stable_step();
  const auto [cut, second_cut] = cuts();
  ok(cleave_model_set_threads(second, 2));
  ok(cleave_model_set_threads(third, 3));
  int64_t broken_at_cut = 0;
  for (int n = 0; n < 180; ++n) {
    whole.step(dt);
    if (n < cut) first.step(dt);
    if (n == cut - 1) broken_at_cut = whole.counts().broken;
  }
  if (takes(GetParam(), "fracture")) {
    ASSERT_GT(broken_at_cut, 3);
    ASSERT_GT(whole.counts().broken, broken_at_cut);
  }
  copy_state(first, second);
  expect_same(first, second);
  for (int n = cut; n < second_cut; ++n) second.step(dt);
  copy_state(second, third);
  for (int n = second_cut; n < 180; ++n) third.step(dt);
  expect_same(whole, third);
}

INSTANTIATE_TEST_SUITE_P(Tables, Restart, testing::ValuesIn(all_cases()), case_name);

}  // namespace
}  // namespace cleave::test
