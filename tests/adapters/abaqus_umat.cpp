// The UMAT without Abaqus: every law by its name against the direct call bit for bit, DDSDDE against
// differences of the Jaumann rate, energies, the request for a smaller increment, wrong decks; and the
// VUMAT and the UMAT as one: the stress turned back does not know of rotations.
#include <gtest/gtest.h>

#include "adapters/abaqus_host.hpp"

extern "C" {
void umat_(double* stress, double* statev, double* ddsdde, double* sse, double* spd, double* scd,
           double* rpl, double* ddsddt, double* drplde, double* drpldt, const double* stran,
           const double* dstran, const double* time, const double* dtime, const double* temp,
           const double* dtemp, const double* predef, const double* dpred, const char* cmname,
           const int* ndi, const int* nshr, const int* ntens, const int* nstatv,
           const double* props, const int* nprops, const double* coords, const double* drot,
           double* pnewdt, const double* celent, const double* dfgrd0, const double* dfgrd1,
           const int* noel, const int* npt, const int* layer, const int* kspt, const int* kstep,
           const int* kinc, std::size_t name_length);
void stdb_abqerr_(const int* lop, const char* text, const int* intv, const double*, const char*,
                  std::size_t length, std::size_t) {
  EXPECT_EQ(*lop, -2);
  EXPECT_EQ(intv[0], 4711);
  EXPECT_EQ(intv[1], 3);
  std::string message(text, length);
  message.erase(message.find_last_not_of(' ') + 1);
  cleave::test::abaqus::errors.texts.push_back(message);
}
void xit_() { ++cleave::test::abaqus::errors.exits; }
}

namespace cleave::test::abaqus {
namespace {

// Places of ij in 11 22 33 12 13 23.
constexpr std::size_t kRow[6] = {0, 1, 2, 0, 0, 1}, kColumn[6] = {0, 1, 2, 1, 2, 2};

struct Point {
  explicit Point(const Law& law, std::size_t states, int shears = 3)
      : material("CLEAVE-" + law.capitals), props(law.properties), statev(states, 0), nshr(shears) {
    statev.push_back(-77);
  }
  std::size_t components() const { return static_cast<std::size_t>(3 + nshr); }
  void call() {
    const int ntens = ndi + nshr, states = static_cast<int>(statev.size()) - 1,
              count = static_cast<int>(props.size()), element = 4711, point = 3, one = 1;
    double F0[9], F1[9], unused = 0;
    for (std::size_t k = 0; k < 9; ++k) {
      F0[k] = before[k % 3][k / 3];
      F1[k] = after[k % 3][k / 3];
    }
    const std::string name = padded(material);
    umat_(stress.data(), statev.data(), ddsdde.data(), &sse, &spd, &scd, &unused, nullptr, nullptr,
          &unused, nullptr, dstran.data(), nullptr, &dtime, nullptr, nullptr, nullptr, nullptr,
          name.c_str(), &ndi, &nshr, &ntens, &states, props.data(), &count, nullptr, nullptr,
          &pnewdt, &length, F0, F1, &element, &point, &one, &one, &one, &one, name.size());
  }
  Matrix3 full_stress() const {
    Matrix3 s{};
    for (std::size_t c = 0; c < components(); ++c)
      s[kRow[c]][kColumn[c]] = s[kColumn[c]][kRow[c]] = stress[c];
    return s;
  }

