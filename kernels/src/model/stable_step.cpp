// The stable step now: that of the undeformed body, times how much the deformation shortens it.
#include <algorithm>
#include <cmath>

#include "model/model.hpp"

namespace cleave {

namespace {

// Smallest stretch of a line element at F, at most 1; exact where one principal stretch differs from 1
// and never too large: |F^-1|^2 = sum of 1/stretch^2.
template <int D>
double shortest_stretch(const Mat<D>& f) {
  const double det = determinant(f);
  if (!(det > 0)) return 1.0;  // turned inside out: no step would help
  const Mat<D> cof = cofactor(f);
  const double inverse_square = contract(cof, cof) / (det * det);
  return std::fmin(1.0, 1 / std::sqrt(std::fmax(1.0, inverse_square - (D - 1))));
}

// Speed of sound over that of the undeformed material, for laws that stiffen.
template <class Law>
double stiffening(const Law& law, double volume_ratio, const History& history) {
  if constexpr (requires { law.wave_speed_ratio(volume_ratio, history); }) {
    return law.wave_speed_ratio(volume_ratio, history);
  } else {
    return 1.0;
  }
}

template <int D>
double deformation_factor(Body& body, int threads) {
  with_law(body.material, [&](const auto& law) {
    for_blocks(
        threads, body.points, [&](std::int64_t block, std::int64_t first, std::int64_t last) {
          double least = 1;
          for (std::int64_t q = first; q < last; ++q) {
            if (!(body.point.volume[q] > 0)) continue;
            const Mat<D> f = plus_identity(load_tensor<D>(body.point.h, q));
            least = std::fmin(least, shortest_stretch(f) /
                                         stiffening(law, body.point.ratio[q], body.history.at(q)));
          }
          body.point_work[block][0] = least;
        });
  });
  double least = 1;
  for (std::int64_t block = 0; block < block_count(body.points); ++block)
    least = std::fmin(least, body.point_work[block][0]);
  return least;
}

}  // namespace

double stable_step(cleave_model& model) {
  double step = kUnbounded;
  for (auto& body : model.bodies) {
    const double factor = body->dimension() == 2 ? deformation_factor<2>(*body, model.threads)
                                                 : deformation_factor<3>(*body, model.threads);
    step = std::min(step, factor * body->formulation->stable_step(*body));
  }
  return step;
}

}  // namespace cleave
