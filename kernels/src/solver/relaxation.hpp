// Quasi-static equilibrium by adaptive dynamic relaxation (Kilic and Madenci 2010), for every
// formulation: forces are all it asks for, so bonds may break and there is no matrix. One increment is:
// move the boundary and the forces, relax, break or soften what has failed in equilibrium, relax again until
// nothing fails. The stiff and smooth problems of static_solver.hpp need fewer evaluations there.  [DR]
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "model/model.hpp"
#include "solver/damped_motion.hpp"
#include "solver/increment.hpp"

namespace cleave {

struct RelaxationOptions {
  double tolerance = 1e-6;               // on the norm of the residual over that of all forces
  std::int64_t max_iterations = 100000;  // of one relaxation
  std::int64_t slice = 0;                // iterations of one call; 0: until it is done
  Breaking breaking = Breaking::all;
};

struct RelaxationReport {
  std::int64_t iterations = 0;  // evaluations of the forces, of all bodies
  std::int64_t rounds = 0;      // how often bonds broke or softened
  std::int64_t broken = 0;      // bonds
  std::int64_t unknowns = 0;
  double residual = 0;  // relative, the largest of the bodies
  bool finished = false;
};

// One body in one increment.
class BodyRelaxation {
 public:
  BodyRelaxation(Body& body, const Clock& clock, ThreadTeam& team,
                 const RelaxationOptions& options);
  // Goes on until equilibrium, true, or for `most` iterations. Throws NO_CONVERGENCE.
  bool go_on(std::int64_t most);
  void add_to(RelaxationReport& report) const;
  const Committed& committed() const { return committed_; }
  std::int64_t bytes() const;

 private:
  struct Path {  // state fields that a trial advances
    Field* field;
    std::vector<double> values;
  };
  void begin();
  void start_round();
  void evaluate();
  void judge(const DampedMotion::Balance& balance);
  bool in_equilibrium() const { return step_ >= ramp_ && relative_ <= options_.tolerance; }
  bool break_bonds();
  void book();
  Error no_convergence(const std::string& why) const;

  Body& body_;
  Clock clock_;
  ThreadTeam& team_;
  RelaxationOptions options_;
  Committed committed_;
  const std::vector<double>& from_;  // (3,n) displacements before the increment
  std::vector<Path> path_;
  DampedMotion motion_;
  // Norm of the internal forces [N], the largest of the equilibria before: what follows may take all away.
  double forces_before_ = 0;
  std::int64_t ramp_ = 0;  // steps over which the boundary moves
  std::int64_t step_ = 0;  // of this round
  std::int64_t iterations_ = 0, rounds_ = 0, broken_ = 0;
  double relative_ = 0, largest_ = 0;    // residual; largest internal forces met [N]
  double work_ = 0, external_work_ = 0;  // of this round
};

class Relaxation {
 public:
  Relaxation(cleave_model& model, double time_new, const RelaxationOptions& options);
  // Throws NO_CONVERGENCE with the state as before the increment.
  RelaxationReport go_on(std::int64_t most);
  void cancel();
  std::int64_t bytes() const;

 private:
  cleave_model& model_;
  Clock clock_;
  RelaxationOptions options_;
  std::vector<std::unique_ptr<BodyRelaxation>> bodies_;  // done, and the one being relaxed
};

// From the present equilibrium to the one with the displacements of cleave_body_motion and the present
// external forces, or a slice of the way: then the model is in phase relaxing and the same call goes on.
// On success the clock stands at time_new, velocities are zero. Throws NO_CONVERGENCE with the state as
// before; UNSUPPORTED for forces that have no rest.
RelaxationReport relax(cleave_model& model, double time_new, const RelaxationOptions& options);
// Back to the equilibrium before the increment that is being relaxed.
void cancel_relaxation(cleave_model& model);

}  // namespace cleave
