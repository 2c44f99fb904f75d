// All instruction sets of the library give the bits of one point after the other: every law of the
// table, points of every kind, in process through the tables of kernels. That one point in lanes has the
// bits of the law's `respond` is tested with the laws.
#include <cfenv>
#include <cstdlib>
#include <cstring>
#include <limits>

#include "core/instruction_set.hpp"
#include "impact_support.hpp"
#include "material/stress_dispatch.hpp"

CLEAVE_DECLARE_KERNELS(cleave_call::StressKernels, kStressKernels)

namespace cleave::test {
namespace {

constexpr std::size_t kPoints = 403;  // no multiple of any number of lanes

const MaterialEntry& entry(cleave_material law) {
  for (const auto& m : material_table())
    if (m.value == law) return m;
  throw std::logic_error("not in the table");
}

// In SI units.
std::vector<double> properties(cleave_material law) {
  const Strength strength{kRate, kMelt, kHeat, 0.9, true};
  switch (law) {
    case CLEAVE_MATERIAL_j2:
      return {7800, 206.9e9, 0.29, 450e6, 715e6, 129e6, 16.93};
    case CLEAVE_MATERIAL_j2_power:
      return {7800, 206.9e9, 0.29, 450e6, 0.01, 0.2};
    case CLEAVE_MATERIAL_j2_table: {
      std::vector<double> p = {7800, 206.9e9, 0.29, 450e6, 0.02, 520e6, 0.06, 500e6, 0.2, 680e6};
      p.resize(4 + 24, 0.0);
      return p;
    }
    case CLEAVE_MATERIAL_johnson_cook:
      return copper(strength);
    case CLEAVE_MATERIAL_johnson_cook_eos:
      return copper_eos(strength);
    case CLEAVE_MATERIAL_mie_gruneisen:
      return Shock{}.fluid();
    default:
      return {1000, 5e9, 0.3};
  }
}

struct Points {
  std::vector<double> h, volume, history, p, energy, plastic, viscous;
  std::vector<std::int32_t> failed;
  StressResult result;

