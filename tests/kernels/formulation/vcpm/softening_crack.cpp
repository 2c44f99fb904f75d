// A strip of close-packed rows pulled apart between two of them by relaxation, its particles held along the
// rows: force and energy of the crack against a chain of rows in closed form.
#include <Eigen/Dense>

#include "formulation/vcpm/balls.hpp"

namespace cleave::test {
namespace {

constexpr double kE = 2.1e5, kOnset = 0.002, kFinal = 0.02;
constexpr int kGaps = 3, kWeak = 1;  // between the rows; the gap that opens
const double kSlope = std::sqrt(3.0) / 2;

struct Constants {
  double nu;
  double k() const { return 4 * kE / (std::sqrt(3.0) * (1 + nu)); }
  double T() const { return kE * (4 * nu - 1) / (2 * (1 + nu) * (1 - 2 * nu)); }
  double c() const { return std::sqrt(3.0) / 9 * T(); }  // V T w^2/2 at spacing 1
};

// Rows of infinite length: elongation x_j of the bonds of each gap, and the force F of a bond, the same in all:
//   k/2 x_j + c (q_j-1 + 2 q_j + q_j+1) = F/g_j,  q = g x,  in the open gap x = strain given.
struct Chain {
  Chain(const Constants& m, double strain, double g) {
    Eigen::MatrixXd A = Eigen::MatrixXd::Zero(kGaps, kGaps);
    Eigen::VectorXd b = Eigen::VectorXd::Zero(kGaps);
    for (int j = 0; j < kGaps; ++j) {
      const double own = j == kWeak ? g : 1;
      const auto add = [&](int gap, double factor) {  // factor x_gap, F in the place of x_kWeak
        if (gap == kWeak) {
          b(j) -= factor * strain;
        } else {
          A(j, gap) += factor;
        }
      };
      add(j, own * m.k() / 2);
      for (int n = j - 1; n <= j + 1; ++n)
        if (n >= 0 && n < kGaps) add(n, own * m.c() * (n == j ? 2 : 1) * (n == kWeak ? g : 1));
      A(j, kWeak) -= 1;
    }
    const Eigen::VectorXd x = A.fullPivLu().solve(b);
    force = x(kWeak);
    double sum = strain;
    for (int j = 0; j < kGaps; ++j)
      if (j != kWeak) sum += x(j);
    pull = sum / kSlope;
    const double theta = 2 * g * strain + x(kWeak - 1) + x(kWeak + 1);
    release = m.k() / 4 * strain * strain + m.c() * theta * strain;
  }
  double force, pull;
  double release;  // -dU/dg of a bond of the open gap
};

double integrity(double strain) {
  return strain > kOnset ? (kFinal - strain) / (kFinal - kOnset) * kOnset / strain : 1;
}

class Strip {
 public:
  Strip(int width, double nu, const std::vector<Setting>& law)
      : cloud_(rows(width)),
        body_(CLEAVE_FORMULATION_vcpm, CLEAVE_PLANE_STRAIN, cloud_, settings(law), {kE, nu, 7.8e-9},
              [&](Model& model) { hold(model); }) {
    EXPECT_EQ(body_.refusal, "");
    model().initialise();
    ok(cleave_relaxation_options_init(&options_));
    options_.tolerance = 1e-9;
  }
  std::int64_t pull(double distance) {
    std::vector<double> u = pulled_;
    for (double& value : u) value *= distance;
    ok(cleave_body_motion(model(), 0, std::ssize(u), u.data(), nullptr));
    cleave_relaxation_report report{};
    report.size = sizeof report;
    ok(cleave_model_relax(model(), 1.0, &options_, &report));
    return report.rounds;
  }
  std::string refusal_of_one() {
    options_.breaking = CLEAVE_BREAKING_ONE;
    EXPECT_EQ(cleave_model_relax(model(), 1.0, &options_, nullptr), CLEAVE_UNSUPPORTED);
    return last_message();
  }
  double force() {
    double f[3] = {};
    ok(cleave_body_reaction(model(), 0, std::ssize(top_), top_.data(), f));
    return f[1];
  }
  // Of a bond of the open gap in the middle.
  double middle_integrity() {
    const auto g = model().real("bond_integrity");
    const auto ends = model().integer("bond_ends");
    double least = 1;
    for (std::size_t b = 0; b < g.size(); ++b) {
      const Point mid = 0.5 * (cloud_.X[static_cast<std::size_t>(ends[2 * b])] +
                               cloud_.X[static_cast<std::size_t>(ends[2 * b + 1])]);
      if (std::fabs(mid[1] - (kWeak + 0.5) * kSlope) < 0.1) least = std::fmin(least, g[b]);
    }
    return least;
  }
  Model& model() { return body_.model; }

