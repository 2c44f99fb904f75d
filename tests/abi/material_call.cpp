// The material update in the layouts of hosts: the same bits wherever the numbers stand, nothing
// written between them, failed points one by one, disjoint ranges from several threads.
#include <cmath>
#include <cstring>
#include <thread>

#include "support/model.hpp"

namespace cleave::test {
namespace {

constexpr std::int64_t kPoints = 203;
constexpr double kUntouched = -77.0;
const std::vector<double> kSteel = {7.8e-9, 206.9e3, 0.29, 450, 715, 129.24, 16.93};

// Places of 11 21 31 12 22 32 13 23 33 in 11 22 33 12 23 31 21 32 13, and as they are.
constexpr std::int64_t kPlain[9] = {0, 1, 2, 3, 4, 5, 6, 7, 8};
constexpr std::int64_t kExplicit[9] = {0, 6, 5, 3, 1, 7, 8, 4, 2};

struct Layout {
  std::int64_t point, component;
  const std::int64_t* order;
};

// An array of `components` numbers a point in a layout, with room around.
struct Array {
  Array(std::int64_t components, const Layout& l)
      : layout(l),
        values(static_cast<std::size_t>(l.point * kPoints + l.component * components + 5),
               kUntouched) {}
  double& at(std::int64_t q, std::int64_t c) {
    return values[static_cast<std::size_t>(layout.point * q + layout.component * c)];
  }
  double& tensor(std::int64_t q, std::size_t k) { return at(q, layout.order[k]); }
  Layout layout;
  std::vector<double> values;
};

struct Host {
  Host(const Layout& tensors, const Layout& state)
      : deformation(9, tensors),
        history(8, state),
        stress(9, tensors),
        tangent(81, {81, 1, kPlain}) {
    Random random(51);
    for (std::int64_t q = 0; q < kPoints; ++q) {
      for (std::size_t k = 0; k < 9; ++k)
        deformation.tensor(q, k) = (q % 3 == 0 ? 1e-3 : 0.05) * random();
      if (failing(q)) deformation.tensor(q, 0) = -1.5;
      for (std::int64_t c = 0; c < 8; ++c) history.at(q, c) = c == 6 ? 0.01 : 0.0;
    }
    energy.assign(2 * kPoints, kUntouched);
    plastic.assign(kPoints, kUntouched);
    failed.assign(3 * kPoints, -7);
  }
  static bool failing(std::int64_t q) { return q % 23 == 11; }
  cleave_material_call call(std::int64_t first = 0, std::int64_t last = kPoints) {
    cleave_material_call c;
    ok(cleave_material_call_init(&c));
    c.material = CLEAVE_MATERIAL_j2;
    c.kinematics = kinematics;
    c.property_count = 7;
    c.properties = kSteel.data();
    c.first = first;
    c.last = last;
    c.deformation = deformation.values.data();
    c.deformation_point = deformation.layout.point;
    c.deformation_component = deformation.layout.component;
    std::copy_n(deformation.layout.order, 9, c.deformation_order);
    c.history = history.values.data();
    c.history_point = history.layout.point;
    c.history_component = history.layout.component;
    c.stress = stress.values.data();
    c.stress_point = stress.layout.point;
    c.stress_component = stress.layout.component;
    std::copy_n(stress.layout.order, 9, c.stress_order);
    c.energy = energy.data();
    c.energy_point = 2;
    c.plastic = plastic.data();
    c.failed = failed.data();
    c.failed_point = 3;
    c.tangent = tangent.values.data();
    return c;
  }
  std::int32_t kinematics = CLEAVE_3D;
  Array deformation, history, stress, tangent;
  std::vector<double> energy, plastic;
  std::vector<std::int32_t> failed;
};

const Layout kByPoint = {9, 1, kPlain};            // a(9,n)
const Layout kByComponent = {1, kPoints, kPlain};  // a(n,9)
const Layout kPadded = {1, kPoints + 13, kPlain};  // leading dimension larger than n
const Layout kPaddedPoint = {14, 1, kPlain};
const Layout kPermuted = {1, kPoints, kExplicit};
const Layout kStatePoint = {8, 1, kPlain}, kStateComponent = {1, kPoints, kPlain},
             kStatePadded = {11, 1, kPlain};

void expect_same(Host& a, Host& b) {
  for (std::int64_t q = 0; q < kPoints; ++q) {
    for (std::size_t k = 0; k < 9; ++k) ASSERT_EQ(a.stress.tensor(q, k), b.stress.tensor(q, k));
    for (std::int64_t c = 0; c < 8; ++c) ASSERT_EQ(a.history.at(q, c), b.history.at(q, c));
  }
  EXPECT_EQ(a.energy, b.energy);
  EXPECT_EQ(a.plastic, b.plastic);
  EXPECT_EQ(a.failed, b.failed);
}

class MaterialCall : public testing::TestWithParam<int32_t> {};

TEST_P(MaterialCall, ServesEveryLayoutWithTheSameBits) {
  Host plain(kByPoint, kStatePoint);
  plain.kinematics = GetParam();
  auto call = plain.call();
  EXPECT_EQ(cleave_material_update(&call), CLEAVE_BAD_JACOBIAN);
  EXPECT_NE(last_message().find("point 11"), std::string::npos) << last_message();
  call.index_base = 1;
  EXPECT_EQ(cleave_material_update(&call), CLEAVE_BAD_JACOBIAN);
  EXPECT_NE(last_message().find("point 12"), std::string::npos) << last_message();
  plain = Host(kByPoint, kStatePoint);
  plain.kinematics = GetParam();
  call = plain.call();
  cleave_material_update(&call);
  for (std::int64_t q = 0; q < kPoints; ++q) {
    EXPECT_EQ(plain.failed[static_cast<std::size_t>(3 * q)], Host::failing(q)) << q;
    EXPECT_EQ(plain.failed[static_cast<std::size_t>(3 * q + 1)], -7);
    EXPECT_EQ(plain.energy[static_cast<std::size_t>(2 * q + 1)], kUntouched);
    if (!Host::failing(q)) continue;
    for (std::size_t k = 0; k < 9; ++k) EXPECT_EQ(plain.stress.tensor(q, k), 0);
    for (std::int64_t c = 0; c < 8; ++c) EXPECT_EQ(plain.history.at(q, c), c == 6 ? 0.01 : 0.0);
  }
  const std::pair<Layout, Layout> others[] = {{kByComponent, kStateComponent},
                                              {kPadded, kStateComponent},
                                              {kPaddedPoint, kStatePadded},
                                              {kPermuted, kStateComponent},
                                              {kPermuted, kStatePoint}};
  for (const auto& [tensors, state] : others) {
    Host host(tensors, state);
    host.kinematics = GetParam();
    const auto before = host.deformation.values;
    call = host.call();
    EXPECT_EQ(cleave_material_update(&call), CLEAVE_BAD_JACOBIAN);
    expect_same(plain, host);
    EXPECT_EQ(before, host.deformation.values);
    // Nothing between and behind the numbers is written.
    std::int64_t untouched = 0;
    for (const double x : host.stress.values) untouched += x == kUntouched;
    EXPECT_EQ(untouched, static_cast<std::int64_t>(host.stress.values.size()) - 9 * kPoints);
  }
}

TEST_P(MaterialCall, IsTheSimpleCall) {
  Host host(kByPoint, kStatePoint), simple(kByPoint, kStatePoint);
  host.kinematics = GetParam();
  auto call = host.call();
  cleave_material_update(&call);
  std::vector<double> energy(kPoints);
  cleave_material_stress(CLEAVE_MATERIAL_j2, GetParam(), 7, kSteel.data(), 0, kPoints,
                         simple.deformation.values.data(), simple.history.values.data(),
                         simple.stress.values.data(), energy.data(), nullptr);
  EXPECT_EQ(host.stress.values, simple.stress.values);
  EXPECT_EQ(host.history.values, simple.history.values);
}

TEST_P(MaterialCall, MayBeSplitAmongThreads) {
  Host whole(kByPoint, kStatePoint), split(kByComponent, kStateComponent);
  whole.kinematics = split.kinematics = GetParam();
  auto call = whole.call();
  cleave_material_update(&call);
  std::vector<std::thread> threads;
  const std::int64_t cuts[] = {0, 37, 90, 151, kPoints};
  for (std::size_t k = 0; k < 4; ++k)
    threads.emplace_back([&split, first = cuts[k], last = cuts[k + 1]] {
      auto part = split.call(first, last);
      cleave_material_update(&part);
    });
  for (auto& t : threads) t.join();
  expect_same(whole, split);
}

// F instead of H: the strains of this test are large enough for F.
TEST_P(MaterialCall, TakesTheDeformationGradient) {
  Host h(kByPoint, kStatePoint), f(kByPoint, kStatePoint);
  h.kinematics = f.kinematics = GetParam();
  for (std::int64_t q = 0; q < kPoints; ++q)
    for (const std::size_t k : {0u, 4u, 8u}) {
      f.deformation.tensor(q, k) += 1;
      h.deformation.tensor(q, k) = f.deformation.tensor(q, k) - 1;
    }
  auto call = h.call();
  cleave_material_update(&call);
  call = f.call();
  call.deformation_is_F = 1;
  cleave_material_update(&call);
  expect_same(h, f);
}

// By central differences of the update, the history before the step the same for both.
TEST_P(MaterialCall, GivesTheTangentInTheOrdersOfTheHost) {
  Host host(kPermuted, kStateComponent);
  host.kinematics = GetParam();
  const auto history = host.history.values;
  auto call = host.call();
  EXPECT_EQ(cleave_material_tangent(&call), CLEAVE_BAD_JACOBIAN);
  EXPECT_EQ(history, host.history.values);
  const std::size_t d = GetParam() == CLEAVE_3D ? 3 : 2;
  const double step = 1e-6;
  double worst = 0;
  for (std::size_t l = 0; l < d; ++l)
    for (std::size_t k = 0; k < d; ++k) {
      Host more(kPermuted, kStateComponent), less(kPermuted, kStateComponent);
      more.kinematics = less.kinematics = GetParam();
      for (std::int64_t q = 0; q < kPoints; ++q) {
        more.deformation.tensor(q, k + 3 * l) += step;
        less.deformation.tensor(q, k + 3 * l) -= step;
      }
      call = more.call();
      cleave_material_update(&call);
      call = less.call();
      cleave_material_update(&call);
      for (std::int64_t q = 0; q < kPoints; ++q)
        for (std::size_t j = 0; j < d; ++j)
          for (std::size_t i = 0; i < d; ++i) {
            const double a = host.tangent.at(q, kExplicit[i + 3 * j] + 9 * kExplicit[k + 3 * l]);
            if (Host::failing(q)) {
              EXPECT_EQ(a, 0);
              continue;
            }
            const double slope =
                (more.stress.tensor(q, i + 3 * j) - less.stress.tensor(q, i + 3 * j)) / (2 * step);
            worst = std::fmax(worst, std::fabs(a - slope) / 3e5);
          }
    }
  EXPECT_LT(worst, 1e-7);
  EXPECT_GT(worst, 0);
}

INSTANTIATE_TEST_SUITE_P(Kinematics, MaterialCall,
                         testing::Values(CLEAVE_3D, CLEAVE_PLANE_STRAIN, CLEAVE_PLANE_STRESS));

TEST(MaterialCallArguments, AreCheckedWithARemedy) {
  Host host(kByPoint, kStatePoint);
  const auto refused = [&](std::int32_t status, const char* part, auto change) {
    auto call = host.call();
    change(call);
    EXPECT_EQ(cleave_material_update(&call), status);
    EXPECT_NE(last_message().find(part), std::string::npos) << last_message();
    EXPECT_EQ(cleave_material_tangent(&call), status);
  };
  using Call = cleave_material_call;
  refused(CLEAVE_ABI_MISMATCH, "cleave_material_call_init", [](Call& c) { c.size = 8; });
  refused(CLEAVE_BAD_RANGE, "range", [](Call& c) { c.first = 5, c.last = 4; });
  refused(CLEAVE_BAD_ARGUMENT, "dt is -1", [](Call& c) { c.dt = -1; });
  refused(CLEAVE_BAD_ARGUMENT, "index_base is 7", [](Call& c) { c.index_base = 7; });
  refused(CLEAVE_BAD_ARGUMENT, "length is", [](Call& c) { c.length = -2; });
  refused(CLEAVE_NULL_ARGUMENT, "'deformation'", [](Call& c) { c.deformation = nullptr; });
  refused(CLEAVE_NULL_ARGUMENT, "'history'", [](Call& c) { c.history = nullptr; });
  refused(CLEAVE_BAD_ARGUMENT, "deformation_order[2] and [3] are both 2",
          [](Call& c) { c.deformation_order[3] = 2; });
  refused(CLEAVE_BAD_ARGUMENT, "stress_order[0] is 9", [](Call& c) { c.stress_order[0] = 9; });
  refused(CLEAVE_UNKNOWN_NAME, "j2_table", [](Call& c) { c.material = 4711; });
  auto call = host.call();
  call.stress = nullptr;
  EXPECT_EQ(cleave_material_update(&call), CLEAVE_NULL_ARGUMENT);
  call.tangent = nullptr;
  EXPECT_EQ(cleave_material_tangent(&call), CLEAVE_NULL_ARGUMENT);
  EXPECT_EQ(cleave_material_update(nullptr), CLEAVE_NULL_ARGUMENT);
  EXPECT_EQ(cleave_material_tangent(nullptr), CLEAVE_NULL_ARGUMENT);
  EXPECT_EQ(cleave_material_call_init(nullptr), CLEAVE_NULL_ARGUMENT);
}

}  // namespace
}  // namespace cleave::test
