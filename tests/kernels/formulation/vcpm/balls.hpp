// Lattices cut to balls, for tests of the volume-compensated particle model.
#pragma once

#include <algorithm>
#include <string>
#include <vector>

#include "formulation/peridynamics/clouds.hpp"

namespace cleave::test {

// Points of a lattice with nearest neighbours at 1 that lie within `radius` of the origin, the first of them
// the origin. `turn` turns the rows of the triangular one away from x.
inline Cloud ball(const std::string& kind, double radius, double turn = 0) {
  const double r2 = std::sqrt(2.0), r3 = std::sqrt(3.0);
  std::array<Point, 3> a;
  if (kind == "triangular")
    a = {{{std::cos(turn), std::sin(turn), 0},
          {std::cos(turn + std::acos(0.5)), std::sin(turn + std::acos(0.5)), 0},
          {0, 0, 1}}};
  if (kind == "sc") a = {{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
  if (kind == "fcc") a = {{{1 / r2, 1 / r2, 0}, {1 / r2, 0, 1 / r2}, {0, 1 / r2, 1 / r2}}};
  if (kind == "bcc")
    a = {{{1 / r3, 1 / r3, -1 / r3}, {1 / r3, -1 / r3, 1 / r3}, {-1 / r3, 1 / r3, 1 / r3}}};
  Cloud cloud;
  cloud.dimension = kind == "triangular" ? 2 : 3;
  const int n = 9, deep = cloud.dimension == 2 ? 0 : n;
  for (int i = -n; i <= n; ++i)
    for (int j = -n; j <= n; ++j)
      for (int k = -deep; k <= deep; ++k) {
        const Point X = static_cast<double>(i) * a[0] + static_cast<double>(j) * a[1] +
                        static_cast<double>(k) * a[2];
        if (norm(X) < radius) cloud.X.push_back(X);
      }
  std::sort(cloud.X.begin(), cloud.X.end(),
            [](const Point& p, const Point& q) { return norm(p) < norm(q); });
  cloud.volume.assign(cloud.size(), 1.0);  // not used: each particle owns a cell
  return cloud;
}

struct Solid {
  std::string lattice;
  std::int32_t kinematics;
};
inline const std::vector<Solid> kSolids = {{"triangular", CLEAVE_PLANE_STRAIN},
                                           {"triangular", CLEAVE_PLANE_STRESS},
                                           {"sc", CLEAVE_3D},
                                           {"fcc", CLEAVE_3D},
                                           {"bcc", CLEAVE_3D}};

}  // namespace cleave::test
