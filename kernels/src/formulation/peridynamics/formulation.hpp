// What all peridynamic formulations have in common: points with a neighbourhood, bonds that break by
// stretch, the release of their energy, and what is shown of them. How points interact is left to the
// formulations themselves.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "core/aligned.hpp"
#include "core/blocks.hpp"
#include "core/thread_team.hpp"
#include "formulation/peridynamics/constants.hpp"
#include "formulation/peridynamics/damage.hpp"
#include "formulation/peridynamics/lattice.hpp"
#include "formulation/peridynamics/lattice_pairs.hpp"
#include "formulation/peridynamics/neighbourhood.hpp"
#include "formulation/peridynamics/pair_kernels.hpp"

namespace cleave::peridynamics {

// Energy of the interactions that a point counts as its own [J], and its rate with the velocities [W].
struct PointEnergy {
  double energy = 0, rate = 0;
};

// Copies vectors to the first three of four numbers each; whether a bit changed.
bool take_rows(const double* from, std::int64_t count, double* to);

class Peridynamic : public Formulation {
 public:
  bool takes_volumes() const override { return true; }
  bool takes_regions() const override { return true; }
  void setup(Body& body, ThreadTeam& team) override;
  void rebuild(Body& body, ThreadTeam& team) override;
  double stable_step(const Body&) const override { return stable_step_; }
  std::string static_obstacle(const Body&) const override;

  // The bound of the stable step for every point that has a bond left; with several materials, each point's own.
  void stiffness_bound(const Body& body, ThreadTeam& team, std::span<double> bound) override;

  bool break_bonds(Body& body, const Clock& clock, ThreadTeam& team) override;
  bool break_most_critical(Body& body, const Clock& clock, ThreadTeam& team,
                           Breaking which) override;
  void find_critical(Body& body, ThreadTeam& team, std::vector<CriticalBond>& found) override;
  double critical_ratio(const Body& body, std::int32_t bond) const override;
  void deform(Body& body, const Clock& clock, ThreadTeam& team) override;
  void forces(Body& body, ThreadTeam& team) override;
  void precrack(Body& body, std::span<const std::int64_t> pairs) override;

  StoredEnergy stored_energy(const Body& body) const override;
  double hourglass_energy(const Body&) const override { return 0; }
  void count(const Body& body, cleave_counts& counts) const override;
  bool derive(const Body& body, std::string_view field, std::int64_t first, std::int64_t last,
              double* values) const override;
  bool derive_integers(const Body& body, std::string_view field, std::int64_t first,
                       std::int64_t last, std::int64_t* values) const override;
  void observe(Body& body, std::string_view field) override;
  std::int64_t bytes() const override;

 protected:
  // What bonds reach [m]; before that, volumes of particles where the formulation says them.
  virtual double lay_out(Body& body);
  // Limit of the severity of bonds of each material; infinite: they do not break.
  virtual std::vector<double> limits(const Body& body);
  // Constants and weights, after the neighbourhood is known. Sets the interactions besides bonds.
  virtual void prepare(Body& body) = 0;
  // Bounds of the row sums of M^-1 K for each point, the largest of which is above its eigenvalues [s-2].
  virtual void find_rates(const Body& body, std::span<double> rates) const = 0;
  // Scratch for so many workers at the same time.
  virtual void expect_workers(int) {}
  // Other bonds of point i carry than before.
  virtual void reconnect(std::int64_t) {}
  // 1: the point has a bond to a higher neighbour that may be beyond its limit. Called before severity.
  virtual void flag_points(Body& body, ThreadTeam& team, std::vector<char>& flag);
  // What is compared with the limit of a bond: its stretch.
  virtual double severity(const Body& body, std::int64_t i, std::int64_t p) const;
  // Of the severity to the limit, made to grow in proportion to the loads.
  virtual double ratio(double severity, double limit) const { return severity / limit; }
  // A bond broke by its limit or with a loose end.
  virtual void broke(std::int32_t) {}
  // Share of its stiffness that an intact bond has, and that it keeps beyond the limit; 0: it breaks.
  virtual double integrity(std::int32_t) const { return 1; }
  virtual double kept_integrity(double) const { return 0; }
  virtual void weaken(std::int32_t, double) {}
  // Severity at which the bond is broken.
  virtual double breaking_limit(std::int64_t i, std::int64_t p) const {
    return damage_.limit(i, p);
  }
  // A bond releases energy [J]; returns all that it has released.
  virtual double add_released(std::int32_t, double energy) { return energy; }
  // Sets the internal force of all points and their energy per volume.
  virtual void act(Body& body, ThreadTeam& team) = 0;
  // worker: tells apart who asks at the same time.
  virtual PointEnergy point_energy(const Body& body, std::int64_t i, int worker) const = 0;
  // P of the own interactions of a point, D x D components; what follows from a plane condition is added
  // by the caller.                                                                    [PD stress]
  virtual Mat<3> point_stress(const Body& body, std::int64_t i, int worker) const = 0;
  // The same for points first to last, where several at a time are faster.
  virtual void point_stresses(const Body& body, std::int64_t first, std::int64_t last, int worker,
                              Mat<3>* stress) const {
    for (std::int64_t i = first; i < last; ++i) stress[i - first] = point_stress(body, i, worker);
  }

