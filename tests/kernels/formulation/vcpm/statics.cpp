// Statics of the volume-compensated particle model: Newton's method on its own stiffness, and the published elements of ten particles,
// which must assemble to the same matrix.
#include <map>

#include "formulation/vcpm/balls.hpp"

namespace cleave::test {
namespace {

// A ball whose shell is moved by a strain of some percent and a little at random; the inside finds equilibrium.
struct Shaken {
  Shaken(const Solid& solid, const std::string& geometry, const std::string& surface)
      : cloud(ball(solid.lattice, 3.2)),
        body(CLEAVE_FORMULATION_vcpm, solid.kinematics, cloud,
             {{"vcpm", "geometry", 0, geometry}, {"vcpm", "surface", 0, surface}},
             {2.1e5, 0.4, 7.8e-9}, [&](Model& model) { hold(model); }) {
    body.damage(12, 5);
    body.model.initialise();
    ok(cleave_body_motion(body.model, 0, std::ssize(given), given.data(), nullptr));
  }
  void hold(Model& model) {
    const std::vector<double> shake = random_field(cloud, 0.01, 3);
    std::vector<std::int64_t> particles;
    std::vector<std::int32_t> directions;
    for (std::size_t i = 0; i < cloud.size(); ++i) {
      if (norm(cloud.X[i]) < 2.1) {
        inside.push_back(i);
        continue;
      }
      for (int k = 0; k < cloud.dimension; ++k) {
        const auto c = static_cast<std::size_t>(k);
        particles.push_back(static_cast<std::int64_t>(i));
        directions.push_back(k);
        given.push_back((k == 0 ? 0.03 : -0.01) * cloud.X[i][c] + 0.05 * cloud.X[i][(c + 1) % 2] +
                        shake[3 * i + c]);
      }
    }
    const std::vector<std::int32_t> motion(particles.size(), CLEAVE_MOTION_EXACT);
    ok(cleave_body_prescribe(model, 0, std::ssize(particles), particles.data(), directions.data(),
                             motion.data()));
  }
  double unbalanced() const {
    const auto f = body.model.real("internal_force");
    double inner = 0;
    for (const std::size_t i : inside)
      for (std::size_t k = 0; k < 3; ++k) inner = std::fmax(inner, std::fabs(f[3 * i + k]));
    return inner / largest(f);
  }
  Cloud cloud;
  std::vector<double> given;
  std::vector<std::size_t> inside;
  mutable CloudBody body;
};

TEST(VolumeCompensatedStatics, NewtonConvergesQuadraticallyOnEveryLattice) {
  for (const Solid& solid : kSolids)
    for (const std::string surface : {"keep", "extend"})
      for (const std::string geometry : {"linear", "finite"}) {
        const Shaken ball(solid, geometry, surface);
        cleave_static_report report{};
        report.size = sizeof report;
        cleave_static_options options;
        ok(cleave_static_options_init(&options));
        options.tolerance = 1e-11;
        ok(cleave_model_solve_static(ball.body.model, 1.0, &options, &report));
        EXPECT_LE(report.iterations, geometry == "linear" ? 1 : 5)  // measured 1 and 4
            << solid.lattice << ' ' << surface;
        EXPECT_LT(ball.unbalanced(),
                  geometry == "linear" ? 1e-13 : 1e-10);  // measured 6e-15, 2e-11
      }
}

TEST(VolumeCompensatedStatics, RelaxationFindsTheSame) {
  for (const Solid& solid : {kSolids[0], kSolids[3]}) {
    const Shaken one(solid, "finite", "extend"), other(solid, "finite", "extend");
    cleave_static_report report{};
    report.size = sizeof report;
    ok(cleave_model_solve_static(one.body.model, 1.0, nullptr, &report));
    cleave_relaxation_options options;
    ok(cleave_relaxation_options_init(&options));
    options.tolerance = 1e-10;
    ok(cleave_model_relax(other.body.model, 1.0, &options, nullptr));
    const auto u = one.body.model.real("displacement"), v = other.body.model.real("displacement");
    EXPECT_LT(difference(u, v), 1e-8);  // measured 1e-10
  }
}

// ---- the published elements

using Slope = std::map<std::size_t, Point>;  // of a scalar with the displacements of particles

struct Elements {
  Elements(const Cloud& points, double stiffness, double T) : cloud(points), k(stiffness), Tbar(T) {
    for (std::size_t a = 0; a < cloud.size(); ++a) {
      neighbours.emplace_back();
      for (std::size_t b = 0; b < cloud.size(); ++b)
        if (b != a && norm(cloud.X[b] - cloud.X[a]) < 1.5) neighbours[a].push_back(b);
    }
  }
  Point direction(std::size_t a, std::size_t b) const {
    const Point d = cloud.X[b] - cloud.X[a];
    return 1 / norm(d) * d;
  }
  // of scale dL_ab
  void add(std::size_t a, std::size_t b, double scale, Slope& slope) const {
    const Point n = scale * direction(a, b);
    slope[a] = slope[a] - n;
    slope[b] = slope[b] + n;
  }
  // Of the force of a bond, over the particles of its element.
  Slope force(std::size_t a, std::size_t b) const {
    Slope slope;
    add(a, b, 0.5 * k, slope);
    for (const std::size_t end : {a, b})
      for (const std::size_t p : neighbours[end]) add(end, p, std::sqrt(3.0) / 18 * Tbar, slope);
    return slope;
  }
  // Each bond twice, once with each end as the first particle: dF_1/du_1 on the diagonal, half of dF_1/du_i beside it and,
  // transposed, below.
  std::vector<double> assemble() const {
    const std::size_t n = 2 * cloud.size();
    std::vector<double> K(n * n, 0.0);
    for (std::size_t a = 0; a < cloud.size(); ++a)
      for (const std::size_t b : neighbours[a]) {
        const Point n1 = -1 * direction(a, b);  // F_1 = F n1
        for (const auto& [p, slope] : force(a, b))
          for (std::size_t r = 0; r < 2; ++r)
            for (std::size_t c = 0; c < 2; ++c) {
              const double entry = n1[r] * slope[c];
              K[n * (2 * a + r) + 2 * p + c] += p == a ? entry : 0.5 * entry;
              if (p != a) K[n * (2 * p + c) + 2 * a + r] += 0.5 * entry;
            }
      }
    return K;
  }
  const Cloud& cloud;
  double k, Tbar;
  std::vector<std::vector<std::size_t>> neighbours;
};

TEST(VolumeCompensatedStatics, TenParticleElementsAssembleToTheSameMatrix) {
  constexpr double kE = 2.1e5, kNu = 0.35;
  const Cloud cloud = ball("triangular", 2.1, 0.4);
  const double T = kE * (4 * kNu - 1) / (2 * (1 + kNu) * (1 - 2 * kNu));
  const std::vector<double> K =
      Elements(cloud, 4 * kE / (std::sqrt(3.0) * (1 + kNu)), T).assemble();
  const std::size_t n = 2 * cloud.size();
  double most = 0, off = 0;
  for (std::size_t column = 0; column < n; ++column) {
    CloudBody body(CLEAVE_FORMULATION_vcpm, CLEAVE_PLANE_STRAIN, cloud,
                   {{"vcpm", "geometry", 0, "linear"}}, kE, kNu);
    std::vector<double> u(3 * cloud.size(), 0.0);
    u[3 * (column / 2) + column % 2] = 1;
    const auto f = body.forces(u);
    for (std::size_t row = 0; row < n; ++row) {
      most = std::fmax(most, std::fabs(K[n * row + column]));
      off = std::fmax(off, std::fabs(K[n * row + column] + f[3 * (row / 2) + row % 2]));
    }
  }
  EXPECT_LT(off, 1e-14 * most);  // measured 6e-16
}

}  // namespace
}  // namespace cleave::test
