#include "formulation/meshless/kernel_gradient.hpp"

#include <algorithm>
#include <cmath>

#include "core/blocks.hpp"
#include "formulation/common/body_simplices.hpp"

namespace cleave::meshless {

namespace {

// Reciprocal condition number of K_i (1: neighbours all around) below which a particle has no gradient.
constexpr double kSingular = 1e-6;

template <int D>
double frobenius(const Mat<D>& m) {
  return std::sqrt(contract(m, m));
}

}  // namespace

void KernelGradient::build(Body& body, const Kernel& kernel) {
  kernel_ = kernel;
  X = body.point.X;
  volume = body.point.volume;
  require_simplices(body);
  simplices = take_simplices(body);
  corners_ = body.fields.integer("simplex_particles");
  share_volumes(body, corners_, simplices);
  check_volumes(body);
  rows = neighbours_within(X, body.particles, kernel.support, kernel.rule, body.label());
  check_distances(body);
  body.fields.allocate(CLEAVE_RELATION_HALF_BOND, half_bonds());
  body.fields.allocate(CLEAVE_RELATION_BOND, half_bonds() / 2);
  zeta = body.fields.real("bond_vector");
  singular_.resize(static_cast<std::size_t>(block_count(body.particles)));
  ThreadTeam alone;
  rebuild(body, alone);
  for (const std::int64_t i : singular_) {
    if (i >= 0) refuse(body, i);
  }
}

void KernelGradient::require_simplices(const Body& body) {
  if (body.given_simplices.empty()) {
    throw Error(CLEAVE_UNSUPPORTED,
                text(body.label(), " has no simplices: ", body.formulation->name(),
                     " takes the volumes of its particles from them; give the body a mesh of "
                     "triangles or tetrahedra, or a lattice"));
  }
}

void KernelGradient::check_volumes(const Body& body) const {
  for (std::int64_t i = 0; i < body.particles; ++i) {
    if (volume[i] > 0) continue;
    throw Error(CLEAVE_BAD_SIMPLEX,
                text(body.label(), ": ", body.particle_label(i),
                     " belongs to no simplex, or to flat ones only, so it has no volume; leave it "
                     "out"));
  }
}

void KernelGradient::check_distances(const Body& body) const {
  for (std::int64_t i = 0; i < body.particles; ++i) {
    for (auto b = rows.row_begin[static_cast<std::size_t>(i)];
         b < rows.row_begin[static_cast<std::size_t>(i) + 1]; ++b) {
      const std::int32_t p = rows.neighbour[static_cast<std::size_t>(b)];
      const Vec<3> d = difference<3>(X, i, p);
      if (!(dot(d, d) > 0)) {
        throw Error(CLEAVE_BAD_ARGUMENT,
                    text(body.label(), ": ", body.particle_label(i), " and particle ",
                         body.number(p), " are at the same place; leave one out"));
      }
    }
  }
}

void KernelGradient::refuse(const Body& body, std::int64_t i) const {
  const auto neighbours =
      rows.row_begin[static_cast<std::size_t>(i) + 1] - rows.row_begin[static_cast<std::size_t>(i)];
  throw Error(CLEAVE_BAD_ARGUMENT,
              text(body.label(), ": the ", neighbours, " neighbours of ", body.particle_label(i),
                   " within ", kernel_.support,
                   " [m] do not surround it well enough for a gradient in ", body.dimension(),
                   " dimensions; use a larger radius in group kernel, or more particles "
                   "there"));
}

// Row i; false if its moment matrix has no inverse to speak of.
template <int D>
bool KernelGradient::weigh(std::int64_t i) {
  const auto first = rows.row_begin[static_cast<std::size_t>(i)],
             last = rows.row_begin[static_cast<std::size_t>(i) + 1];
  const auto weight_of = [&](std::int32_t b, Vec<D>& d) {
    const std::int32_t p = rows.neighbour[static_cast<std::size_t>(b)];
    d = difference<D>(X, i, p);
    return volume[p] * kernel_.omega(std::sqrt(dot(d, d)));
  };
  Mat<D> moment;
  Vec<D> d;
  for (auto b = first; b < last; ++b) {
    const double weight = weight_of(b, d);
    Vec<D> scaled;
    for (int k = 0; k < D; ++k) scaled[k] = weight * d[k];
    add_dyad(moment, scaled, d);
  }
  const Mat<D> cof = cofactor(moment);
  const double det = determinant(moment);
  const bool regular = det > kSingular * frobenius(moment) * frobenius(cof);
  if (kernel_.gradient == GradientForm::corrected && !regular) return false;
  for (auto b = first; b < last; ++b) {
    const double weight = volume[i] * weight_of(b, d);
    Vec<D> direction = d;
    if (kernel_.gradient == GradientForm::corrected) {
      direction = multiply(cof, d);  // symmetric: the inverse times det K
      for (int k = 0; k < D; ++k) direction[k] /= det;
    }
    for (int k = 0; k < D; ++k) zeta[kVector * b + k] = weight * direction[k];
  }
  return true;
}

void KernelGradient::rebuild(const Body& body, ThreadTeam& team) {
  share_volumes(body, corners_, simplices);
  const bool plane = body.dimension() == 2;
  for_blocks(team, body.particles, [&](std::int64_t block, std::int64_t first, std::int64_t last) {
    std::int64_t& singular = singular_[static_cast<std::size_t>(block)];
    singular = -1;
    for (std::int64_t i = first; i < last; ++i) {
      const bool regular = plane ? weigh<2>(i) : weigh<3>(i);
      if (!regular && singular < 0) singular = i;
    }
  });
}

std::vector<double> KernelGradient::pair_values(
    const std::function<double(double, double)>& f) const {
  std::vector<double> value(rows.neighbour.size());
  for (std::size_t i = 0; i + 1 < rows.row_begin.size(); ++i) {
    for (auto b = static_cast<std::size_t>(rows.row_begin[i]);
         b < static_cast<std::size_t>(rows.row_begin[i + 1]); ++b) {
      const Vec<3> d = difference<3>(X, static_cast<std::int64_t>(i), rows.neighbour[b]);
      value[b] = f(volume[i] * volume[rows.neighbour[b]], std::sqrt(dot(d, d)));
    }
  }
  return value;
}

std::vector<double> KernelGradient::bond_weights() const {
  std::vector<double> weight(rows.neighbour.size());
  for (std::size_t i = 0; i + 1 < rows.row_begin.size(); ++i) {
    for (auto b = static_cast<std::size_t>(rows.row_begin[i]);
         b < static_cast<std::size_t>(rows.row_begin[i + 1]); ++b) {
      weight[b] = dot(load_vector<3>(zeta, static_cast<std::int64_t>(b)),
                      difference<3>(X, static_cast<std::int64_t>(i), rows.neighbour[b]));
    }
  }
  return weight;
}

std::int64_t KernelGradient::bytes() const {
  return static_cast<std::int64_t>(
      (rows.row_begin.capacity() + rows.neighbour.capacity() + rows.reverse.capacity()) *
      sizeof(std::int32_t));
}

}  // namespace cleave::meshless
