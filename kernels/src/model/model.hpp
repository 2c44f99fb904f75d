// The model behind the opaque handle: bodies, the clock, and the order of the calls.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "core/thread_team.hpp"
#include "model/body.hpp"

namespace cleave {
class KeptStiffness;
class Relaxation;
}  // namespace cleave

// The opaque type of the interface.
struct cleave_model {
  // Where the model is in its life; calls out of order are refused by name.
  enum class Phase { building, ready, stepping, advanced, relaxing };

  Phase phase = Phase::building;
  cleave::ThreadTeam team;
  int index_base = 0;    // of messages
  bool by_rows = false;  // see Body
  cleave::Clock clock;
  std::vector<std::unique_ptr<cleave::Body>> bodies;
  std::unique_ptr<cleave::Relaxation> relaxation;  // in phase relaxing
  // Of bodies with a constant one, for the static solver; empty where it has to be found anew.
  std::vector<std::unique_ptr<cleave::KeptStiffness>> stiffness;

  cleave_model();
  ~cleave_model();
  void require(Phase wanted, const char* remedy) const;
  void require_set_up() const;
  cleave::Body& body(std::int64_t index) const;
};

namespace cleave {

// set-up
void prescribe(Body& body, std::span<const std::int64_t> particle,
               std::span<const std::int32_t> direction, std::span<const std::int32_t> motion);
void set_up(cleave_model& model);

// stepping (time_step.cpp)
void initialise(cleave_model& model, double time);
void advance(cleave_model& model, double dt, double time_new);
void update(cleave_model& model);
void restore(cleave_model& model, std::int64_t step, double time);
// stable_step.cpp: for the present deformation
double stable_step(cleave_model& model);
bool is_stable(cleave_model& model, double dt);
// Factor <= 1 by which the deformation of the fields shortens the stable step of a body.
double shortening(Body& body, ThreadTeam& team);

// questions
void reaction(const Body& body, std::span<const std::int64_t> particles, double force[3]);
cleave_energies energies(const Body& body);
cleave_counts counts(const Body& body);

// Derived fields of every body (derived.cpp); false if the name is not one of them.
bool derive_core(const Body& body, std::string_view field, std::int64_t first, std::int64_t last,
                 double* values);

}  // namespace cleave
