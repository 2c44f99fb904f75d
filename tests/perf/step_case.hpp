// The steps that are timed: a body of the Continuum Bond Method in a state that stays what its name says
// for thousands of steps, made and driven through the C interface. What is timed and how the numbers are
// put together is the business of step_speed.cpp and of the script run.
//
// A case is named by words joined with +, the law first:
//   svk | j2 | j2_table | any law of the table with E, nu and rho alone
//   plastic     every particle flows in every step; without it a law of plasticity stays elastic
//   fracture    fracture is on and all bonds are far from breaking
//   search      fracture is on, no bond breaks, and every bond must be looked at in every step: the body
//               spins, and its bonds are nearer to breaking than particles of a block move in a step
//   breaking    a crack front runs through the body, a quarter of a spacing a step
//   viscosity   artificial viscosity, form frozen
// They hold for some thousand steps.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "cleave/cleave.h"
#include "support/meshes.hpp"

namespace cleave::perf {

// Throws std::runtime_error with the library's message.
void check(std::int32_t status);

struct StepCase {
  explicit StepCase(const std::string& words);
  std::string name, law;
  bool plastic = false, fracture = false, search = false, breaking = false, viscosity = false;
};

// A mesh, and what the motions need to know of it.
struct StepMesh {
  explicit StepMesh(test::SimplexMesh m);
  test::SimplexMesh mesh;
  double low[3], high[3];  // box of the particles [m]
  double spacing;          // cube root (square root) of the box's volume over the particles [m]
};
// Jittered lattice of about this many particles, jitter 0.2, numbered row by row, or at random.
StepMesh lattice(int dimension, std::int64_t particles, bool shuffled = false);
// Triangles or tetrahedra of a Gmsh file.
StepMesh from_gmsh(const std::string& path);

// What making the model took, up to and with its first step, which may make arrays of its own; bytes as
// the system counts them, without the mesh, 0 where it does not tell.
struct SetUp {
  double seconds = 0;
  std::int64_t peak = 0, resident = 0;
};

class StepModel {
 public:
  StepModel(const StepCase& wanted, const StepMesh& mesh, int threads);
  ~StepModel() { cleave_model_destroy(model_); }
  StepModel(const StepModel&) = delete;
  StepModel& operator=(const StepModel&) = delete;

  void set_threads(int threads) { check(cleave_model_set_threads(model_, threads)); }
  void step();
  const SetUp& set_up() const { return set_up_; }
  cleave_counts counts() const;
  std::int64_t bytes() const;  // as the library reports them
  // Bonds broken since the last call; forgets the events, as a host does that has written them.
  std::int64_t take_broken();
  // Does one step; share of the particles whose plastic strain grew in it, 0 without plasticity.
  double flowing();

 private:
  void add_body(const StepCase& wanted, const StepMesh& mesh);
  void choose_material(const StepCase& wanted);
  void choose_fracture(const StepCase& wanted, const StepMesh& mesh);
  void put_motion(const StepCase& wanted, const StepMesh& mesh, std::vector<double>& u,
                  std::vector<double>& v);
  void open_slab(const StepMesh& mesh, std::vector<double>& u, std::vector<double>& v) const;
  std::vector<double> plastic_strain() const;

  cleave_model* model_ = nullptr;
  SetUp set_up_;
  double dt_ = 0;
  std::int64_t particles_ = 0, step_ = 0;
  bool has_plastic_strain_ = false;
};

}  // namespace cleave::perf
