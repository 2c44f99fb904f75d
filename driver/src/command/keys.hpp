// `cleave keys`: the key table for people and for the reference manual.
#pragma once

#include <string>

#include "command/table_text.hpp"

namespace cleave::driver {

// topic: "" everything, "body" a group, "body.mesh" a key. Throws DeckError for an unknown one.
std::string keys_listing(const std::string& topic, TextFormat format);

// The keys that `cleave restart --deck` may change, and what becomes of them.
std::string restart_listing(TextFormat format);

// "group.key" of every key, one a line.
std::string key_names();

}  // namespace cleave::driver
