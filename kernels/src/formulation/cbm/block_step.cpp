#include "formulation/cbm/block_step.hpp"

#include <algorithm>
#include <cmath>

#include "material/stress_dispatch.hpp"

namespace cleave::cbm {

namespace {

// Points that are given to the law at once: their gradients and stresses stay in the first-level cache.
constexpr std::int32_t kBatch = 64;

std::size_t at(std::int64_t k) { return static_cast<std::size_t>(k); }

}  // namespace

double BlockStep::total(std::int64_t component) const {
  const double f = f_[at(component)], bonds = fv_.empty() ? f : f + fv_[at(component)];
  return bonds + (has_external_ ? fe_[at(component)] : 0.0);
}

void BlockStep::add_power(std::int64_t component, PowerSums& powers) const {
  const double v = v_[at(component)];
  powers.internal += f_[at(component)] * v;
  if (!fv_.empty()) powers.viscous += fv_[at(component)] * v;
  if (has_external_) powers.external += fe_[at(component)] * v;
}

SearchBody BlockStep::search_body(const Body& body) const {
  return {net_, parts_.network, *kernels_, body.dimension(), X_.data(), u_.data()};
}

MotionArrays BlockStep::motion() {
  return {u_.data(),
          v_.data(),
          f_.data(),
          fv_.empty() ? nullptr : fv_.data(),
          has_external_ ? fe_.data() : nullptr,
          inverse_mass_.data(),
          is_driven_.data()};
}

template <int D>
void BlockStep::advance_in(Body& body, double dt) {
  PowerSums driven{};
  const double reaction = advance_driven<D>(body, dt, driven);
  const SearchBody searched = search_body(body);
  search_.expect(searched, *team_);
  team_->for_blocks(static_cast<std::int64_t>(net_.blocks.size()), [&](std::int64_t b, int worker) {
    const Block& block = net_.blocks[at(b)];
    results_[at(b)].powers = kernels_->advance[D - 2](
        motion(), block.first, block.first + block.own, 0.5 * dt, dt, boxes_[at(b)]);
    search_.advanced(searched, boxes_, dt, b, worker);
  });
  book(body, dt, driven, reaction);
}

// Power of the forces that keep the motion [W]; the others' is added to `powers`.
template <int D>
double BlockStep::advance_driven(Body& body, double dt, PowerSums& powers) {
  double reaction = 0;
  for (const Driven& d : driven_) {
    for (int k = 0; k < D; ++k) {
      const std::int64_t c = D * static_cast<std::int64_t>(d.place) + k;
      const PrescribedDof* dof = d.dof[at(k)] < 0 ? nullptr : &body.prescribed[at(d.dof[at(k)])];
      const double a = dof != nullptr ? d.a[at(k)] : total(c) * inverse_mass_[at(d.place)];
      const bool exact = dof != nullptr && dof->motion == CLEAVE_MOTION_EXACT;
      double& v = v_[at(c)];
      v = exact ? (dof->displacement - u_[at(c)]) / dt : v + 0.5 * dt * a;
      add_power(c, powers);
      if (dof != nullptr) reaction += (body.point.mass[dof->particle] * a - total(c)) * v;
      u_[at(c)] = exact ? dof->displacement : u_[at(c)] + dt * v;
    }
  }
  return reaction;
}

// Half of the trapezoid of the works.
void BlockStep::book(Body& body, double dt, PowerSums powers, double reaction) const {
  for (const BlockResult& r : results_) {
    powers.internal += r.powers.internal;
    powers.viscous += r.powers.viscous;
    powers.external += r.powers.external;
  }
  double* entry = body.point.ledger;
  const double half = 0.5 * dt;
  entry[ledger::kInternal] -= half * powers.internal;
  entry[ledger::kViscous] -= half * powers.viscous;
  entry[ledger::kExternal] += half * powers.external;
  entry[ledger::kReaction] += half * reaction;
}

// Positions and velocities of own and foreign particles beside each other.
template <int D>
void BlockStep::gather_viscous(const Block& block, Scratch& s) const {
  const auto particle = [&](std::int64_t p, std::int64_t l) {
    for (int k = 0; k < D; ++k) {
      const auto to = at(kStride<D> * l + k), from = at(D * p + k);
      const double X = X_[from];
      s.x[to] = X + u_[from];
      s.v[to] = v_[from];
      if (parts_.local_lengths) s.X[to] = X;
    }
  };
  for (std::int32_t l = 0; l < block.own; ++l) particle(block.first + l, l);
  std::int64_t l = block.own;
  for (const std::int32_t q : block.foreign) particle(q, l++);
}

namespace {

BlockRows rows_of(const BlockBonds& b) {
  return {b.begin.data(), b.count.data(), b.end.data(), b.zeta.data(), b.weight.data()};
}

// det F of points, not below zero.
template <int D>
void clipped_ratio(const double* h, std::int64_t count, double* ratio) {
  for (std::int64_t q = 0; q < count; ++q) {
    const double J = determinant(plus_identity(load_tensor<D>(h, q)));
    ratio[q] = J > 0 ? J : 0.0;
  }
}

}  // namespace

// What the gradient needs: displacements, sums at zero.
template <int D>
BlockArrays BlockStep::arrays_of(const Block& block, Scratch& s) const {
  // Sequential, so that the hardware reads ahead; the loops jump.
  double* to = std::copy_n(u_.data() + D * static_cast<std::int64_t>(block.first), D * block.own,
                           s.u.data());
  for (const std::int32_t q : block.foreign)
    to = std::copy_n(u_.data() + D * static_cast<std::int64_t>(q), D, to);
  std::fill_n(s.rows.begin(), D * kStride<D> * static_cast<std::int64_t>(block.own), 0.0);
  BlockArrays a{};
  a.own = block.own;
  a.twins = rows_of(block.twins);
  a.halves = rows_of(block.halves);
  a.u = s.u.data();
  a.rows = s.rows.data();
  a.volume = volume_.data() + block.first;
  return a;
}

template BlockArrays BlockStep::arrays_of<2>(const Block&, Scratch&) const;
template BlockArrays BlockStep::arrays_of<3>(const Block&, Scratch&) const;

template <int D>
void BlockStep::form_block(const Body& body, std::int32_t b, const Clock& clock, Scratch& s) {
  const Block& block = net_.blocks[at(b)];
  BlockResult& result = results_[at(b)];
  result = {};
  BlockArrays a = arrays_of<D>(block, s);
  const bool stored = !P_.empty();
  double* P = stored ? P_.data() + kTensor * block.first : s.P.data();
  a.P = P;
  StressArrays points;
  points.h = s.h.data();
  points.dt = clock.dt;
  for (std::int32_t i = 0; i < block.own; i += kBatch) {
    const std::int32_t count = std::min(kBatch, block.own - i);
    kernels_->gradient[D - 2](a, i, i + count, s.h.data());
    if (parts_.viscosity != nullptr) clipped_ratio<D>(s.h.data(), count, s.J.data() + i);
    if (watch_) {
      result.square_strain =
          std::fmax(result.square_strain, kernels_->square_strain[D - 2](s.h.data(), count));
    }
    points.volume = a.volume + i;
    points.p = P + kTensor * i;
    points.energy = stored ? energy_.data() + block.first + i : nullptr;
    for (std::size_t k = 0; k < history_.size(); ++k) {
      points.history.stride[k] = body.history.stride[k];
      points.history.base[k] = history_[k].data() + body.history.stride[k] * (block.first + i);
    }
    const StressResult r = update_stress(body.material, D, points, 0, count);
    result.plastic += r.plastic;
    result.shock += r.viscous;
    if (r.first_failed >= 0 && result.failed < 0) result.failed = i + r.first_failed;
  }
  form_forces<D>(block, a, s);
}

// Forces of own particles, and what the block adds to foreign ones.
template <int D>
void BlockStep::form_forces(const Block& block, BlockArrays a, Scratch& s) {
  const auto zero = [&](AlignedReals& f) {
    std::fill_n(f.begin(), kStride<D> * static_cast<std::int64_t>(block.locals()), 0.0);
    return f.data();
  };
  a.f = zero(s.f);
  kernels_->force[D - 2](a);
  scatter<D>(block, s.f, f_, slots_);
  if (parts_.viscosity == nullptr) return;
  gather_viscous<D>(block, s);
  a.x = s.x.data();
  a.v = s.v.data();
  a.X = parts_.local_lengths ? s.X.data() : nullptr;
  a.J = s.J.data();
  a.fv = zero(s.fv);
  a.coefficient = parts_.viscosity->beta_rho_c;
  a.length = parts_.viscosity->length;
  kernels_->viscous_force[D - 2](a);
  scatter<D>(block, s.fv, fv_, viscous_slots_);
}

// From local particles to own places and slots.
template <int D>
void BlockStep::scatter(const Block& block, const AlignedReals& from, std::vector<double>& f,
                        std::vector<double>& slots) const {
  const double* next = from.data();
  const auto copy = [&next](std::size_t count, double* to) {
    for (std::size_t l = 0; l < count; ++l, next += kStride<D>, to += D)
      for (int k = 0; k < D; ++k) to[k] = next[k];
  };
  copy(at(block.own), f.data() + D * static_cast<std::int64_t>(block.first));
  copy(block.foreign.size(), slots.data() + D * block.slot);
}

// To particles at the face of a block, what the blocks around add, in their order.
template <int D>
void BlockStep::add_slots(const Block& block) {
  const auto add = [](const std::vector<double>& slots, std::int64_t slot, std::vector<double>& f,
                      std::int64_t p) {
    for (int c = 0; c < D; ++c) f[at(D * p + c)] += slots[at(D * slot + c)];
  };
  for (std::int64_t p = block.first; p < block.first + block.surface; ++p) {
    for (std::int32_t k = net_.incoming_begin[at(p)]; k < net_.incoming_begin[at(p) + 1]; ++k) {
      add(slots_, net_.incoming[at(k)], f_, p);
      if (!fv_.empty()) add(viscous_slots_, net_.incoming[at(k)], fv_, p);
    }
  }
}

template <int D>
double BlockStep::finish_driven(const Body& body, double half, PowerSums& powers) {
  double reaction = 0;
  for (Driven& d : driven_) {
    for (int k = 0; k < D; ++k) {
      const std::int64_t c = D * static_cast<std::int64_t>(d.place) + k;
      const PrescribedDof* dof = d.dof[at(k)] < 0 ? nullptr : &body.prescribed[at(d.dof[at(k)])];
      const double a = dof != nullptr ? dof->acceleration : total(c) * inverse_mass_[at(d.place)];
      double& v = v_[at(c)];
      add_power(c, powers);
      if (dof != nullptr) {
        d.a[at(k)] = a;
        reaction += (body.point.mass[dof->particle] * a - total(c)) * v;
      }
      v += half * a;
    }
  }
  return reaction;
}

// Stress and forces, and the second half of the kick if asked for: inner particles of a block at once, the
// others when all blocks have given.
template <int D>
void BlockStep::update_forces(Body& body, const Clock& clock, double half, bool kick) {
  const auto blocks = static_cast<std::int64_t>(net_.blocks.size());
  const auto kick_range = [&](std::int64_t b, std::int64_t first, std::int64_t last) {
    if (!kick) return;
    const PowerSums p = kernels_->kick[D - 2](motion(), first, last, half);
    PowerSums& powers = results_[at(b)].powers;
    powers.internal += p.internal;
    powers.viscous += p.viscous;
    powers.external += p.external;
  };
  team_->for_blocks(blocks, [&](std::int64_t b, int worker) {
    const Block& block = net_.blocks[at(b)];
    form_block<D>(body, static_cast<std::int32_t>(b), clock, scratch_[at(worker)]);
    kick_range(b, block.first + block.surface, block.first + block.own);
  });
  double plastic = 0, shock = 0;
  for (const BlockResult& r : results_) plastic += r.plastic, shock += r.shock;
  body.point.ledger[ledger::kPlastic] += plastic;
  body.point.ledger[ledger::kShock] += shock;
  refuse_failed(body);
  team_->for_blocks(blocks, [&](std::int64_t b) {
    const Block& block = net_.blocks[at(b)];
    add_slots<D>(block);
    kick_range(b, block.first, block.first + block.surface);
  });
}

template <int D>
void BlockStep::update_in(Body& body, const Clock& clock) {
  const auto& broken = search_.find(search_body(body), *team_);
  rebuild_rows(body, parts_.fracture.step(body, parts_.network, parts_.stabilisation, clock, broken,
                                          state(body)));
  const double half = 0.5 * clock.dt;
  update_forces<D>(body, clock, half, true);
  PowerSums driven{};
  const double reaction = finish_driven<D>(body, half, driven);
  book(body, clock.dt, driven, reaction);
}

template <int D>
void BlockStep::start_in(Body& body, const Clock& clock) {
  update_forces<D>(body, clock, 0, false);
  for (Driven& d : driven_)
    for (int k = 0; k < D; ++k)
      if (d.dof[at(k)] >= 0) d.a[at(k)] = body.prescribed[at(d.dof[at(k)])].acceleration;
}

void BlockStep::advance(Body& body, double dt, ThreadTeam& team) {
  prepare(body, team);
  release_unasked(body);
  const bool plane = body.dimension() == 2;
  current_.fill(false);
  plane ? advance_in<2>(body, dt) : advance_in<3>(body, dt);
}

void BlockStep::update(Body& body, const Clock& clock, ThreadTeam& team) {
  prepare(body, team);
  const bool plane = body.dimension() == 2;
  if (!external_loaded_) plane ? load_external<2>(body) : load_external<3>(body);
  current_.fill(false);
  watched_ = false;
  plane ? update_in<2>(body, clock) : update_in<3>(body, clock);
  watched_ = watch_;
  current_.fill(false);
}

void BlockStep::start(Body& body, const Clock& clock, ThreadTeam& team) {
  prepare(body, team);
  current_.fill(false);
  body.dimension() == 2 ? start_in<2>(body, clock) : start_in<3>(body, clock);
}

// The smallest eigenvalue of C = I + 2 E is not below 1 - |2 E|.
double BlockStep::shortest_stretch() {
  watch_ = true;
  if (!watched_ || !loaded_) return 0;
  double largest = 0;
  for (const BlockResult& r : results_) largest = std::fmax(largest, r.square_strain);
  return std::sqrt(std::fmax(0.0, 1 - std::sqrt(largest) * (1 + 1e-12))) * (1 - 1e-12);
}

void BlockStep::refuse_failed(Body& body) {
  std::int32_t failed = -1;
  for (std::size_t b = 0; b < results_.size(); ++b) {
    if (results_[b].failed < 0) continue;
    const std::int32_t i = net_.given[at(net_.blocks[b].first + results_[b].failed)];
    failed = failed < 0 ? i : std::min(failed, i);
  }
  if (failed < 0) return;
  current_.fill(false);
  fetch(body, "volume_ratio");
  parts_.points.refuse(body, parts_.network.gradient(), failed);
}

}  // namespace cleave::cbm
