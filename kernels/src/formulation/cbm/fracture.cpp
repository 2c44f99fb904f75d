#include "formulation/cbm/fracture.hpp"

#include <cmath>
#include <limits>

#include "formulation/common/stress_points.hpp"

namespace cleave::cbm {

namespace {

constexpr double kNever = std::numeric_limits<double>::infinity();
// First size of the lists of one deletion; they grow beyond it only in a step that breaks more.
constexpr std::int64_t kReserve = 65536;

double elongation(const Body& body, const Network& network, std::int32_t bond) {
  const Vec<3> d = difference<3>(body.point.x, network.ends[2 * bond], network.ends[2 * bond + 1]);
  return (std::sqrt(dot(d, d)) - network.length[bond]) / network.length[bond];
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
  block_has_broken_.assign(static_cast<std::size_t>(block_count(network.bonds)), 0);
  killed_place_.assign(static_cast<std::size_t>(network.simplices), -1);
  affected_mark_.assign(static_cast<std::size_t>(network.simplices), 0);
  touched_place_.assign(static_cast<std::size_t>(body.particles), -1);
  if (!active_) return;
  for (auto* list : {&broken_, &killed_, &touched_, &affected_, &killers_}) {
    list->reserve(static_cast<std::size_t>(std::min(network.bonds, kReserve)));
  }
  for (auto* list : {&killed_volume_, &release_, &bond_release_}) {
    list->reserve(static_cast<std::size_t>(std::min(network.bonds, kReserve)));
  }
  cuts_.reserve(static_cast<std::size_t>(std::min(network.bonds, kReserve)));
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
  for (std::int64_t b = 0; b < network.bonds; ++b) {
    const char common = shield[static_cast<std::size_t>(network.ends[2 * b])] &
                        shield[static_cast<std::size_t>(network.ends[2 * b + 1])];
    if (!active_ || common != 0) {
      critical[b] = kNever;
    } else {
      critical[b] =
          given > 0 ? given : std::sqrt(2 * Gf / (youngs * (local ? network.length[b] : length)));
    }
  }
}

bool Fracture::find_broken(const Body& body, const Network& network, ThreadTeam& team) {
  const double* critical = network.critical;
  for_blocks(team, network.bonds, [&](std::int64_t block, std::int64_t first, std::int64_t last) {
    bool any = false;
    for (std::int64_t b = first; b < last; ++b) {
      const Vec<3> d = difference<3>(body.point.x, network.ends[2 * b], network.ends[2 * b + 1]);
      const double limit = (1 + critical[b]) * network.length[b];
      any |= network.status[b] == kIntact && dot(d, d) >= limit * limit;
    }
    block_has_broken_[static_cast<std::size_t>(block)] = any ? 1 : 0;
  });
  for (std::int64_t block = 0; block < block_count(network.bonds); ++block) {
    if (block_has_broken_[static_cast<std::size_t>(block)] == 0) continue;
    for (std::int64_t b = block * kBlock; b < std::min(network.bonds, (block + 1) * kBlock); ++b) {
      const Vec<3> d = difference<3>(body.point.x, network.ends[2 * b], network.ends[2 * b + 1]);
      const double limit = (1 + critical[b]) * network.length[b];
      if (network.status[b] == kIntact && dot(d, d) >= limit * limit)
        broken_.push_back(static_cast<std::int32_t>(b));
    }
  }
  return !broken_.empty();
}

// From broken_: the simplices that go, the particles that lose one, and all simplices around those.
void Fracture::collect(const Body& body, const Network& network) {
  const int corner_count = body.dimension() + 1;
  for (std::size_t place = 0; place < broken_.size(); ++place) {
    network.for_live_simplices(broken_[place], corner_count, [&](std::int32_t s) {
      std::int32_t& at = killed_place_[static_cast<std::size_t>(s)];
      if (at < 0) {
        at = static_cast<std::int32_t>(killed_.size());
        killed_.push_back(s);
        killers_.push_back(0);
      }
      ++killers_[static_cast<std::size_t>(at)];
      cuts_.push_back({static_cast<std::int32_t>(place), at});
    });
  }
  for (const std::int32_t s : killed_) {
    for (int a = 0; a < corner_count; ++a) {
      const std::int32_t i = network.corners[Network::kStride * s + a];
      std::int32_t& at = touched_place_[static_cast<std::size_t>(i)];
      if (at >= 0) continue;
      at = static_cast<std::int32_t>(touched_.size());
      touched_.push_back(i);
      for (auto k = network.incidence.begin[static_cast<std::size_t>(i)];
           k < network.incidence.begin[static_cast<std::size_t>(i) + 1]; ++k) {
        const std::int32_t around = network.incidence.simplex[static_cast<std::size_t>(k)];
        if (affected_mark_[static_cast<std::size_t>(around)] != 0) continue;
        affected_mark_[static_cast<std::size_t>(around)] = 1;
        affected_.push_back(around);
      }
    }
  }
  release_.assign(touched_.size(), 0.0);
  killed_volume_.assign(touched_.size(), 0.0);
  bond_release_.assign(broken_.size(), 0.0);
}

// Adds sign * (Omega psi - 1/2 P : sum_p dx_ip (x) zeta_ip) of every touched particle, with the
// present topology and the new positions. The first term is the stored energy; the second takes out
// what the trapezoid of the force after deletion books as work. Called with + before and - after.
// History is read, not changed.
template <int D>
void Fracture::add_release(const Body& body, const Network& network,
                           const Stabilisation& stabilisation, const Clock& clock, double sign) {
  const GradientOperator g = network.gradient();
  const StressArrays arrays = stress_arrays(body, clock);
  const double share = sign * stabilisation.particle_share();
  for (std::size_t place = 0; place < touched_.size(); ++place) {
    const std::int64_t i = touched_[place];
    const double volume = network.volume[i];
    if (!(volume > 0)) continue;
    Mat<D> h = row_gradient<D>(g, body.point.u, i);
    for (int r = 0; r < D; ++r)
      for (int c = 0; c < D; ++c) h(r, c) /= volume;
    const auto response =
        trial_response<D>(body.material, body.history, h, arrays.increment<D>(i), i);
    release_[place] +=
        share * (volume * (response.energy + response.plastic + response.viscous) -
                 0.5 * clock.dt * contract(response.stress, row_gradient<D>(g, body.point.v, i)));
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
      sharers += touched_place_[static_cast<std::size_t>(corners[a])] >= 0 ? 1 : 0;
    }
    Mat<D> stress;
    Mat<D> rate = simplex_gradient(geometry, corners, body.point.v);
    const double energy = stabilisation.simplex_energy<D>(
        body, geometry.volume, simplex_gradient(geometry, corners, body.point.u), mean, &stress);
    for (int r = 0; r < D; ++r)
      for (int c = 0; c < D; ++c) rate(r, c) -= mean_rate(r, c);
    const double booked = sign * (energy - 0.5 * dt * contract(stress, rate)) / sharers;
    for (int a = 0; a <= D; ++a) {
      const std::int32_t place = touched_place_[static_cast<std::size_t>(corners[a])];
      if (place >= 0) release_[static_cast<std::size_t>(place)] += booked;
    }
  }
}

template <int D>
void Fracture::delete_collected(Network& network) const {
  for (const std::int32_t s : killed_) network.alive[s] = 0;
  for (const std::int32_t i : touched_) network.rebuild_row_of<D>(i);
}

// A bond whose simplices are all gone, without having met the criterion itself, is inert.
void Fracture::mark_inert(const Body& body, const Network& network) const {
  const int corner_count = body.dimension() + 1;
  for (const std::int32_t s : killed_) {
    const std::int32_t* corners = network.corners + Network::kStride * s;
    for (int a = 0; a < corner_count; ++a) {
      for (int b = 0; b < a; ++b) {
        const std::int32_t bond = network.find_bond(corners[a], corners[b]);
        if (network.status[bond] == kIntact && !network.on_live_simplex(bond, corner_count)) {
          network.status[bond] = kInert;
        }
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
    return corner_count == 3 ? simplex_geometry<2>(network.X, corners).volume
                             : simplex_geometry<3>(network.X, corners).volume;
  };
  const auto place_of = [&](std::int32_t s, int corner) {
    return static_cast<std::size_t>(
        touched_place_[static_cast<std::size_t>(network.corners[Network::kStride * s + corner])]);
  };
  for (const std::int32_t s : killed_) {
    for (int a = 0; a < corner_count; ++a) killed_volume_[place_of(s, a)] += volume_of(s);
  }
  for (const Cut& cut : cuts_) {
    const std::int32_t s = killed_[static_cast<std::size_t>(cut.simplex)];
    double sum = 0;
    for (int a = 0; a < corner_count; ++a) {
      const std::size_t place = place_of(s, a);
      sum += release_[place] * (volume_of(s) / killed_volume_[place]);
    }
    bond_release_[static_cast<std::size_t>(cut.bond)] +=
        sum / killers_[static_cast<std::size_t>(cut.simplex)];
  }
}

void Fracture::record_events(Body& body, const Network& network, const Clock& clock) const {
  for (std::size_t place = 0; place < broken_.size(); ++place) {
    const std::int32_t bond = broken_[place];
    const std::int32_t i = network.ends[2 * bond], p = network.ends[2 * bond + 1];
    cleave_event e{};
    e.size = sizeof(cleave_event);
    e.step = clock.step;
    e.time = clock.time;
    e.first = i;
    e.second = p;
    for (int k = 0; k < 3; ++k) {
      e.midpoint[k] = 0.5 * (network.X[kVector * i + k] + network.X[kVector * p + k]);
    }
    e.criterion = elongation(body, network, bond);
    e.limit = network.critical[bond];
    e.released = bond_release_[place];
    body.events.push_back(e);
  }
}

void Fracture::reset() {
  for (const std::int32_t s : killed_) killed_place_[static_cast<std::size_t>(s)] = -1;
  for (const std::int32_t s : affected_) affected_mark_[static_cast<std::size_t>(s)] = 0;
  for (const std::int32_t i : touched_) touched_place_[static_cast<std::size_t>(i)] = -1;
  for (auto* list : {&broken_, &killed_, &touched_, &affected_, &killers_}) list->clear();
  cuts_.clear();
}

template <int D>
void Fracture::break_bonds(Body& body, Network& network, const Stabilisation& stabilisation,
                           const Clock& clock, StateKeeper* keeper) {
  collect(body, network);
  if (keeper != nullptr) keeper->bring(body, touched_);
  add_release<D>(body, network, stabilisation, clock, +1);
  delete_collected<D>(network);
  add_release<D>(body, network, stabilisation, clock, -1);
  for (const std::int32_t bond : broken_) network.status[bond] = kBroken;
  mark_inert(body, network);
  for (const double e : release_) body.point.ledger[ledger::kFracture] += e;
  share_release(body, network);
  record_events(body, network, clock);
  if (keeper != nullptr) keeper->rebuilt(body, touched_);
  reset();
}

void Fracture::step(Body& body, Network& network, const Stabilisation& stabilisation,
                    const Clock& clock, ThreadTeam& team) {
  if (!active_ || !find_broken(body, network, team)) return;
  body.dimension() == 2 ? break_bonds<2>(body, network, stabilisation, clock, nullptr)
                        : break_bonds<3>(body, network, stabilisation, clock, nullptr);
}

void Fracture::step(Body& body, Network& network, const Stabilisation& stabilisation,
                    const Clock& clock, std::span<const std::int32_t> broken, StateKeeper& keeper) {
  if (broken.empty()) return;
  broken_.assign(broken.begin(), broken.end());
  body.dimension() == 2 ? break_bonds<2>(body, network, stabilisation, clock, &keeper)
                        : break_bonds<3>(body, network, stabilisation, clock, &keeper);
}

void Fracture::precrack(Body& body, Network& network, std::span<const std::int64_t> pairs) {
  for (std::size_t k = 0; k + 1 < pairs.size(); k += 2) {
    const std::int32_t bond = network.find_bond(pairs[k], pairs[k + 1]);
    if (bond < 0) {
      reset();  // a refused list changes nothing
      throw Error(
          CLEAVE_BAD_ARGUMENT,
          text(body.label(), ": particles ", body.number(pairs[k]), " and ",
               body.number(pairs[k + 1]), " are not bonded; a pre-crack takes the ends of bonds"));
    }
    broken_.push_back(bond);
  }
  collect(body, network);
  if (body.dimension() == 2) {
    delete_collected<2>(network);
  } else {
    delete_collected<3>(network);
  }
  for (const std::int32_t bond : broken_) network.status[bond] = kInert;
  mark_inert(body, network);
  reset();
}

}  // namespace cleave::cbm
