// What a formulation does for a body. Called a few times a step, never inside a loop over
// particles.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "cleave/cleave.h"
#include "core/gradient_operator.hpp"
#include "core/thread_team.hpp"

namespace cleave {

struct Body;
class ResidentStep;
class StiffnessSource;

// The step being done: number (1 = first), time at its end, size.
struct Clock {
  std::int64_t step = 0;
  double time = 0;
  double dt = 0;
};

struct StoredEnergy {
  double elastic = 0, stabilisation = 0;
};

inline constexpr std::int64_t kPointsAreParticles = -1;

// Which of the bonds break that fail in an equilibrium.
enum class Breaking {
  all,
  one,  // the one furthest beyond its limit, the first of those within 1e-9
  ties  // that one, and those as far beyond within 1e-9
};

// A bond that is beyond its limit, and how far: 1 at the limit, in proportion to the loads.
struct CriticalBond {
  std::int32_t bond;
  double ratio;
};

class Formulation {
 public:
  virtual ~Formulation() = default;
  virtual const char* name() const = 0;  // as in the formulations table

  // Number of points where the stress is evaluated, before fields are allocated;
  // kPointsAreParticles: the particles themselves.
  virtual std::int64_t integration_points(const Body&) const { return kPointsAreParticles; }
  // Whether volumes of particles may be given instead of simplices.
  virtual bool takes_volumes() const { return false; }
  // Whether particles may have another material than the body.
  virtual bool takes_regions() const { return false; }
  // Checks the options, allocates the formulation's fields and fills those of lifetime setup.
  virtual void setup(Body& body, ThreadTeam& team) = 0;
  // All caches from setup and state fields, and whatever the formulation keeps outside fields.
  virtual void rebuild(Body& body, ThreadTeam& team) = 0;
  // Largest stable step of the undeformed body with its safety [s].
  virtual double stable_step(const Body& body) const = 0;
  // The gradient operator of a formulation with a stress at points, else nullptr. Valid until bonds
  // break or the body is rebuilt.
  virtual const GradientOperator* gradient_operator(ThreadTeam&) { return nullptr; }
  virtual bool has_gradient_operator() const { return false; }

  // The explicit step of a formulation that keeps the state in an order of its own; nullptr: the step goes
  // by the functions below, on the fields.
  virtual ResidentStep* resident() { return nullptr; }

  // The stiffness of a formulation that has no gradient operator but can give one; else nullptr.
  virtual const StiffnessSource* stiffness() const { return nullptr; }
  // What the static solver would miss, as a sentence; empty: nothing.
  virtual std::string static_obstacle(const Body&) const { return {}; }

  // For dynamic relaxation. A bound S of the tangent stiffness K of the body as it is connected now, but
  // undeformed: sum over j of |K_ij| <= S_i, or at least no eigenvalue of S^-1 K above 1. (3,n) [N/m]; zero
  // for a degree of freedom that nothing resists. Here: S = m (2/dt)^2 with the stable step dt, which is
  // below 2/omega_max.
  virtual void stiffness_bound(const Body& body, ThreadTeam& team, std::span<double> bound);
  // What dynamic relaxation would miss, as a sentence; empty: nothing.
  virtual std::string relaxation_obstacle(const Body&) const { return {}; }
  // What breaking one bond at a time would miss, as a sentence; empty: nothing.
  virtual std::string one_bond_obstacle(const Body&) const { return {}; }
  // As break_bonds, for the bond that is furthest beyond its limit and the ties. False: this formulation breaks
  // bonds and cannot choose among them.
  virtual bool break_most_critical(Body&, const Clock&, ThreadTeam&, Breaking) { return false; }
  // Bonds beyond their limits at the present positions, in their order; and the ratio of one of them.
  virtual void find_critical(Body&, ThreadTeam&, std::vector<CriticalBond>& found) {
    found.clear();
  }
  virtual double critical_ratio(const Body&, std::int32_t) const { return 0; }
  // Breaks all bonds of particles that fewer independent bonds hold than there are directions, until there are
  // none: a matrix with them would be singular.
  virtual void release_loose(Body&, const Clock&, ThreadTeam&) {}

  // The parts of a step, in this order. Whether bonds broke or carry less than before.
  virtual bool break_bonds(Body& body, const Clock& clock, ThreadTeam& team) = 0;
  // Displacement gradient, then stress.
  virtual void deform(Body& body, const Clock& clock, ThreadTeam& team) = 0;
  virtual void forces(Body& body, ThreadTeam& team) = 0;  // sets internal and viscous force

  // Breaks bonds before the first step. [in] pairs (2,count)
  virtual void precrack(Body& body, std::span<const std::int64_t> pairs) = 0;

  virtual StoredEnergy stored_energy(const Body& body) const = 0;
  virtual double hourglass_energy(const Body& body) const = 0;
  virtual void count(const Body& body, cleave_counts& counts) const = 0;
  // Fill a derived field of this formulation; false if it has no field of that name.
  virtual bool derive(const Body& body, std::string_view field, std::int64_t first,
                      std::int64_t last, double* values) const = 0;
  // The same for derived fields of integers.
  virtual bool derive_integers(const Body&, std::string_view, std::int64_t, std::int64_t,
                               std::int64_t*) const {
    return false;
  }
  // Brings a field up to date that no step needs, before it is read.
  virtual void observe(Body&, std::string_view) {}
  virtual std::int64_t bytes() const = 0;
};

// Defined in formulation/formulations.cpp. Throws UNKNOWN_NAME with the known formulations.
std::unique_ptr<Formulation> make_formulation(std::int32_t value);

}  // namespace cleave
