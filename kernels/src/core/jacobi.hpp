// Eigenvalues and orthonormal eigenvectors of one symmetric 3x3 tensor by cyclic Jacobi rotations:
// backward stable and orthonormal to round-off whatever the gaps between the eigenvalues, which the
// closed form with cross products is not. For the points that the power series cannot take, and for
// tangents; not for the bulk of the points.
#pragma once

#include <cmath>

#include "core/symmetric.hpp"

namespace cleave {

struct Spectral {
  double value[3];
  double vector[3][3];  // vector[i][a]: component i of eigenvector a
};

// One rotation in the plane (p,q) that annihilates a[p][q].
inline void rotate(double (&a)[3][3], double (&v)[3][3], int p, int q) {
  if (a[p][q] == 0) return;
  const int r = 3 - p - q;
  const double difference = a[q][q] - a[p][p], twice = 2 * a[p][q];
  // tan of the smaller angle: twice / (difference +- hypot), the sign that does not cancel.
  const double scale = std::fmax(std::fabs(difference), std::fabs(twice));
  const double d = difference / scale, t2 = twice / scale;
  const double t = (d < 0 ? -t2 : t2) / (std::fabs(d) + std::sqrt(d * d + t2 * t2));
  const double c = 1 / std::sqrt(1 + t * t), s = t * c;
  a[p][p] -= t * a[p][q];
  a[q][q] += t * a[p][q];
  a[p][q] = a[q][p] = 0;
  const double rp = a[r][p], rq = a[r][q];
  a[r][p] = a[p][r] = c * rp - s * rq;
  a[r][q] = a[q][r] = s * rp + c * rq;
  for (int i = 0; i < 3; ++i) {
    const double vp = v[i][p], vq = v[i][q];
    v[i][p] = c * vp - s * vq;
    v[i][q] = s * vp + c * vq;
  }
}

// Finite components of a size whose square is representable. Six sweeps: three or four reach the last
// bit, and a rotation of a zero is free.
inline Spectral spectral(const Symmetric<double>& s) {
  double a[3][3] = {{s.xx, s.xy, s.zx}, {s.xy, s.yy, s.yz}, {s.zx, s.yz, s.zz}};
  Spectral e{{}, {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
  for (int sweep = 0; sweep < 6; ++sweep) {
    rotate(a, e.vector, 0, 1);
    rotate(a, e.vector, 0, 2);
    rotate(a, e.vector, 1, 2);
  }
  for (int k = 0; k < 3; ++k) e.value[k] = a[k][k];
  return e;
}

// sum_a f_a n_a (x) n_a
inline Symmetric<double> assemble(const Spectral& e, const double (&f)[3]) {
  double c[3][3];
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j)
      c[i][j] = (f[0] * e.vector[i][0] * e.vector[j][0] + f[1] * e.vector[i][1] * e.vector[j][1]) +
                f[2] * e.vector[i][2] * e.vector[j][2];
  return {c[0][0], c[1][1], c[2][2], c[0][1], c[1][2], c[2][0]};
}

}  // namespace cleave
