// What `cleave info` says of a checkpoint, from its header alone; nothing is verified but the header.
#pragma once

#include <string>

#include "io/archive.hpp"

namespace cleave::driver {

// Where the run was, its bodies, its files and its program, then all attributes and arrays.
std::string checkpoint_text(const std::string& path, const io::ArchiveHeader& archive);

// The deck that a checkpoint carries, as it was written. Throws io::Error, DeckError if there is none.
std::string checkpoint_deck(const std::string& path);

}  // namespace cleave::driver
