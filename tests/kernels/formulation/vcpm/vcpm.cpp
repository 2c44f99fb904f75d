// The volume-compensated particle model: constants against the isotropic solid on every lattice, force against
// energy, rotation, strength by direction, and what is refused.
#include "formulation/vcpm/balls.hpp"

namespace cleave::test {
namespace {

constexpr double kE = 2.1e5;

std::vector<double> affine(const Cloud& cloud, const double (&g)[3][3]) {
  std::vector<double> u;
  for (const Point& X : cloud.X)
    for (const auto& row : g) u.push_back(row[0] * X[0] + row[1] * X[1] + row[2] * X[2]);
  return u;
}

TEST(VolumeCompensatedParticles, StressInsideIsThatOfTheIsotropicSolid) {
  for (const Solid& solid : kSolids)
    for (const double nu : {-0.5, 0.0, 0.1, 0.25, 0.3, 1.0 / 3, 0.45, 0.49}) {
      const Cloud cloud = ball(solid.lattice, 3.2, 0.3);
      CloudBody body(CLEAVE_FORMULATION_vcpm, solid.kinematics, cloud,
                     {{"vcpm", "geometry", 0, "linear"}}, kE, nu);
      const bool space = solid.kinematics == CLEAVE_3D;
      const double g[3][3] = {{2e-3, 3e-3, space ? -1e-3 : 0},
                              {1e-3, -4e-3, space ? 2e-3 : 0},
                              {space ? 5e-4 : 0, space ? 1e-3 : 0, space ? 3e-3 : 0}};
      body.forces(affine(cloud, g));
      body.model.real("cauchy_stress");  // asks for the stress
      const auto p = body.model.real("first_piola_kirchhoff_stress");
      const double mu = kE / (2 * (1 + nu)), lambda3 = kE * nu / ((1 + nu) * (1 - 2 * nu));
      const double lambda =
          solid.kinematics == CLEAVE_PLANE_STRESS ? kE * nu / (1 - nu * nu) : lambda3;
      const double trace = g[0][0] + g[1][1] + g[2][2];
      for (std::size_t r = 0; r < (space ? 3u : 2u); ++r)
        for (std::size_t c = 0; c < (space ? 3u : 2u); ++c) {
          const double due = mu * (g[r][c] + g[c][r]) + (r == c ? lambda * trace : 0);
          EXPECT_NEAR(p[3 * c + r], due, 1e-12 * kE * 5e-3 / (1 - 2 * nu))  // measured 2e-13
              << solid.lattice << " nu = " << nu;
        }
    }
}

// E = 1, nu = 0.3: k_n = 1.77646, T = 0.192308 in plane strain, -0.0549451 in plane stress.
TEST(VolumeCompensatedParticles, ForceOfABondHasThePrintedConstants) {
  for (const auto& [kinematics, T] :
       {std::pair{CLEAVE_PLANE_STRAIN, 0.192308}, std::pair{CLEAVE_PLANE_STRESS, -0.0549451}}) {
    const Cloud cloud = ball("triangular", 1.1);
    CloudBody body(CLEAVE_FORMULATION_vcpm, kinematics, cloud, {{"vcpm", "geometry", 0, "linear"}},
                   1.0, 0.3);
    std::vector<double> u(3 * cloud.size(), 0.0);
    for (std::size_t k = 0; k < 2; ++k) u[3 + k] = 1e-3 * cloud.X[1][k];
    body.forces(u);
    const auto force = body.model.real("bond_force");
    const auto ends = body.model.integer("bond_ends");
    // S of both ends: the stretched bond, and what the two bonds to its sides give the moved end.
    const double own = 1e-3, sides = 2 * 0.5e-3;
    for (std::size_t b = 0; b < force.size(); ++b) {
      if (ends[2 * b] != 0 || ends[2 * b + 1] != 1) continue;
      EXPECT_NEAR(force[b], 0.5 * 1.77646 * own + std::sqrt(3.0) / 18 * T * (2 * own + sides),
                  2e-6 * force[b]);  // printed with six digits: 1.4e-6
    }
  }
}

TEST(VolumeCompensatedParticles, ForceIsMinusTheEnergyGradient) {
  for (const Solid& solid : kSolids)
    for (const std::string surface : {"keep", "extend"})
      for (const std::string geometry : {"finite", "linear"}) {
        const Cloud cloud = ball(solid.lattice, 2.1);
        const std::vector<double> u = random_field(cloud, 0.05, 7);
        // Forces, and the energy; a state is given once to a body.
        const auto respond = [&](const std::vector<double>& displacement, double* energy) {
          CloudBody body(CLEAVE_FORMULATION_vcpm, solid.kinematics, cloud,
                         {{"vcpm", "geometry", 0, geometry}, {"vcpm", "surface", 0, surface}}, kE,
                         0.4);
          body.damage(6, 3);
          const auto forces = body.forces(displacement);
          *energy = body.model.energies().elastic;
          return forces;
        };
        double stored = 0;
        const std::vector<double> f = respond(u, &stored);
        const auto energy = [&](std::size_t c, double change) {
          std::vector<double> moved = u;
          moved[c] += change;
          respond(moved, &stored);
          return stored;
        };
        const double h = 1e-5;
        for (std::size_t c = 0; c < f.size(); c += 7) {
          if (cloud.dimension == 2 && c % 3 == 2) continue;
          EXPECT_NEAR(f[c], (energy(c, -h) - energy(c, h)) / (2 * h), 1e-7 * largest(f))  // 3e-9
              << solid.lattice << ' ' << surface << ' ' << geometry;
        }
      }
}

TEST(VolumeCompensatedParticles, RotationHasNoForceUnlessGeometryIsLinear) {
  const double angle = 0.7, c = std::cos(angle) - 1, s = std::sin(angle);
  const double turn[3][3] = {{c, -s, 0}, {s, c, 0}, {0, 0, 0}};
  for (const Solid& solid : kSolids) {
    const Cloud cloud = ball(solid.lattice, 2.1);
    const auto force = [&](const std::string& geometry) {
      CloudBody body(CLEAVE_FORMULATION_vcpm, solid.kinematics, cloud,
                     {{"vcpm", "geometry", 0, geometry}});
      return largest(body.forces(affine(cloud, turn))) / kE;
    };
    EXPECT_LT(force("finite"), 1e-14);  // measured 1e-15
    EXPECT_GT(force("linear"), 0.05);
  }
}

// Uniaxial stress until the first bond has its limit: across a row, along it, and at 45 degrees.
TEST(VolumeCompensatedParticles, StrengthDependsOnTheDirectionOfTheLattice) {
  const double kRight = std::acos(0.0), strength = 50;
  for (const std::int32_t kinematics : {CLEAVE_PLANE_STRAIN, CLEAVE_PLANE_STRESS})
    for (const double nu : {0.1, 0.3})
      for (const auto& [angle, share] :
           {std::pair{kRight, 1.0}, std::pair{0.0, 2.0 / 3}, std::pair{0.5 * kRight, 0.7320508},
            std::pair{kRight / 3, 1.0}}) {
        const Cloud cloud = ball("triangular", 3.2);
        CloudBody body(CLEAVE_FORMULATION_vcpm, kinematics, cloud,
                       {{"vcpm", "geometry", 0, "linear"}, {"vcpm", "strength", strength}}, kE, nu);
        const bool strain = kinematics == CLEAVE_PLANE_STRAIN;
        const double along = (strain ? 1 - nu * nu : 1.0) / kE,
                     across = -(strain ? nu * (1 + nu) : nu) / kE;
        const double n[2] = {std::cos(angle), std::sin(angle)};
        double g[3][3] = {};
        for (std::size_t r = 0; r < 2; ++r)
          for (std::size_t k = 0; k < 2; ++k)
            g[r][k] = (along - across) * n[r] * n[k] + (r == k ? across : 0);  // of a stress of 1
        body.forces(affine(cloud, g));
        const auto force = body.model.real("bond_force");
        const auto ends = body.model.integer("bond_ends");
        double most = 0;
        for (std::size_t b = 0; b < force.size(); ++b)
          if (ends[2 * b] == 0) most = std::fmax(most, force[b]);  // of the particle in the middle
        EXPECT_NEAR(strength / std::sqrt(3.0) / most, share * strength, 1e-7 * strength);
      }
}

// A bar pulled until the criterion is met in its middle: nothing breaks before.
TEST(VolumeCompensatedParticles, BondsBreakAtTheLimitOfEachCriterion) {
  for (const std::string criterion : {"force", "strain", "energy"}) {
    const Cloud cloud = ball("triangular", 1.1);
    const auto broken = [&](double limit) {
      CloudBody body(CLEAVE_FORMULATION_vcpm, CLEAVE_PLANE_STRESS, cloud,
                     {{"vcpm", "criterion", 0, criterion}, {"vcpm", "limit", limit}}, kE, 1.0 / 3);
      std::vector<double> u(3 * cloud.size(), 0.0);
      for (std::size_t k = 0; k < 2; ++k) u[3 + k] = 0.02 * cloud.X[1][k];
      body.model.put("displacement", u);
      body.model.initialise();
      body.model.step(1e-9 * body.model.stable_step());
      return body.model.counts().broken;
    };
    // nu = 1/3 in plane stress: T = 0, so the bond is a spring of stiffness k_n/2.
    const double k = 4 * kE / std::sqrt(3.0) / (1 + 1.0 / 3), dL = 0.02;
    const double due = criterion == "force"    ? 0.5 * k * dL
                       : criterion == "strain" ? dL
                                               : 0.25 * k * dL * dL;
    EXPECT_EQ(broken(due * (1 - 1e-6)), 1) << criterion;
    EXPECT_EQ(broken(due * (1 + 1e-6)), 0) << criterion;
  }
}

TEST(VolumeCompensatedParticles, WhatIsNoLatticeIsRefused) {
  const auto said = [](std::int32_t kinematics, const Cloud& cloud,
                       const std::vector<Setting>& settings) {
    std::string words;
    CloudBody body(CLEAVE_FORMULATION_vcpm, kinematics, cloud, settings, 0.3, words);
    return words;
  };
  const auto says = [](const std::string& words, const std::string& part) {
    EXPECT_NE(words.find(part), std::string::npos) << words;
  };
  says(said(CLEAVE_PLANE_STRAIN, random_cloud(2, 6, 1), {}), "needs all particles on one lattice");
  says(said(CLEAVE_3D, ball("fcc", 2.1), {{"vcpm", "lattice", 0, "bcc"}}),
       "has more than 8 neighbours at 1 [m], which is all that lattice bcc");
  says(said(CLEAVE_3D, ball("bcc", 2.1), {{"vcpm", "lattice", 0, "fcc"}}),
       "lattice fcc with nearest neighbours at 1 [m] has bonds of 1 and 1.41421356 [m]");
  says(said(CLEAVE_3D, ball("sc", 1.1), {{"vcpm", "lattice", 0, "triangular"}}),
       "allowed there: sc, fcc, bcc");
  says(said(CLEAVE_3D, ball("sc", 3), {{"vcpm", "strength", 1.0}}),
       "depends on the direction; give limit, or use criterion 'strain'");
  says(said(CLEAVE_PLANE_STRAIN, ball("triangular", 3), {{"fracture", "Gf", 1.0}}),
       "vcpm has no relation to Gf");
  says(said(CLEAVE_PLANE_STRAIN, ball("triangular", 3),
            {{"vcpm", "strength", 1.0}, {"vcpm", "limit", 1.0}}),
       "give one of them");
  EXPECT_EQ(said(CLEAVE_3D, ball("bcc", 3), {}), "");
}

}  // namespace
}  // namespace cleave::test
