// What is shown of points and bonds: damage, stretches, and measures of deformation and stress, which no step needs.
#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>

#include "formulation/peridynamics/formulation.hpp"

namespace cleave::peridynamics {

namespace {

// A fit of the deformation needs a moment matrix with this reciprocal condition number.
constexpr double kSingular = 1e-6;

template <int D>
bool fit(const Mat<3>& moment, const Mat<3>& sum, Mat<3>& h) {
  Mat<D> k, s;
  for (int r = 0; r < D; ++r)
    for (int c = 0; c < D; ++c) {
      k(r, c) = moment(r, c);
      s(r, c) = sum(r, c);
    }
  const Mat<D> cof = cofactor(k);
  const double det = determinant(k);
  if (!(det > kSingular * std::sqrt(contract(k, k) * contract(cof, cof)))) return false;
  const Mat<D> product = multiply(s, cof);
  for (int r = 0; r < D; ++r)
    for (int c = 0; c < D; ++c) h(r, c) = product(r, c) / det;
  return true;
}

// Measures of stress. The tensor P itself is a state of other methods, so that every checkpoint asks for it:
// it is left from the last of these that was asked for in this step, else zero.
bool is_stress(std::string_view name) {
  if (name == "first_piola_kirchhoff_stress") return false;
  return name.find("stress") != std::string_view::npos || name == "pressure";
}
bool is_deformation(std::string_view name) {
  if (name == "strain_energy_density") return false;
  return name == "displacement_gradient" || name == "volume_ratio" ||
         name == "deformation_gradient" || name.find("strain") != std::string_view::npos;
}

}  // namespace

bool Peridynamic::derive(const Body& body, std::string_view field, std::int64_t first,
                         std::int64_t last, double* values) const {
  if (field == "damage") {
    for (std::int64_t i = first; i < last; ++i) {
      const std::int32_t all = hood_.count(i);
      values[i - first] = all == 0 ? 0.0 : 1 - static_cast<double>(damage_.intact_count(i)) / all;
    }
    return true;
  }
  if (field == "bond_stretch") {
    hood_.for_bonds(first, last,
                    [&](std::int32_t bond, std::int64_t i, std::int32_t p, std::int32_t) {
                      values[bond - first] = stretch(hood_, body.point.x, i, p);
                    });
    return true;
  }
  if (field != "largest_stretch") return false;
  for (std::int64_t i = first; i < last; ++i) {
    double largest = -1;
    for_carrying(i, [&](std::int32_t p, std::int32_t) {
      largest = std::fmax(largest, stretch(hood_, body.point.x, i, p));
    });
    values[i - first] = damage_.intact_count(i) == 0 ? 0.0 : largest;
  }
  return true;
}

bool Peridynamic::derive_integers(const Body& body, std::string_view field, std::int64_t first,
                                  std::int64_t last, std::int64_t* values) const {
  if (field == "region") {
    for (std::int64_t i = first; i < last; ++i) values[i - first] = body.region_of(i);
    return true;
  }
  if (field != "bond_ends") return false;
  hood_.for_bonds(first, last,
                  [&](std::int32_t bond, std::int64_t i, std::int32_t p, std::int32_t) {
                    values[2 * (bond - first)] = i;
                    values[2 * (bond - first) + 1] = p;
                  });
  return true;
}

// H that fits the bonds which carry best, weighed by volumes: exact for affine motion.
Mat<3> Peridynamic::fitted_gradient(const Body& body, std::int64_t i) const {
  Mat<3> moment, sum, h;
  for_carrying(i, [&](std::int32_t p, std::int32_t) {
    const Vec<3> d = difference<3>(hood_.X, i, p), u = difference<3>(body.point.u, i, p);
    Vec<3> weighed;
    for (int k = 0; k < 3; ++k) weighed[k] = hood_.volume[p] * d[k];
    add_dyad(moment, d, weighed);
    add_dyad(sum, u, weighed);
  });
  if (dimension_ == 1) {
    if (moment(0, 0) > 0) h(0, 0) = sum(0, 0) / moment(0, 0);
    return h;
  }
  if (dimension_ == 2) {
    fit<2>(moment, sum, h);
  } else {
    fit<3>(moment, sum, h);
  }
  return h;
}

void Peridynamic::observe(Body& body, std::string_view field) {
  const bool wants_stress = is_stress(field) && !stress_observed_;
  const bool wants_gradient = (is_stress(field) || is_deformation(field)) && !gradient_observed_;
  if (!wants_stress && !wants_gradient) return;
  ThreadTeam alone;
  ThreadTeam& team = team_ == nullptr ? alone : *team_;
  constexpr std::int64_t kSmall = 32;  // points: a stress may be dear
  team.for_blocks((hood_.points + kSmall - 1) / kSmall, [&](std::int64_t block, int worker) {
    const std::int64_t first = block * kSmall, last = std::min(hood_.points, first + kSmall);
    for (std::int64_t i = first; wants_gradient && i < last; ++i) {
      const Mat<3> h = fitted_gradient(body, i);
      store_tensor(h, body.point.h, i);
      body.point.ratio[i] = determinant(plus_identity(h));
    }
    if (!wants_stress) return;
    std::array<Mat<3>, kSmall> stress;
    point_stresses(body, first, last, worker, stress.data());
    for (std::int64_t i = first; i < last; ++i) {
      Mat<3>& p = stress[static_cast<std::size_t>(i - first)];
      // What the plane condition adds: sigma_33.
      if (body.kinematics == CLEAVE_PLANE_STRAIN) p(2, 2) = elastic(i).nu * (p(0, 0) + p(1, 1));
      store_tensor(p, body.point.p, i);
    }
  });
  gradient_observed_ = gradient_observed_ || wants_gradient;
  stress_observed_ = stress_observed_ || wants_stress;
}

}  // namespace cleave::peridynamics
