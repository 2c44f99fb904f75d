#include "deck/restart_keys.hpp"

#include <algorithm>

namespace cleave::driver {
namespace {

constexpr RestartKey kKeys[] = {
#define CLEAVE_RESTART_KEY(group, key, rule, effect) {#group, #key, RestartRule::rule, effect},
#include "deck/restart_keys.def"
};

}  // namespace

std::span<const RestartKey> restart_keys() { return kKeys; }

RestartRule restart_rule(std::string_view group, std::string_view key) {
  const auto* entry = std::find_if(std::begin(kKeys), std::end(kKeys), [&](const RestartKey& k) {
    return k.group == group && (k.key == "*" || k.key == key);
  });
  return entry == std::end(kKeys) ? RestartRule::never : entry->rule;
}

std::string restart_text(RestartRule rule) {
  switch (rule) {
    case RestartRule::never:
      return {};
    case RestartRule::always:
      return "may change at a restart";
    case RestartRule::on:
      return "may be switched on at a restart";
    case RestartRule::later:
      return "may change at a restart while the load is zero";
  }
  return {};
}

std::string restart_key_list() {
  std::string text;
  for (const RestartKey& key : kKeys) {
    if (!text.empty()) text += ", ";
    text.append(key.group).append(".").append(key.key);
  }
  return text;
}

}  // namespace cleave::driver