  // Of forces between two points, from left_ and the fourth of now_; alpha (n) outlives this. To be said in
  // `prepare`.
  void weigh_pairs(PairForm form, const double* alpha = nullptr) {
    pair_form_ = form;
    alpha_of_pairs_ = alpha;
  }
  // After that: sets the internal force and the energy per volume from these, on a lattice for eight points at a
  // time, unless stencil forbids it.
  void act_by_pairs(Body& body, ThreadTeam& team);
  // Whether the positions in now_ are others than when this was asked before.
  bool take_moved();
  PairArrays pair_arrays(Body& body) const;
  const PairKernels& kernels() const;
  // 2 sum_j w_ij / L_ij / m_i; weight(i, p)
  template <class W>
  void pair_rates(const Body& body, const W& weight, std::span<double> rates) const {
    for (std::int64_t i = 0; i < hood_.points; ++i) {
      double sum = 0;
      for (auto b = hood_.first(i); b < hood_.last(i); ++b) {
        const std::int32_t p = hood_.neighbour(b);
        sum += weight(i, p) / hood_.length(i, p);
      }
      rates[static_cast<std::size_t>(i)] = 2 * sum / body.point.mass[i];
    }
  }
  // f(neighbour, half) for the bonds of i that carry.
  template <class F>
  void for_carrying(std::int64_t i, const F& f) const {
    for (auto b = hood_.first(i); b < hood_.last(i); ++b)
      if (damage_.intact(b)) f(hood_.neighbour(b), b);
  }

  Neighbourhood hood_;
  Damage damage_;
  std::vector<Elastic> materials_;         // of the body, then of its regions
  std::vector<std::int32_t> material_of_;  // (n) place in materials_
  const Elastic& elastic(std::int64_t i) const {
    return materials_[static_cast<std::size_t>(material_of_[static_cast<std::size_t>(i)])];
  }
  // Breaks bonds as if they had failed, and sets touched_.
  void break_these(Body& body, const Clock& clock, ThreadTeam& team,
                   std::span<const std::int32_t> bonds);
  std::vector<std::int32_t> touched_;  // ends of the bonds that broke or weakened last, each once
  Reach reach() const { return {dimension_, hood_.horizon, hood_.section}; }
  int dimension_ = 3;  // 1: a bar
  bool use_lattice_ = true;
  AlignedReals now_, reference_;  // (4,n) x y z right; X Y Z volume
  std::vector<double> left_;      // (n) weights of the pair kernels
  double* interactions_ = nullptr;

 private:
  void share_stencil(const Body& body);
  // Other bonds of points carry than before.
  void rewire(std::int64_t i);
  void refuse_groups(const Body& body) const;
  void take_positions(const Body& body, ThreadTeam& team);
  struct Weaker {  // a bond that carries less from now on
    std::int32_t bond;
    double kept, lost;  // integrity
  };
  void find_weaker(Body& body, ThreadTeam& team);
  void touch_ends();
  void weaken_found(Body& body, const Clock& clock, ThreadTeam& team);
  void release(Body& body, const Clock& clock, ThreadTeam& team, double sign);
  void record(Body& body, const Clock& clock);
  Mat<3> fitted_gradient(const Body& body, std::int64_t i) const;

  std::optional<PairForm> pair_form_;
  const double* alpha_of_pairs_ = nullptr;
  LatticePairs lattice_pairs_;  // active: instead of the kernels for any cloud
  double stable_step_ = 0;
  std::vector<char> moved_;    // by block of points: now_ has changed
  std::vector<double> rates_;  // (n) several materials, else of the stiffest point alone
  std::vector<char> flag_;     // (n) a bond may be beyond its limit
  std::vector<CriticalBond> critical_;
  std::vector<Weaker> weaker_;       // bonds of the step being done
  std::vector<std::int32_t> place_;  // (n) in touched_, or -1
  std::vector<double> share_;        // what the bonds of a touched point lose of their integrity
  std::vector<double> release_;      // of a touched point
  ThreadTeam* team_ = nullptr;       // of the model, for what is asked between steps
  bool gradient_observed_ = false, stress_observed_ = false;
};

}  // namespace cleave::peridynamics
