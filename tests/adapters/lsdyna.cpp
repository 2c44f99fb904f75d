// The LS-DYNA adapter without LS-DYNA: every law behind its number, scalar and vector form, any range of
// a block, against the direct call bit for bit; sizes of the step by point, deletion, wrong cards.
#include <gtest/gtest.h>

#include "adapters/fortran_host.hpp"

using cleave::test::Int;
using cleave::test::Real;

// Argument lists of the hosts: R9 and later; R7 and R8 lack nnpcrv and reject.
#ifdef CLEAVE_LSDYNA_R8
#define CLEAVE_CURVES const Real*
#define CLEAVE_REJECT
#define CLEAVE_NO_CURVES nullptr
#define CLEAVE_NO_REJECT
#else
#define CLEAVE_CURVES const Real*, const Int*
#define CLEAVE_REJECT Int*,
#define CLEAVE_NO_CURVES nullptr, nullptr
#define CLEAVE_NO_REJECT nullptr,
#endif
#define CLEAVE_UMAT(number)                                                                        \
  void umat##number##_(const Real*, const Real*, Real*, Real*, Real*, const Real*, const Real*,    \
                       const char*, const Real*, const Real*, Int*, CLEAVE_CURVES, const Real*,    \
                       const Real*, const Real*, const std::int64_t*, CLEAVE_REJECT std::size_t);  \
  void umat##number##v_(const Real*, const Real*, const Real*, const Real*, const Real*,           \
                        const Real*, const Real*, Real*, Real*, Real*, Real*, Real*, Real*, Real*, \
                        Real*, const Int*, const Int*, const Real*, const Real*, const char*,      \
                        const Real*, const Real*, Int*, const Int*, CLEAVE_CURVES, const Real*,    \
                        const Real*, const Real*, const std::int64_t*, CLEAVE_REJECT std::size_t);
extern "C" {
CLEAVE_UMAT(41)
CLEAVE_UMAT(42)
CLEAVE_UMAT(43)
CLEAVE_UMAT(44)
CLEAVE_UMAT(45)
CLEAVE_UMAT(46)
CLEAVE_UMAT(47)
CLEAVE_UMAT(48)
CLEAVE_UMAT(49)
void cleave_umats_(const Int*, const Real*, Real*, Real*, Real*, const Real*, const char*,
                   const Real*, Int*, const Real*, std::size_t);
void adios_(const Int* code);
}

namespace cleave::test::lsdyna {
namespace {

thread_local int stops = 0;

constexpr std::size_t kLeading = 136;  // nlq of the stand-in
constexpr Real kUntouched = -77;
// Places of ij in xx yy zz xy yz zx.
constexpr std::size_t kFirst[6] = {0, 1, 2, 0, 1, 2}, kSecond[6] = {0, 1, 2, 1, 2, 0};

constexpr auto kScalar =
    std::array{umat41_, umat42_, umat43_, umat44_, umat45_, umat46_, umat47_, umat48_, umat49_};
constexpr auto kVector = std::array{umat41v_, umat42v_, umat43v_, umat44v_, umat45v_,
                                    umat46v_, umat47v_, umat48v_, umat49v_};

// The constants of a card: properties, bulk and shear modulus.
std::vector<Real> card(const Law& law) {
  std::vector<Real> cm = law.host_properties();
  const Lame moduli = lame(law);
  cm.push_back(static_cast<Real>(moduli.lambda + 2 * moduli.mu / 3));
  cm.push_back(static_cast<Real>(moduli.mu));
  cm.resize(48, 0);
  return cm;
}

// By the fields table; -1: the law has none.
std::ptrdiff_t plastic_strain_place(const Law& law) {
  std::int64_t count = 0;
  ok(cleave_field_table_count(&count));
  std::ptrdiff_t place = 0;
  for (std::int64_t k = 0; k < count; ++k) {
    cleave_field f;
    f.size = sizeof f;
    ok(cleave_field_table_get(k, &f));
    if (law.name != f.owner) continue;
    if (std::string(f.name) == "equivalent_plastic_strain") return place;
    place += f.components;
  }
  return -1;
}

// Arrays of nlq points.
struct Block {
  explicit Block(const Law& l, std::size_t number = 0)
      : law(l), slot(number), cm(card(l)), hsv(kLeading * (law.history + 10), 0) {
    for (auto& s : sig) s.assign(kLeading, kUntouched);
    epsps.assign(kLeading, kUntouched);
    dt.assign(kLeading, static_cast<Real>(1e-6));
    length.assign(kLeading, static_cast<Real>(0.01));
    fails.assign(kLeading, 0);
    for (std::size_t k = 0; k < kLeading; ++k) put(k, kUnit);
  }
  Real& state(std::size_t point, std::size_t c) { return hsv[point + kLeading * c]; }
  void put(std::size_t point, const Matrix3& F) {
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t j = 0; j < 3; ++j)
        state(point, law.history + 1 + i + 3 * j) = static_cast<Real>(F[i][j]);
  }
  // Points first to last, from 1.
  void call(std::size_t first, std::size_t last) {
    const Int lft = static_cast<Int>(first), llt = static_cast<Int>(last), nlqa = kLeading;
    const Real zero = 0;
    const Real* nothing = nullptr;
    kVector[slot](cm.data(), nothing, nothing, nothing, nothing, nothing, nothing, sig[0].data(),
                  sig[1].data(), sig[2].data(), sig[3].data(), sig[4].data(), sig[5].data(),
                  epsps.data(), hsv.data(), &lft, &llt, dt.data(), &zero, etype.c_str(), &time,
                  nothing, fails.data(), &nlqa, CLEAVE_NO_CURVES, nothing, nothing, length.data(),
                  nullptr, CLEAVE_NO_REJECT 5);
  }

