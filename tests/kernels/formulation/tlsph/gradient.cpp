// Bond vectors of the kernel methods against brute force, and what set-up refuses.
#include "formulation/tlsph/bodies.hpp"
#include "formulation/tlsph/kernel.hpp"

namespace cleave::test {
namespace {

class KernelGradients : public testing::TestWithParam<int> {
 protected:
  static SimplexMesh mesh() { return patch(GetParam(), GetParam() == 2 ? 9 : 5, 0.7, 0.25, 71); }
  static constexpr double kRadius = 1.1;
};

std::vector<Setting> radius(double r) { return {{"kernel", "radius", r}}; }

TEST_P(KernelGradients, AreThoseOfAllPairs) {
  const SimplexMesh m = mesh();
  const tlsph::CubicSpline w(m.dimension, kRadius);
  const BruteGradient expected(m, 2 * kRadius, [&](double x) { return -w.slope(x) / x; });
  Model model;
  model.add(kernel_case(CLEAVE_FORMULATION_tlsph, m.dimension), m, radius(kRadius));
  model.setup();
  const auto zeta = model.real("bond_vector"), volume = model.real("volume"),
             mass = model.real("mass");
  ASSERT_EQ(zeta.size(), expected.zeta.size());
  const double size = largest(expected.zeta);
  for (std::size_t k = 0; k < zeta.size(); ++k)
    ASSERT_NEAR(zeta[k], expected.zeta[k], 1e-13 * size);  // measured 8e-16
  for (std::size_t i = 0; i < volume.size(); ++i) {
    EXPECT_NEAR(volume[i], expected.volume[i], 1e-14 * volume[i] + 1e-16);
    EXPECT_DOUBLE_EQ(mass[i], 1190 * volume[i]);
  }
  EXPECT_EQ(model.counts().bonds, static_cast<int64_t>(expected.neighbour.size()) / 2);
}

// The same volumes as the Continuum Bond Method, to the bit, so that results can be compared.
TEST_P(KernelGradients, VolumesAreThoseOfCbm) {
  Model one, other;
  one.add(kernel_case(CLEAVE_FORMULATION_tlsph, GetParam()), mesh(), radius(kRadius));
  other.add(kernel_case(CLEAVE_FORMULATION_cbm, GetParam()), mesh());
  one.setup();
  other.setup();
  EXPECT_EQ(one.real("volume"), other.real("volume"));
  EXPECT_EQ(one.real("mass"), other.real("mass"));
}

TEST_P(KernelGradients, WeightsOfARowAddUpToItsVolume) {
  const SimplexMesh m = mesh();
  const tlsph::CubicSpline w(m.dimension, kRadius);
  const BruteGradient rows(m, 2 * kRadius, [&](double x) { return -w.slope(x) / x; });
  Model model;
  model.add(kernel_case(CLEAVE_FORMULATION_tlsph, m.dimension), m, radius(kRadius));
  model.setup();
  const auto zeta = model.real("bond_vector"), volume = model.real("volume");
  for (std::int64_t i = 0; i < m.particles(); ++i) {
    double sum = 0;
    for (auto b = rows.row_begin[at(i)]; b < rows.row_begin[at(i + 1)]; ++b) {
      const auto X = rows.between(i, rows.neighbour[at(b)]);
      double weight = 0;
      for (std::size_t k = 0; k < 3; ++k) weight += zeta[3 * at(b) + k] * X[k];
      EXPECT_GT(weight, 0);
      sum += weight;
    }
    EXPECT_NEAR(sum, m.dimension * volume[at(i)], 1e-13 * volume[at(i)]);  // measured 3e-15
  }
}

TEST_P(KernelGradients, AffineMotionIsExactAtEveryParticle) {
  const Matrix3 g = {{{0.3, -0.2, 0.1}, {0.15, -0.25, 0.05}, {0.1, 0.2, 0.4}}};
  const SimplexMesh m = mesh();
  const Deformed body(CLEAVE_FORMULATION_tlsph, m, affine(m, g), radius(kRadius));
  const auto h = body.model.real("displacement_gradient");
  for (std::size_t i = 0; i < h.size() / 9; ++i)
    for (std::size_t r = 0; r < at(m.dimension); ++r)
      for (std::size_t c = 0; c < at(m.dimension); ++c)
        EXPECT_NEAR(h[9 * i + r + 3 * c], g[r][c], 1e-13);  // measured 6e-16
}

TEST_P(KernelGradients, CutoffIsTwiceTheKernelRadius) {
  Model one, other;
  one.add(kernel_case(CLEAVE_FORMULATION_tlsph, GetParam()), mesh(), radius(kRadius));
  other.add(kernel_case(CLEAVE_FORMULATION_tlsph, GetParam()), mesh(),
            radius(2 * kRadius) + std::vector<Setting>{{"kernel", "radius_meaning", 0, "cutoff"}});
  one.setup();
  other.setup();
  EXPECT_EQ(one.real("bond_vector"), other.real("bond_vector"));
}

INSTANTIATE_TEST_SUITE_P(Dimensions, KernelGradients, testing::Values(2, 3),
                         [](const auto& shape) { return std::to_string(shape.param) + "d"; });

// Plain gradients of u = X/100 are 1/100 of the moment matrices. Theory chapter: their diagonal inside a triangular
// lattice for r = 1, 1.5, 2, 3, 4 spacings; at the rim they are far from the unit matrix.
TEST(PlainGradient, HasTheKnownErrorInsideALattice) {
  const SimplexMesh m = triangular_lattice(24, 24, 1.0, 0.0, 1);
  const std::size_t middle = 12 * 24 + 12;
  const double radii[] = {1, 1.5, 2, 3, 4}, known[] = {0.996, 0.986, 1.003, 1.001, 0.9998};
  for (int k = 0; k < 5; ++k) {
    const double stretch = 0.01;
    const Matrix3 unit = {{{stretch, 0, 0}, {0, stretch, 0}, {0, 0, stretch}}};
    const Deformed body(
        CLEAVE_FORMULATION_tlsph, m, affine(m, unit),
        radius(radii[k]) + std::vector<Setting>{{"kernel", "gradient", 0, "plain"}});
    const auto h = body.model.real("displacement_gradient");
    EXPECT_NEAR(h[9 * middle] / stretch, known[k], 5.1e-4) << radii[k];
    EXPECT_NEAR(h[9 * middle + 4], h[9 * middle], 1e-12);
    EXPECT_NEAR(h[9 * middle + 1], 0, 1e-12);
    EXPECT_LT(h[0], 0.6 * stretch);  // a corner
  }
}

// What set-up answers: status and a piece of the message.
void expect_refused(const Case& c, const SimplexMesh& mesh, const std::vector<Setting>& settings,
                    int32_t status, const std::string& piece) {
  Model model;
  model.add(c, mesh, settings);
  EXPECT_EQ(cleave_model_setup(model), status) << piece;
  EXPECT_NE(last_message().find(piece), std::string::npos) << last_message();
}

TEST(KernelSetup, SaysWhatIsMissingOrDoesNotApply) {
  const SimplexMesh m = patch(2, 6, 1.0, 0.1, 72);
  const Case sph = kernel_case(CLEAVE_FORMULATION_tlsph, 2),
             nosb = kernel_case(CLEAVE_FORMULATION_nosb, 2),
             cbm = kernel_case(CLEAVE_FORMULATION_cbm, 2);
  expect_refused(sph, m, radius(0), CLEAVE_MISSING_PARAMETER, "needs radius > 0");
  expect_refused(sph, m, radius(0.45), CLEAVE_BAD_ARGUMENT, "neighbours of particle 0 (at X");
  expect_refused(sph, m, {{"kernel", "influence", 0, "cone"}}, CLEAVE_UNSUPPORTED, "nosb");
  expect_refused(nosb, m, {{"kernel", "gradient", 0, "plain"}}, CLEAVE_UNSUPPORTED, "tlsph");
  expect_refused(sph, m, {{"fracture", "critical_strain", 0.1}}, CLEAVE_UNSUPPORTED,
                 "has no use for group fracture");
  expect_refused(sph, m, {{"stabilisation", "alpha", 0.1}}, CLEAVE_UNSUPPORTED, "group hourglass");
  expect_refused(cbm, m, radius(1), CLEAVE_UNSUPPORTED, "has no use for group kernel");
  expect_refused(cbm, m, hourglass("projected", 0.1), CLEAVE_UNSUPPORTED, "group stabilisation");
  expect_refused(sph, m, {{"viscosity", "length_mode", 0, "local"}}, CLEAVE_UNSUPPORTED,
                 "use 'constant'");
  expect_refused(sph, m, {{"viscosity", "beta", 0.5}}, CLEAVE_MISSING_PARAMETER, "length > 0");
  expect_refused(
      sph, m,
      hourglass("conservative", 0.1) + std::vector<Setting>{{"kernel", "gradient", 0, "plain"}},
      CLEAVE_UNSUPPORTED, "needs the corrected gradient");
  Model off;  // a criterion of none is no fracture
  off.add(sph, m, {{"fracture", "criterion", 0, "none"}});
  EXPECT_EQ(cleave_model_setup(off), CLEAVE_OK) << last_message();
}

// Two rows of particles that come ever closer: below a millionth of the condition there is no gradient.
TEST(KernelSetup, KnowsNeighboursThatAreNearlyInALine) {
  SimplexMesh rows = triangular_lattice(12, 2, 1.0, 0.0, 1);
  for (std::size_t k = 1; k < rows.X.size(); k += 3) rows.X[k] *= 1e-2;
  Model flat;
  flat.add(kernel_case(CLEAVE_FORMULATION_tlsph, 2), rows, radius(2.0));
  EXPECT_EQ(cleave_model_setup(flat), CLEAVE_OK) << last_message();
  for (std::size_t k = 1; k < rows.X.size(); k += 3) rows.X[k] *= 1e-2;
  expect_refused(kernel_case(CLEAVE_FORMULATION_tlsph, 2), rows, radius(2.0), CLEAVE_BAD_ARGUMENT,
                 "do not surround it well enough");
}

// Later questions that the methods have no answer to.
TEST(KernelSetup, RefusesCutsAndStaticsWithAPenalty) {
  Model model;
  model.add(kernel_case(CLEAVE_FORMULATION_tlsph, 2), patch(2, 6, 1.0, 0.1, 72),
            hourglass("conservative", 0.1));
  model.setup();
  const std::array<int64_t, 2> pair = {0, 1};
  EXPECT_EQ(cleave_body_precrack(model, 0, 1, pair.data()), CLEAVE_UNSUPPORTED);
  EXPECT_NE(last_message().find("no bonds that can be cut"), std::string::npos) << last_message();
  model.initialise();
  EXPECT_EQ(cleave_model_solve_static(model, 1.0, nullptr, nullptr), CLEAVE_UNSUPPORTED);
  EXPECT_NE(last_message().find("hourglass penalty"), std::string::npos) << last_message();
}

TEST(KernelSetup, NamesMeshesItCannotUse) {
  const Case sph = kernel_case(CLEAVE_FORMULATION_tlsph, 2);
  SimplexMesh cloud = patch(2, 4, 1.0, 0.1, 73);
  cloud.simplices.clear();
  expect_refused(sph, cloud, {}, CLEAVE_UNSUPPORTED, "has no simplices");
  SimplexMesh twins = patch(2, 4, 1.0, 0.1, 73);
  for (std::size_t k = 0; k < 3; ++k) twins.X[3 * 7 + k] = twins.X[3 * 12 + k];
  expect_refused(sph, twins, {}, CLEAVE_BAD_ARGUMENT, "at the same place");
  SimplexMesh lonely = patch(2, 4, 1.0, 0.1, 73);
  lonely.X.insert(lonely.X.end(), {0.5, 0.4, 0.0});
  expect_refused(sph, lonely, {}, CLEAVE_BAD_SIMPLEX, "particle 25");
  SimplexMesh wrong = patch(2, 4, 1.0, 0.1, 73);
  wrong.simplices[5] = 25;
  expect_refused(sph, wrong, {}, CLEAVE_BAD_SIMPLEX, "particle 25 of simplex 1");
}

}  // namespace
}  // namespace cleave::test