  std::string material;
  std::vector<double> props, statev;
  int ndi = 3, nshr;
  Matrix3 before = kUnit, after = kUnit;
  std::array<double, 7> stress{0, 0, 0, 0, 0, 0, -77};
  std::array<double, 37> ddsdde{};
  std::array<double, 6> dstran{1, 0, 0, 0, 0, 0};
  double sse = 0, spd = 0, scd = 0, dtime = 1e-6, pnewdt = 1, length = 0.01;
};

class Umat : public testing::Test {
 protected:
  Umat() { errors = {}; }
};

void compare(const Law& law, int shears, Random& random) {
  const std::size_t states = law.history + 2;
  Point point(law, states, shears);
  point.statev[law.history + 1] = 13;  // not the adapter's
  Direct direct(law, 1);
  double lost = 0;
  for (int step = 0; step < 4; ++step) {
    point.before = point.after;
    point.after = random_gradient(random, 0.1);
    if (shears == 1)
      for (std::size_t k = 0; k < 2; ++k) point.after[k][2] = point.after[2][k] = 0;
    point.ddsdde[point.components() * point.components()] = -77;
    point.call();
    ASSERT_TRUE(errors.texts.empty()) << errors.texts[0];
    const auto moduli = direct.tangent(0, point.after, point.dtime, point.length);
    const auto answer = direct.step(0, point.after, point.dtime, point.length);
    ASSERT_FALSE(answer.failed);
    double largest = 0;
    for (const double x : moduli) largest = std::max(largest, std::fabs(x));
    for (std::size_t a = 0; a < point.components(); ++a) {
      ASSERT_EQ(point.stress[a], answer.stress[kRow[a]][kColumn[a]]);
      for (std::size_t b = 0; b < point.components(); ++b) {
        const auto modulus = [&](std::size_t i, std::size_t j, std::size_t k, std::size_t l) {
          return moduli[i + 3 * j + 9 * (k + 3 * l)];
        };
        // The two minor symmetries hold to rounding: measured 3e-16.
        ASSERT_NEAR(point.ddsdde[a + point.components() * b],
                    modulus(kRow[a], kColumn[a], kRow[b], kColumn[b]), 1e-15 * largest);
      }
    }
    ASSERT_EQ(point.ddsdde[point.components() * point.components()], -77);
    ASSERT_EQ(point.stress[6], -77);
    for (std::size_t c = 0; c < law.history; ++c) ASSERT_EQ(point.statev[c], direct.history[0][c]);
    ASSERT_EQ(point.statev[law.history], 1);
    ASSERT_EQ(point.statev[law.history + 1], 13);
    ASSERT_EQ(point.statev[law.history + 2], -77);
    ASSERT_EQ(point.pnewdt, 1);
    // Energies per current volume.
    const double J = determinant(point.after);
    lost += answer.plastic + answer.viscous;
    ASSERT_NEAR(point.sse, answer.energy / J, 1e-14 * std::fabs(answer.energy));
    ASSERT_NEAR(point.spd, lost / J, 1e-14 * std::fabs(lost));
  }
}

TEST_F(Umat, GivesTheBitsOfTheDirectCallForEveryLaw) {
  Random random(31);
  for (const Law& law : laws(41)) {
    SCOPED_TRACE(law.name);
    for (int k = 0; k < 20; ++k) compare(law, k % 2 == 0 ? 3 : 1, random);
    if (HasFatalFailure()) return;
  }
}

TEST_F(Umat, ServesLawsWithoutHistoryWithoutStateVariables) {
  for (const Law& law : laws(46)) {
    if (law.history > 0) continue;
    Point point(law, 0), flagged(law, 1);
    point.after[0][1] = flagged.after[0][1] = 0.01;
    point.call();
    flagged.call();
    EXPECT_TRUE(errors.texts.empty());
    EXPECT_EQ(point.stress, flagged.stress);
    EXPECT_EQ(point.statev[0], -77);
  }
}

// d tau/dt for a stretching D without spin is the Jaumann rate; F -> (I + h D) F. linear_elastic has no
// such moduli: it is not objective, and its P F^T is not symmetric.
TEST_F(Umat, GivesTheModuliOfTheJaumannRate) {
  Random random(32);
  for (const Law& law : laws(42)) {
    if (law.name == "linear_elastic") continue;
    SCOPED_TRACE(law.name);
    Point loaded(law, law.history + 1);
    loaded.after = random_gradient(random, 0.05);
    loaded.call();
    loaded.before = loaded.after;
    loaded.after = random_gradient(random, 0.05);
    Point answered = loaded;
    answered.call();
    const double h = 1e-6;
    double largest = 0;
    for (const double x : answered.ddsdde) largest = std::max(largest, std::fabs(x));
    for (std::size_t b = 0; b < 6; ++b) {
      Matrix3 tau[2];
      for (int side = 0; side < 2; ++side) {
        Matrix3 push = kUnit;
        const double part = (side == 0 ? h : -h) * (b < 3 ? 1 : 0.5);
        push[kRow[b]][kColumn[b]] += part;
        if (b >= 3) push[kColumn[b]][kRow[b]] += part;
        Point moved = loaded;
        moved.after = product(push, loaded.after);
        moved.call();
        tau[side] = moved.full_stress();
        for (auto& row : tau[side])
          for (double& x : row) x *= determinant(moved.after);
      }
      for (std::size_t a = 0; a < 6; ++a) {
        const double rate = (tau[0][kRow[a]][kColumn[a]] - tau[1][kRow[a]][kColumn[a]]) / (2 * h);
        // Measured: 3e-10, with an h that balances rounding and curvature.
        EXPECT_NEAR(answered.ddsdde[a + 6 * b], rate / determinant(loaded.after), 3e-9 * largest)
            << a << b;
      }
    }
  }
}

// The stress of F = R U turned back by R, with other rotations in every step, is that of the VUMAT, which
// sees U alone. linear_elastic is not objective: a rotation is a strain to it.
TEST_F(Umat, AndVumatDoNotKnowOfRotations) {
  Random random(33);
  for (const Law& law : laws(43)) {
    if (law.name == "linear_elastic") continue;
    SCOPED_TRACE(law.name);
    double largest = 0, worst = 0;
    for (int sample = 0; sample < 4; ++sample) {
      Block block(law, 1, 3, law.history + 1);
      block.length[0] = 0.01;
      std::vector<Point> turned(4, Point(law, law.history + 1));
      for (int step = 0; step < 4; ++step) {
        const Matrix3 U = random_stretch(random, 0.1, false);
        block.put(block.stretch_new, 0, U);
        block.call();
        ASSERT_TRUE(errors.texts.empty()) << errors.texts[0];
        for (std::size_t c = 0; c < 6; ++c)
          largest = std::max(largest, std::fabs(block.at(block.stress_new, 0, c)));
        for (Point& point : turned) {
          const Matrix3 R = rotation(random);
          point.after = product(R, U);
          point.call();
          ASSERT_TRUE(errors.texts.empty()) << errors.texts[0];
          const Matrix3 back = product(transposed(R), product(point.full_stress(), R));
          for (std::size_t c = 0; c < 6; ++c)
            worst = std::max(
                worst, std::fabs(back[kFirst[c]][kSecond[c]] - block.at(block.stress_new, 0, c)));
        }
        block.advance();
      }
    }
    EXPECT_LT(worst, 1e-13 * largest);  // measured: 6e-15
  }
}

TEST_F(Umat, AsksForASmallerIncrement) {
  for (const Law& law : laws(44)) {
    SCOPED_TRACE(law.name);
    Random random(34);
    Point point(law, law.history + 1);
    point.after = random_gradient(random, 0.05);
    point.call();
    const Point before = point;
    point.after[0][0] = -1;
    point.call();
    EXPECT_TRUE(errors.texts.empty());
    EXPECT_EQ(point.pnewdt, 0.25);
    EXPECT_EQ(point.stress, before.stress);
    EXPECT_EQ(point.statev, before.statev);
    EXPECT_EQ(point.sse, before.sse);
    EXPECT_EQ(point.spd, before.spd);
    const Lame moduli = lame(law);
    const double allowed = 3e-5 * (moduli.lambda + 2 * moduli.mu);
    for (std::size_t a = 0; a < 6; ++a)
      for (std::size_t b = 0; b < 6; ++b) {
        const double hooke =
            (a < 3 && b < 3 ? moduli.lambda : 0) + (a == b ? moduli.mu * (a < 3 ? 2 : 1) : 0);
        EXPECT_NEAR(point.ddsdde[a + 6 * b], hooke, allowed);
      }
  }
}

TEST_F(Umat, FlagsWhatTheLawCallsFailed) {
  for (Law law : laws(45)) {
    if (law.damage < 0) continue;
    law.property("D1") = 0.02;
    Point point(law, law.history + 1);
    point.dtime = 1e-3;
    for (int step = 1; step <= 20; ++step) {
      point.after[0][1] = 0.01 * step;
      point.call();
      ASSERT_TRUE(errors.texts.empty()) << errors.texts[0];
      EXPECT_EQ(point.statev[law.history],
                point.statev[static_cast<std::size_t>(law.damage)] >= 1 ? 0 : 1);
    }
    EXPECT_EQ(point.statev[law.history], 0) << law.name;
  }
}

TEST_F(Umat, RefusesWrongDecks) {
  const Law law = law_called("j2");
  const auto expect_error = [](Point point, const std::string& part) {
    errors = {};
    point.call();
    ASSERT_EQ(errors.texts.size(), 1u) << part;
    EXPECT_EQ(errors.exits, 1);
    EXPECT_NE(errors.texts[0].find(part), std::string::npos) << errors.texts[0];
    EXPECT_NE(errors.texts[0].find(point.material + ", element %I, point %I: "), std::string::npos)
        << errors.texts[0];
  };
  Point good(law, law.history);
  good.after[0][0] = 1.001;
  good.call();
  EXPECT_TRUE(errors.texts.empty());  // no flag is no error
  Point point = good;
  point.material = "CLEAVE_J2";
  expect_error(point, "does not name a law");
  point.material = "CLEAVE-J22";
  expect_error(point, "j2_table");
  point = good;
  point.props.pop_back();
  expect_error(point, "takes 7 properties, not 6");
  point = good;
  point.props[0] = 0;
  expect_error(point, "rho");
  point = good;
  point.ndi = 2;
  point.nshr = 1;
  expect_error(point, "solid elements only");
  point = Point(law, law.history - 1);
  expect_error(point, "*DEPVAR 9");
  point = good;
  point.before = point.after = kUnit;
  expect_error(point, "NLGEOM=YES");
  point.dstran = {};
  errors = {};
  point.call();
  EXPECT_TRUE(errors.texts.empty());
}

}  // namespace
}  // namespace cleave::test::abaqus
