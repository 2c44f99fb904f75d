#include "model/stiffness_bound.hpp"

#include <cmath>

namespace cleave {

namespace {

template <int D>
Vec<D> magnitude(const Vec<D>& v) {
  Vec<D> out;
  for (int k = 0; k < D; ++k) out[k] = std::fabs(v[k]);
  return out;
}

// f(particle, |zeta|) of row q, the point's own weight - sum zeta included.
template <int D, class F>
void for_row(const GradientOperator& g, std::int64_t q, const F& f) {
  Vec<D> own;
  for (auto b = g.begin(q); b < g.end(q); ++b) {
    const Vec<D> zeta = load_vector<D>(g.zeta, b);
    for (int k = 0; k < D; ++k) own[k] += zeta[k];
    f(static_cast<std::int64_t>(g.particle(b)), magnitude(zeta));
  }
  if (g.of_particles()) f(q, magnitude(own));
}

template <int D>
void add_in(const Body& body, const GradientOperator& g, std::span<double> bound) {
  double plane_wave = 0, mu = 0;
  with_law(body.material, [&](const auto& law) {
    plane_wave = law.density() * law.wave_speed() * law.wave_speed();
    mu = law.shear_modulus();
  });
  const double lambda = std::fabs(plane_wave - 2 * mu);
  for (std::int64_t q = 0; q < body.points; ++q) {
    if (!(g.volume[q] > 0)) continue;
    Vec<D> all;  // sum_b |zeta_qb|
    for_row<D>(g, q, [&](std::int64_t, const Vec<D>& z) {
      for (int k = 0; k < D; ++k) all[k] += z[k];
    });
    double any = 0;
    for (int k = 0; k < D; ++k) any += all[k];
    for_row<D>(g, q, [&](std::int64_t a, const Vec<D>& z) {
      double sum = 0;
      for (int k = 0; k < D; ++k) sum += z[k];
      for (int j = 0; j < D; ++j) {
        bound[static_cast<std::size_t>(kVector * a + j)] +=
            (lambda * z[j] * any + mu * (sum * all[j] + dot(z, all))) / g.volume[q];
      }
    });
  }
}

}  // namespace

void add_row_sums(const Body& body, const GradientOperator& g, std::span<double> bound) {
  body.dimension() == 2 ? add_in<2>(body, g, bound) : add_in<3>(body, g, bound);
}

void Formulation::stiffness_bound(const Body& body, ThreadTeam& team, std::span<double> bound) {
  const double dt = stable_step(body);
  const GradientOperator* g = gradient_operator(team);
  for (std::int64_t i = 0; i < body.particles; ++i) {
    const bool carried = g == nullptr || !g->of_particles() || g->volume[i] > 0;
    for (int k = 0; k < body.dimension() && carried; ++k)
      bound[static_cast<std::size_t>(kVector * i + k)] = 4 * body.point.mass[i] / (dt * dt);
  }
}

}  // namespace cleave
