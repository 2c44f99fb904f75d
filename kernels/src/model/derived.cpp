// Fields that are computed when they are asked for: measures of stress and strain at the integration
// points.
#include <Eigen/Eigenvalues>
#include <array>
#include <cmath>

#include "model/model.hpp"

namespace cleave {

namespace {

// F = I + H with the out-of-plane stretch of the plane condition.
Mat<3> deformation_gradient(const Body& body, std::int64_t q) {
  Mat<3> f = plus_identity(load_tensor<3>(body.point.h, q));
  if (body.dimension() == 2) {
    const Mat<2> plane = load_tensor<2>(body.point.h, q);
    f(2, 2) = with_law(body.material_of(q), [&](const auto& law) {
      return law.thickness_stretch(plane, body.history.at(q));
    });
  }
  return f;
}

// tau = P F^T
Mat<3> kirchhoff_stress(const Body& body, std::int64_t q) {
  const Mat<3> f = deformation_gradient(body, q), p = load_tensor<3>(body.point.p, q);
  Mat<3> tau;
  for (int r = 0; r < 3; ++r)
    for (int c = 0; c < 3; ++c)
      for (int k = 0; k < 3; ++k) tau(r, c) += p(r, k) * f(c, k);
  return tau;
}

// sigma = tau / det F; zero where det F is not positive.
Mat<3> cauchy_stress(const Body& body, std::int64_t q) {
  const double det = determinant(deformation_gradient(body, q));
  if (!(det > 0)) return {};
  Mat<3> sigma = kirchhoff_stress(body, q);
  for (int r = 0; r < 3; ++r)
    for (int c = 0; c < 3; ++c) sigma(r, c) /= det;
  return sigma;
}

// E = (H + H^T + H^T H)/2: full accuracy for small H. The plane condition's F33 - 1 enters as H33.
Mat<3> green_lagrange_strain(const Body& body, std::int64_t q) {
  Mat<3> h = deformation_gradient(body, q);
  const Mat<3> stored = load_tensor<3>(body.point.h, q);
  for (int r = 0; r < 3; ++r)
    for (int c = 0; c < 3; ++c)
      h(r, c) = r == 2 && c == 2 && body.dimension() == 2 ? h(2, 2) - 1 : stored(r, c);
  Mat<3> e;
  for (int r = 0; r < 3; ++r)
    for (int c = 0; c < 3; ++c) {
      e(r, c) = 0.5 * (h(r, c) + h(c, r));
      for (int k = 0; k < 3; ++k) e(r, c) += 0.5 * h(k, r) * h(k, c);
    }
  return e;
}

double von_mises(const Mat<3>& s) {
  const double mean = (s(0, 0) + s(1, 1) + s(2, 2)) / 3;
  double sum = 0;
  for (int r = 0; r < 3; ++r)
    for (int c = 0; c < 3; ++c) {
      const double d = s(r, c) - (r == c ? mean : 0.0);
      sum += d * d;
    }
  return std::sqrt(1.5 * sum);
}

double pressure(const Mat<3>& s) { return -(s(0, 0) + s(1, 1) + s(2, 2)) / 3; }

// Eigenvalues of the symmetric part, descending.
std::array<double, 3> principal(const Mat<3>& s) {
  Eigen::Matrix3d m;
  for (int r = 0; r < 3; ++r)
    for (int c = 0; c < 3; ++c) m(r, c) = 0.5 * (s(r, c) + s(c, r));
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(m, Eigen::EigenvaluesOnly);
  return {solver.eigenvalues()(2), solver.eigenvalues()(1), solver.eigenvalues()(0)};
}

// ln of the principal stretches, from C - I = 2 E.
std::array<double, 3> principal_logarithmic_strain(const Body& body, std::int64_t q) {
  std::array<double, 3> e = principal(green_lagrange_strain(body, q));
  for (double& value : e) value = 2 * value > -1 ? 0.5 * std::log1p(2 * value) : 0.0;
  return e;
}

void put(const Mat<3>& m, double* out) { store_tensor(m, out, 0); }
void put(double v, double* out) { *out = v; }

struct Measure {
  std::string_view name;
  int components;
  void (*compute)(const Body&, std::int64_t, double*);
};
#define CLEAVE_MEASURE(name, components, expression)                                           \
  Measure {                                                                                    \
    name, components, [](const Body& b, std::int64_t q, double* out) { put(expression, out); } \
  }
constexpr std::array kMeasures = {
    CLEAVE_MEASURE("deformation_gradient", 9, deformation_gradient(b, q)),
    CLEAVE_MEASURE("green_lagrange_strain", 9, green_lagrange_strain(b, q)),
    CLEAVE_MEASURE("principal_logarithmic_strain_1", 1, principal_logarithmic_strain(b, q)[0]),
    CLEAVE_MEASURE("principal_logarithmic_strain_2", 1, principal_logarithmic_strain(b, q)[1]),
    CLEAVE_MEASURE("principal_logarithmic_strain_3", 1, principal_logarithmic_strain(b, q)[2]),
    CLEAVE_MEASURE("cauchy_stress", 9, cauchy_stress(b, q)),
    CLEAVE_MEASURE("equivalent_stress", 1, von_mises(cauchy_stress(b, q))),
    CLEAVE_MEASURE("principal_stress_1", 1, principal(cauchy_stress(b, q))[0]),
    CLEAVE_MEASURE("principal_stress_2", 1, principal(cauchy_stress(b, q))[1]),
    CLEAVE_MEASURE("principal_stress_3", 1, principal(cauchy_stress(b, q))[2]),
    CLEAVE_MEASURE("pressure", 1, pressure(cauchy_stress(b, q))),
    CLEAVE_MEASURE("kirchhoff_stress", 9, kirchhoff_stress(b, q)),
    CLEAVE_MEASURE("kirchhoff_equivalent_stress", 1, von_mises(kirchhoff_stress(b, q))),
};
#undef CLEAVE_MEASURE

}  // namespace

bool derive_core(const Body& body, std::string_view field, std::int64_t first, std::int64_t last,
                 double* values) {
  for (const Measure& measure : kMeasures) {
    if (measure.name != field) continue;
    for (std::int64_t q = first; q < last; ++q)
      measure.compute(body, q, values + measure.components * (q - first));
    return true;
  }
  return false;
}

}  // namespace cleave
