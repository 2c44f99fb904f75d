// What goes between the fields of a body and the arrays of the step in blocks.
#include <algorithm>
#include <numeric>

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

bool BlockStep::setup(const Body& body) {
  kernels_ = &CLEAVE_KERNELS(kBlockKernels).chosen(InstructionSet::avx2);
  loaded_ = false;
  current_.fill(true);
  if (!net_.build(body, parts_.network, parts_.viscosity != nullptr, parts_.fracture.active(),
                  *team_))
    return false;
  search_.setup(net_, parts_.fracture.active());
  results_.assign(net_.blocks.size(), {});
  boxes_.assign(net_.blocks.size(), {});
  redo_.resize(net_.blocks.size());
  std::iota(redo_.begin(), redo_.end(), 0);
  in_redo_.assign(net_.blocks.size(), 0);
  row_changed_.assign(at(body.particles), 0);
  return true;
}

void BlockStep::fit_scratch(int dimension) {
  if (static_cast<std::int64_t>(scratch_.size()) >= team_->size()) return;
  const int stride = dimension == 3 ? kStride<3> : kStride<2>;
  std::int32_t own = 0;
  for (const Block& block : net_.blocks) own = std::max(own, block.own);
  scratch_.resize(at(team_->size()));
  const auto locals = at(stride * static_cast<std::int64_t>(net_.largest));
  const bool viscous = parts_.viscosity != nullptr;
  for (Scratch& s : scratch_) {
    s.u.assign(locals, 0.0);
    s.f.assign(locals, 0.0);
    s.rows.assign(at(dimension * stride * static_cast<std::int64_t>(own)), 0.0);
    s.h.assign(at(kTensor * own), 0.0);
    if (P_.empty()) s.P.assign(at(kTensor * (own + 1)), 0.0);
    for (auto* a : {&s.x, &s.v, &s.fv}) a->assign(viscous ? locals : 0, 0.0);
    s.X.assign(viscous && parts_.viscosity->lengths != nullptr ? locals : 0, 0.0);
    s.J.assign(viscous ? at(own) : 0, 0.0);
    s.scale.assign(viscous ? at(net_.most_bonds() + 4) : 0, 0.0);
    s.first.assign(s.scale.size(), 0);
    if (parts_.fracture.active()) net_.reserve(s.rows_of_block, dimension);
  }
}

template <int D>
void BlockStep::load(Body& body) {
  const std::int64_t n = body.particles;
  const PointArrays& pt = body.point;
  const auto vectors = [&](const double* field, std::vector<double>& to) {
    to.resize(at(D * n));
    for (std::int64_t p = 0; p < n; ++p)
      for (int k = 0; k < D; ++k) to[at(D * p + k)] = field[kVector * net_.given[at(p)] + k];
  };
  vectors(pt.X, X_);
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
  for (std::int64_t p = 0; p < n; ++p) {
    inverse_mass_[at(p)] = 1 / pt.mass[net_.given[at(p)]];
    volume_[at(p)] = pt.volume[net_.given[at(p)]];
  }
  history_.resize(body.law->history.size());
  for (std::size_t k = 0; k < history_.size(); ++k) {
    const std::int64_t stride = body.history.stride[k];
    history_[k].resize(at(stride * n));
    for (std::int64_t p = 0; p < n; ++p)
      std::copy_n(body.history.base[k] + stride * net_.given[at(p)], stride,
                  history_[k].begin() + stride * p);
  }
  load_external<D>(body);
  load_driven(body);
  search_.forget();
  loaded_ = true;
  // The rows may have changed with what was put.
  redo_.resize(net_.blocks.size());
  std::iota(redo_.begin(), redo_.end(), 0);
  rebuild_blocks(body, nullptr);
}

void BlockStep::rebuild_blocks(const Body& body, const char* changed_rows) {
  team_->for_blocks(static_cast<std::int64_t>(redo_.size()), [&](std::int64_t k, int worker) {
    net_.rebuild(parts_.network, body.dimension(), changed_rows, net_.blocks[at(redo_[at(k)])],
                 scratch_[at(worker)].rows_of_block);
  });
}

