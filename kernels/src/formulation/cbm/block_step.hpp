// The explicit step of the Continuum Bond Method in fixed blocks: a block's gradients, stresses and forces
// are formed in one go while its bonds are in a core's cache, then particles at the faces of blocks add up
// what the blocks around them gave. Blocks depend on the mesh alone, and all sums run in their order, so
// that the bits do not depend on threads.
//
// It serves what a block can do by itself: the bonds' force and the viscosity "frozen". Everything else
// goes by the rows of Network, in the order of the array calls.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "core/aligned.hpp"
#include "core/thread_team.hpp"
#include "formulation/cbm/block_kernels.hpp"
#include "formulation/cbm/block_network.hpp"
#include "formulation/cbm/block_search.hpp"
#include "formulation/cbm/fracture.hpp"
#include "formulation/common/stress_points.hpp"
#include "formulation/common/viscosity.hpp"
#include "model/resident.hpp"

namespace cleave::cbm {

class BlockStep final : public ResidentStep {
 public:
  struct Parts {
    Network& network;
    const Stabilisation& stabilisation;
    Fracture& fracture;
    StressPoints& points;
    const BondRate<std::int32_t>* viscosity;  // nullptr: none
    bool local_lengths;                       // of the viscosity: each bond's own
  };
  explicit BlockStep(const Parts& parts) : parts_(parts) {}

  // False if the mesh does not fit into blocks.
  bool setup(const Body& body, ThreadTeam& team);
  std::int64_t bytes() const;

  void prepare(Body& body, ThreadTeam& team) override;
  void start(Body& body, const Clock& clock, ThreadTeam& team) override;
  void advance(Body& body, double dt, ThreadTeam& team) override;
  void update(Body& body, const Clock& clock, ThreadTeam& team) override;
  void fetch(Body& body, std::string_view field) override;
  void changed(std::string_view field) override;
  double shortest_stretch() override;

 private:
  // What one particle of the list below is: a prescribed one.
  struct Driven {
    std::int32_t place;
    std::array<std::int32_t, 3> dof;  // into Body::prescribed; -1: free
    std::array<double, 3> a;          // acceleration at the end of the last update [m s-2]
  };
  struct BlockResult {
    PowerSums powers{};
    double plastic = 0, shock = 0;
    double square_strain = 0;  // largest |2 E|^2, if watched
    std::int64_t failed = -1;  // first local particle whose law has no answer
  };
  struct Scratch {
    AlignedReals u, x, v, X, rows, h, P, J, f, fv;
    BlockNetwork::Workspace rows_of_block;
  };
  // Groups of fields that are brought up to date together.
  enum Group { kMotion, kForces, kDeformation, kStress, kGroups };

  template <int D>
  void load(Body& body);
  template <int D>
  void load_external(const Body& body);
  void load_driven(const Body& body);
  void rebuild_all_rows();
  void rebuild_rows(const Body& body, std::span<const std::int32_t> particles);
  template <int D>
  void advance_in(Body& body, double dt);
  template <int D>
  double advance_driven(Body& body, double dt, PowerSums& powers);
  template <int D>
  void update_in(Body& body, const Clock& clock);
  template <int D>
  void start_in(Body& body, const Clock& clock);
  template <int D>
  void update_forces(Body& body, const Clock& clock, double half, bool kick);
  template <int D>
  BlockArrays arrays_of(const Block& block, Scratch& s) const;
  template <int D>
  void gather_viscous(const Block& block, Scratch& s) const;
  template <int D>
  void form_block(const Body& body, std::int32_t b, const Clock& clock, Scratch& s);
  template <int D>
  void form_forces(const Block& block, BlockArrays a, Scratch& s);
  template <int D>
  void scatter(const Block& block, const AlignedReals& from, std::vector<double>& f,
               std::vector<double>& slots) const;
  template <int D>
  void add_slots(const Block& block);
  template <int D>
  double finish_driven(const Body& body, double half, PowerSums& powers);
  MotionArrays motion();
  SearchBody search_body(const Body& body) const;
  double total(std::int64_t component) const;
  void add_power(std::int64_t component, PowerSums& powers) const;
  void book(Body& body, double dt, PowerSums powers, double reaction) const;
  void refuse_failed(Body& body);
  void fit_scratch(int dimension);

  template <int D>
  void fetch_motion(Body& body);
  template <int D>
  void fetch_forces(Body& body);
  template <int D>
  void fetch_deformation(Body& body);
  void fetch_stress(Body& body);
  // f(name) of every field of a group.
  template <class F>
  void for_fields(const Body& body, int group, const F& f);
  void make_current(Body& body, int group);
  void release_unasked(Body& body);
  ParticleState state(const Body& body);

  Parts parts_;
  const BlockKernels* kernels_ = nullptr;
  BlockNetwork net_;
  BlockSearch search_;
  ThreadTeam* team_ = nullptr;  // the model's

  bool loaded_ = false, external_loaded_ = false, rows_loaded_ = false;
  bool watch_ = false, watched_ = false;  // the strain: asked for; known of the last update
  std::array<bool, kGroups> current_{};   // the fields of the group hold the present state
  std::array<bool, kGroups> held_{};      // have memory
  std::array<bool, kGroups> asked_{};     // were asked for since the last step
  bool has_external_ = false;

  // By place.
  std::vector<double> u_, v_, f_, fv_, fe_;    // (D,n)
  std::vector<double> X_;                      // (D,n); of fracture or viscosity only
  std::vector<double> inverse_mass_, volume_;  // (n) [kg-1], [m3]
  std::vector<std::vector<double>> history_;   // of every variable: (components,n)
  std::vector<double> P_,
      energy_;                   // (9,n), (n): of laws whose stress is not a function of the state
  std::vector<char> is_driven_;  // (n)
  std::vector<Driven> driven_;
  std::vector<double> slots_, viscous_slots_;  // (D,slots)
  std::vector<BlockResult> results_;
  std::vector<VelocityBox> boxes_;
  std::vector<Scratch> scratch_;  // one a worker
};

}  // namespace cleave::cbm