  StressArrays arrays(const MaterialEntry& law) {
    StressArrays a;
    a.h = h.data();
    a.volume = volume.data();
    a.dt = 1e-8;
    const auto n = static_cast<std::int64_t>(history.size() / kPoints);
    std::int64_t place = 0;
    for (std::size_t k = 0; k < law.history.size(); ++k) {
      a.history.base[k] = history.data() + place;
      a.history.stride[k] = n;
      place += law.history[k].components;
    }
    a.p = p.data();
    a.energy = energy.data();
    a.plastic = plastic.data();
    a.viscous = viscous.data();
    a.failed = failed.data();
    return a;
  }
};

Points start(const MaterialEntry& law) {
  Points r;
  std::size_t components = 0;
  for (const auto& field : law.history) components += static_cast<std::size_t>(field.components);
  r.h.resize(9 * kPoints);
  r.history.assign(components * kPoints, 0.0);
  r.p.assign(9 * kPoints, 7.0);
  for (auto* each : {&r.energy, &r.plastic, &r.viscous}) each->assign(kPoints, 7.0);
  r.failed.assign(kPoints, 7);
  r.volume.assign(kPoints, 1e-9);
  return r;
}
void first_deformation(Points& r, Random& random) {
  for (double& x : r.h) x = 0.03 * random();
}
// These two hand on what is not finite; the others refuse it.
bool refuses(const MaterialEntry& law) {
  return law.value != CLEAVE_MATERIAL_svk && law.value != CLEAVE_MATERIAL_linear_elastic;
}
// Small, large, dead, not finite, inverted, and far by its volume.
void second_deformation(Points& r, const MaterialEntry& law, Random& random) {
  const double sizes[] = {1e-12, 1e-5, 1e-3, 0.01, 0.1, 0.5, 0.0};
  for (std::size_t q = 0; q < kPoints; ++q) {
    const double size = sizes[static_cast<std::size_t>(3.49 + 3.49 * random())];
    const double earlier = q % 3 == 0 ? 0.0 : 1.0;
    for (std::size_t k = 0; k < 9; ++k) r.h[9 * q + k] = earlier * r.h[9 * q + k] + size * random();
    if (q % 17 == 3) r.h[9 * q] = -1.2;
    if (refuses(law)) {
      if (q % 29 == 5) r.h[9 * q + 4] = std::numeric_limits<double>::quiet_NaN();
      if (q % 31 == 7) r.h[9 * q + 1] = std::numeric_limits<double>::infinity();
    }
    if (q % 13 == 6) r.volume[q] = 0;
    if (q % 19 == 8)
      for (const std::size_t k : {0u, 4u, 8u}) r.h[9 * q + k] -= 0.3;
  }
}

template <class T>
bool same(const std::vector<T>& a, const std::vector<T>& b) {
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(T)) == 0;
}
void expect_same(const Points& a, const Points& b, const std::string& what) {
  EXPECT_TRUE(same(a.p, b.p)) << what;
  EXPECT_TRUE(same(a.history, b.history)) << what;
  EXPECT_TRUE(same(a.energy, b.energy)) << what;
  EXPECT_TRUE(same(a.plastic, b.plastic)) << what;
  EXPECT_TRUE(same(a.viscous, b.viscous)) << what;
  EXPECT_TRUE(same(a.failed, b.failed)) << what;
}

// The plane conditions that the law knows.
std::vector<Kinematics> known(const MaterialEntry& law) {
  std::vector<Kinematics> all = {CLEAVE_3D, CLEAVE_PLANE_STRAIN};
  if (law.value != CLEAVE_MATERIAL_mie_gruneisen) all.push_back(CLEAVE_PLANE_STRESS);
  return all;
}
// The law in lanes, or NULL.
const void* in_lanes(const Material& material) {
  return with_law(material, [](const auto& law) -> const void* {
    if constexpr (LaneLaw<std::decay_t<decltype(law)>>) {
      if (law.in_lanes()) return &law;
    }
    return nullptr;
  });
}
cleave_call::StressKernel kernel(const Material& material, InstructionSet set, int dimension) {
  return CLEAVE_KERNELS(kStressKernels).in(set).update[material.index() - 1][dimension - 2];
}
constexpr auto kCount = static_cast<std::int64_t>(kPoints);

// Without lanes.
void one_by_one(const Material& material, int dimension, const StressArrays& a) {
  for (std::int64_t q = 0; q < kCount; ++q) {
    if (const void* law = in_lanes(material))
      kernel(material, InstructionSet::baseline, dimension)(law, a, q, q + 1);
    else
      update_stress(material, dimension, a, q, q + 1);
  }
}

class EveryLaw : public ::testing::TestWithParam<cleave_material> {};

TEST_P(EveryLaw, HasTheSameBitsInAllInstructionSets) {
  const MaterialEntry& law = entry(GetParam());
  for (const Kinematics kinematics : known(law)) {
    const Material material = law.make(properties(law.value), kinematics);
    const int dimension = kinematics == CLEAVE_3D ? 3 : 2;
    Random random(61);
    Points one = start(law);
    first_deformation(one, random);
    one_by_one(material, dimension, one.arrays(law));
    second_deformation(one, law, random);
    const Points before = one;
    one_by_one(material, dimension, one.arrays(law));
    const auto failures = std::count(one.failed.begin(), one.failed.end(), 1);
    EXPECT_EQ(failures > 20, refuses(law)) << failures;

    Points chosen = before;
    chosen.result = update_stress(material, dimension, chosen.arrays(law), 0, kCount);
    expect_same(one, chosen, text("dispatched, kinematics ", static_cast<int>(kinematics)));
    const void* typed = in_lanes(material);
    if (typed == nullptr) continue;
    for (int s = 0; s < kInstructionSets; ++s) {
      const auto set = static_cast<InstructionSet>(s);
      if (!available(set)) continue;
      Points lanes = before;
      lanes.result = kernel(material, set, dimension)(typed, lanes.arrays(law), 0, kCount);
      const auto what = text(name_of(set), ", kinematics ", static_cast<int>(kinematics));
      expect_same(one, lanes, what);
      EXPECT_EQ(chosen.result.plastic, lanes.result.plastic) << what;
      EXPECT_EQ(chosen.result.viscous, lanes.result.viscous) << what;
      EXPECT_EQ(chosen.result.first_failed, lanes.result.first_failed) << what;
    }
  }
}

#if defined(__GLIBC__)
// Hosts run with traps on, NaN and infinity in the input included.
TEST_P(EveryLaw, RaisesNoFloatingPointExceptionInAnyInstructionSet) {
  const MaterialEntry& law = entry(GetParam());
  for (const Kinematics kinematics : known(law)) {
    const Material material = law.make(properties(law.value), kinematics);
    const int dimension = kinematics == CLEAVE_3D ? 3 : 2;
    Random random(62);
    Points run = start(law);
    first_deformation(run, random);
    second_deformation(run, law, random);
    std::feclearexcept(FE_ALL_EXCEPT);
    feenableexcept(FE_INVALID | FE_DIVBYZERO | FE_OVERFLOW);
    update_stress(material, dimension, run.arrays(law), 0, kCount);
    std::feclearexcept(FE_ALL_EXCEPT);
    fedisableexcept(FE_INVALID | FE_DIVBYZERO | FE_OVERFLOW);
  }
}
#endif

std::string law_name(const ::testing::TestParamInfo<cleave_material>& info) {
  return entry(info.param).name;
}
constexpr cleave_material kLaws[] = {
#define CLEAVE_MATERIAL(name, value, type, title, source) CLEAVE_MATERIAL_##name,
#include "cleave/tables/materials.def"
};
INSTANTIATE_TEST_SUITE_P(InstructionSets, EveryLaw, ::testing::ValuesIn(kLaws), law_name);

TEST(InstructionSets, TheBestIsChosenUpToACeiling) {
  if (std::getenv("CLEAVE_INSTRUCTION_SET") != nullptr) GTEST_SKIP() << "one was asked for";
  EXPECT_TRUE(available(InstructionSet::baseline));
  EXPECT_EQ(instruction_set(InstructionSet::baseline), InstructionSet::baseline);
  EXPECT_LE(instruction_set(InstructionSet::avx2), InstructionSet::avx2);
  EXPECT_TRUE(available(instruction_set()));
}

}  // namespace
}  // namespace cleave::test
