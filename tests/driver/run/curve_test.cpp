#include "scene/curve.hpp"

#include <gtest/gtest.h>

#include "support.hpp"

namespace cleave::driver::testing {
namespace {

Curve curve_of(const std::string& keys) {
  const Deck deck =
      parse_deck(std::string("&run units='other' t_end=1 /\n") + kUnitPlate + kUnitMaterial +
                     "&load kind='displacement' set='ymax' directions='y' value=1 " + keys + " /\n",
                 "case.nml");
  return Curve::of_load(deck, *deck.all("load").front());
}

constexpr auto kDisplacement = MotionKind::displacement;
constexpr auto kVelocity = MotionKind::velocity;
constexpr auto kAcceleration = MotionKind::acceleration;

TEST(Curve, SmoothDisplacementIsThePublishedPolynomial) {
  const Curve curve = curve_of("curve='smooth' ramp=4");
  const double s = 0.25, u = 3.0;  // t = 1                                            [CBM 26]
  const MotionValue at = curve.motion(kDisplacement, u, 1.0);
  EXPECT_NEAR(at.displacement, u * s * s * s * (10 - 15 * s + 6 * s * s), 1e-15);
  EXPECT_NEAR(at.velocity, u / 4 * 30 * s * s * (1 - s) * (1 - s), 1e-15);
  EXPECT_NEAR(at.acceleration, u / 16 * (120 * s * s * s - 180 * s * s + 60 * s), 1e-15);
  EXPECT_EQ(curve.motion(kDisplacement, u, 5.0).displacement, u);
}

TEST(Curve, SmoothVelocityReachesItsValueAtTheEndOfTheRamp) {
  const Curve curve = curve_of("curve='smooth' ramp=4 begin=1");
  EXPECT_EQ(curve.motion(kVelocity, 2.0, 0.5).velocity, 0.0);
  const MotionValue at = curve.motion(kVelocity, 2.0, 6.0);
  EXPECT_DOUBLE_EQ(at.velocity, 2.0);
  EXPECT_DOUBLE_EQ(at.displacement, 2.0 * 4 / 2 + 2.0);  // v tau/2 and one unit of time  [CBM 30]
  EXPECT_EQ(at.acceleration, 0.0);
}

// Displacement, velocity and acceleration are derivatives of each other, for every curve and kind.
TEST(Curve, MotionsAreDerivativesOfEachOther) {
  const double h = 1e-4;
  for (const std::string keys :
       {"curve='constant'", "curve='linear' ramp=2.5", "curve='smooth' ramp=2.5",
        "curve='table' times=0.5,1,3 factors=1,-2,4", "curve='smooth' ramp=1 begin=0.3"}) {
    const Curve curve = curve_of(keys);
    for (const MotionKind kind : {kDisplacement, kVelocity, kAcceleration}) {
      for (const double t : {0.1, 0.77, 1.9, 2.8, 4.1}) {  // not at a kink
        const MotionValue before = curve.motion(kind, 1.5, t - h);
        const MotionValue now = curve.motion(kind, 1.5, t);
        const MotionValue after = curve.motion(kind, 1.5, t + h);
        // measured 1.2e-7: the fourth derivative of the smooth ramp times h^2
        EXPECT_NEAR((after.displacement - before.displacement) / (2 * h), now.velocity, 1e-6)
            << keys << " at " << t;
        EXPECT_NEAR((after.velocity - before.velocity) / (2 * h), now.acceleration, 1e-6)
            << keys << " at " << t;
      }
    }
  }
}

TEST(Curve, TableOfVelocitiesIsIntegratedExactly) {
  const Curve curve = curve_of("curve='table' times=1,2,4 factors=1,3,0");
  // 1 until t = 1; 1 to 3 until 2: area 2; 3 to 0 until 4: area 3; 0 afterwards
  EXPECT_DOUBLE_EQ(curve.motion(kVelocity, 1.0, 1.0).displacement, 1.0);
  EXPECT_DOUBLE_EQ(curve.motion(kVelocity, 1.0, 2.0).displacement, 3.0);
  EXPECT_DOUBLE_EQ(curve.motion(kVelocity, 1.0, 3.0).displacement, 3.0 + 2.25);
  EXPECT_DOUBLE_EQ(curve.motion(kVelocity, 1.0, 9.0).displacement, 6.0);
}

TEST(Curve, FactorOfForces) {
  EXPECT_EQ(curve_of("curve='constant'").factor(0.0), 1.0);
  EXPECT_EQ(curve_of("curve='constant' begin=1").factor(0.99), 0.0);
  EXPECT_DOUBLE_EQ(curve_of("curve='linear' ramp=4").factor(1.0), 0.25);
  EXPECT_DOUBLE_EQ(curve_of("curve='smooth' ramp=4").factor(1.0), 3.0 / 16 - 2.0 / 64);
  EXPECT_EQ(curve_of("curve='smooth' ramp=4").factor(7.0), 1.0);
}

TEST(Curve, SaysWhichCurvesAccelerationsCannotFollow) {
  EXPECT_STREQ(curve_of("curve='smooth' ramp=1").jump(kDisplacement), "");
  EXPECT_STREQ(curve_of("curve='constant'").jump(kVelocity), "");
  EXPECT_STREQ(curve_of("curve='linear' ramp=1").jump(kVelocity), "");
  EXPECT_STRNE(curve_of("curve='linear' ramp=1").jump(kDisplacement), "");
  EXPECT_STRNE(curve_of("curve='constant' begin=1").jump(kVelocity), "");
}

TEST(Curve, WrongTablesAreRefused) {
  const auto said = [](const std::string& keys) {
    return message_of<DeckError>([&] { curve_of(keys); });
  };
  EXPECT_TRUE(has(said("curve='smooth'"), "needs its duration: ramp > 0"));
  EXPECT_TRUE(has(said("curve='table'"), "needs times and factors"));
  EXPECT_TRUE(has(said("curve='table' times=0,1 factors=1"), "here 1 and 2"));
  EXPECT_TRUE(has(said("curve='table' times=0,2,1 factors=1,2,3"), "entry 3 is 1 after 2"));
  EXPECT_TRUE(has(said("curve='constant' times=0 factors=1"), "belong to curve = 'table'"));
}

}  // namespace
}  // namespace cleave::driver::testing
