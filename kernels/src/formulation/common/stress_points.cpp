#include "formulation/common/stress_points.hpp"

#include "core/error.hpp"
#include "material/stress_dispatch.hpp"

namespace cleave {

namespace {

template <int D>
void gradients_in(Body& body, const GradientOperator& g, ThreadTeam& team) {
  for_blocks(team, body.points, [&](std::int64_t, std::int64_t first, std::int64_t last) {
    displacement_gradient<D>(g, body.point.u, first, last, body.point.h);
    for (std::int64_t q = first; q < last; ++q) {
      body.point.ratio[q] = determinant(plus_identity(load_tensor<D>(body.point.h, q)));
    }
  });
}

}  // namespace

StressArrays stress_arrays(const Body& body, const Clock& clock) {
  StressArrays a;
  a.h = body.point.h;
  a.volume = body.point.volume;
  a.dt = clock.dt;
  a.history = body.history;
  a.p = body.point.p;
  a.energy = body.point.energy;
  return a;
}

std::string point_label(const Body& body, const GradientOperator& g, std::int64_t q) {
  if (g.of_particles()) return body.particle_label(q);
  return text("integration point ", body.number(q), " beside ",
              body.particle_label(g.origin_of(q)));
}

void StressPoints::setup(const Body& body) {
  failed_.assign(static_cast<std::size_t>(block_count(body.points)), -1);
  dissipated_.resize(body.points);
}

void StressPoints::gradients(Body& body, const GradientOperator& g, ThreadTeam& team) const {
  body.dimension() == 2 ? gradients_in<2>(body, g, team) : gradients_in<3>(body, g, team);
}

void StressPoints::deform(Body& body, const GradientOperator& g, const Clock& clock,
                          ThreadTeam& team) {
  gradients(body, g, team);
  const StressArrays arrays = stress_arrays(body, clock);
  for_blocks(team, body.points, [&](std::int64_t block, std::int64_t first, std::int64_t last) {
    const StressResult r = update_stress(body.material, body.dimension(), arrays, first, last);
    failed_[static_cast<std::size_t>(block)] = r.first_failed;
    dissipated_[block] = {r.plastic, r.viscous};
  });
  const auto [plastic, viscous] = dissipated_.total();
  body.point.ledger[ledger::kPlastic] += plastic;
  body.point.ledger[ledger::kShock] += viscous;
  for (const std::int64_t q : failed_) {
    if (q >= 0) refuse(body, g, q);
  }
}

void StressPoints::refuse(const Body& body, const GradientOperator& g, std::int64_t q) const {
  throw Error(CLEAVE_BAD_JACOBIAN,
              text(body.label(), ": law ", body.law->name, " has no answer at ",
                   point_label(body, g, q), " (det F = ", body.point.ratio[q],
                   "); the deformation is outside its range: use a smaller step, "
                   "stabilisation, or another law"));
}

void StressPoints::observe(Body& body, ThreadTeam& team) const {
  const StressArrays arrays = stress_arrays(body, Clock{});
  for_blocks(team, body.points, [&](std::int64_t, std::int64_t first, std::int64_t last) {
    // The law advances a copy.
    StressArrays trial = arrays;
    std::vector<double> copy[kMaxHistory];
    for (std::size_t k = 0; k < body.law->history.size(); ++k) {
      const std::int64_t stride = arrays.history.stride[k];
      const double* from = arrays.history.base[k];
      copy[k].assign(from + stride * first, from + stride * last);
      trial.history.base[k] = copy[k].data() - stride * first;
    }
    update_stress(body.material, body.dimension(), trial, first, last);
  });
}

double StressPoints::stored_energy(const Body& body) const {
  double sum = 0;
  for (std::int64_t q = 0; q < body.points; ++q) sum += body.point.volume[q] * body.point.energy[q];
  return sum;
}

std::int64_t StressPoints::inverted(const Body& body) const {
  std::int64_t count = 0;
  for (std::int64_t q = 0; q < body.points; ++q) {
    if (body.point.volume[q] > 0 && !(body.point.ratio[q] > 0)) ++count;
  }
  return count;
}

}  // namespace cleave
