// Bonds between points of a lattice, eight points at a time and each bond once: the forces of any cloud, of sums
// over all pairs and of closed forms; the same bonds break; the same bits for any number of threads.
#include <algorithm>
#include <cstring>

#include "formulation/peridynamics/ordered_sums.hpp"

namespace cleave::test {
namespace {

constexpr double kPi = 3.14159265358979323846;
constexpr double kE = 2.1e5;

// Points of a lattice with a corner, a slit and a hole taken out, in an order of no meaning.
Cloud notched(int nx, int ny, int nz, double spacing, bool alike) {
  Cloud cloud = lattice_cloud(nx, ny, nz, spacing);
  Cloud out{cloud.dimension, {}, {}};
  std::vector<std::pair<double, std::size_t>> order;
  Random random(7);
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    const Point at = (1 / spacing) * cloud.X[i];
    const bool corner = at[0] + at[1] + at[2]<3.6, slit = at[1]> 4 && at[1] < 5 && at[0] > 3;
    if (!corner && !slit && i != cloud.size() / 2) order.emplace_back(random(), i);
  }
  std::sort(order.begin(), order.end());
  for (const auto& [key, i] : order) {
    out.X.push_back(cloud.X[i]);
    out.volume.push_back(cloud.volume[i] * (alike || cloud.X[i][1] > spacing ? 1 : 0.5));
  }
  return out;
}

std::vector<Setting> with_stencil(std::vector<Setting> settings, double horizon, bool lattice) {
  settings.push_back({"peridynamics", "horizon", horizon});
  settings.push_back({"peridynamics", "stencil", 0, lattice ? "lattice" : "never"});
  return settings;
}

struct Answer {
  std::vector<double> force, density;
};
Answer answer(CloudBody& body, int cut_every, const std::vector<double>& u) {
  if (cut_every > 0) body.damage(cut_every, 5);
  return {body.forces(u), body.model.real("strain_energy_density")};
}
void expect_alike(const Answer& a, const Answer& b, double tolerance, const std::string& what) {
  EXPECT_GT(largest(b.force), 0.0) << what;
  EXPECT_LT(difference(a.force, b.force), tolerance) << what;
  EXPECT_LT(difference(a.density, b.density), tolerance) << what;
}

// In space and in the plane, few and many lanes, with the volumes of points alike or not, small and large
// motion, whole, damaged and mostly cut.
TEST(PeridynamicLatticePairs, ForcesAreThoseOfTheCloudAndOfAllPairs) {
  for (const auto& [nx, ny, nz] : {std::array{9, 7, 5}, std::array{5, 19, 3}, std::array{4, 6, 13},
                                   std::array{21, 8, 0}, std::array{6, 30, 0}})
    for (const double reach : {1.75, 2.4, 3.015})
      for (const bool alike : {false, true})
        for (const int every : {0, 300, 2})
          for (const double size : {1e-3, 0.4}) {
            const double dx = 1.125;
            const Cloud cloud = notched(nx, ny, nz, dx, alike);
            const auto u = random_field(cloud, size * dx, 3);
            const int32_t kinematics = nz == 0 ? CLEAVE_PLANE_STRAIN : CLEAVE_3D;
            CloudBody eights(CLEAVE_FORMULATION_bond_pd, kinematics, cloud,
                             with_stencil({}, reach * dx, true), kE, 0.25);
            CloudBody single(CLEAVE_FORMULATION_bond_pd, kinematics, cloud,
                             with_stencil({}, reach * dx, false), kE, 0.25);
            const Answer a = answer(eights, every, u), b = answer(single, every, u);
            const std::string what = std::to_string(nx) + ' ' + std::to_string(reach) +
                                     (alike ? " alike " : " ") + std::to_string(every) + ' ' +
                                     std::to_string(size);
            // Measured 3e-15, and 6e-13 with small motion: that of the cloud, which takes differences of lengths.
            expect_alike(a, b, size < 0.01 ? 3e-12 : 3e-14, what);
            if (reach != 2.4) continue;
            const double mu = kE / 2.5, h = reach * dx;
            const double c =
                nz == 0 ? 24 * mu / (kPi * h * h * h) : 30 * mu / (kPi * h * h * h * h);
            const auto f = OrderedSums(cloud, h, eights.model).bonds(c);
            EXPECT_LT(difference(a.force, f), size < 0.01 ? 3e-12 : 1e-13) << what;
          }
}

// Own and shared weights of the one-neighbour part of cpd.
TEST(PeridynamicLatticePairs, OneNeighbourForcesAreThoseOfTheCloud) {
  const double dx = 0.1;
  const Cloud cloud = notched(9, 11, 6, dx, true);
  for (const std::string weights : {"paper", "conservative"})
    for (const int every : {0, 7}) {
      const auto u = random_field(cloud, 0.3 * dx, 4);
      Answer a[2];
      for (const bool lattice : {false, true}) {
        CloudBody body(CLEAVE_FORMULATION_cpd, CLEAVE_3D, cloud,
                       with_stencil({{"cpd", "weights", 0, weights}}, 3.015 * dx, lattice), kE,
                       0.25);
        a[lattice ? 1 : 0] = answer(body, every, u);
      }
      expect_alike(a[1], a[0], 3e-14, weights);  // measured 3e-15
    }
}

// Several materials: springs in series, and the mean.
TEST(PeridynamicLatticePairs, BondsBetweenMaterialsAreThoseOfTheCloud) {
  const double dx = 0.25;
  for (const bool plane : {false, true})
    for (const std::string rule : {"series", "mean"}) {
      const Cloud cloud = notched(10, 7, plane ? 0 : 5, dx, false);
      const auto u = random_field(cloud, 0.3 * dx, 4);
      Answer a[2];
      for (const bool lattice : {false, true}) {
        const auto layer = [&](Model& model) {
          std::vector<int64_t> points;
          for (std::size_t i = 0; i < cloud.size(); ++i)
            if (cloud.X[i][0] > 4 * dx) points.push_back(static_cast<int64_t>(i));
          const double properties[3] = {3e-9, 9e5, 0.25};
          ok(cleave_body_region(model, 0, std::ssize(points), points.data(),
                                CLEAVE_MATERIAL_linear_elastic, 3, properties, 0, 0));
        };
        CloudBody body(CLEAVE_FORMULATION_bond_pd, plane ? CLEAVE_PLANE_STRAIN : CLEAVE_3D, cloud,
                       with_stencil({{"peridynamics", "interface", 0, rule}}, 2.4 * dx, lattice),
                       {kE, 0.25, 8e-9}, layer);
        EXPECT_EQ(body.refusal, "");
        a[lattice ? 1 : 0] = answer(body, 9, u);
      }
      expect_alike(a[1], a[0], 3e-14, rule);  // measured 3e-15
    }
}

// A bar under the same stretch everywhere: force on its end and energy in the middle in closed form, on both sides of
// where the kernel changes its formula ((1 + s)^2 - 1 = 1/32, (1 + s)^2 = 1/4), and down to no length at all.
TEST(PeridynamicLatticePairs, StretchIsExactForAllLengths) {
  const double A = 0.3, h = 3.2, dx = 1;
  Cloud bar{2, {}, {}};
  for (int i = 0; i < 40; ++i) {
    bar.X.push_back({i * dx, 0, 0});
    bar.volume.push_back(A * dx);
  }
  const double c = 2 * kE / (A * h * h), w = c * A * A;
  const double edge = std::sqrt(1 + 1.0 / 32) - 1, below = std::sqrt(1 - 1.0 / 32) - 1;
  for (const double s :
       {1e-15,        -1e-12,        1e-9,          1e-6, -1e-3, 0.01,         edge - 1e-12,
        edge + 1e-12, below - 1e-12, below + 1e-12, 0.1,  -0.3,  -0.5 - 1e-12, -0.5 + 1e-12,
        -0.9,         -0.999,        -1.0,          -1.5, 3.0,   1e6}) {
    CloudBody body(CLEAVE_FORMULATION_bond_pd, CLEAVE_PLANE_STRESS, bar,
                   {{"peridynamics", "horizon", h}, {"peridynamics", "section", A}}, kE, 0.3);
    std::vector<double> u(3 * bar.size(), 0.0);
    for (std::size_t i = 0; i < bar.size(); ++i) u[3 * i] = s * bar.X[i][0];
    const auto f = body.forces(u);
    const auto density = body.model.real("strain_energy_density");
    const double stretch = s < -1 ? -2 - s : s;
    // Towards the others: with no length there is no direction. Whole numbers of spacings times s round.
    const double force = s == -1 ? 0.0 : 3 * w * stretch * (s < -1 ? -1 : 1);
    const double rounding = s == -1 ? 1e-14 : 1e-14 * std::fmax(1.0, 1 / std::fabs(1 + s));
    EXPECT_NEAR(f[0], force, std::fabs(force) * rounding) << s;
    EXPECT_NEAR(density[20], 0.25 * w * stretch * stretch * 12 / A,
                3 * w * stretch * stretch / A * rounding)
        << s;
    EXPECT_EQ(f[1], 0.0);
  }
}

TEST(PeridynamicLatticePairs, ReferenceHasExactlyNoForce) {
  const Cloud cloud = notched(11, 9, 4, 0.1, false);
  CloudBody body(CLEAVE_FORMULATION_bond_pd, CLEAVE_3D, cloud, with_stencil({}, 0.3015, true), kE,
                 0.25);
  EXPECT_EQ(largest(body.forces(std::vector<double>(3 * cloud.size(), 0.0))), 0.0);
}

struct Torn {
  std::vector<std::array<std::int64_t, 3>> broken;  // step and ends
  std::vector<double> u;
};
Torn torn(const Cloud& cloud, bool lattice, int threads) {
  const double dx = 0.5;
  CloudBody body(CLEAVE_FORMULATION_bond_pd, cloud.dimension == 2 ? CLEAVE_PLANE_STRAIN : CLEAVE_3D,
                 cloud, with_stencil({{"fracture", "critical_strain", 0.04}}, 2.4 * dx, lattice),
                 {kE, 0.25, 7.8e-9},
                 [&](Model& model) { ok(cleave_model_set_threads(model, threads)); });
  body.damage(40, 2);
  body.model.put("velocity", random_field(cloud, 1.2e6, 3));
  body.model.initialise();
  const double dt = 0.5 * body.model.stable_step();
  for (int n = 0; n < 8; ++n) body.model.step(dt);
  Torn torn;
  int64_t count = 0;
  ok(cleave_body_event_count(body.model, 0, &count));
  for (int64_t k = 0; k < count; ++k) {
    cleave_event e{};
    e.size = sizeof e;
    ok(cleave_body_event_get(body.model, 0, k, &e));
    torn.broken.push_back({e.step, e.first, e.second});
  }
  torn.u = body.model.real("displacement");
  return torn;
}

TEST(PeridynamicLatticePairs, TheSameBondsBreakForAnyNumberOfThreads) {
  for (const auto& [nx, ny, nz] : {std::array{12, 9, 5}, std::array{30, 19, 0}}) {
    const Cloud cloud = notched(nx, ny, nz, 0.5, true);
    const Torn one = torn(cloud, true, 1), single = torn(cloud, false, 1);
    EXPECT_GT(one.broken.size(), 100u);
    EXPECT_EQ(one.broken, single.broken);
    EXPECT_LT(difference(one.u, single.u), 1e-13);  // measured 2e-15
    for (const int threads : {2, 5}) {
      const Torn more = torn(cloud, true, threads);
      EXPECT_EQ(more.broken, one.broken);
      EXPECT_EQ(std::memcmp(more.u.data(), one.u.data(), one.u.size() * sizeof(double)), 0);
    }
  }
}

// Beyond what counts as a lattice, points are treated as any cloud: the same bits as with 'never'. Up to that, strains
// are those of the lattice, so that forces differ by as much as lengths do.
TEST(PeridynamicLatticePairs, PointsBesideALatticeAreACloud) {
  for (const double off : {1e-7, 1e-5}) {
    Cloud cloud = notched(9, 8, 5, 1.0, false);
    Random random(3);
    for (auto& X : cloud.X)
      for (double& x : X) x += off * random();
    const auto u = random_field(cloud, 0.3, 4);
    Answer a[2];
    for (const bool lattice : {false, true}) {
      CloudBody body(CLEAVE_FORMULATION_bond_pd, CLEAVE_3D, cloud, with_stencil({}, 2.4, lattice),
                     kE, 0.25);
      a[lattice ? 1 : 0] = answer(body, 9, u);
    }
    if (off > 1e-6) {
      EXPECT_EQ(a[1].force, a[0].force);
    } else {
      EXPECT_GT(difference(a[1].force, a[0].force), 1e-9);
      EXPECT_LT(difference(a[1].force, a[0].force), 10 * off);
    }
  }
}

// A horizon at a shell of neighbours, which places a little beside the lattice put on both sides of it: these are not
// the bonds of whole shells.
TEST(PeridynamicLatticePairs, HorizonInsideAShellIsThatOfACloud) {
  Cloud cloud = lattice_cloud(12, 6, 0, 1.0);
  // The first row says where the lattice begins.
  for (std::size_t i = 12; i < cloud.size(); ++i) cloud.X[i][1] += i % 5 < 2 ? 9e-7 : -9e-7;
  const auto u = random_field(cloud, 0.3, 4);
  Answer a[2];
  std::int64_t bonds = 0;
  for (const bool lattice : {false, true}) {
    CloudBody body(CLEAVE_FORMULATION_bond_pd, CLEAVE_PLANE_STRAIN, cloud,
                   with_stencil({}, 2.0, lattice), kE, 0.25);
    a[lattice ? 1 : 0] = answer(body, 0, u);
    bonds = body.model.counts().bonds;
  }
  const std::int64_t near = 11 * 6 + 12 * 5 + 2 * 11 * 5, at = 10 * 6 + 12 * 4;
  EXPECT_GT(bonds, near);
  EXPECT_LT(bonds, near + at);
  EXPECT_EQ(a[1].force, a[0].force);
}

}  // namespace
}  // namespace cleave::test
