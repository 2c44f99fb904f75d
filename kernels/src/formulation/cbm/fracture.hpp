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

// Who keeps the state of the particles elsewhere: is told before the fields of particles and their
// neighbours are read, and after their rows were rebuilt.
class StateKeeper {
 public:
  virtual ~StateKeeper() = default;
  virtual void bring(Body& body, std::span<const std::int32_t> particles) = 0;
  virtual void rebuilt(Body& body, std::span<const std::int32_t> particles) = 0;
};

class Fracture {
 public:
  bool active() const { return active_; }
  // Options and critical strains. Bonds with both ends exempt, or both prescribed in every
  // direction, never break.
  void setup(const Body& body, const Network& network);
  void step(Body& body, Network& network, const Stabilisation& stabilisation, const Clock& clock,
            ThreadTeam& team);
  // The same for bonds found elsewhere, ascending, with the state in `keeper`.
  void step(Body& body, Network& network, const Stabilisation& stabilisation, const Clock& clock,
            std::span<const std::int32_t> broken, StateKeeper& keeper);
  // Deletes the simplices of the bonds without criterion, energy or event.
  void precrack(Body& body, Network& network, std::span<const std::int64_t> pairs);

 private:
  void set_critical_strains(const Body& body, const Network& network) const;
  bool find_broken(const Body& body, const Network& network, ThreadTeam& team);
  void collect(const Body& body, const Network& network);
  template <int D>
  void add_release(const Body& body, const Network& network, const Stabilisation& stabilisation,
                   const Clock& clock, double sign);
  template <int D>
  void add_simplex_release(const Body& body, const Network& network,
                           const Stabilisation& stabilisation, double dt, double sign);
  template <int D>
  void delete_collected(Network& network) const;
  void mark_inert(const Body& body, const Network& network) const;
  template <int D>
  void break_bonds(Body& body, Network& network, const Stabilisation& stabilisation,
                   const Clock& clock, StateKeeper* keeper);
  void share_release(const Body& body, const Network& network);
  void record_events(Body& body, const Network& network, const Clock& clock) const;
  void reset();

  bool active_ = false;
  std::vector<char> block_has_broken_;  // per block of bonds

  // One deletion. Places are positions in the lists, -1 outside of a deletion.
  struct Cut {
    std::int32_t bond, simplex;  // places in broken_, killed_
  };
  std::vector<std::int32_t> broken_, killed_, touched_,
      affected_;  // bonds, simplices, particles, simplices
  std::vector<Cut> cuts_;
  std::vector<std::int32_t> killers_;        // per killed simplex: bonds that cut it
  std::vector<double> killed_volume_;        // per touched particle: volume of its killed simplices
  std::vector<double> release_;              // per touched particle [J]
  std::vector<double> bond_release_;         // per broken bond [J]
  std::vector<std::int32_t> killed_place_;   // (m)
  std::vector<std::int32_t> touched_place_;  // (n)
  std::vector<char> affected_mark_;          // (m)
};

}  // namespace cleave::cbm
