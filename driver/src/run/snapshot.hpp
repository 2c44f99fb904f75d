// The state of a run at one moment, in memory, and its way into a checkpoint.
//
// A checkpoint holds the deck, the geometry of the bodies with their named sets (so that no mesh
// file is needed again), every field of lifetime setup and state under "body/field", and how far
// the output files had been written. Loads have no memory: they are functions of time. Everything
// goes into the file in blocks: there is no second copy of the state or of the mesh.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "run/compact_integers.hpp"
#include "run/schedule.hpp"
#include "scene/scene.hpp"

namespace cleave::driver {

// How far the output files have been written.
struct Cursors {
  std::int64_t frames = 0, history = 0, events = 0;
};

// The state fields of all bodies. Taking it again reuses the memory.
class Snapshot {
 public:
  // step: the last that is done; time: of the state, later than that step's within a static increment
  void take(const Scene& scene, std::int64_t step, double time, const Cursors& cursors);
  std::int64_t step() const { return step_; }
  double time() const { return time_; }
  std::int64_t bytes() const;
  // Writes the checkpoint of this moment. Throws io::Error.
  void write(const std::string& path, const Scene& scene, const Clock& clock) const;

 private:
  struct StateField {
    std::int64_t body = 0;
    cleave_field field{};
    std::vector<double> reals;
    CompactIntegers integers;
  };
  std::int64_t step_ = 0;
  double time_ = 0;
  Cursors cursors_;
  std::vector<StateField> state_;
};

// Name, or "", of the first state field with a value that is not finite, and where.
std::string not_finite(const Scene& scene);

}  // namespace cleave::driver
