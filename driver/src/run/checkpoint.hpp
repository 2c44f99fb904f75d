// Continuing from a checkpoint: its deck, its bodies, its fields. What is in one: snapshot.hpp.
//
// Arrays are read from the file one at a time, when they are needed; each is verified again then.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "io/archive.hpp"
#include "run/snapshot.hpp"
#include "scene/scene.hpp"

namespace cleave::driver {

// Why this version cannot continue a checkpoint with these attributes, and what to do; "" if it can.
std::string why_not_continued(const std::vector<io::Attribute>& attributes);

// What a checkpoint says apart from the fields. Reading throws DeckError for a file that is not a
// checkpoint of this version.
struct CheckpointHeader {
  std::string deck_text, deck_path, resolved_deck;
  std::int64_t step = 0, steps = 0;
  double dt = 0, time = 0;
  Cursors cursors;
};
CheckpointHeader header_of(const io::ArchiveHeader& archive, const std::string& path);
// The deck of a checkpoint: places as in its text, values as the run used them, whatever the defaults
// of this version are.
Deck deck_of(const CheckpointHeader& header);
// The bodies of a checkpoint in the order of the deck.
std::vector<BodyGeometry> bodies_of(const io::ArchiveHeader& archive, const Deck& deck,
                                    const std::string& path);
// Puts all fields, of setup and state, into a model that was set up from those bodies, and sets its
// clock.
void restore_fields(const io::ArchiveHeader& archive, const CheckpointHeader& header, Scene& scene,
                    const std::string& path);

}  // namespace cleave::driver
