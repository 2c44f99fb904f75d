#include "deck/deck_references.hpp"

#include <algorithm>
#include <map>
#include <string>
#include <vector>

#include "deck/key_table.hpp"
#include "deck/nearest_name.hpp"

namespace cleave::driver {
namespace {

struct Named {
  std::string name;
  const DeckGroup* group;
};
using NamesByKind = std::map<std::string, std::vector<Named>>;

std::string line_text(const DeckGroup& group) {
  return "&" + group.name + " of line " + std::to_string(group.place.line);
}

// Calls visit(spec, key) for every text key of the group that names or refers to something.
template <class Visit>
void for_each_reference(const DeckGroup& group, Visit visit) {
  const std::vector<const KeySpec*> specs = key_specs(group);
  for (std::size_t i = 0; i < std::min(specs.size(), group.keys.size()); ++i) {
    const Allowed& allowed = specs[i]->allowed;
    const bool matters = !allowed.names.empty() || !allowed.refers.empty();
    if (matters && std::holds_alternative<std::string>(group.keys[i].value))
      visit(*specs[i], group.keys[i]);
  }
}

NamesByKind collect_names(const Deck& deck, Mistakes& mistakes) {
  NamesByKind names;
  for (const DeckGroup& group : deck.groups) {
    for_each_reference(group, [&](const KeySpec& spec, const DeckKey& key) {
      const auto& name = std::get<std::string>(key.value);
      if (spec.allowed.names.empty() || name.empty()) return;
      auto& known = names[spec.allowed.names];
      for (const Named& other : known)
        if (other.name == name)
          mistakes.add(key.place, "the name '" + name + "' of this &" + group.name +
                                      (key.given ? "" : " (its default)") + " is taken by " +
                                      line_text(*other.group) +
                                      ". Give every one a name of its own.");
      known.push_back({name, &group});
    });
  }
  return names;
}

void check_reference(const DeckGroup& group, const KeySpec& spec, const DeckKey& key,
                     const std::vector<Named>& known, Mistakes& mistakes) {
  const auto& name = std::get<std::string>(key.value);
  if (name.empty()) return;
  std::vector<std::string> names;
  for (const Named& named : known) names.push_back(named.name);
  for (const std::string& candidate : names)
    if (candidate == name) return;
  const std::string groups = key_table().groups_naming(spec.allowed.refers);
  std::string message = "key \"" + key.name + "\" of &" + group.name + ": ";
  if (names.empty())
    message += "the deck has no " + groups + ", but '" + name + "' is wanted here" +
               (key.given ? "." : " (the default).");
  else
    message += "no " + groups + " is called '" + name + "'" + did_you_mean(name, names, "'", "'") +
               " Known: " + listed(names, "'", "'") + ".";
  mistakes.add(key.place, message);
}

}  // namespace

void check_names(const Deck& deck, Mistakes& mistakes) {
  NamesByKind names = collect_names(deck, mistakes);
  for (const DeckGroup& group : deck.groups) {
    for_each_reference(group, [&](const KeySpec& spec, const DeckKey& key) {
      const std::string& kind = spec.allowed.refers;
      if (!kind.empty()) check_reference(group, spec, key, names[kind], mistakes);
    });
  }
}

void check_once_per_body(const Deck& deck, Mistakes& mistakes) {
  for (const GroupSpec& spec : key_table().groups()) {
    if (!spec.parameter_group) continue;
    std::vector<const DeckGroup*> seen;
    for (const DeckGroup* group : deck.all(spec.name.c_str())) {
      const std::string& body = group->text("body");
      for (const DeckGroup* other : seen) {
        const std::string& other_body = other->text("body");
        if (!body.empty() && !other_body.empty() && body != other_body) continue;
        const std::string& shared = body.empty() ? other_body : body;
        mistakes.add(group->place, (shared.empty() ? "every body" : "body '" + shared + "'") +
                                       " already has the " + line_text(*other) +
                                       "; a body takes one &" + spec.name + ".");
        break;
      }
      seen.push_back(group);
    }
  }
}

}  // namespace cleave::driver
