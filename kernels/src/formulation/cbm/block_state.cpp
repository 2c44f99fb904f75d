// What goes between the fields of a body and the arrays of the step in blocks.
#include <algorithm>

#include "core/instruction_set.hpp"
#include "formulation/cbm/block_step.hpp"

CLEAVE_DECLARE_KERNELS(cleave_call::BlockKernels, kBlockKernels)

namespace cleave::cbm {

namespace {

std::size_t at(std::int64_t k) { return static_cast<std::size_t>(k); }

// Whether the stress of a law follows from the gradient and the history after a step; else it is kept.
bool answers_by_state(const Material& material) {
  return with_law(material, [](const auto& law) {
    if constexpr (requires { law.kAnswersByState; }) {
      return law.kAnswersByState;
    } else {
      return false;
    }
  });
}

template <class Reals>
std::int64_t bytes_of(const Reals& a) {
  return static_cast<std::int64_t>(a.capacity() * sizeof(double));
}

}  // namespace

bool BlockStep::setup(const Body& body, ThreadTeam& team) {
  team_ = &team;
  kernels_ = &CLEAVE_KERNELS(kBlockKernels).chosen(InstructionSet::avx2);
  loaded_ = false;
  current_.fill(true);
  held_.fill(true);
  asked_.fill(false);
  if (!net_.build(body, parts_.network, parts_.viscosity != nullptr, parts_.fracture.active(),
                  *team_))
    return false;
  search_.setup(net_, parts_.fracture.active());
  results_.assign(net_.blocks.size(), {});
  boxes_.assign(net_.blocks.size(), {});
  rows_loaded_ = true;
  return true;
}

void BlockStep::fit_scratch(int dimension) {
  if (static_cast<std::int64_t>(scratch_.size()) >= team_->size()) return;
  const int stride = dimension == 3 ? kStride<3> : kStride<2>;
  const std::int64_t own = net_.most_own;
  scratch_.resize(at(team_->size()));
  const auto locals = at(stride * static_cast<std::int64_t>(net_.largest));
  const bool viscous = parts_.viscosity != nullptr;
  for (Scratch& s : scratch_) {
    s.u.assign(at(dimension * static_cast<std::int64_t>(net_.largest)), 0.0);
    s.f.assign(locals, 0.0);
    s.rows.assign(at(dimension * stride * own), 0.0);
    s.h.assign(at(kTensor * own), 0.0);
    if (P_.empty()) s.P.assign(at(kTensor * (own + 1)), 0.0);
    for (auto* a : {&s.x, &s.v, &s.fv}) a->assign(viscous ? locals : 0, 0.0);
    s.X.assign(viscous && parts_.local_lengths ? locals : 0, 0.0);
    s.J.assign(viscous ? at(own) : 0, 0.0);
    net_.reserve(s.rows_of_block, parts_.network);
  }
}

template <int D>
void BlockStep::load(Body& body) {
  const std::int64_t n = body.particles;
  const PointArrays& pt = body.point;
  const auto vectors = [&](const double* field, std::vector<double>& to) {
    to.resize(at(D * n + 1));  // so that vectors of four may be loaded
    for_blocks(*team_, n, [&](std::int64_t, std::int64_t first, std::int64_t last) {
      for (std::int64_t p = first; p < last; ++p)
        for (int k = 0; k < D; ++k) to[at(D * p + k)] = field[kVector * net_.given[at(p)] + k];
    });
  };
  if (parts_.viscosity != nullptr || parts_.fracture.active()) vectors(pt.X, X_);
  vectors(pt.u, u_);
  vectors(pt.v, v_);
  vectors(pt.internal, f_);
  slots_.resize(at(D * net_.slots));
  if (parts_.viscosity != nullptr) {
    vectors(pt.viscous, fv_);
    viscous_slots_.resize(at(D * net_.slots));
  }
  inverse_mass_.resize(at(n));
  volume_.resize(at(n));
  history_.resize(body.law->history.size());
  for (std::size_t k = 0; k < history_.size(); ++k)
    history_[k].resize(at(body.history.stride[k] * n));
  for (std::int64_t p = 0; p < n; ++p) {
    const std::int64_t i = net_.given[at(p)];
    inverse_mass_[at(p)] = 1 / pt.mass[i];
    volume_[at(p)] = pt.volume[i];
    for (std::size_t k = 0; k < history_.size(); ++k) {
      const std::int64_t stride = body.history.stride[k];
      std::copy_n(body.history.base[k] + stride * i, stride, history_[k].begin() + stride * p);
    }
    if (P_.empty()) continue;
    std::copy_n(pt.p + kTensor * i, kTensor, P_.begin() + kTensor * p);
    energy_[at(p)] = pt.energy[i];
  }
  load_external<D>(body);
  load_driven(body);
  if (!rows_loaded_) rebuild_all_rows();
  search_.start(net_, X_, u_);
  rows_loaded_ = loaded_ = true;
  current_.fill(true);
  current_[kDeformation] = false;
}

void BlockStep::rebuild_all_rows() {
  team_->for_blocks(static_cast<std::int64_t>(net_.blocks.size()), [&](std::int64_t b, int worker) {
    net_.rebuild(parts_.network, net_.blocks[at(b)], scratch_[at(worker)].rows_of_block);
  });
}

// Of particles that lost a simplex.
void BlockStep::rebuild_rows(const Body& body, std::span<const std::int32_t> particles) {
  for (const std::int32_t i : particles) {
    const std::int32_t place = net_.place[at(i)];
    Block& block = net_.blocks[at(net_.block_of(place))];
    volume_[at(place)] = body.point.volume[i];
    net_.rebuild_row(parts_.network, block, place - block.first, scratch_.front().rows_of_block);
  }
}

void BlockStep::prepare(Body& body, ThreadTeam& team) {
  team_ = &team;
  if (!answers_by_state(body.material)) {
    P_.resize(at(kTensor * (body.particles + 1)), 0.0);
    energy_.resize(at(body.particles));
  }
  fit_scratch(body.dimension());
  if (!loaded_) parts_.network.drop_rows();
  if (!loaded_) body.dimension() == 2 ? load<2>(body) : load<3>(body);
}

template <int D>
void BlockStep::load_external(const Body& body) {
  const double* field = body.point.external;
  const std::int64_t n = body.particles;
  if (!has_external_) {
    has_external_ =
        std::any_of(field, field + kVector * n, [](double component) { return component != 0; });
  }
  if (has_external_) {
    fe_.resize(at(D * n));
    for (std::int64_t p = 0; p < n; ++p)
      for (int k = 0; k < D; ++k) fe_[at(D * p + k)] = field[kVector * net_.given[at(p)] + k];
  }
  external_loaded_ = true;
}

void BlockStep::load_driven(const Body& body) {
  driven_.clear();
  is_driven_.assign(at(body.particles), 0);
  std::vector<std::int32_t> entry_of(at(body.particles), -1);  // into driven_
  driven_.reserve(body.prescribed.size());
  for (std::size_t k = 0; k < body.prescribed.size(); ++k) {
    const PrescribedDof& dof = body.prescribed[k];
    const std::int32_t place = net_.place[at(dof.particle)];
    is_driven_[at(place)] = 1;
    std::int32_t& e = entry_of[at(place)];
    if (e < 0) {
      e = static_cast<std::int32_t>(driven_.size());
      driven_.push_back({place, {-1, -1, -1}, {}});
    }
    driven_[at(e)].dof[at(dof.direction)] = static_cast<std::int32_t>(k);
    driven_[at(e)].a[at(dof.direction)] = body.point.a[kVector * dof.particle + dof.direction];
  }
}

void BlockStep::changed(std::string_view field) {
  if (field == "external_force") {
    external_loaded_ = false;
    return;
  }
  loaded_ = false;
  if (field.empty() || field == "simplex_alive" || field == "critical_strain") rows_loaded_ = false;
}

template <int D>
void BlockStep::fetch_motion(Body& body) {
  const PointArrays& pt = body.point;
  team_->for_blocks(static_cast<std::int64_t>(net_.blocks.size()), [&](std::int64_t b) {
    const Block& block = net_.blocks[at(b)];
    for (std::int64_t p = block.first; p < block.first + block.own; ++p)
      for (int k = 0; k < D; ++k) {
        const std::int64_t c = kVector * net_.given[at(p)] + k;
        pt.u[c] = u_[at(D * p + k)];
        pt.x[c] = pt.X[c] + pt.u[c];
        pt.v[c] = v_[at(D * p + k)];
      }
  });
}

template <int D>
void BlockStep::fetch_forces(Body& body) {
  const PointArrays& pt = body.point;
  team_->for_blocks(static_cast<std::int64_t>(net_.blocks.size()), [&](std::int64_t b) {
    const Block& block = net_.blocks[at(b)];
    for (std::int64_t p = block.first; p < block.first + block.own; ++p)
      for (int k = 0; k < D; ++k) {
        const std::int64_t c = kVector * net_.given[at(p)] + k, mine = D * p + k;
        pt.internal[c] = f_[at(mine)];
        if (!fv_.empty()) pt.viscous[c] = fv_[at(mine)];
        pt.a[c] = total(mine) * inverse_mass_[at(p)];
      }
  });
  for (const Driven& d : driven_)
    for (int k = 0; k < D; ++k)
      if (d.dof[at(k)] >= 0) pt.a[kVector * net_.given[at(d.place)] + k] = d.a[at(k)];
}

template <int D>
void BlockStep::fetch_deformation(Body& body) {
  team_->for_blocks(static_cast<std::int64_t>(net_.blocks.size()), [&](std::int64_t b, int worker) {
    const Block& block = net_.blocks[at(b)];
    Scratch& s = scratch_[at(worker)];
    const BlockArrays a = arrays_of<D>(block, s);
    kernels_->gradient[D - 2](a, 0, block.own, s.h.data());
    for (std::int32_t l = 0; l < block.own; ++l) {
      const std::int64_t i = net_.given[at(block.first + l)];
      const Mat<D> h = load_tensor<D>(s.h.data(), l);
      store_tensor(h, body.point.h, i);
      body.point.ratio[i] = determinant(plus_identity(h));
    }
  });
}

void BlockStep::fetch_stress(Body& body) {
  for_blocks(*team_, body.particles, [&](std::int64_t, std::int64_t first, std::int64_t last) {
    for (std::int64_t p = first; p < last; ++p) {
      const std::int64_t i = net_.given[at(p)];
      for (std::size_t k = 0; k < history_.size(); ++k) {
        const std::int64_t stride = body.history.stride[k];
        std::copy_n(history_[k].begin() + stride * p, stride, body.history.base[k] + stride * i);
      }
      if (P_.empty()) continue;
      std::copy_n(P_.begin() + kTensor * p, kTensor, body.point.p + kTensor * i);
      body.point.energy[i] = energy_[at(p)];
    }
  });
  if (P_.empty()) parts_.points.observe(body, *team_);
}

namespace {

// f(name) of every field of a group but the law's history.
template <class F>
void for_names(int group, const F& f) {
  static constexpr std::array<std::initializer_list<const char*>, 4> kNames = {
      {{"displacement", "velocity", "position"},
       {"acceleration", "internal_force", "viscous_force"},
       {"displacement_gradient", "volume_ratio"},
       {"first_piola_kirchhoff_stress", "strain_energy_density"}}};
  for (const char* name : kNames[at(group)]) f(name);
}

}  // namespace

template <class F>
void BlockStep::for_fields(const Body& body, int group, const F& f) {
  for_names(group, f);
  if (group == kStress)
    for (const FieldSpec& variable : body.law->history) f(variable.name);
}

void BlockStep::make_current(Body& body, int group) {
  asked_[at(group)] = true;
  if (current_[at(group)]) return;
  if (!held_[at(group)]) {
    for_fields(body, group, [&](const char* name) { body.fields.restore(name); });
    body.point_into_fields();
    held_[at(group)] = true;
  }
  fit_scratch(body.dimension());  // there may be more threads than in the last step
  const bool plane = body.dimension() == 2;
  switch (group) {
    case kMotion:
      plane ? fetch_motion<2>(body) : fetch_motion<3>(body);
      break;
    case kForces:
      plane ? fetch_forces<2>(body) : fetch_forces<3>(body);
      break;
    case kDeformation:
      plane ? fetch_deformation<2>(body) : fetch_deformation<3>(body);
      break;
    default:
      make_current(body, kDeformation);
      fetch_stress(body);
  }
  current_[at(group)] = true;
}

// A stored field needs its group; a derived one any of them, unless it belongs to the formulation.
void BlockStep::fetch(Body& body, std::string_view field) {
  if (!loaded_) return;
  const Field* f = body.fields.find(field);
  if (f == nullptr ||
      (f->spec.lifetime == CLEAVE_LIFETIME_DERIVED && std::string_view(f->owner) == "core")) {
    for (int group = 0; group < kGroups; ++group) make_current(body, group);
    return;
  }
  for (int group = 0; group < kGroups; ++group)
    for_fields(body, group, [&](const char* name) {
      if (field == name) make_current(body, group);
    });
}

// What the host did not ask for in a whole step has no memory in the next.
void BlockStep::release_unasked(Body& body) {
  bool any = false;
  for (int group = 0; group < kGroups; ++group) {
    if (asked_[at(group)] || !held_[at(group)]) continue;
    for_fields(body, group, [&](const char* name) { body.fields.release(name); });
    held_[at(group)] = false;
    any = true;
  }
  if (any) body.point_into_fields();
  asked_.fill(false);
}

ParticleState BlockStep::state(const Body& body) {
  ParticleState s{u_.data(), v_.data(), body.dimension(), net_.place.data(), body.history};
  for (std::size_t k = 0; k < history_.size(); ++k) s.history.base[k] = history_[k].data();
  return s;
}

std::int64_t BlockStep::bytes() const {
  std::int64_t sum = net_.bytes();
  for (const auto* a : {&X_, &u_, &v_, &f_, &fv_, &fe_, &inverse_mass_, &volume_, &P_, &energy_,
                        &slots_, &viscous_slots_})
    sum += bytes_of(*a);
  for (const auto& h : history_) sum += bytes_of(h);
  for (const Scratch& s : scratch_)
    for (const auto* a : {&s.u, &s.f, &s.fv, &s.x, &s.v, &s.X, &s.rows, &s.h, &s.P, &s.J})
      sum += bytes_of(*a);
  return sum + search_.bytes() + static_cast<std::int64_t>(is_driven_.capacity());
}

template void BlockStep::load<2>(Body&);
template void BlockStep::load<3>(Body&);
template void BlockStep::load_external<2>(const Body&);
template void BlockStep::load_external<3>(const Body&);

}  // namespace cleave::cbm
