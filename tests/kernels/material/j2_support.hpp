// The law under test by the array call, and the algorithm as in textbooks in extended precision: F,
// Cp^-1, an eigen-solve of B*, logarithms, fixed-point-free bisection of the flow. Independent of the
// kernels, and slow.
#pragma once

#include <array>
#include <cmath>
#include <functional>
#include <vector>

#include "support/bonds.hpp"
#include "support/model.hpp"

namespace cleave::test {

// The necking data set of the theory page [MPa]; E and nu from G and kappa.
inline constexpr double kG = 80193.8, kKappa = 164206;
inline constexpr double kE = 9 * kKappa * kG / (3 * kKappa + kG);
inline constexpr double kNu = (3 * kKappa - 2 * kG) / (2 * (3 * kKappa + kG));
inline const std::vector<double> kSteel = {7.8e-9, kE, kNu, 450, 715, 129.24, 16.93};

struct Point {
  Matrix3 P{};
  std::array<double, 8> history{};
  double energy = 0, plastic = 0;
  std::int32_t failed = 0, status = CLEAVE_OK;
  double strain() const { return history[6]; }
};

inline Point ask(std::int32_t material, std::int32_t kinematics,
                 const std::vector<double>& properties, const Matrix3& H,
                 const std::array<double, 8>& history = {}) {
  double h[9], p[9];
  for (std::size_t r = 0; r < 3; ++r)
    for (std::size_t c = 0; c < 3; ++c) h[r + 3 * c] = H[r][c];
  Point out;
  out.history = history;
  cleave_material_call call;
  ok(cleave_material_call_init(&call));
  call.material = material;
  call.kinematics = kinematics;
  call.property_count = static_cast<std::int64_t>(properties.size());
  call.properties = properties.data();
  call.last = 1;
  call.deformation = h;
  call.history = out.history.data();
  call.stress = p;
  call.energy = &out.energy;
  call.plastic = &out.plastic;
  call.failed = &out.failed;
  out.status = cleave_material_update(&call);
  for (std::size_t r = 0; r < 3; ++r)
    for (std::size_t c = 0; c < 3; ++c) out.P[r][c] = p[r + 3 * c];
  return out;
}
inline Point ask(const Matrix3& H, const std::array<double, 8>& history = {}) {
  return ask(CLEAVE_MATERIAL_j2, CLEAVE_3D, kSteel, H, history);
}

inline double largest(const Matrix3& m) {
  double size = 0;
  for (const auto& row : m)
    for (const double x : row) size = std::fmax(size, std::fabs(x));
  return size;
}
inline double distance(const Matrix3& a, const Matrix3& b) {
  double size = 0;
  for (std::size_t r = 0; r < 3; ++r)
    for (std::size_t c = 0; c < 3; ++c) size = std::fmax(size, std::fabs(a[r][c] - b[r][c]));
  return size;
}
inline Matrix3 product(const Matrix3& a, const Matrix3& b) {
  Matrix3 c{};
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j)
      for (std::size_t k = 0; k < 3; ++k) c[i][j] += a[i][k] * b[k][j];
  return c;
}
inline Matrix3 random_matrix(Random& random, double size) {
  Matrix3 H{};
  for (auto& row : H)
    for (double& x : row) x = size * random();
  return H;
}
// A rotation by Rodrigues' formula about a random axis.
inline Matrix3 random_rotation(Random& random) {
  double a[3], length = 0;
  for (double& x : a) {
    x = random();
    length += x * x;
  }
  for (double& x : a) x /= std::sqrt(length);
  const double angle = 3 * random(), s = std::sin(angle), c = 1 - std::cos(angle);
  const Matrix3 w = {{{0, -a[2], a[1]}, {a[2], 0, -a[0]}, {-a[1], a[0], 0}}};
  const Matrix3 w2 = product(w, w);
  Matrix3 q{};
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j) q[i][j] = (i == j ? 1 : 0) + s * w[i][j] + c * w2[i][j];
  return q;
}

using Real = long double;
using Wide = std::array<std::array<Real, 3>, 3>;

struct Reference {
  Wide P{};
  Real strain = 0, energy = 0, equivalent = 0;
  double condition = 1;  // of B*: the factor by which any algorithm in terms of B* loses digits
  Wide cpi{};
};

