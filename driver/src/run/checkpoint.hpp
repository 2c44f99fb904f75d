// Checkpoints: everything that a run needs to go on as if it had never stopped.
//
// A checkpoint holds the deck, the geometry of the bodies with their named sets (so that no mesh
// file is needed again), every field of lifetime setup and state under "body/field", and how far
// the output files had been written. Loads have no memory: they are functions of time.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "io/archive.hpp"
#include "run/schedule.hpp"
#include "scene/scene.hpp"

namespace cleave::driver {

// How far the output files have been written.
struct Cursors {
  std::int64_t frames = 0, history = 0, events = 0;
};

// The state fields of all bodies at one moment, in memory. Taking it again reuses the memory.
class Snapshot {
 public:
  void take(const Scene& scene, std::int64_t step, const Cursors& cursors);
  std::int64_t step() const { return step_; }
  // Writes the checkpoint of this moment. Throws io::Error.
  void write(const std::string& path, const Scene& scene, const Clock& clock) const;

 private:
  std::int64_t step_ = 0;
  Cursors cursors_;
  std::vector<io::NamedArray> arrays_;
};

// Name, or "", of the first state field with a value that is not finite, and where.
std::string not_finite(const Scene& scene);

// Why this version cannot continue a checkpoint with these attributes, and what to do; "" if it can.
std::string why_not_continued(const std::vector<io::Attribute>& attributes);

// What a checkpoint says apart from the fields. Reading throws DeckError for a file that is not a
// checkpoint of this version.
struct CheckpointHeader {
  std::string deck_text, deck_path, resolved_deck;
  std::int64_t step = 0, steps = 0;
  double dt = 0;
  Cursors cursors;
};
CheckpointHeader header_of(const io::Archive& archive, const std::string& path);
// The deck of a checkpoint: places as in its text, values as the run used them, whatever the defaults
// of this version are.
Deck deck_of(const CheckpointHeader& header);
// The bodies of a checkpoint in the order of the deck.
std::vector<BodyGeometry> bodies_of(const io::Archive& archive, const Deck& deck,
                                    const std::string& path);
// Puts all fields, of setup and state, into a model that was set up from those bodies, and sets its
// clock.
void restore_fields(const io::Archive& archive, const CheckpointHeader& header, Scene& scene,
                    const std::string& path);

}  // namespace cleave::driver
