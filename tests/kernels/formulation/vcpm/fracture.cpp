// Bonds that break one after the other in Newton's method: that every equilibrium is one, that relaxation goes the same
// way, that a restart has the same bits, loads that stop at a limit, ties, loose and free pieces.
#include <algorithm>
#include <cmath>
#include <functional>

#include "formulation/common/critical_bonds.hpp"
#include "formulation/vcpm/balls.hpp"
#include "solver/loaded_patch.hpp"

namespace cleave::test {
namespace {

constexpr double kStrain = 0.01;  // of bonds

struct Brittle {
  std::int32_t kinematics = CLEAVE_PLANE_STRESS;
  std::string criterion = "strain", geometry = "linear", softening = "none";
};

Case case_of(const Brittle& b) {
  return {CLEAVE_FORMULATION_vcpm, CLEAVE_MATERIAL_linear_elastic, b.kinematics};
}

SimplexMesh mesh_of(const Brittle& b, int cells) {
  return solid(case_of(b), cells, LoadedPatch::kSpacing, 0.0, 1);
}

double limit_of(const Brittle& b) {
  if (b.criterion == "strain") return kStrain;
  const double E = 3.24e9, h = LoadedPatch::kSpacing;
  const double force = 0.6 * E * kStrain * (b.kinematics == CLEAVE_3D ? h * h : h);
  return b.criterion == "force" ? force : 0.5 * force * kStrain * h;
}

// Pulled in x, notched in the middle.
class Strip : public LoadedPatch {
 public:
  explicit Strip(const Brittle& b, int cells = 12, bool begin = true, bool notched = true)
      : LoadedPatch(case_of(b), mesh_of(b, cells),
                    {{"vcpm", "criterion", 0, b.criterion},
                     {"vcpm", "geometry", 0, b.geometry},
                     {"vcpm", "limit", limit_of(b)},
                     {"vcpm", "softening", 0, b.softening},
                     {"vcpm", "final_strain", b.softening == "none" ? 0 : 4 * kStrain}},
                    false) {
    ok(cleave_static_options_init(&newton));
    newton.breaking = CLEAVE_BREAKING_ONE;
    newton.tolerance = 1e-11;
    if (!begin) return;
    if (notched) notch();
    model.initialise();
  }
  void notch() {
    const auto X = model.real("reference_position");
    double top = 0;
    for (std::size_t i = 1; i < X.size(); i += 3) top = std::fmax(top, X[i]);
    cut([&](const double* a, const double* b) {
      return (a[0] - 0.52 * width()) * (b[0] - 0.52 * width()) < 0 && a[1] + b[1] < 0.5 * top;
    });
  }
  void cut(const std::function<bool(const double*, const double*)>& crosses) {
    const auto X = model.real("reference_position");
    const auto ends = model.integer("bond_ends");
    std::vector<std::int64_t> pairs;
    for (std::size_t b = 0; b < ends.size(); b += 2)
      if (crosses(&X[3 * static_cast<std::size_t>(ends[b])],
                  &X[3 * static_cast<std::size_t>(ends[b + 1])]))
        pairs.insert(pairs.end(), {ends[b], ends[b + 1]});
    ok(cleave_body_precrack(model, 0, std::ssize(pairs) / 2, pairs.data()));
  }
  cleave_static_report load(double strain) {
    pull(strain);
    cleave_static_report report{};
    report.size = sizeof report;
    ok(cleave_model_solve_static(model, strain, &newton, &report));
    return report;
  }
  cleave_static_report break_once() {
    cleave_static_report report{};
    report.size = sizeof report;
    ok(cleave_model_break_static(model, &newton, &report));
    return report;
  }
  std::int64_t break_all() {
    std::int64_t broken = 0;
    for (auto done = break_once(); done.broken > 0; done = break_once()) broken += done.broken;
    return broken;
  }
  std::vector<std::int64_t> order() const {
    const auto number = model.integer("bond_event");
    std::vector<std::int64_t> out(static_cast<std::size_t>(model.counts().broken), -1);
    for (std::size_t b = 0; b < number.size(); ++b)
      if (number[b] > 0)
        out[static_cast<std::size_t>(number[b] - 1)] = static_cast<std::int64_t>(b);
    return out;
  }
  cleave_static_options newton{};
};

const std::vector<Brittle> kKinds = {{CLEAVE_PLANE_STRESS, "strain", "linear"},
                                     {CLEAVE_PLANE_STRAIN, "force", "linear"},
                                     {CLEAVE_PLANE_STRAIN, "energy", "linear"},
                                     {CLEAVE_PLANE_STRESS, "force", "finite"},
                                     {CLEAVE_3D, "strain", "linear"}};

std::string label(const Brittle& b) {
  return b.criterion + " " + b.geometry + " " + std::to_string(b.kinematics);
}
int cells_of(const Brittle& b) { return b.kinematics == CLEAVE_3D ? 5 : 12; }
// Beyond the first failures of all of them.
double far(const Brittle& b) {
  if (b.kinematics == CLEAVE_3D) return 0.02;
  return b.criterion == "strain" ? 0.01 : 0.006;
}

TEST(VolumeCompensatedFracture, RoundingDoesNotChooseAmongEquals) {
  const std::vector<CriticalBond> bonds = {{9, 1.2}, {7, 1.5 + 1e-12}, {3, 1.5}, {5, 1.5 - 1e-8}};
  const auto kept = [&](Breaking which) {
    std::vector<CriticalBond> found = bonds;
    keep_most_critical(found, which);
    std::vector<std::int32_t> numbers;
    for (const CriticalBond& bond : found) numbers.push_back(bond.bond);
    return numbers;
  };
  EXPECT_EQ(kept(Breaking::one), (std::vector<std::int32_t>{3}));
  EXPECT_EQ(kept(Breaking::ties), (std::vector<std::int32_t>{7, 3}));
  EXPECT_EQ(kept(Breaking::all).size(), 4u);
}

// A corrected factorisation that were not that of the bonds that carry would need more iterations.
TEST(VolumeCompensatedFracture, EveryEquilibriumTakesOneSolution) {
  for (const Brittle& kind : kKinds) {
    Strip strip(kind, cells_of(kind));
    strip.load(far(kind));
    std::int64_t events = 0, most = 0;
    for (auto done = strip.break_once(); done.broken > 0; done = strip.break_once(), ++events) {
      most = std::max(most, done.iterations);
      EXPECT_LT(done.residual, strip.newton.tolerance);
    }
    EXPECT_GT(events, 10) << label(kind);
    EXPECT_LE(most, kind.geometry == "linear" ? 1 : 4) << label(kind);
    const cleave_energies e = strip.model.energies();
    // measured 3e-13; of the trapezoid over the one increment 7e-4
    EXPECT_LT(std::fabs(e.balance), (kind.geometry == "linear" ? 1e-10 : 2e-3) * e.reaction)
        << label(kind);
    EXPECT_GT(e.viscous, 0.05 * e.reaction);  // the crack runs: what it cannot use is lost
  }
}

TEST(VolumeCompensatedFracture, RelaxationBreaksTheSameBonds) {
  for (const Brittle& kind : kKinds) {
    Strip newton(kind, cells_of(kind)), relaxed(kind, cells_of(kind));
    newton.load(0.6 * far(kind));
    newton.break_all();
    relaxed.options.breaking = CLEAVE_BREAKING_ONE;
    relaxed.options.tolerance = 1e-9;
    relaxed.relaxed(0.6 * far(kind));
    EXPECT_EQ(newton.order().size(), relaxed.order().size()) << label(kind);
    if (kind.kinematics == CLEAVE_3D) continue;  // rows of equals
    EXPECT_EQ(newton.order(), relaxed.order()) << label(kind);
    EXPECT_NEAR(newton.force(), relaxed.force(), 1e-6 * std::fabs(relaxed.force()));
    const cleave_energies a = newton.model.energies(), b = relaxed.model.energies();
    EXPECT_NEAR(a.fracture, b.fracture, 1e-6 * b.fracture);
    EXPECT_NEAR(a.viscous, b.viscous, 1e-6 * b.reaction);
  }
}

// The last with more unknowns than one level has.
TEST(VolumeCompensatedFracture, ConjugateGradientsBreakTheSameBonds) {
  std::vector<std::pair<Brittle, int>> bodies;
  for (const Brittle& kind : kKinds) bodies.emplace_back(kind, cells_of(kind));
  bodies.emplace_back(kKinds.front(), 34);
  std::size_t most = 0;
  for (const auto& [kind, cells] : bodies) {
    Strip direct(kind, cells), iterative(kind, cells);
    iterative.newton.solver = CLEAVE_SOLVER_ITERATIVE;
    for (Strip* strip : {&direct, &iterative}) {
      strip->load((cells == 34 ? 0.6 : 1.0) * far(kind));
      strip->break_all();
    }
    most = std::max(most, direct.order().size());
    EXPECT_EQ(direct.order().size(), iterative.order().size()) << label(kind);
    if (kind.kinematics == CLEAVE_3D) continue;  // rows of equals
    EXPECT_EQ(direct.order(), iterative.order()) << label(kind);
    // measured 2e-11
    EXPECT_NEAR(direct.force(), iterative.force(), 1e-8 * std::fabs(direct.force()));
  }
  EXPECT_GT(most, 60u);  // so that multigrid is made anew on the way
}

// Bonds that the factor does not know yet, after each that breaks.
TEST(VolumeCompensatedFracture, FactorsAreCorrectedAsOftenAsTheCallerAllows) {
  Strip expected({}, 12);
  expected.load(far({}));
  for (int k = 0; k < 9; ++k) expected.break_once();
  for (const std::int32_t most : {0, 1, 3}) {
    Strip strip({}, 12);
    strip.newton.corrections = most;
    strip.load(far({}));
    for (std::int32_t k = 1; k < 10; ++k) {
      strip.break_once();
      EXPECT_EQ(k - strip.model.integer("factored_bonds")[0], k % (most + 1)) << most;
    }
    EXPECT_EQ(strip.order(), expected.order()) << most;
    // measured 3e-15
    EXPECT_NEAR(strip.force(), expected.force(), 1e-11 * std::fabs(expected.force())) << most;
  }
  expected.newton.corrections = -2;
  cleave_static_report report{};
  report.size = sizeof report;
  EXPECT_EQ(cleave_model_break_static(expected.model, &expected.newton, &report),
            CLEAVE_BAD_ARGUMENT);
}

TEST(VolumeCompensatedFracture, ARestartHasTheSameBits) {
  for (const Brittle& kind : kKinds)
    for (const int stop : {3, 9, 14}) {
      Strip whole(kind, cells_of(kind)), second(kind, cells_of(kind), false);
      if (stop == 14) whole.newton.solver = second.newton.solver = CLEAVE_SOLVER_ITERATIVE;
      whole.load(far(kind));
      for (int k = 0; k < stop; ++k) whole.break_once();
      copy_state(whole.model, second.model);
      for (int k = 0; k < 20; ++k) {
        whole.break_once();
        second.break_once();
      }
      whole.load(1.1 * far(kind));
      second.load(1.1 * far(kind));
      EXPECT_EQ(whole.state(), second.state()) << label(kind) << " after " << stop;
    }
}

TEST(VolumeCompensatedFracture, LoadsStopWhereABondReachesItsLimit) {
  for (const Brittle& kind : kKinds) {
    Strip strip(kind, cells_of(kind));
    strip.newton.stop_at_limit = 1;
    double strain = far(kind), reached = 0;
    auto report = strip.load(strain);
    ASSERT_LT(report.fraction, 1);
    EXPECT_EQ(strip.model.energies().reaction, 0);
    for (int k = 0; k < 8 && report.fraction < 1; ++k) {
      strain = reached + report.fraction * (strain - reached);
      report = strip.load(strain);
    }
    EXPECT_EQ(report.fraction, 1) << label(kind);
    EXPECT_GE(report.critical, 1) << label(kind);
    EXPECT_EQ(strip.break_once().broken, 1);
    cleave_event event{};
    event.size = sizeof event;
    ok(cleave_body_event_get(strip.model, 0, 0, &event));
    EXPECT_GT(event.criterion, event.limit);
    EXPECT_LT(event.criterion, (1 + (kind.geometry == "linear" ? 1e-8 : 2.1e-6)) * event.limit)
        << label(kind);
  }
}

TEST(VolumeCompensatedFracture, TiesKeepASymmetricBodySymmetric) {
  const auto mirrored = [](const Strip& strip) {
    const auto X = strip.model.real("reference_position"), d = strip.model.real("damage");
    double top = 0, off = 0;
    for (std::size_t i = 1; i < X.size(); i += 3) top = std::fmax(top, X[i]);
    for (std::size_t i = 0; i < d.size(); ++i)
      for (std::size_t p = 0; p < d.size(); ++p)
        if (std::hypot(X[3 * i] - X[3 * p], X[3 * i + 1] + X[3 * p + 1] - top) < 1e-6)
          off = std::fmax(off, std::fabs(d[i] - d[p]));
    return off;
  };
  Strip one({}, 12, true, false), ties({}, 12, true, false);
  ties.newton.breaking = CLEAVE_BREAKING_TIES;
  for (Strip* strip : {&one, &ties}) {
    strip->load(0.012);
    strip->break_once();
  }
  EXPECT_GT(mirrored(one), 0);
  EXPECT_EQ(mirrored(ties), 0);
  for (int k = 0; k < 5; ++k) EXPECT_GE(ties.break_once().broken, 2);
  EXPECT_EQ(mirrored(ties), 0);
}

// A particle that hangs on one bond could turn about its neighbour: it loses that bond too.
TEST(VolumeCompensatedFracture, LooseParticlesLoseTheirBonds) {
  Strip strip({});
  strip.newton.breaking = CLEAVE_BREAKING_ALL;  // shatters it
  strip.load(0.05);
  strip.break_all();
  std::int64_t count = 0, with_particles = 0;
  ok(cleave_body_event_count(strip.model, 0, &count));
  for (std::int64_t k = 0; k < count; ++k) {
    cleave_event event{};
    event.size = sizeof event;
    ok(cleave_body_event_get(strip.model, 0, k, &event));
    with_particles += event.criterion < event.limit ? 1 : 0;
  }
  const auto status = strip.model.integer("bond_status"), ends = strip.model.integer("bond_ends");
  std::vector<int> held(static_cast<std::size_t>(strip.model.counts().particles), 0);
  for (std::size_t b = 0; b < status.size(); ++b)
    for (std::size_t k = 0; k < 2 && status[b] == 0; ++k)
      ++held[static_cast<std::size_t>(ends[2 * b + k])];
  EXPECT_EQ(std::count(held.begin(), held.end(), 1), 0);
  EXPECT_GT(with_particles, 0);
}

// A ball whose rim is stretched along x, around an island whose ties alone may break. With the last of them gone it
// stays where it is and the rest goes on, unless it carries a load.
struct Island {
  static constexpr double kIsland = 2.6, kRim = 5.6;
  Island()
      : cloud(ball("triangular", 6.6, 0.2)),
        body(CLEAVE_FORMULATION_vcpm, CLEAVE_PLANE_STRAIN, cloud,
             {{"vcpm", "geometry", 0, "linear"},
              {"vcpm", "criterion", 0, "strain"},
              {"vcpm", "limit", kStrain}},
             {2.1e5, 0.4, 7.8e-9}, [this](Model& model) { hold(model); }) {
    const auto ends = body.model.integer("bond_ends");
    std::vector<std::int64_t> pairs;
    for (std::size_t b = 0; b < ends.size(); b += 2)
      if (inside(ends[b]) != inside(ends[b + 1]) && std::fabs(at(ends[b])[1]) > 1)
        pairs.insert(pairs.end(), {ends[b], ends[b + 1]});
    ok(cleave_body_precrack(body.model, 0, std::ssize(pairs) / 2, pairs.data()));
    body.model.initialise();
    ok(cleave_static_options_init(&options));
  }
  void hold(Model& model) {
    std::vector<std::int64_t> particles, tough;
    std::vector<std::int32_t> directions;
    for (std::size_t i = 0; i < cloud.size(); ++i) {
      const auto particle = static_cast<std::int64_t>(i);
      if (std::fabs(norm(cloud.X[i]) - kIsland) > 1) tough.push_back(particle);
      for (int k = 0; k < 2 && norm(cloud.X[i]) > kRim; ++k) {
        particles.push_back(particle);
        directions.push_back(k);
        stretch.push_back(k == 0 ? cloud.X[i][0] : 0.0);
      }
    }
    const std::vector<std::int32_t> motion(particles.size(), CLEAVE_MOTION_EXACT);
    ok(cleave_body_prescribe(model, 0, std::ssize(particles), particles.data(), directions.data(),
                             motion.data()));
    ok(cleave_body_exempt(model, 0, std::ssize(tough), tough.data()));
  }
  const Point& at(std::int64_t i) const { return cloud.X[static_cast<std::size_t>(i)]; }
  bool inside(std::int64_t i) const { return norm(at(i)) < kIsland; }
  std::int32_t load(double strain) {
    std::vector<double> u = stretch;
    for (double& value : u) value *= strain;
    ok(cleave_body_motion(body.model, 0, std::ssize(u), u.data(), nullptr));
    return cleave_model_solve_static(body.model, strain, &options, nullptr);
  }
  std::int64_t ties() const {
    const auto ends = body.model.integer("bond_ends"), status = body.model.integer("bond_status");
    std::int64_t count = 0;
    for (std::size_t b = 0; b < status.size(); ++b)
      count += status[b] == 0 && inside(ends[2 * b]) != inside(ends[2 * b + 1]);
    return count;
  }
  Cloud cloud;
  std::vector<double> stretch;
  mutable CloudBody body;
  cleave_static_options options{};
};

TEST(VolumeCompensatedFracture, APieceThatIsCutOffStaysWhereItIs) {
  for (const bool loaded : {false, true}) {
    Island island;
    Model& model = island.body.model;
    EXPECT_GT(island.ties(), 5);
    std::vector<double> force(3 * island.cloud.size(), 0.0);
    force[0] = loaded ? 1e-3 : 0.0;  // on the particle in the middle
    model.put("external_force", force);
    ok(island.load(0.3));
    std::int32_t status = CLEAVE_OK;
    cleave_static_report report{};
    std::vector<std::int64_t> before;
    for (report.broken = 1; status == CLEAVE_OK && report.broken > 0;) {
      before = model.integer("bond_event");
      report = {};
      report.size = sizeof report;
      status = cleave_model_break_static(model, &island.options, &report);
    }
    EXPECT_EQ(status, loaded ? CLEAVE_NO_CONVERGENCE : CLEAVE_OK) << last_message();
    if (loaded) {
      EXPECT_NE(last_message().find("nothing holds it any more"), std::string::npos)
          << last_message();
      EXPECT_EQ(before, model.integer("bond_event"));
      EXPECT_GT(island.ties(), 0);
    } else {
      EXPECT_EQ(island.ties(), 0);
      ok(island.load(0.4));
    }
  }
}

// Bonds that soften are another body after every equilibrium, broken or not.
TEST(VolumeCompensatedFracture, SofteningFollowsRelaxation) {
  const Brittle soft{CLEAVE_PLANE_STRESS, "strain", "linear", "linear"};
  Strip newton(soft), relaxed(soft);
  newton.newton.breaking = CLEAVE_BREAKING_ALL;
  relaxed.options.tolerance = 1e-9;
  double peak = 0;
  for (const double strain : {0.006, 0.009, 0.012, 0.016, 0.02}) {
    newton.load(strain);
    for (auto done = newton.break_once(); done.critical > 0;) done = newton.break_once();
    relaxed.relaxed(strain);
    peak = std::fmax(peak, std::fabs(newton.force()));
    EXPECT_NEAR(newton.force(), relaxed.force(), 1e-4 * peak) << strain;
  }
  EXPECT_LT(std::fabs(newton.force()), 0.9 * peak);
  EXPECT_GT(newton.model.energies().fracture, 0);
  cleave_static_options one = newton.newton;
  one.breaking = CLEAVE_BREAKING_ONE;
  EXPECT_EQ(cleave_model_break_static(newton.model, &one, nullptr), CLEAVE_UNSUPPORTED);
  EXPECT_NE(last_message().find("not taken one at a time"), std::string::npos);
}

TEST(VolumeCompensatedFracture, ABodyThatNothingHoldsIsNamed) {
  const Cloud cloud = ball("triangular", 3.1);
  CloudBody body(CLEAVE_FORMULATION_vcpm, CLEAVE_PLANE_STRAIN, cloud,
                 {{"vcpm", "geometry", 0, "linear"}});
  body.model.initialise();
  EXPECT_EQ(cleave_model_solve_static(body.model, 1.0, nullptr, nullptr), CLEAVE_NO_CONVERGENCE);
  EXPECT_NE(last_message().find("can move without resistance"), std::string::npos)
      << last_message();
  EXPECT_NE(last_message().find("particle"), std::string::npos) << last_message();
}

}  // namespace
}  // namespace cleave::test