void BlockStep::prepare(Body& body, ThreadTeam& team) {
  team_ = &team;
  if (!answers_by_state(body.material)) {
    P_.resize(at(kTensor * (body.particles + 1)), 0.0);
    energy_.resize(at(body.particles));
  }
  fit_scratch(body.dimension());
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
  driven_entry_.assign(at(body.particles), -1);
  driven_.reserve(body.prescribed.size());
  for (std::size_t k = 0; k < body.prescribed.size(); ++k) {
    const PrescribedDof& dof = body.prescribed[k];
    const std::int32_t place = net_.place[at(dof.particle)];
    is_driven_[at(place)] = 1;
    std::int32_t& e = driven_entry_[at(place)];
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
  } else {
    loaded_ = false;
  }
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

void BlockStep::fetch_history(Body& body, std::int64_t place) const {
  for (std::size_t k = 0; k < history_.size(); ++k) {
    const std::int64_t stride = body.history.stride[k];
    std::copy_n(history_[k].begin() + stride * place, stride,
                body.history.base[k] + stride * net_.given[at(place)]);
  }
}

void BlockStep::fetch_stress(Body& body) {
  team_->for_blocks(static_cast<std::int64_t>(net_.blocks.size()), [&](std::int64_t b) {
    const Block& block = net_.blocks[at(b)];
    for (std::int64_t p = block.first; p < block.first + block.own; ++p) {
      fetch_history(body, p);
      if (P_.empty()) continue;
      const std::int64_t i = net_.given[at(p)];
      std::copy_n(P_.begin() + kTensor * p, kTensor, body.point.p + kTensor * i);
      body.point.energy[i] = energy_[at(p)];
    }
  });
  if (P_.empty()) parts_.points.observe(body, *team_);
}

void BlockStep::fetch(Body& body, std::string_view field) {
  if (!loaded_) return;
  const bool plane = body.dimension() == 2;
  const auto is = [field](std::initializer_list<std::string_view> names) {
    return std::find(names.begin(), names.end(), field) != names.end();
  };
  // Fields that the step does not change, and those that follow it at once.
  if (is({"reference_position", "mass", "volume", "external_force", "ledger", "damage",
          "simplex_particles", "simplex_alive", "bond_ends", "critical_strain", "bond_status",
          "bond_length", "bond_vector", "bond_weight"}))
    return;
  const bool all = !is({"displacement", "position", "velocity", "acceleration", "internal_force",
                        "viscous_force", "displacement_gradient", "volume_ratio"});
  const bool forces = all || is({"acceleration", "internal_force", "viscous_force"});
  const bool deformation = all || is({"displacement_gradient", "volume_ratio"});
  const auto make = [&](Group group, const auto& work) {
    if (current_[group]) return;
    work();
    current_[group] = true;
  };
  make(kMotion, [&] { plane ? fetch_motion<2>(body) : fetch_motion<3>(body); });
  if (forces) make(kForces, [&] { plane ? fetch_forces<2>(body) : fetch_forces<3>(body); });
  if (deformation) {
    make(kDeformation, [&] { parts_.points.gradients(body, parts_.network.gradient(), *team_); });
  }
  if (all) make(kStress, [&] { fetch_stress(body); });
}

// Motion and history of the particles, motion of their neighbours.
void BlockStep::bring(Body& body, std::span<const std::int32_t> particles) {
  const Network& network = parts_.network;
  const PointArrays& pt = body.point;
  const int D = body.dimension();
  const auto motion_of = [&](std::int32_t i) {
    const std::int64_t p = net_.place[at(i)];
    for (int k = 0; k < D; ++k) {
      const std::int64_t c = kVector * i + k;
      pt.u[c] = u_[at(D * p + k)];
      pt.x[c] = pt.X[c] + pt.u[c];
      pt.v[c] = v_[at(D * p + k)];
    }
  };
  for (const std::int32_t i : particles) {
    motion_of(i);
    fetch_history(body, net_.place[at(i)]);
    for (std::int32_t h = network.row_begin[at(i)]; h < network.row_begin[at(i) + 1]; ++h)
      motion_of(network.neighbour[at(h)]);
  }
}

void BlockStep::rebuilt(Body& body, std::span<const std::int32_t> particles) {
  redo_.clear();
  for (const std::int32_t i : particles) {
    const std::int32_t place = net_.place[at(i)], block = net_.block_of(place);
    volume_[at(place)] = body.point.volume[i];
    row_changed_[at(place)] = 1;
    if (in_redo_[at(block)] == 0) redo_.push_back(block);
    in_redo_[at(block)] = 1;
  }
  for (const std::int32_t block : redo_) in_redo_[at(block)] = 0;
  rebuild_blocks(body, row_changed_.data());
  for (const std::int32_t i : particles) row_changed_[at(net_.place[at(i)])] = 0;
}

std::int64_t BlockStep::bytes() const {
  std::int64_t sum = net_.bytes();
  for (const auto* a : {&X_, &u_, &v_, &f_, &fv_, &fe_, &inverse_mass_, &volume_, &P_, &energy_,
                        &slots_, &viscous_slots_})
    sum += bytes_of(*a);
  for (const auto& h : history_) sum += bytes_of(h);
  for (const Scratch& s : scratch_)
    for (const auto* a : {&s.u, &s.x, &s.v, &s.X, &s.rows, &s.h, &s.P, &s.f, &s.fv, &s.J})
      sum += bytes_of(*a);
  return sum + static_cast<std::int64_t>(is_driven_.capacity());
}

template void BlockStep::load<2>(Body&);
template void BlockStep::load<3>(Body&);
template void BlockStep::load_external<2>(const Body&);
template void BlockStep::load_external<3>(const Body&);

}  // namespace cleave::cbm
