#include "deck/deck_difference.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "deck/key_table.hpp"

namespace cleave::driver {
namespace {

namespace fs = std::filesystem;

using Groups = std::vector<const DeckGroup*>;

// The key by which groups of a kind are found again wherever they stand; nullptr: their order counts.
const KeySpec* identity_of(const GroupSpec& spec) {
  if (spec.parameter_group) return spec.find("body");
  for (const KeySpec& key : spec.keys) {
    const std::string& kind = key.allowed.names;
    if (kind == "mesh" || kind == "material" || kind == "set") return &key;
  }
  return nullptr;
}

std::string label(const GroupSpec& spec, const DeckGroup& group, const Deck& deck) {
  std::string text = "&" + spec.name;
  for (const KeySpec& key : spec.keys) {
    if (!key.allowed.names.empty() && !group.text(key.name.c_str()).empty())
      return text + " '" + group.text(key.name.c_str()) + "'";
  }
  const Groups all = deck.all(spec.name.c_str());
  if (all.size() < 2) return text;
  const auto place = std::find(all.begin(), all.end(), &group) - all.begin();
  return text + " number " + std::to_string(place + 1);
}

// Bit for bit, but "to be computed" equals itself.
bool same(const KeyValue& a, const KeyValue& b) {
  const auto *x = std::get_if<double>(&a), *y = std::get_if<double>(&b);
  if (x != nullptr && y != nullptr && std::isnan(*x) && std::isnan(*y)) return true;
  return a == b;
}

bool same_file(const Deck& before, const KeyValue& a, const Deck& after, const KeyValue& b) {
  const auto absolute = [](const Deck& deck, const KeyValue& value) {
    const fs::path folder = fs::absolute(deck.source.path).parent_path();
    return (folder / std::get<std::string>(value)).lexically_normal();
  };
  return absolute(before, a) == absolute(after, b);
}

std::string shown(const KeyValue& value) {
  const std::string text = value_text(value);
  return text.empty() ? "(none given)" : text;
}

class Comparison {
 public:
  Comparison(const Deck& before, const Deck& after) : before_(before), after_(after) {}

  void compare_kind(const GroupSpec& spec) {
    const Groups old_groups = before_.all(spec.name.c_str());
    const Groups new_groups = after_.all(spec.name.c_str());
    const KeySpec* identity = identity_of(spec);
    std::vector<char> used(new_groups.size(), 0);
    for (std::size_t i = 0; i < old_groups.size(); ++i) {
      const std::size_t j =
          identity == nullptr ? i : find(*old_groups[i], new_groups, used, *identity);
      if (j >= new_groups.size()) {
        found.push_back({old_groups[i], nullptr, "", label(spec, *old_groups[i], before_), "", ""});
        continue;
      }
      used[j] = 1;
      compare_groups(spec, *old_groups[i], *new_groups[j]);
    }
    for (std::size_t j = 0; j < new_groups.size(); ++j) {
      if (used[j] == 0)
        found.push_back({nullptr, new_groups[j], "", label(spec, *new_groups[j], after_), "", ""});
    }
  }

  std::vector<DeckDifference> found;

 private:
  static std::size_t find(const DeckGroup& group, const Groups& candidates,
                          const std::vector<char>& used, const KeySpec& identity) {
    std::size_t j = 0;
    while (j < candidates.size() && (used[j] != 0 || candidates[j]->text(identity.name.c_str()) !=
                                                         group.text(identity.name.c_str())))
      ++j;
    return j;
  }

  void compare_groups(const GroupSpec& spec, const DeckGroup& old_group,
                      const DeckGroup& new_group) {
    const char* selector = spec.selector.empty() ? nullptr : spec.selector.c_str();
    const bool other_keys =
        selector != nullptr && old_group.text(selector) != new_group.text(selector);
    const auto specs = key_specs(new_group);
    for (std::size_t k = 0; k < new_group.keys.size(); ++k) {
      const DeckKey& key = new_group.keys[k];
      if (other_keys && key.name != spec.selector) continue;
      const KeyValue& old_value = old_group.key(key.name.c_str()).value;
      if (same(old_value, key.value)) continue;
      // With another selector the keys may be those of the old one: only the selector itself is compared.
      if (!other_keys && specs[k]->allowed.is_file &&
          same_file(before_, old_value, after_, key.value))
        continue;
      found.push_back({&old_group, &new_group, key.name, label(spec, old_group, before_),
                       shown(old_value), shown(key.value)});
    }
  }

  const Deck& before_;
  const Deck& after_;
};

}  // namespace

std::vector<DeckDifference> differences(const Deck& before, const Deck& after) {
  Comparison comparison(before, after);
  for (const GroupSpec& spec : key_table().groups()) comparison.compare_kind(spec);
  return std::move(comparison.found);
}

std::string difference_line(const DeckDifference& difference) {
  if (difference.before == nullptr) return difference.group + ": new";
  if (difference.after == nullptr) return difference.group + ": left out";
  return difference.group + " " + difference.key + ": " + difference.old_value + " -> " +
         difference.new_value;
}

}  // namespace cleave::driver
