// The stable step now: that of the undeformed body, times how much the deformation shortens it
// [CBM deformed].
#include <algorithm>
#include <cmath>

#include "model/model.hpp"
#include "model/resident.hpp"

namespace cleave {

namespace {

// Largest eigenvalue of F^-1 F^-T from the cofactors of F, in the closed form of symmetric matrices.
template <int D>
double largest_inverse_square(const Mat<D>& f, double det) {
  const Mat<D> cof = cofactor(f);
  Mat<D> b;
  double mean = 0;
  for (int r = 0; r < D; ++r)
    for (int c = 0; c < D; ++c)
      for (int k = 0; k < D; ++k) b(r, c) += cof(r, k) / det * (cof(c, k) / det);
  for (int r = 0; r < D; ++r) mean += b(r, r) / D;
  for (int r = 0; r < D; ++r) b(r, r) -= mean;
  const double spread = std::sqrt(contract(b, b) / (D * (D - 1)));
  if constexpr (D == 2) return mean + spread;
  if (!(spread > 0)) return mean;
  for (int r = 0; r < D; ++r)
    for (int c = 0; c < D; ++c) b(r, c) /= spread;
  const double cosine = std::fmax(-1.0, std::fmin(1.0, 0.5 * determinant(b)));
  return mean + 2 * spread * std::cos(std::acos(cosine) / 3);
}

// Smallest stretch of a line element at F, at most 1.
template <int D>
double shortest_stretch(const Mat<D>& f) {
  const double det = determinant(f);
  if (!(det > 0)) return 1.0;  // turned inside out: no step would help
  return 1 / std::sqrt(std::fmax(1.0, largest_inverse_square(f, det)));
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
double deformation_factor(Body& body, ThreadTeam& team) {
  if (!body.formulation->has_gradient_operator()) return 1.0;  // no stress at points
  with_law(body.material, [&](const auto& law) {
    for_blocks(team, body.points, [&](std::int64_t block, std::int64_t first, std::int64_t last) {
      double least = 1;
      for (std::int64_t q = first; q < last; ++q) {
        if (!(body.point.volume[q] > 0)) continue;
        const Mat<D> f = plus_identity(load_tensor<D>(body.point.h, q));
        least = std::fmin(
            least, shortest_stretch(f) / stiffening(law, body.point.ratio[q], body.history.at(q)));
      }
      body.point_work[block][0] = least;
    });
  });
  double least = 1;
  for (std::int64_t block = 0; block < block_count(body.points); ++block)
    least = std::fmin(least, body.point_work[block][0]);
  return least;
}

double stable_step(Body& body, ThreadTeam& team) {
  fetch(body);
  return shortening(body, team) * body.formulation->stable_step(body);
}

bool stiffens(const Body& body) {
  return with_law(body.material, [](const auto& law) {
    return requires { law.wave_speed_ratio(1.0, History{}); };
  });
}

}  // namespace

double shortening(Body& body, ThreadTeam& team) {
  return body.dimension() == 2 ? deformation_factor<2>(body, team)
                               : deformation_factor<3>(body, team);
}

double stable_step(cleave_model& model) {
  double step = kUnbounded;
  for (auto& body : model.bodies) step = std::min(step, stable_step(*body, model.team));
  return step;
}

bool is_stable(cleave_model& model, double dt) {
  for (auto& body : model.bodies) {
    ResidentStep* resident = body->formulation->resident();
    const double bound =
        resident == nullptr || stiffens(*body) ? 0.0 : resident->shortest_stretch();
    if (dt <= bound * body->formulation->stable_step(*body)) continue;
    if (!(dt <= stable_step(*body, model.team))) return false;
  }
  return true;
}

}  // namespace cleave
