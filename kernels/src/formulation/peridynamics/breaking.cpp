// Bonds that break or weaken: which of them, the energy of their ends before and after, and the events.
#include <algorithm>
#include <vector>

#include "formulation/common/bond_event.hpp"
#include "formulation/common/critical_bonds.hpp"
#include "formulation/peridynamics/formulation.hpp"

namespace cleave::peridynamics {

namespace {

// A bond is left as it is while it would lose less than this share of its integrity: in statics, equilibrium
// is not sought again for less.                                                     [VCPM softening]
constexpr double kLeastLoss = 1e-4;

}  // namespace

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
                      cleave_event e = bond_event(body, clock, i, p);
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

}  // namespace cleave::peridynamics
