// The batched stress update has the bits of one point after the other: for any width, any split of the
// range and any neighbours, elastic, plastic, far outside the series, degenerate and dead.
#include <cfenv>
#include <cstring>
#include <limits>

#include "j2_support.hpp"
#include "material/stress.hpp"

namespace cleave::test {
namespace {

constexpr std::int64_t kPoints = 1500;

struct Field {
  std::vector<double> h, volume, history, p, energy, plastic;
  std::vector<std::int32_t> failed;

  StressArrays arrays() {
    StressArrays a;
    a.h = h.data();
    a.volume = volume.data();
    const int offset[3] = {0, 6, 7};
    for (std::size_t k = 0; k < 3; ++k) {
      a.history.base[k] = history.data() + offset[k];
      a.history.stride[k] = 8;
    }
    a.p = p.data();
    a.energy = energy.data();
    a.plastic = plastic.data();
    a.failed = failed.data();
    return a;
  }
};

// Points of every kind in random order; the history is that of an earlier step of another kind.
Field random_field(unsigned seed) {
  Random random(seed);
  Field f;
  const auto n = static_cast<std::size_t>(kPoints);
  f.h.resize(9 * n);
  f.history.assign(8 * n, 0.0);
  f.p.assign(9 * n, 7.0);
  f.energy.assign(n, 7.0);
  f.plastic.assign(n, 7.0);
  f.failed.assign(n, 7);
  f.volume.assign(n, 1e-3);
  const double sizes[] = {1e-12, 1e-5, 1e-3, 3e-3, 1e-2, 0.05, 0.3, 1.5, 0.0};
  for (std::size_t q = 0; q < n; ++q) {
    const double size = sizes[static_cast<std::size_t>(4.49 + 4.49 * random())];
    for (std::size_t k = 0; k < 9; ++k) f.h[9 * q + k] = size * random();
    const double earlier = sizes[static_cast<std::size_t>(2.0 + 1.99 * random())];
    for (std::size_t k = 0; k < 6; ++k) f.history[8 * q + k] = earlier * random();
    f.history[8 * q + 6] = 0.2 * std::fabs(random());
    if (q % 17 == 3) f.h[9 * q] = -1.2;
    if (q % 29 == 5) f.h[9 * q + 4] = std::numeric_limits<double>::quiet_NaN();
    if (q % 31 == 7) f.h[9 * q + 1] = std::numeric_limits<double>::infinity();
    if (q % 37 == 2) f.history[8 * q + 6] = -0.1;
    if (q % 41 == 4) f.history[8 * q + 2] = -1.5;
    if (q % 13 == 6) f.volume[q] = 0;
    if (q % 19 == 8)
      for (std::size_t k : {0u, 4u, 8u}) f.h[9 * q + k] -= 0.3;  // leaves the radius by its volume
  }
  return f;
}

bool same(const std::vector<double>& a, const std::vector<double>& b) {
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(double)) == 0;
}
void expect_same(const Field& a, const Field& b) {
  EXPECT_TRUE(same(a.p, b.p));
  EXPECT_TRUE(same(a.history, b.history));
  EXPECT_TRUE(same(a.energy, b.energy));
  EXPECT_TRUE(same(a.plastic, b.plastic));
  EXPECT_EQ(a.failed, b.failed);
}

template <int D, int W, class Law>
void update_in_packs(const Law& law, Field& f) {
  const StressArrays a = f.arrays();
  stress_update::Sums sums(0);
  stress_update::update_batches<D, W>(law, a, 0, kPoints, sums);
}

template <int D, class Law>
void compare(const Law& law) {
  Field one = random_field(31), all = one, halves = one, two = one;
  const StressResult a = update_stress_pointwise<D>(law, one.arrays(), 0, kPoints);
  const StressResult b = update_stress<D>(law, all.arrays(), 0, kPoints);
  EXPECT_EQ(a.plastic, b.plastic);
  EXPECT_EQ(a.first_failed, b.first_failed);
  std::int64_t failures = 0, flowing = 0;
  for (std::size_t q = 0; q < all.failed.size(); ++q) {
    failures += all.failed[q];
    flowing += all.plastic[q] > 0;
  }
  EXPECT_GT(failures, kPoints / 10);
  EXPECT_GT(flowing, kPoints / 4);
  expect_same(one, all);
  for (std::int64_t first = 0, width = 1; first < kPoints; first += width, width = 1 + width % 11)
    update_stress<D>(law, halves.arrays(), first, std::min(kPoints, first + width));
  expect_same(one, halves);
  update_in_packs<D, 2>(law, two);
  expect_same(one, two);
}

std::vector<double> table_properties() {
  std::vector<double> p = {7.8e-9, kE, kNu, 450};
  p.resize(4 + 24, 0.0);
  const double curve[] = {0.02, 520, 0.06, 500, 0.2, 680};
  std::copy(std::begin(curve), std::end(curve), p.begin() + 4);
  return p;
}

TEST(J2Batch, HasTheBitsOfTheScalarPath) {
  compare<3>(J2Voce(kSteel, CLEAVE_3D));
  compare<2>(J2Voce(kSteel, CLEAVE_PLANE_STRAIN));
  compare<3>(J2Power(std::vector<double>{7.8e-9, kE, kNu, 450, 0.01, 0.2}, CLEAVE_3D));
  compare<3>(J2Table(table_properties(), CLEAVE_3D));
}

#if defined(__GLIBC__)
// Hosts run with traps on, NaN and infinite input included.
TEST(J2Batch, RaisesNoFloatingPointException) {
  const int traps = FE_INVALID | FE_DIVBYZERO | FE_OVERFLOW;
  Field f = random_field(32);
  for (const Kinematics k : {CLEAVE_3D, CLEAVE_PLANE_STRAIN, CLEAVE_PLANE_STRESS}) {
    const J2Voce voce(kSteel, k);
    const J2Power power(std::vector<double>{7.8e-9, kE, kNu, 450, 0.01, 0.2}, k);
    const J2Table table(table_properties(), k);
    Field a = f, b = f, c = f;
    std::feclearexcept(FE_ALL_EXCEPT);
    feenableexcept(traps);
    if (k == CLEAVE_3D) {
      update_stress<3>(voce, a.arrays(), 0, kPoints);
      update_stress<3>(power, b.arrays(), 0, kPoints);
      update_stress<3>(table, c.arrays(), 0, kPoints);
    } else {
      update_stress<2>(voce, a.arrays(), 0, kPoints);
      update_stress<2>(power, b.arrays(), 0, kPoints);
      update_stress<2>(table, c.arrays(), 0, kPoints);
    }
    std::feclearexcept(FE_ALL_EXCEPT);
    fedisableexcept(traps);
  }
}
#endif

}  // namespace
}  // namespace cleave::test
