// The table restart_keys.def: which keys of a deck a restart may change. It judges no deck.
#pragma once

#include <span>
#include <string>
#include <string_view>

namespace cleave::driver {

enum class RestartRule { never, always, on, later };

struct RestartKey {
  std::string_view group, key;  // key "*": every key of the group
  RestartRule rule;
  std::string_view effect;
};

std::span<const RestartKey> restart_keys();

// never: not in the table.
RestartRule restart_rule(std::string_view group, std::string_view key);

// "may change at a restart" and the like; empty for never.
std::string restart_text(RestartRule rule);

// All of the table in a few words: "run.title, run.t_end, ..., checkpoint.*".
std::string restart_key_list();

}  // namespace cleave::driver
