// Breaking of bonds: the criterion, the deletion of simplices, the energy it releases, the events.
//
// One snapshot of positions decides: first all bonds that meet the criterion are collected, then
// their simplices are deleted, then the rows of the particles touched are rebuilt.      [CBM 20]
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/thread_team.hpp"
#include "formulation/cbm/network.hpp"
#include "formulation/cbm/stabilisation.hpp"

namespace cleave::cbm {

// Where displacement, velocity and history of a particle stand.
struct ParticleState {
  const double *u, *v;  // component k of particle i at stride * place(i) + k [m], [m s-1]
  std::int64_t stride;
  const std::int32_t* places;  // nullptr: the place is the number
  HistoryArrays history;       // by place

  std::int64_t place(std::int64_t i) const { return places == nullptr ? i : places[i]; }
};

class Fracture {
 public:
  bool active() const { return active_; }
  // Options and critical strains. Bonds with both ends exempt, or both prescribed in every
  // direction, never break.
  void setup(const Body& body, const Network& network);
  void step(Body& body, Network& network, const Stabilisation& stabilisation, const Clock& clock,
            ThreadTeam& team);
  // The same for those of the bonds with the largest elongations over their limits.
  void step_some(Body& body, Network& network, const Stabilisation& stabilisation,
                 const Clock& clock, ThreadTeam& team, Breaking which);
  // The same for bonds found elsewhere, ascending. Returns the particles that lost a simplex, ascending;
  // valid until the next call.
  std::span<const std::int32_t> step(Body& body, Network& network,
                                     const Stabilisation& stabilisation, const Clock& clock,
                                     std::span<const std::int32_t> broken,
                                     const ParticleState& state);
  // Deletes the simplices of the bonds without criterion, energy or event.
  void precrack(Body& body, Network& network, std::span<const std::int64_t> pairs);

 private:
  void set_critical_strains(const Body& body, const Network& network) const;
  void find_broken(const Body& body, const Network& network, ThreadTeam& team);
  void collect(const Body& body, const Network& network);
  void collect_around(const Network& network);
  template <int D>
  void add_release(const Body& body, const Network& network, const Stabilisation& stabilisation,
                   const Clock& clock, const ParticleState& state, double sign);
  template <int D>
  void add_simplex_release(const Body& body, const Network& network,
                           const Stabilisation& stabilisation, double dt, double sign);
  void delete_collected(Network& network) const;
  void mark_inert(const Body& body, const Network& network) const;
  template <int D>
  void break_bonds(Body& body, Network& network, const Stabilisation& stabilisation,
                   const Clock& clock, const ParticleState& state);
  void share_release(const Body& body, const Network& network);
  void record_events(Body& body, const Network& network, const Clock& clock,
                     const ParticleState& state) const;

  bool active_ = false;
  std::vector<char> block_has_broken_;  // per block of particles: a bond of theirs

  // One deletion. Lists of bonds, simplices, particles, simplices are ascending; places are positions in
  // them.
  struct Cut {
    std::int32_t bond, simplex;  // place in broken_; simplex
  };
  std::vector<std::int32_t> broken_, killed_, touched_, affected_;
  std::vector<Cut> cuts_;
  std::vector<std::int32_t> killers_;  // per killed simplex: bonds that cut it
  std::vector<double> killed_volume_;  // per touched particle: volume of its killed simplices
  std::vector<double> release_;        // per touched particle [J]
  std::vector<double> bond_release_;   // per broken bond [J]
  std::vector<double> zeta_;           // (3, longest row)
};

}  // namespace cleave::cbm
