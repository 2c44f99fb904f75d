// The listings of the developer manual compile and do what the manual says.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <random>

#include "blatz_ko.hpp"
#include "linear_simplices.hpp"

namespace {

using namespace cleave;

constexpr std::array kRubber = {1000.0, 1.5e6, 0.4e6, 3.0e6};
constexpr std::array kSvk = {1000.0, 5.0e6, 0.3};

template <int D>
Mat<D> random_gradient(std::mt19937_64& engine) {
  std::uniform_real_distribution<double> uniform(-0.2, 0.2);
  Mat<D> h;
  for (int i = 0; i < D; ++i)
    for (int j = 0; j < D; ++j) h(i, j) = uniform(engine);
  return h;
}

// dW/dF by central differences.
template <int D>
double worst_gradient_error(const BlatzKo& law, Mat<D> h) {
  constexpr double step = 1e-6;
  const Mat<D> stress = law.respond(h, History{}, Increment{}).stress;
  double worst = 0;
  for (int i = 0; i < D; ++i) {
    for (int j = 0; j < D; ++j) {
      const double h0 = h(i, j);
      h(i, j) = h0 + step;
      const double above = law.respond(h, History{}, Increment{}).energy;
      h(i, j) = h0 - step;
      const double below = law.respond(h, History{}, Increment{}).energy;
      h(i, j) = h0;
      worst = std::fmax(worst, std::fabs((above - below) / (2 * step) - stress(i, j)));
    }
  }
  return worst / kRubber[1];
}

TEST(BlatzKoExample, HasNoStressAtRest) {
  const BlatzKo law(kRubber, CLEAVE_3D);
  const auto r = law.respond(Mat<3>{}, History{}, Increment{});
  EXPECT_TRUE(r.valid);
  EXPECT_EQ(r.energy, 0.0);
  EXPECT_EQ(contract(r.stress, r.stress), 0.0);
}

TEST(BlatzKoExample, StressIsTheDerivativeOfTheEnergy) {
  std::mt19937_64 engine(7);
  for (int trial = 0; trial < 20; ++trial) {
    // measured 1e-10
    EXPECT_LT(worst_gradient_error(BlatzKo(kRubber, CLEAVE_3D), random_gradient<3>(engine)), 1e-9);
    EXPECT_LT(
        worst_gradient_error(BlatzKo(kRubber, CLEAVE_PLANE_STRAIN), random_gradient<2>(engine)),
        1e-9);
  }
}

TEST(BlatzKoExample, RefusesInversionAndPlaneStress) {
  Mat<2> inverted;
  inverted(0, 0) = -1.5;
  EXPECT_FALSE(
      BlatzKo(kRubber, CLEAVE_PLANE_STRAIN).respond(inverted, History{}, Increment{}).valid);
  EXPECT_FALSE(
      BlatzKo(kRubber, CLEAVE_PLANE_STRESS).respond(Mat<2>{}, History{}, Increment{}).valid);
}

// A strip of jittered triangles with the example in place of the formulation of the body.
class LinearSimplicesExample : public testing::Test {
 protected:
  static constexpr int kColumns = 6, kRows = 4;

  LinearSimplicesExample() {
    std::uniform_real_distribution<double> jitter(-0.2, 0.2);
    for (int r = 0; r < kRows; ++r)
      for (int c = 0; c < kColumns; ++c)
        for (const double x : {c + jitter(engine_), r + jitter(engine_), 0.0})
          positions_.push_back(x);
    for (int r = 0; r + 1 < kRows; ++r) {
      for (int c = 0; c + 1 < kColumns; ++c) {
        const std::int64_t i = r * kColumns + c;
        for (const std::int64_t corner :
             {i, i + 1, i + kColumns, i + 1, i + 1 + kColumns, i + kColumns})
          simplices_.push_back(corner);
      }
    }
    cleave_body_spec spec{};
    cleave_body_spec_init(&spec);
    spec.formulation = CLEAVE_FORMULATION_cbm;
    spec.material = CLEAVE_MATERIAL_svk;
    spec.kinematics = CLEAVE_PLANE_STRAIN;
    spec.particles = kColumns * kRows;
    spec.X = positions_.data();
    spec.simplex_count = static_cast<std::int64_t>(simplices_.size()) / 3;
    spec.simplices = simplices_.data();
    body_ = std::make_unique<Body>(spec, 0);
    body_->formulation = std::make_unique<LinearSimplices>();
    body_->make_fields();
    body_->material = body_->law->make(kSvk, CLEAVE_PLANE_STRAIN);
    ThreadTeam alone;
    body_->formulation->setup(*body_, alone);
  }

  void displace(int particle, int direction, double amount) {
    body_->point.u[3 * particle + direction] += amount;
  }
  double energy() {
    body_->formulation->deform(*body_, {}, team_);
    return body_->formulation->stored_energy(*body_).elastic;
  }

  std::mt19937_64 engine_{11};
  std::vector<double> positions_;
  std::vector<std::int64_t> simplices_;
  std::unique_ptr<Body> body_;
  ThreadTeam team_{2};
};

TEST_F(LinearSimplicesExample, ForceIsMinusTheGradientOfTheEnergy) {
  std::uniform_real_distribution<double> uniform(-0.05, 0.05);
  for (int i = 0; i < kColumns * kRows; ++i)
    for (int k = 0; k < 2; ++k) displace(i, k, uniform(engine_));
  body_->formulation->deform(*body_, {}, team_);
  body_->formulation->forces(*body_, team_);
  constexpr double step = 1e-6;
  double worst = 0, largest = 0;
  for (int i = 0; i < kColumns * kRows; ++i) {
    for (int k = 0; k < 2; ++k) {
      displace(i, k, step);
      const double above = energy();
      displace(i, k, -2 * step);
      const double below = energy();
      displace(i, k, step);
      const double force = body_->point.internal[3 * i + k];
      worst = std::fmax(worst, std::fabs(force + (above - below) / (2 * step)));
      largest = std::fmax(largest, std::fabs(force));
    }
  }
  EXPECT_GT(largest, 0.0);
  EXPECT_LT(worst / largest, 1e-9);  // measured 4e-11
}

TEST_F(LinearSimplicesExample, CarriesTheMassOfTheStripAndSaysWhatItCannotDo) {
  double mass = 0, area = 0;
  for (int i = 0; i < kColumns * kRows; ++i) mass += body_->point.mass[i];
  for (std::size_t s = 0; s < simplices_.size(); s += 3)
    area += simplex_geometry<2>(positions_.data(), simplices_.data() + s).volume;
  EXPECT_NEAR(mass / (kSvk[0] * area), 1.0, 1e-14);  // measured 1e-16
  EXPECT_GT(body_->formulation->stable_step(*body_), 0.0);
  EXPECT_THROW(body_->formulation->precrack(*body_, {}), Error);
}

}  // namespace