 private:
  static Cloud rows(int width) {
    Cloud cloud{2, {}, {}};
    for (int r = 0; r <= kGaps; ++r)
      for (int i = 0; i < width; ++i) cloud.X.push_back({i + 0.5 * (r % 2), kSlope * r, 0});
    cloud.volume.assign(cloud.size(), 1.0);
    return cloud;
  }
  static std::vector<Setting> settings(std::vector<Setting> law) {
    law.push_back({"vcpm", "geometry", 0, "linear"});
    law.push_back({"vcpm", "criterion", 0, "strain"});
    law.push_back({"vcpm", "limit", kOnset});
    law.push_back({"vcpm", "softening", 0, "linear"});
    return law;
  }
  void hold(Model& model) {
    std::vector<std::int64_t> particles, strong;
    std::vector<std::int32_t> directions;
    for (std::size_t i = 0; i < cloud_.size(); ++i) {
      const auto number = static_cast<std::int64_t>(i);
      const double row = cloud_.X[i][1] / kSlope;
      particles.push_back(number);
      directions.push_back(0);
      pulled_.push_back(0);
      if (row < kWeak - 0.5 || row > kWeak + 1.5) strong.push_back(number);
      if (row > 0.5 && row < kGaps - 0.5) continue;
      particles.push_back(number);
      directions.push_back(1);
      pulled_.push_back(row > 0.5 ? 1 : 0);
      if (row > 0.5) top_.push_back(number);
    }
    const std::vector<std::int32_t> motion(particles.size(), CLEAVE_MOTION_EXACT);
    ok(cleave_body_prescribe(model, 0, std::ssize(particles), particles.data(), directions.data(),
                             motion.data()));
    ok(cleave_body_exempt(model, 0, std::ssize(strong), strong.data()));
  }
  Cloud cloud_;
  std::vector<double> pulled_;
  std::vector<std::int64_t> top_;
  CloudBody body_;
  cleave_relaxation_options options_{};
};

const std::vector<Setting> kByStrain = {{"vcpm", "final_strain", kFinal}};

// Springs alone (nu = 1/4): rows stay straight, also at the ends.
TEST(VolumeCompensatedSoftening, StripFollowsTheChainOfRows) {
  const Constants m{0.25};
  const int width = 6, bonds = 2 * width - 1;
  Strip strip(width, m.nu, kByStrain);
  const double end = kFinal / kSlope;
  int most = 0;
  double off_force = 0, off_integrity = 0;
  for (int n = 1; n <= 40; ++n) {
    const double pull = 1.05 * end * n / 40;
    most = std::max(most, static_cast<int>(strip.pull(pull)));
    // The strain of the chain with this pull.
    double low = 0, high = kFinal;
    for (int k = 0; k < 60; ++k) {
      const double mid = 0.5 * (low + high);
      (Chain(m, mid, integrity(mid)).pull < pull ? low : high) = mid;
    }
    const double g = integrity(low);
    const double peak = bonds * kSlope * 0.5 * m.k() * kOnset;
    const double due = n > 38 ? 0 : bonds * kSlope * Chain(m, low, g).force;
    off_force = std::fmax(off_force, std::fabs(strip.force() - due) / peak);
    if (n < 38) off_integrity = std::fmax(off_integrity, std::fabs(strip.middle_integrity() - g));
  }
  EXPECT_LT(off_force, 3e-4);  // measured 1.1e-4: bonds are left as they are while they would lose
  EXPECT_LT(off_integrity, 5e-4);  // less than 1e-4; measured 2.4e-4
  EXPECT_LT(most, 40);             // measured 19
  EXPECT_EQ(strip.model().counts().broken, bonds);
  const cleave_energies e = strip.model().energies();
  EXPECT_LT(std::fabs(e.balance), 1e-8 * e.reaction);  // measured 8e-11
}

TEST(VolumeCompensatedSoftening, OneBondAtATimeIsRefused) {
  Strip strip(4, 0.25, kByStrain);
  EXPECT_NE(strip.refusal_of_one().find("use breaking 'all', or softening 'none' in group vcpm"),
            std::string::npos);
}

// Two widths differ by a crack without ends. The works of the increments err by their size: extrapolated.
TEST(VolumeCompensatedSoftening, EnergyOfACrackAlongARow) {
  for (const double nu : {-0.3, 0.0, 0.25, 0.3}) {
    const Constants m{nu};
    double due = 0;
    const int parts = 1000;
    for (int n = 0; n < parts; ++n) {
      const double a = kOnset + (kFinal - kOnset) * n / parts,
                   b = kOnset + (kFinal - kOnset) * (n + 1) / parts, mid = 0.5 * (a + b);
      due += 2 * Chain(m, mid, integrity(mid)).release * (integrity(a) - integrity(b));
    }
    const auto work = [&](int width, int increments) {
      Strip strip(width, nu, kByStrain);
      for (int n = 1; n <= increments; ++n) strip.pull(1.1 * kFinal / kSlope * n / increments);
      EXPECT_EQ(strip.model().counts().broken, 2 * width - 1);
      return strip.model().energies().reaction;
    };
    const auto toughness = [&](int increments) {
      return (work(9, increments) - work(6, increments)) / 3;
    };
    const double Gf = 2 * toughness(80) - toughness(40), springs = 0.5 * m.k() * kOnset * kFinal;
    EXPECT_NEAR(Gf, due, 3e-3 * due) << nu;  // measured 4e-4 to 9e-4
    if (nu == 0.25) {
      EXPECT_NEAR(due, springs, 1e-5 * springs);
    }
  }
}

}  // namespace
}  // namespace cleave::test
