// Fields that are computed when they are asked for.
#include <cmath>

#include "model/model.hpp"

namespace cleave {

namespace {

// Full F with the out-of-plane stretch of the plane condition.
Mat<3> full_deformation_gradient(const Body& body, std::int64_t i) {
  Mat<3> h = load_tensor<3>(body.point.h, i);
  Mat<3> f = plus_identity(h);
  if (body.dimension() == 2) {
    Mat<2> plane;
    for (int r = 0; r < 2; ++r)
      for (int c = 0; c < 2; ++c) plane(r, c) = h(r, c);
    f(2, 2) = with_law(body.material, [&](const auto& law) {
      return law.thickness_stretch(plane, body.history.at(i));
    });
  }
  return f;
}

// sigma = P F^T / det F; zero where det F is not positive.
Mat<3> cauchy_stress(const Body& body, std::int64_t i) {
  const Mat<3> f = full_deformation_gradient(body, i), p = load_tensor<3>(body.point.p, i);
  const double det = determinant(f);
  Mat<3> sigma;
  if (!(det > 0)) return sigma;
  for (int r = 0; r < 3; ++r)
    for (int c = 0; c < 3; ++c)
      for (int k = 0; k < 3; ++k) sigma(r, c) += p(r, k) * f(c, k) / det;
  return sigma;
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

}  // namespace

bool derive_core(const Body& body, std::string_view field, std::int64_t first, std::int64_t last,
                 double* values) {
  for (std::int64_t i = first; i < last; ++i) {
    if (field == "deformation_gradient") {
      store_tensor(full_deformation_gradient(body, i), values, i - first);
    } else if (field == "cauchy_stress") {
      store_tensor(cauchy_stress(body, i), values, i - first);
    } else if (field == "equivalent_stress") {
      values[i - first] = von_mises(cauchy_stress(body, i));
    } else {
      return false;
    }
  }
  return true;
}

}  // namespace cleave
