#include "formulation/peridynamics/formulation.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>

#include "formulation/common/critical_bonds.hpp"
#include "formulation/common/unused_groups.hpp"
#include "tables/tables.hpp"

namespace cleave::peridynamics {

namespace {

// Of the bound below 2/omega_max, which itself is safe by 1.4 and more.                 [PD step]
constexpr double kSafety = 0.9;
// A bond is left as it is while it would lose less than this share of its integrity: in statics, equilibrium
// is not sought again for less.                                                     [VCPM softening]
constexpr double kLeastLoss = 1e-4;
// First size of the lists of one step; they grow beyond it only in a step that breaks more.
constexpr std::size_t kReserve = 65536;
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

void Peridynamic::refuse_groups(const Body& body) const {
  refuse_group(body, "viscosity", "leave it out, or apply it to other bodies");
  refuse_group(body, "stabilisation", "bonds have no hourglass modes; leave it out");
  refuse_group(body, "kernel", "its radius is horizon in group peridynamics");
  refuse_group(body, "hourglass", "bonds have no hourglass modes; leave it out");
  if (std::string_view(name()) != "cpd") refuse_group(body, "cpd", "it belongs to formulation cpd");
  if (std::string_view(name()) != "vcpm")
    refuse_group(body, "vcpm", "it belongs to formulation vcpm");
}

void Peridynamic::setup(Body& body, ThreadTeam&) {
  refuse_groups(body);
  const ParameterSet& options = body.group("peridynamics");
  const double section = options.real("section");
  if (section > 0 && body.kinematics != CLEAVE_PLANE_STRESS) {
    throw Error(CLEAVE_UNSUPPORTED,
                text("group peridynamics of ", body.label(), ": section ", section,
                     " [m2] makes it a bar, which needs kinematics plane_stress"));
  }
  dimension_ = section > 0 ? 1 : body.dimension();
  use_lattice_ = options.choice("stencil") == static_cast<int>(Stencil::lattice);
  materials_ = elastic_constants(body);
  hood_.build(body, dimension_, lay_out(body), section);
  const auto n = static_cast<std::size_t>(hood_.points);
  reference_.assign(4 * n, 0.0);
  now_.assign(4 * n, 0.0);
  left_.assign(n, 0.0);
  moved_.assign(static_cast<std::size_t>(block_count(hood_.points)), 1);
  material_of_.resize(n);
  for (std::size_t i = 0; i < n; ++i) {
    material_of_[i] = body.region_of(static_cast<std::int64_t>(i));
    body.point.mass[i] = elastic(static_cast<std::int64_t>(i)).density * hood_.volume[i];
    for (std::size_t k = 0; k < 3; ++k) reference_[4 * i + k] = body.point.X[3 * i + k];
    reference_[4 * i + 3] = hood_.volume[i];
  }
  damage_.setup(body, hood_, limits(body), options.real("interface_strain"));
  interactions_ = body.fields.real("interactions");
  interactions_[0] = static_cast<double>(hood_.half_bonds());
  pair_form_.reset();
  prepare(body);
  share_stencil(body);
  for (std::int64_t i = 0; i < hood_.points; ++i) rewire(i);
  rates_.assign(n, 0.0);
  find_rates(body, rates_);
  const double largest = *std::max_element(rates_.begin(), rates_.end());
  if (materials_.size() == 1) rates_.assign(1, largest);
  stable_step_ = kSafety * 2 / std::sqrt(largest);
  flag_.assign(n, 0);
  place_.assign(n, -1);
  const std::size_t reserve = std::min(static_cast<std::size_t>(hood_.bonds()), kReserve);
  weaker_.reserve(reserve);
  touched_.reserve(reserve);
  for (auto* list : {&share_, &release_}) list->reserve(reserve);
}

void Peridynamic::rebuild(Body& body, ThreadTeam& team) {
  damage_.rebuild();
  stress_observed_ = true;  // what a checkpoint brought is as old as its step
  for (std::int64_t i = 0; i < hood_.points; ++i) rewire(i);
  take_positions(body, team);
}

std::string Peridynamic::static_obstacle(const Body&) const {
  return "it needs a gradient operator, which interactions do not have; use relaxation";
}

bool take_rows(const double* from, std::int64_t count, double* to) {
  std::uint64_t changed = 0;
  for (std::int64_t i = 0; i < count; ++i)
    for (std::int64_t k = 0; k < 3; ++k) {
      const double x = from[kVector * i + k];
      changed |= std::bit_cast<std::uint64_t>(x) ^ std::bit_cast<std::uint64_t>(to[4 * i + k]);
      to[4 * i + k] = x;
    }
  return changed != 0;
}

void Peridynamic::take_positions(const Body& body, ThreadTeam& team) {
  team_ = &team;
  expect_workers(team.size());
  if (stress_observed_) std::fill(body.point.p, body.point.p + kTensor * hood_.points, 0.0);
  gradient_observed_ = stress_observed_ = false;
  for_blocks(team, hood_.points, [&](std::int64_t block, std::int64_t first, std::int64_t last) {
    if (lattice_pairs_.active()) {
      lattice_pairs_.take(body.point.u, first, last);
      return;
    }
    const bool moved =
        take_rows(body.point.x + kVector * first, last - first, now_.data() + 4 * first);
    if (moved) moved_[static_cast<std::size_t>(block)] = 1;
  });
}

bool Peridynamic::take_moved() {
  const bool moved = std::find(moved_.begin(), moved_.end(), 1) != moved_.end();
  std::fill(moved_.begin(), moved_.end(), 0);
  return moved;
}

void Peridynamic::deform(Body& body, const Clock&, ThreadTeam& team) { take_positions(body, team); }

void Peridynamic::forces(Body& body, ThreadTeam& team) {
  std::fill(body.point.viscous, body.point.viscous + kVector * hood_.points, 0.0);
  act(body, team);
}

void Peridynamic::stiffness_bound(const Body& body, ThreadTeam&, std::span<double> bound) {
  for (std::int64_t i = 0; i < hood_.points; ++i) {
    const bool carried = damage_.intact_count(i) > 0;
    const double rate = rates_.size() == 1 ? rates_[0] : rates_[static_cast<std::size_t>(i)];
    for (int k = 0; k < dimension_; ++k)
      bound[static_cast<std::size_t>(kVector * i + k)] = carried ? rate * body.point.mass[i] : 0.0;
  }
}

bool Peridynamic::break_bonds(Body& body, const Clock& clock, ThreadTeam& team) {
  find_weaker(body, team);
  if (!weaker_.empty()) weaken_found(body, clock, team);
  return !weaker_.empty();
}

bool Peridynamic::break_most_critical(Body& body, const Clock& clock, ThreadTeam& team,
                                      Breaking which) {
  find_critical(body, team, critical_);
  keep_most_critical(critical_, which);
  std::erase_if(weaker_, [this](const Weaker& w) {
    return std::none_of(critical_.begin(), critical_.end(),
                        [&](const CriticalBond& bond) { return bond.bond == w.bond; });
  });
  if (!weaker_.empty()) weaken_found(body, clock, team);
  return true;
}

void Peridynamic::break_these(Body& body, const Clock& clock, ThreadTeam& team,
                              std::span<const std::int32_t> bonds) {
  weaker_.clear();
  for (const std::int32_t bond : bonds) {
    hood_.for_bonds(bond, bond + 1,
                    [&](std::int32_t, std::int64_t, std::int32_t, std::int32_t half) {
                      weaker_.push_back({bond, 0.0, integrity(half)});
                    });
  }
  weaken_found(body, clock, team);
}

void Peridynamic::find_critical(Body& body, ThreadTeam& team, std::vector<CriticalBond>& found) {
  find_weaker(body, team);
  found.clear();
  for (const Weaker& w : weaker_) found.push_back({w.bond, critical_ratio(body, w.bond)});
}

double Peridynamic::critical_ratio(const Body& body, std::int32_t bond) const {
  double value = 0;
  hood_.for_bonds(bond, bond + 1, [&](std::int32_t, std::int64_t i, std::int32_t p, std::int32_t) {
    value = ratio(severity(body, i, p), damage_.limit(i, p));
  });
  return value;
}

// Sets weaker_: the bonds that are beyond their limit and keep less than they have.
void Peridynamic::find_weaker(Body& body, ThreadTeam& team) {
  weaker_.clear();
  if (!damage_.active()) return;
  take_positions(body, team);
  flag_points(body, team, flag_);
  damage_.find(
      flag_, [&](std::int64_t i, std::int64_t p) { return severity(body, i, p); },
      [&](std::int64_t i, std::int32_t half, double s) {
        const double now = integrity(half), kept = kept_integrity(s);
        if (kept <= (1 - kLeastLoss) * now)
          weaker_.push_back({hood_.bond_of_upper(i, half), kept, now - kept});
      });
}

double Peridynamic::severity(const Body& body, std::int64_t i, std::int64_t p) const {
  return stretch(hood_, body.point.x, i, p);
}

double Peridynamic::lay_out(Body& body) { return body.group("peridynamics").real("horizon"); }

std::vector<double> Peridynamic::limits(const Body& body) {
  return critical_stretches(body, materials_, reach());
}

// Sets touched_: the ends of the bonds of weaker_, and their shares.
void Peridynamic::touch_ends() {
  touched_.clear();
  share_.clear();
  for (const Weaker& w : weaker_) {
    hood_.for_bonds(w.bond, w.bond + 1,
                    [&](std::int32_t, std::int64_t i, std::int32_t p, std::int32_t) {
                      for (const std::int64_t end : {i, static_cast<std::int64_t>(p)}) {
                        std::int32_t& at = place_[static_cast<std::size_t>(end)];
                        if (at < 0) {
                          at = static_cast<std::int32_t>(touched_.size());
                          touched_.push_back(static_cast<std::int32_t>(end));
                          share_.push_back(0);
                        }
                        share_[static_cast<std::size_t>(at)] += w.lost;
                      }
                    });
  }
}

// Weakens or breaks the bonds of weaker_.
void Peridynamic::weaken_found(Body& body, const Clock& clock, ThreadTeam& team) {
  touch_ends();
  release_.assign(touched_.size(), 0.0);
  release(body, clock, team, +1);
  for (const Weaker& w : weaker_) {
    weaken(w.bond, w.kept);
    if (w.kept > 0) continue;
    damage_.mark(w.bond, kBroken);
    broke(w.bond);
  }
  for (const std::int32_t i : touched_) rewire(i);
  release(body, clock, team, -1);
  for (const double e : release_) body.point.ledger[ledger::kFracture] += e;
  record(body, clock);
  for (const std::int32_t i : touched_) place_[static_cast<std::size_t>(i)] = -1;
}

// The energy that a point has before and no longer has after, at the new positions, without the work that
// the trapezoid of the force after the weakening books already.
void Peridynamic::release(Body& body, const Clock& clock, ThreadTeam& team, double sign) {
  team.for_blocks(static_cast<std::int64_t>(touched_.size()), [&](std::int64_t k, int worker) {
    const auto at = static_cast<std::size_t>(k);
    const PointEnergy e = point_energy(body, touched_[at], worker);
    release_[at] += sign * (e.energy - 0.5 * clock.dt * e.rate);
  });
}

// What a point releases goes to its weakened bonds by what they lose, so the sum over bonds is the ledger's. A
// bond that breaks makes an event.
void Peridynamic::record(Body& body, const Clock& clock) {
  for (const Weaker& w : weaker_) {
    const auto part_of = [&](std::int64_t end) {
      const auto at = static_cast<std::size_t>(place_[static_cast<std::size_t>(end)]);
      return release_[at] * w.lost / share_[at];
    };
    hood_.for_bonds(w.bond, w.bond + 1,
                    [&](std::int32_t, std::int64_t i, std::int32_t p, std::int32_t) {
                      const double released = add_released(w.bond, part_of(i) + part_of(p));
                      if (w.kept > 0) return;
                      cleave_event e{};
                      e.size = sizeof(cleave_event);
                      e.step = clock.step;
                      e.time = clock.time;
                      e.first = i;
                      e.second = p;
                      for (int k = 0; k < 3; ++k)
                        e.midpoint[k] = 0.5 * (hood_.X[kVector * i + k] + hood_.X[kVector * p + k]);
                      e.criterion = severity(body, i, p);
                      e.limit = breaking_limit(i, p);
                      e.released = released;
                      body.events.push_back(e);
                    });
  }
}

void Peridynamic::precrack(Body& body, std::span<const std::int64_t> pairs) {
  std::vector<std::int32_t> bonds;
  for (std::size_t k = 0; k + 1 < pairs.size(); k += 2) {
    const std::int64_t i = std::min(pairs[k], pairs[k + 1]), p = std::max(pairs[k], pairs[k + 1]);
    const std::int32_t half = i < 0 || p >= hood_.points ? -1 : hood_.find_half(i, p);
    if (half < 0) {
      throw Error(
          CLEAVE_BAD_ARGUMENT,
          text(body.label(), ": particles ", body.number(pairs[k]), " and ",
               body.number(pairs[k + 1]), " are not bonded; a pre-crack takes the ends of bonds"));
    }
    bonds.push_back(hood_.bond_of_upper(i, half));
  }
  for (const std::int32_t bond : bonds) damage_.mark(bond, kCut);
  for (std::int64_t i = 0; i < hood_.points; ++i) rewire(i);
}

StoredEnergy Peridynamic::stored_energy(const Body& body) const {
  StoredEnergy e;
  for (std::int64_t i = 0; i < hood_.points; ++i)
    e.elastic += hood_.volume[i] * body.point.energy[i];
  return e;
}

void Peridynamic::count(const Body&, cleave_counts& counts) const {
  counts.bonds += hood_.bonds();
  counts.simplices += hood_.simplices;
  counts.broken += damage_.count(kBroken);
  counts.inert += damage_.count(kCut);
  for (std::int64_t i = 0; i < hood_.points; ++i) counts.isolated += damage_.intact_count(i) == 0;
}

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

std::int64_t Peridynamic::bytes() const {
  return hood_.bytes() + damage_.bytes() + lattice_pairs_.bytes() +
         static_cast<std::int64_t>((now_.capacity() + reference_.capacity() + left_.capacity()) *
                                   sizeof(double)) +
         static_cast<std::int64_t>(flag_.capacity() +
                                   (place_.capacity() + material_of_.capacity()) *
                                       sizeof(std::int32_t));
}

}  // namespace cleave::peridynamics