  Law law;
  std::size_t slot;
  std::vector<Real> cm;
  std::array<std::vector<Real>, 6> sig;
  std::vector<Real> epsps, hsv, dt, length;
  std::vector<Int> fails;
  std::string etype = "solid";
  Real time = 0;
};

// One point, contiguous.
struct Point {
  explicit Point(const Law& l, std::size_t number)
      : law(l), slot(number), cm(card(l)), hsv(l.history + 10, 0) {}
  void call(const Matrix3& F) {
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t j = 0; j < 3; ++j)
        hsv[law.history + 1 + i + 3 * j] = static_cast<Real>(F[i][j]);
    const Real zero = 0;
    const Real* nothing = nullptr;
    kScalar[slot](cm.data(), nothing, sig.data(), &epsp, hsv.data(), &dt, &zero, "solid", &time,
                  &zero, &fails, CLEAVE_NO_CURVES, nothing, nothing, &length, nullptr,
                  CLEAVE_NO_REJECT 5);
  }
  Law law;
  std::size_t slot;
  std::vector<Real> cm, hsv;
  std::array<Real, 7> sig{0, 0, 0, 0, 0, 0, kUntouched};
  Real epsp = kUntouched, dt = static_cast<Real>(1e-6), length = static_cast<Real>(0.01), time = 0;
  Int fails = 0;
};

class LsDyna : public testing::Test {
 protected:
  LsDyna() { stops = 0; }
  template <class Call>
  void expect_stop(const Call& call, const std::string& part) {
    stops = 0;
    call();
    EXPECT_EQ(stops, 1) << part;
    EXPECT_NE(last_message().find(part), std::string::npos) << last_message();
  }
};

void compare(const Law& law, std::size_t slot, std::size_t first, std::size_t last,
             Random& random) {
  Block block(law, slot);
  Direct direct(law, kLeading);
  const std::ptrdiff_t plastic = plastic_strain_place(law);
  for (std::size_t k = 0; k < kLeading; ++k) {
    block.length[k] = static_cast<Real>(0.01 * (1.5 + random()));
    if (last % 5 == 0 && k % 7 > 3) block.dt[k] = static_cast<Real>(2e-6);
  }
  std::vector<bool> dead(kLeading, false);
  for (int step = 0; step < 3; ++step) {
    std::vector<Matrix3> F;
    for (std::size_t k = 0; k < kLeading; ++k) {
      F.push_back(random_gradient(random, 0.1));
      block.put(k, F[k]);
    }
    block.call(first, last);
    ASSERT_EQ(stops, 0) << last_message();
    block.time += 1;
    for (std::size_t k = 0; k < kLeading; ++k) {
      if (k + 1 < first || k + 1 > last) {
        for (const auto& s : block.sig) ASSERT_EQ(s[k], kUntouched);
        for (std::size_t c = 0; c <= law.history; ++c) ASSERT_EQ(block.state(k, c), 0);
        ASSERT_EQ(block.epsps[k], kUntouched);
        continue;
      }
      if (dead[k]) continue;
      const auto answer = direct.step(k, F[k], static_cast<double>(block.dt[k]),
                                      static_cast<double>(block.length[k]));
      ASSERT_FALSE(answer.failed);
      for (std::size_t c = 0; c < 6; ++c)
        ASSERT_EQ(block.sig[c][k], static_cast<Real>(answer.stress[kFirst[c]][kSecond[c]]))
            << "point " << k << " component " << c;
      for (std::size_t c = 0; c < law.history; ++c)
        ASSERT_EQ(static_cast<double>(block.state(k, c)), direct.history[k][c]);
      ASSERT_EQ(block.epsps[k],
                plastic < 0 ? kUntouched : block.state(k, static_cast<std::size_t>(plastic)));
      dead[k] = law.damage >= 0 && direct.history[k][static_cast<std::size_t>(law.damage)] >= 1;
      ASSERT_EQ(block.state(k, law.history), dead[k] ? 1 : 0);
      ASSERT_EQ(block.fails[k] != 0, dead[k]);
      for (std::size_t c = 0; c < 9; ++c)
        ASSERT_EQ(static_cast<double>(block.state(k, law.history + 1 + c)), F[k][c % 3][c / 3]);
    }
  }
}

