#include "formulation/cbm/fracture.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "formulation/common/bond_event.hpp"
#include "formulation/common/critical_bonds.hpp"
#include "formulation/common/stress_points.hpp"

namespace cleave::cbm {

namespace {

constexpr double kNever = std::numeric_limits<double>::infinity();
// First size of the lists of one deletion; they grow beyond it only in a step that breaks more.
constexpr std::int64_t kReserve = 65536;

// Bond strain of the pair; positions as the fields have them.
double elongation(const Network& network, const ParticleState& state, std::int32_t i,
                  std::int32_t p) {
  const auto position = [&](std::int64_t particle, int k) {
    return network.X[kVector * particle + k] + state.u[state.stride * state.place(particle) + k];
  };
  double square = 0;
  for (int k = 0; k < network.dimension; ++k) {
    const double d = position(p, k) - position(i, k);
    square += d * d;
  }
  const double length = network.length(i, p);
  return (std::sqrt(square) - length) / length;
}

ParticleState state_of_fields(const Body& body) {
  return {body.point.u, body.point.v, kVector, nullptr, body.history};
}

std::size_t at(std::int64_t k) { return static_cast<std::size_t>(k); }

// Ascending, each once.
void sort_unique(std::vector<std::int32_t>& list) {
  std::sort(list.begin(), list.end());
  list.erase(std::unique(list.begin(), list.end()), list.end());
}

// Position in an ascending list, or -1.
std::int64_t find_place(const std::vector<std::int32_t>& list, std::int32_t value) {
  const auto found = std::lower_bound(list.begin(), list.end(), value);
  return found != list.end() && *found == value ? found - list.begin() : -1;
}

// Which particles lose no bond between two of them: 1 exempt zone, 2 prescribed in every direction.
std::vector<char> protection(const Body& body) {
  std::vector<char> directions(static_cast<std::size_t>(body.particles), 0);
  for (const auto& dof : body.prescribed) {
    if (dof.direction < body.dimension()) {
      directions[static_cast<std::size_t>(dof.particle)] |= static_cast<char>(1 << dof.direction);
    }
  }
  std::vector<char> out(static_cast<std::size_t>(body.particles), 0);
  for (std::size_t i = 0; i < out.size(); ++i) {
    const bool driven = directions[i] == (1 << body.dimension()) - 1;
    const bool exempt = !body.exempt.empty() && body.exempt[i] != 0;
    out[i] = static_cast<char>((exempt ? 1 : 0) | (driven ? 2 : 0));
  }
  return out;
}

}  // namespace

void Fracture::setup(const Body& body, const Network& network) {
  const ParameterSet& options = body.group("fracture");
  active_ = options.any_given() &&
            options.choice("criterion") == static_cast<int>(Criterion::bond_strain);
  set_critical_strains(body, network);
  block_has_broken_.assign(at(block_count(body.particles)), 0);
  zeta_.assign(kVector * at(network.longest_row()), 0.0);
  if (!active_) return;
  const std::size_t reserve = at(std::min(network.bonds, kReserve));
  for (auto* list : {&broken_, &killed_, &touched_, &killers_}) list->reserve(reserve);
  for (auto* list : {&killed_volume_, &release_, &bond_release_}) list->reserve(reserve);
  cuts_.reserve(reserve);
}

// eps_crit given, or sqrt(2 G_f / (E l)).                                                [CBM 32]
void Fracture::set_critical_strains(const Body& body, const Network& network) const {
  const ParameterSet& options = body.group("fracture");
  double* critical = network.critical;
  const double given = options.real("critical_strain"), Gf = options.real("Gf"),
               length = options.real("length");
  const bool local = options.choice("length_mode") == static_cast<int>(LengthMode::local);
  if (active_ && given == 0 && Gf == 0) {
    throw Error(CLEAVE_MISSING_PARAMETER,
                text("group fracture of ", body.label(),
                     " needs critical_strain > 0, or Gf > 0 with a length"));
  }
  if (active_ && given > 0 && Gf > 0) {
    throw Error(CLEAVE_BAD_ARGUMENT,
                text("group fracture of ", body.label(), " has critical_strain = ", given,
                     " and Gf = ", Gf, "; give one of them"));
  }
  if (active_ && Gf > 0 && !local && length == 0) {
    throw Error(CLEAVE_MISSING_PARAMETER, text("group fracture of ", body.label(),
                                               " has Gf, so it needs length > 0 (the spacing of "
                                               "the refined region), or length_mode 'local'"));
  }
  const double youngs =
      with_law(body.material, [](const auto& law) { return law.youngs_modulus(); });
  if (active_ && Gf > 0 && !(youngs > 0)) {
    throw Error(CLEAVE_UNSUPPORTED,
                text("group fracture of ", body.label(), " has Gf, but law ", body.law->name,
                     " has no Young's modulus; give critical_strain"));
  }
  const std::vector<char> shield = protection(body);
  network.for_bonds(0, body.particles, [&](std::int32_t bond, std::int32_t i, std::int32_t p) {
    const bool never = !active_ || (shield[at(i)] & shield[at(p)]) != 0;
    critical[bond] = never ? kNever
                     : given > 0
                         ? given
                         : std::sqrt(2 * Gf / (youngs * (local ? network.length(i, p) : length)));
  });
}

void Fracture::find_broken(const Body& body, const Network& network, ThreadTeam& team) {
  broken_.clear();
  const auto meets = [&](std::int32_t bond, std::int32_t i, std::int32_t p) {
    const Vec<3> d = difference<3>(body.point.x, i, p);
    const double limit = (1 + network.critical[bond]) * network.lengths()[bond];
    return network.status[bond] == kIntact && dot(d, d) >= limit * limit;
  };
  for_blocks(team, body.particles, [&](std::int64_t block, std::int64_t first, std::int64_t last) {
    bool any = false;
    network.for_bonds(first, last, [&](std::int32_t bond, std::int32_t i, std::int32_t p) {
      any |= meets(bond, i, p);
    });
    block_has_broken_[at(block)] = any ? 1 : 0;
  });
  for (std::int64_t block = 0; block < block_count(body.particles); ++block) {
    if (block_has_broken_[at(block)] == 0) continue;
    network.for_bonds(block * kBlock, std::min(body.particles, (block + 1) * kBlock),
                      [&](std::int32_t bond, std::int32_t i, std::int32_t p) {
                        if (meets(bond, i, p)) broken_.push_back(bond);
                      });
  }
}

// From broken_: the simplices that go, and the particles that lose one.
void Fracture::collect(const Body& body, const Network& network) {
  const int corner_count = body.dimension() + 1;
  cuts_.clear();
  killed_.clear();
  for (std::size_t place = 0; place < broken_.size(); ++place) {
    const auto [i, p] = network.ends(broken_[place]);
    network.for_live_simplices(i, p, corner_count, [&](std::int32_t s) {
      killed_.push_back(s);
      cuts_.push_back({static_cast<std::int32_t>(place), s});
    });
  }
  sort_unique(killed_);
  killers_.assign(killed_.size(), 0);
  for (const Cut& cut : cuts_) ++killers_[at(find_place(killed_, cut.simplex))];
  touched_.clear();
  for (const std::int32_t s : killed_) {
    const std::int32_t* corners = network.corners + Network::kStride * s;
    touched_.insert(touched_.end(), corners, corners + corner_count);
  }
  sort_unique(touched_);
  release_.assign(touched_.size(), 0.0);
  killed_volume_.assign(touched_.size(), 0.0);
  bond_release_.assign(broken_.size(), 0.0);
}

// All simplices around the touched particles.
void Fracture::collect_around(const Network& network) {
  affected_.clear();
  for (const std::int32_t i : touched_) {
    const auto* around = network.incidence.simplex.data();
    affected_.insert(affected_.end(), around + network.incidence.begin[at(i)],
                     around + network.incidence.begin[at(i) + 1]);
  }
  sort_unique(affected_);
}

// Adds sign * (Omega psi - 1/2 P : sum_p dx_ip (x) zeta_ip) of every touched particle, with the
// present topology and the new positions. The first term is the stored energy; the second takes out
// what the trapezoid of the force after deletion books as work. Called with + before and - after.
// History is read, not changed.
template <int D>
void Fracture::add_release(const Body& body, const Network& network,
                           const Stabilisation& stabilisation, const Clock& clock,
                           const ParticleState& state, double sign) {
  const StressArrays arrays = stress_arrays(body, clock);
  const double share = sign * stabilisation.particle_share();
  for (std::size_t place = 0; place < touched_.size(); ++place) {
    const std::int64_t i = touched_[place], own = state.place(i);
    const double volume = network.form_row<D>(i, zeta_.data(), nullptr);
    if (!(volume > 0)) continue;
    const std::span<const std::int32_t> row = network.neighbours(i);
    const auto sum_dyads = [&](const double* w) {
      Mat<D> sum;
      for (std::size_t b = 0; b < row.size(); ++b) {
        const double *to = w + state.stride * state.place(row[b]), *from = w + state.stride * own;
        Vec<D> d;
        for (int k = 0; k < D; ++k) d[k] = to[k] - from[k];
        add_dyad(sum, d, load_vector<D>(zeta_.data(), static_cast<std::int64_t>(b)));
      }
      return sum;
    };
    Mat<D> h = sum_dyads(state.u);
    for (int r = 0; r < D; ++r)
      for (int c = 0; c < D; ++c) h(r, c) /= volume;
    const auto response =
        trial_response<D>(body.material, state.history, h, arrays.increment<D>(i), own);
    release_[place] += share * (volume * (response.energy + response.plastic + response.viscous) -
                                0.5 * clock.dt * contract(response.stress, sum_dyads(state.v)));
  }
  if (stabilisation.active()) add_simplex_release<D>(body, network, stabilisation, clock.dt, sign);
}

// The same for the energy that the stabilisation keeps on simplices, booked on touched corners.
template <int D>
void Fracture::add_simplex_release(const Body& body, const Network& network,
                                   const Stabilisation& stabilisation, double dt, double sign) {
  const GradientOperator g = network.gradient();
  const bool deviation = stabilisation.form() == StabilisationForm::deviation;
  for (const std::int32_t s : affected_) {
    if (network.alive[s] == 0) continue;
    const std::int32_t* corners = network.corners + Network::kStride * s;
    const auto geometry = simplex_geometry<D>(network.X, corners);
    Mat<D> mean, mean_rate;
    int sharers = 0;
    for (int a = 0; a <= D; ++a) {
      const Mat<D> h = row_gradient<D>(g, body.point.u, corners[a]);
      const Mat<D> rate = row_gradient<D>(g, body.point.v, corners[a]);
      const double scale = 1 / ((D + 1) * network.volume[corners[a]]);
      for (int r = 0; r < D; ++r)
        for (int c = 0; c < D; ++c) {
          mean(r, c) += scale * h(r, c);
          mean_rate(r, c) += deviation ? scale * rate(r, c) : 0.0;
        }
      sharers += find_place(touched_, corners[a]) >= 0 ? 1 : 0;
    }
    Mat<D> stress;
    Mat<D> rate = simplex_gradient(geometry, corners, body.point.v);
    const double energy = stabilisation.simplex_energy<D>(
        body, geometry.volume, simplex_gradient(geometry, corners, body.point.u), mean, &stress);
    for (int r = 0; r < D; ++r)
      for (int c = 0; c < D; ++c) rate(r, c) -= mean_rate(r, c);
    const double booked = sign * (energy - 0.5 * dt * contract(stress, rate)) / sharers;
    for (int a = 0; a <= D; ++a) {
      const std::int64_t place = find_place(touched_, corners[a]);
      if (place >= 0) release_[at(place)] += booked;
    }
  }
}

void Fracture::delete_collected(Network& network) const {
  for (const std::int32_t s : killed_) network.alive[s] = 0;
  network.rebuild(touched_);
}

// A bond whose simplices are all gone, without having met the criterion itself, is inert.
void Fracture::mark_inert(const Body& body, const Network& network) const {
  const int corner_count = body.dimension() + 1;
  for (const std::int32_t s : killed_) {
    const std::int32_t* corners = network.corners + Network::kStride * s;
    for (int a = 0; a < corner_count; ++a) {
      for (int b = 0; b < a; ++b) {
        const std::int32_t bond = network.find_bond(corners[a], corners[b]);
        bool live = false;
        network.for_live_simplices(corners[a], corners[b], corner_count,
                                   [&](std::int32_t) { live = true; });
        if (network.status[bond] == kIntact && !live) network.status[bond] = kInert;
      }
    }
  }
}

// What a particle releases goes to its killed simplices by volume, and from a simplex to the bonds
// that cut it in equal parts; so the sum over bonds is the ledger's.
void Fracture::share_release(const Body& body, const Network& network) {
  const int corner_count = body.dimension() + 1;
  const auto volume_of = [&](std::int32_t s) {
    const std::int32_t* corners = network.corners + Network::kStride * s;
    return corner_count == 3 ? simplex_volume<2>(network.X, corners)
                             : simplex_volume<3>(network.X, corners);
  };
  const auto place_of = [&](std::int32_t s, int corner) {
    return at(find_place(touched_, network.corners[Network::kStride * s + corner]));
  };
  for (const std::int32_t s : killed_) {
    for (int a = 0; a < corner_count; ++a) killed_volume_[place_of(s, a)] += volume_of(s);
  }
  for (const Cut& cut : cuts_) {
    const std::int32_t s = cut.simplex;
    double sum = 0;
    for (int a = 0; a < corner_count; ++a) {
      const std::size_t place = place_of(s, a);
      sum += release_[place] * (volume_of(s) / killed_volume_[place]);
    }
    bond_release_[at(cut.bond)] += sum / killers_[at(find_place(killed_, s))];
  }
}

void Fracture::record_events(Body& body, const Network& network, const Clock& clock,
                             const ParticleState& state) const {
  for (std::size_t place = 0; place < broken_.size(); ++place) {
    const std::int32_t bond = broken_[place];
    const auto [i, p] = network.ends(bond);
    cleave_event e = bond_event(body, clock, i, p);
    e.criterion = elongation(network, state, i, p);
    e.limit = network.critical[bond];
    e.released = bond_release_[place];
    body.events.push_back(e);
  }
}

template <int D>
void Fracture::break_bonds(Body& body, Network& network, const Stabilisation& stabilisation,
                           const Clock& clock, const ParticleState& state) {
  collect(body, network);
  if (stabilisation.active()) collect_around(network);
  add_release<D>(body, network, stabilisation, clock, state, +1);
  delete_collected(network);
  add_release<D>(body, network, stabilisation, clock, state, -1);
  for (const std::int32_t bond : broken_) network.status[bond] = kBroken;
  mark_inert(body, network);
  for (const double e : release_) body.point.ledger[ledger::kFracture] += e;
  share_release(body, network);
  record_events(body, network, clock, state);
}

std::span<const std::int32_t> Fracture::step(Body& body, Network& network,
                                             const Stabilisation& stabilisation, const Clock& clock,
                                             std::span<const std::int32_t> broken,
                                             const ParticleState& state) {
  if (broken.empty()) return {};
  if (broken.data() != broken_.data()) broken_.assign(broken.begin(), broken.end());
  body.dimension() == 2 ? break_bonds<2>(body, network, stabilisation, clock, state)
                        : break_bonds<3>(body, network, stabilisation, clock, state);
  return touched_;
}

void Fracture::step(Body& body, Network& network, const Stabilisation& stabilisation,
                    const Clock& clock, ThreadTeam& team) {
  if (!active_) return;
  find_broken(body, network, team);
  step(body, network, stabilisation, clock, broken_, state_of_fields(body));
}

void Fracture::step_some(Body& body, Network& network, const Stabilisation& stabilisation,
                         const Clock& clock, ThreadTeam& team, Breaking which) {
  if (!active_) return;
  find_broken(body, network, team);
  if (broken_.empty()) return;
  const ParticleState state = state_of_fields(body);
  std::vector<CriticalBond> found;
  for (const std::int32_t bond : broken_) {
    const auto [i, p] = network.ends(bond);
    found.push_back({bond, elongation(network, state, i, p) / network.critical[bond]});
  }
  keep_most_critical(found, which);
  broken_.clear();
  for (const CriticalBond& chosen : found) broken_.push_back(chosen.bond);
  step(body, network, stabilisation, clock, broken_, state);
}

void Fracture::precrack(Body& body, Network& network, std::span<const std::int64_t> pairs) {
  broken_.clear();
  for (std::size_t k = 0; k + 1 < pairs.size(); k += 2) {
    const std::int32_t bond = network.find_bond(pairs[k], pairs[k + 1]);
    if (bond < 0) {
      throw Error(
          CLEAVE_BAD_ARGUMENT,
          text(body.label(), ": particles ", body.number(pairs[k]), " and ",
               body.number(pairs[k + 1]), " are not bonded; a pre-crack takes the ends of bonds"));
    }
    broken_.push_back(bond);
  }
  collect(body, network);
  delete_collected(network);
  for (const std::int32_t bond : broken_) network.status[bond] = kInert;
  mark_inert(body, network);
}

}  // namespace cleave::cbm
