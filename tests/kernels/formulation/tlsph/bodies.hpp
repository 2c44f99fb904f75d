// Bodies for the tests of the kernel methods, and their neighbours and gradients by brute force.
#pragma once

#include <cmath>

#include "support/bonds.hpp"
#include "support/model.hpp"

namespace cleave::test {

inline std::size_t at(std::int64_t i) { return static_cast<std::size_t>(i); }

inline Case kernel_case(int32_t formulation, int dimension) {
  return {formulation, CLEAVE_MATERIAL_svk, dimension == 2 ? CLEAVE_PLANE_STRESS : CLEAVE_3D};
}

// A body at given displacements, initialised.
struct Deformed {
  Deformed(int32_t formulation, const SimplexMesh& mesh, const std::vector<double>& u,
           const std::vector<Setting>& settings) {
    model.add(kernel_case(formulation, mesh.dimension), mesh, settings);
    model.setup();
    model.put("displacement", u);
    model.initialise();
  }
  std::vector<double> force() const { return model.real("internal_force"); }
  Model model;
};

inline double largest(const std::vector<double>& v) {
  double m = 0;
  for (const double x : v) m = std::fmax(m, std::fabs(x));
  return m;
}

inline std::vector<double> affine(const SimplexMesh& mesh, const Matrix3& g) {
  std::vector<double> u(mesh.X.size(), 0.0);
  const auto d = at(mesh.dimension);
  for (std::size_t i = 0; i < u.size() / 3; ++i)
    for (std::size_t r = 0; r < d; ++r)
      for (std::size_t c = 0; c < d; ++c) u[3 * i + r] += g[r][c] * mesh.X[3 * i + c];
  return u;
}

inline std::vector<Setting> hourglass(const char* form, double psi) {
  return {{"hourglass", "form", 0, form}, {"hourglass", "psi", psi}};
}

inline std::vector<Setting> operator+(std::vector<Setting> a, const std::vector<Setting>& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

// Reference gradients: every pair, the moment matrix inverted by elimination. `omega` of a distance;
// neighbours strictly within `support`.
struct BruteGradient {
  template <class Omega>
  BruteGradient(const SimplexMesh& m, double support, const Omega& omega) : mesh(m) {
    const std::int64_t n = m.particles(), d = m.dimension;
    volume.assign(at(n), 0.0);
    for (std::int64_t s = 0; s < m.simplex_count(); ++s)
      for (std::int64_t a = 0; a <= d; ++a)
        volume[at(m.simplices[at((d + 1) * s + a)])] +=
            reference_simplex(m, s).volume / static_cast<double>(d + 1);
    row_begin.push_back(0);
    for (std::int64_t i = 0; i < n; ++i) {
      Matrix3 moment{};
      for (std::size_t k = at(d); k < 3; ++k) moment[k][k] = 1;
      for (std::int64_t p = 0; p < n; ++p) {
        const auto X = between(i, p);
        const double distance = std::hypot(X[0], X[1], X[2]);
        if (p == i || distance >= support) continue;
        neighbour.push_back(p);
        const double weight = volume[at(p)] * omega(distance);
        for (std::size_t r = 0; r < 3; ++r)
          for (std::size_t c = 0; c < 3; ++c) moment[r][c] += weight * X[r] * X[c];
      }
      const Matrix3 K = inverse(moment);
      for (auto b = row_begin.back(); b < static_cast<std::int64_t>(neighbour.size()); ++b) {
        const auto X = between(i, neighbour[at(b)]);
        const double distance = std::hypot(X[0], X[1], X[2]);
        const double weight = volume[at(i)] * volume[at(neighbour[at(b)])] * omega(distance);
        for (std::size_t r = 0; r < 3; ++r)
          zeta.push_back(weight * (K[r][0] * X[0] + K[r][1] * X[1] + K[r][2] * X[2]));
      }
      moments.push_back(moment);
      row_begin.push_back(static_cast<std::int64_t>(neighbour.size()));
    }
  }
  std::array<double, 3> between(std::int64_t i, std::int64_t p) const {
    std::array<double, 3> X;
    for (std::size_t k = 0; k < 3; ++k) X[k] = mesh.X[3 * at(p) + k] - mesh.X[3 * at(i) + k];
    return X;
  }
  SimplexMesh mesh;
  std::vector<double> volume, zeta;
  std::vector<std::int64_t> row_begin, neighbour;
  std::vector<Matrix3> moments;
};

}  // namespace cleave::test