inline Wide wide_product(const Wide& a, const Wide& b) {
  Wide c{};
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j)
      for (std::size_t k = 0; k < 3; ++k) c[i][j] += a[i][k] * b[k][j];
  return c;
}
inline Wide transposed(const Wide& a) {
  Wide c{};
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j) c[i][j] = a[j][i];
  return c;
}
inline Wide wide_inverse(const Wide& f) {
  Wide inv{};
  Real det = 0;
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j) {
      const std::size_t i1 = (i + 1) % 3, i2 = (i + 2) % 3, j1 = (j + 1) % 3, j2 = (j + 2) % 3;
      inv[j][i] = f[i1][j1] * f[i2][j2] - f[i1][j2] * f[i2][j1];
      if (i == 0) det += f[0][j] * inv[j][0];
    }
  for (auto& row : inv)
    for (Real& x : row) x /= det;
  return inv;
}
// b = v diag(value) v^T by rotations chosen from atan2 on the largest off-diagonal entry.
inline void wide_eigen(Wide b, std::array<Real, 3>& value, Wide& v) {
  v = {{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
  for (int n = 0; n < 60; ++n) {
    std::size_t p = 0, q = 1;
    if (std::fabs(b[0][2]) > std::fabs(b[p][q])) q = 2;
    if (std::fabs(b[1][2]) > std::fabs(b[p][q])) p = 1, q = 2;
    const Real angle = 0.5L * std::atan2(2 * b[p][q], b[q][q] - b[p][p]);
    Wide g = {{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
    g[p][p] = g[q][q] = std::cos(angle);
    g[p][q] = std::sin(angle);
    g[q][p] = -g[p][q];
    b = wide_product(transposed(g), wide_product(b, g));
    v = wide_product(v, g);
  }
  for (std::size_t k = 0; k < 3; ++k) value[k] = b[k][k];
}

// yield(e): the yield stress. From F, Cp^-1 and eps_p.
inline Reference reference(Real g, Real kappa, const std::function<Real(Real)>& yield,
                           const Matrix3& H, const Wide& cpi, Real strain) {
  Wide f{};
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j) f[i][j] = static_cast<Real>(H[i][j]) + (i == j ? 1 : 0);
  const Wide inverse = wide_inverse(f);
  std::array<Real, 3> b{}, e{}, tau{}, be{};
  Wide v{};
  wide_eigen(wide_product(f, wide_product(cpi, transposed(f))), b, v);
  Reference r;
  r.condition = static_cast<double>(std::fmax(b[0], std::fmax(b[1], b[2])) /
                                    std::fmin(b[0], std::fmin(b[1], b[2])));
  Real t = 0, dd = 0;
  for (std::size_t a = 0; a < 3; ++a) t += e[a] = 0.5L * std::log(b[a]);
  for (Real& x : e) {
    x -= t / 3;
    dd += x * x;
  }
  Real equivalent = 2 * g * std::sqrt(1.5L * dd), theta = 1;
  r.strain = strain;
  if (equivalent > yield(strain)) {
    Real low = 0, high = equivalent / (3 * g);
    for (int n = 0; n < 200; ++n) {
      const Real x = 0.5L * (low + high);
      (equivalent - 3 * g * x - yield(strain + x) > 0 ? low : high) = x;
    }
    theta = 1 - 3 * g * low / equivalent;
    r.strain += low;
  }
  for (std::size_t a = 0; a < 3; ++a) {
    tau[a] = kappa * t + 2 * g * theta * e[a];
    be[a] = std::exp(2 * (t / 3 + theta * e[a]));
  }
  Wide stress{}, metric{};
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j)
      for (std::size_t a = 0; a < 3; ++a) {
        stress[i][j] += v[i][a] * tau[a] * v[j][a];
        metric[i][j] += v[i][a] * be[a] * v[j][a];
      }
  r.P = wide_product(stress, transposed(inverse));
  r.cpi = wide_product(inverse, wide_product(metric, transposed(inverse)));
  r.energy = 0.5L * kappa * t * t + g * theta * theta * dd;
  r.equivalent = theta * equivalent;
  return r;
}
inline const Wide kVirgin = {{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
inline Real steel_yield(Real e) { return 450 + 129.24L * e + 265 * (1 - std::exp(-16.93L * e)); }

inline double distance(const Matrix3& a, const Wide& b) {
  double size = 0;
  for (std::size_t r = 0; r < 3; ++r)
    for (std::size_t c = 0; c < 3; ++c)
      size = std::fmax(size, static_cast<double>(std::fabs(static_cast<Real>(a[r][c]) - b[r][c])));
  return size;
}

}  // namespace cleave::test