TEST_F(LsDyna, GivesTheBitsOfTheDirectCallForEveryLawAndRange) {
  Random random(61);
  std::size_t slot = 0;
  for (const Law& law : laws(71)) {
    SCOPED_TRACE(law.name);
    ASSERT_LT(slot, kVector.size()) << "a law without a number; add it to cleave_slots.f90";
    for (std::size_t length = 1; length <= kLeading; ++length)
      compare(law, slot, 1 + length % (kLeading - length + 1),
              length % (kLeading - length + 1) + length, random);
    if (HasFatalFailure()) return;
    ++slot;
  }
}

TEST_F(LsDyna, ScalarAndVectorFormAreOne) {
  Random random(62);
  std::size_t slot = 0;
  for (const Law& law : laws(72)) {
    SCOPED_TRACE(law.name);
    Point point(law, slot);
    Block block(law, slot++);
    for (int step = 0; step < 4; ++step) {
      const Matrix3 F = random_gradient(random, 0.1);
      block.put(5, F);
      block.call(6, 6);
      point.call(F);
      ASSERT_EQ(stops, 0) << last_message();
      for (std::size_t c = 0; c < 6; ++c) EXPECT_EQ(point.sig[c], block.sig[c][5]);
      EXPECT_EQ(point.sig[6], kUntouched);
      for (std::size_t c = 0; c <= law.history; ++c) EXPECT_EQ(point.hsv[c], block.state(5, c));
      EXPECT_EQ(point.epsp, block.epsps[5]);
      EXPECT_EQ(point.fails, 0);
    }
  }
}

TEST_F(LsDyna, DeletesPointsWithoutAnAnswer) {
  std::size_t slot = 0;
  for (const Law& law : laws(73)) {
    const std::size_t number = slot++;
    SCOPED_TRACE(law.name);
    Random random(63);
    Block good(law, number), with(law, number);
    const std::size_t bad = 77;
    for (int step = 0; step < 4; ++step) {
      for (std::size_t k = 0; k < kLeading; ++k) {
        const Matrix3 F = random_gradient(random, 0.05);
        good.put(k, F);
        with.put(k, step == 1 && k == bad ? Matrix3{{{-1, 0, 0}, {0, 1, 0}, {0, 0, 1}}} : F);
      }
      const std::vector<Real> before = with.hsv;
      good.call(1, kLeading);
      with.call(1, kLeading);
      ASSERT_EQ(stops, 0) << last_message();
      for (std::size_t k = 0; k < kLeading; ++k) {
        const bool dead = k == bad && step >= 1;
        EXPECT_EQ(with.fails[k] != 0, dead);
        EXPECT_EQ(with.state(k, law.history), dead ? 1 : 0);
        for (std::size_t c = 0; c < 6; ++c) EXPECT_EQ(with.sig[c][k], dead ? 0 : good.sig[c][k]);
        for (std::size_t c = 0; c < law.history; ++c)
          EXPECT_EQ(with.state(k, c), dead ? before[k + kLeading * c] : good.state(k, c));
      }
    }
  }
}

