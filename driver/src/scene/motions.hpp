// Prescribed motion: which degrees of freedom follow which curve, and the values that the kernels
// want before and after they advance (the stepping protocol of cleave.h).
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "scene/curve.hpp"
#include "scene/model.hpp"
#include "scene/sets.hpp"

namespace cleave::driver {

// Every &load of kind displacement, velocity or acceleration.
class Motions {
 public:
  // Throws DeckError, also where two loads prescribe one degree of freedom.
  Motions(const Deck& deck, const std::vector<BodyGeometry>& bodies, const Sets& sets);

  // Tells the model which degrees of freedom are prescribed; before its set-up.
  void prescribe(Model& model) const;
  // Displacement, velocity and acceleration at time 0. Before time 0 every curve is continued with
  // its initial velocity.
  void start(Model& model, double dt);
  // Displacement at time 0, without velocity and acceleration: statics.
  void start_at_rest(Model& model);
  // Displacements at the end of the step from t to t_new, before the model advances.
  void before_advance(Model& model, double t_new);
  // Accelerations at time t = t_n, before the model updates; t_before, t_after: the steps beside
  // it.
  void before_update(Model& model, double t_before, double t, double t_after, double dt);

  struct Reaction {
    std::string load;
    std::vector<int> directions;
    double force[3];  // sum over the particles of the load [N]
  };
  // One entry a load, in the order of the deck; `force` is filled by reactions().
  const std::vector<Reaction>& reactions(Model& model);
  const std::vector<Reaction>& reaction_columns() const { return reactions_; }

 private:
  struct Load {
    MotionKind kind;
    bool exact;
    double value;
    Curve curve;
    std::vector<Selection> selections;
  };
  struct BodyList {  // degrees of freedom of one body in the order of cleave_body_prescribe
    std::vector<std::int64_t> particle;
    std::vector<std::int32_t> direction, motion;
    std::vector<std::size_t> load;
    std::vector<double> displacement, acceleration;
  };
  void add(const Deck& deck, const std::vector<BodyGeometry>& bodies, const Sets& sets,
           const DeckGroup& group, const std::string& name);
  void put_start(Model& model, bool moving) const;
  void send(Model& model, bool displacement, bool acceleration);

  std::vector<Load> loads_;
  std::vector<Reaction> reactions_;
  std::vector<BodyList> bodies_;
  std::vector<double> displacement_, acceleration_;  // of every load, at the time last asked for
};

// Name of a load: its key `name`, else "load" and its number among all loads, from 1.
std::string load_name(const Deck& deck, const DeckGroup& load);
// The letters of `directions` as 0, 1, 2. Throws DeckError: empty, unknown, twice, z in a plane.
std::vector<int> load_directions(const Deck& deck, const DeckGroup& load,
                                 const std::vector<BodyGeometry>& bodies,
                                 const std::vector<Selection>& selections);

}  // namespace cleave::driver
