// Influence functions of correspondence peridynamics, and its identity with total-Lagrangian SPH.
#include "formulation/nosb/influence.hpp"

#include "formulation/tlsph/bodies.hpp"

namespace cleave::test {
namespace {

using nosb::Influence;
using nosb::InfluenceFunction;

const std::array<std::pair<const char*, Influence>, 6> kAll = {
    {{"constant", Influence::constant},
     {"cone", Influence::cone},
     {"spline", Influence::spline},
     {"inverse_distance", Influence::inverse_distance},
     {"gaussian", Influence::gaussian},
     {"tlsph", Influence::tlsph}}};

// Integral of omega |X|^2 over the horizon is the dimension, whatever the function and the unit.
TEST(InfluenceFunctions, AreScaledToAUnitMomentMatrix) {
  for (const auto& [name, form] : kAll) {
    for (const int d : {2, 3}) {
      for (const double horizon : {1e-3, 2.5}) {
        const InfluenceFunction omega(form, d, horizon);
        const int panels = 4000;
        double sum = 0;
        for (int k = 0; k < panels; ++k) {  // midpoints: the error falls with the square
          const double x = horizon * (k + 0.5) / panels;
          sum += omega(x) * std::pow(x, d + 1) * horizon / panels;
        }
        sum *= (d == 2 ? 2 : 4) * std::numbers::pi;
        EXPECT_NEAR(sum, d, 1e-6) << name;  // measured 2e-7
      }
    }
  }
}

TEST(InfluenceFunctions, TlsphIsTheSlopeOfItsKernel) {
  for (const int d : {2, 3}) {
    const tlsph::CubicSpline w(d, 0.8);
    const InfluenceFunction omega(Influence::tlsph, d, 1.6);
    for (const double x : {0.1, 0.5, 0.9, 1.5})
      EXPECT_NEAR(omega(x), -w.slope(x) / x, 1e-12 * omega(x));  // measured 1e-15
  }
}

class Correspondence : public testing::TestWithParam<int> {
 protected:
  static SimplexMesh mesh() { return patch(GetParam(), GetParam() == 2 ? 9 : 5, 1.0, 0.2, 91); }
  static std::vector<Setting> settings(const char* influence) {
    return {{"kernel", "radius", 1.6}, {"kernel", "influence", 0, influence}};
  }
};

// With the influence function 'tlsph' both methods are one: operator, penalty, step.
TEST_P(Correspondence, WithTheSlopeOfTheKernelIsTlsph) {
  const SimplexMesh m = mesh();
  const auto u = random_vectors(m, 0.1, 3);
  for (const char* form : {"none", "projected", "conservative"}) {
    const Deformed one(CLEAVE_FORMULATION_tlsph, m, u,
                       std::vector<Setting>{{"kernel", "radius", 1.6}} + hourglass(form, 0.3)),
        other(CLEAVE_FORMULATION_nosb, m, u, settings("tlsph") + hourglass(form, 0.3));
    for (const char* field : {"bond_vector", "internal_force"}) {
      const auto a = one.model.real(field), b = other.model.real(field);
      ASSERT_EQ(a.size(), b.size());
      const double size = largest(a);
      for (std::size_t k = 0; k < a.size(); ++k)
        ASSERT_NEAR(a[k], b[k], 1e-12 * size) << field;  // measured 7e-16
    }
    EXPECT_NEAR(one.model.stable_step(), other.model.stable_step(),
                1e-10 * one.model.stable_step());
  }
  const Deformed differs(CLEAVE_FORMULATION_nosb, m, u, settings("cone"));
  const Deformed sph(CLEAVE_FORMULATION_tlsph, m, u, {{"kernel", "radius", 1.6}});
  EXPECT_GT(std::fabs(differs.force()[3] - sph.force()[3]), 1e-3 * largest(sph.force()));
}

TEST_P(Correspondence, IsThatOfAllPairsForEveryInfluence) {
  const SimplexMesh m = mesh();
  for (const auto& [name, form] : kAll) {
    // Nobody stands on the horizon of this irregular patch.
    const BruteGradient expected(
        m, 3.2, [form = form](double x) { return nosb::influence_shape(form, x / 3.2); });
    Model model;
    model.add(kernel_case(CLEAVE_FORMULATION_nosb, m.dimension), m, settings(name));
    model.setup();
    const auto zeta = model.real("bond_vector");
    ASSERT_EQ(zeta.size(), expected.zeta.size()) << name;
    const double size = largest(expected.zeta);
    for (std::size_t k = 0; k < zeta.size(); ++k)
      ASSERT_NEAR(zeta[k], expected.zeta[k], 1e-13 * size) << name;  // measured 1e-15
  }
}

// Particles on the horizon count where the influence does not vanish there.
TEST(CorrespondenceHorizon, CountsParticlesOnItWhereTheyWeigh) {
  const SimplexMesh m = triangular_lattice(24, 24, 1.0, 0.0, 1);
  const auto bonds = [&](const char* influence) {
    Model model;
    model.add(kernel_case(CLEAVE_FORMULATION_nosb, 2), m,
              {{"kernel", "radius", 4.0},
               {"kernel", "radius_meaning", 0, "cutoff"},
               {"kernel", "influence", 0, influence}});
    model.setup();
    return model.counts().bonds;
  };
  const auto open = bonds("spline"), closed = bonds("constant");
  EXPECT_EQ(bonds("cone"), open);
  Model sph;
  sph.add(kernel_case(CLEAVE_FORMULATION_tlsph, 2), m, {{"kernel", "radius", 2.0}});
  sph.setup();
  EXPECT_EQ(sph.counts().bonds, open);
  EXPECT_EQ(bonds("tlsph"), open);
  EXPECT_EQ(bonds("gaussian"), closed);
  EXPECT_EQ(bonds("inverse_distance"), closed);
  // Half of the six at distance 4 of every particle, less those beyond the rim: by hand 20 x 24 along
  // the rows, and 22 or 20 of 24 columns for 20 rows along each of the two others.
  EXPECT_EQ(closed - open, 20 * 24 + 2 * 22 * 20);
}

INSTANTIATE_TEST_SUITE_P(Dimensions, Correspondence, testing::Values(2, 3),
                         [](const auto& shape) { return std::to_string(shape.param) + "d"; });

}  // namespace
}  // namespace cleave::test