TEST_F(LsDyna, DeletesWhatTheLawCallsFailed) {
  std::size_t slot = 0;
  int tried = 0;
  for (Law law : laws(74)) {
    const std::size_t number = slot++;
    if (law.damage < 0) continue;
    ++tried;
    SCOPED_TRACE(law.name);
    law.property("D1") = static_cast<double>(static_cast<Real>(0.1));
    Point point(law, number);
    point.dt = static_cast<Real>(1e-3);
    int died = 0;
    for (int step = 1; step <= 60; ++step) {
      point.fails = 0;
      const double a = std::exp(0.005 * step);
      point.call({{{a, 0, 0}, {0, 1 / std::sqrt(a), 0}, {0, 0, 1 / std::sqrt(a)}}});
      ASSERT_EQ(stops, 0) << last_message();
      const bool failed = point.hsv[static_cast<std::size_t>(law.damage)] >= 1;
      EXPECT_EQ(point.fails != 0, failed);
      EXPECT_EQ(point.hsv[law.history], failed ? 1 : 0);
      EXPECT_EQ(point.sig[0] > 0, died == 0);
      if (died == 0 && failed) died = step;
    }
    EXPECT_GT(died, 15);
    EXPECT_LT(died, 40);
  }
  EXPECT_GT(tried, 0);
}

TEST_F(LsDyna, RefusesWrongCards) {
  std::size_t slot = 0;
  for (const Law& law : laws(75)) {
    const std::size_t number = slot++;
    SCOPED_TRACE(law.name);
    Block block(law, number);
    const auto call = [&] { block.call(1, 10); };
    // One property too few: the bulk modulus stands one place early.
    block.cm.erase(block.cm.begin() + static_cast<std::ptrdiff_t>(law.properties.size()) - 1);
    block.cm.push_back(0);
    stops = 0;
    call();
    EXPECT_EQ(stops, 1);
    for (std::size_t c = 0; c < 6; ++c) EXPECT_EQ(block.sig[c][0], kUntouched);
    block.cm = card(law);
    block.cm[law.properties.size()] *= static_cast<Real>(0.9);
    expect_stop(call, "bulk");
    if (lame(law).mu > 0) {
      block.cm = card(law);
      block.cm[law.properties.size() + 1] *= static_cast<Real>(0.9);
      expect_stop(call, "shear");
    }
    block.time = 1;  // checked once
    stops = 0;
    call();
    EXPECT_EQ(stops, 0);
    block.time = 0;
    block.cm = card(law);
    block.etype = "shell";
    expect_stop(call, "not shell");
    block.etype = "solid";
    block.cm[0] = -1;
    expect_stop(call, "rho");
  }
}

// IHYPER forgotten or NHV wrong: zeros stand where a column of F should be.
TEST_F(LsDyna, MissesTheDeformationGradient) {
  std::size_t slot = 0;
  for (const Law& law : laws(76)) {
    const std::size_t number = slot++;
    SCOPED_TRACE(law.name);
    for (std::size_t column = 0; column < 3; ++column) {
      Matrix3 F = kUnit;
      F[column][column] = 0;
      Block block(law, number);
      for (std::size_t k = 0; k < kLeading; ++k) block.put(k, F);
      expect_stop([&] { block.call(1, 10); },
                  "IHYPER = 1 and NHV = " + std::to_string(law.history + 1));
    }
  }
}

TEST_F(LsDyna, RefusesANumberWithoutALaw) {
  const Law law = law_called("svk");
  const Int fifty = 50;
  const Real one = 1, zero = 0;
  Real sig[6] = {}, epsp = 0;
  std::vector<Real> hsv(20, 0), cm = card(law);
  Int fails = 0;
  expect_stop(
      [&] {
        cleave_umats_(&fifty, cm.data(), sig, &epsp, hsv.data(), &one, "solid", &zero, &fails, &one,
                      5);
      },
      "umat50");
}

TEST_F(LsDyna, MayBeCalledByManyThreads) {
  const std::vector<Law> all = laws(77);
  const auto run = [&](unsigned seed) {
    Random random(seed);
    Block block(all[seed % all.size()], seed % all.size());
    for (int step = 0; step < 40; ++step) {
      for (std::size_t k = 0; k < kLeading; ++k) block.put(k, random_gradient(random, 0.05));
      block.call(1, kLeading);
    }
    return block.sig;
  };
  const auto together = at_once(8, run);
  for (unsigned t = 0; t < 8; ++t) EXPECT_EQ(together[t], run(t)) << t;
}

}  // namespace
}  // namespace cleave::test::lsdyna

void adios_(const Int* code) {
  EXPECT_EQ(*code, 2);
  ++cleave::test::lsdyna::stops;
}
