#include "deck/group_reader.hpp"

#include <algorithm>
#include <deque>
#include <map>

#include "deck/key_reader.hpp"
#include "deck/nearest_name.hpp"

namespace cleave::driver {
namespace {

using io::namelist::Assignment;

class GroupReader {
 public:
  GroupReader(const GroupSpec& spec, Mistakes& mistakes) : spec_(spec), mistakes_(mistakes) {}

  DeckGroup read(const io::namelist::Group& group) {
    use_keys(group);
    for (const Assignment& assignment : group.assignments) assign(assignment);
    return finish(group.place);
  }

  DeckGroup read_nothing() {
    use_keys({});
    return finish({});
  }

 private:
  // The keys that the group has with this choice of its selector.
  void use_keys(const io::namelist::Group& group) {
    for (const Assignment& assignment : group.assignments) {
      if (spec_.selector.empty() || assignment.full_name() != spec_.selector) continue;
      for (const auto& value : assignment.values)
        if (const auto* text = std::get_if<std::string>(&value.scalar); text && choice_.empty())
          choice_ = text->substr(0, text->find_last_not_of(' ') + 1);
    }
    has_variant_ = spec_.selector.empty() ||
                   std::any_of(spec_.variants.begin(), spec_.variants.end(),
                               [&](const KeyVariant& v) { return v.choice == choice_; });
    for (const KeySpec* key : spec_.keys_of(choice_)) {
      keys_.push_back(key);
      readers_.emplace_back(*key, spec_.name, mistakes_);
    }
  }

  void assign(const Assignment& assignment) {
    const std::string& name = assignment.name.front().name;
    const auto at = std::find_if(keys_.begin(), keys_.end(),
                                 [&](const KeySpec* key) { return same_name(key->name, name); });
    if (at == keys_.end()) return unknown(assignment, name);
    if (assignment.name.size() > 1)
      return mistakes_.add(assignment.place, "key \"" + name + "\" of &" + spec_.name +
                                                 " has no components; write " + (*at)->name +
                                                 " = ...");
    const auto [first, is_new] = first_line_.emplace(assignment.full_name(), assignment.place.line);
    if (!is_new)
      return mistakes_.add(assignment.place, "key \"" + (*at)->name + "\" of &" + spec_.name +
                                                 " is given twice; the first is on line " +
                                                 std::to_string(first->second) +
                                                 ". Keep one of them.");
    readers_[static_cast<std::size_t>(at - keys_.begin())].assign(assignment);
  }

  void unknown(const Assignment& assignment, const std::string& name) {
    // Without a valid choice nobody can say which keys it would have had.
    if (!has_variant_ && spec_.find(name)) return;
    std::vector<std::string> known;
    for (const KeySpec* key : keys_) known.push_back(key->name);
    std::string message = "key \"" + name + "\" in group &" + spec_.name + " is unknown";
    if (nearest_name(name, known).empty())
      message += elsewhere(name);
    else
      message += did_you_mean(name, known);
    message += " Known keys";
    if (!choice_.empty() && has_variant_)
      message += " with " + spec_.selector + " = '" + choice_ + "'";
    mistakes_.add(assignment.place, message + ": " + listed(known) + ".");
  }

  // "; &body has a key of this name.": it may stand in the wrong group, or belong to another
  // choice.
  std::string elsewhere(const std::string& name) const {
    for (const KeyVariant& variant : spec_.variants)
      for (const KeySpec& key : variant.keys)
        if (same_name(key.name, name))
          return "; it belongs to " + spec_.selector + " = '" + variant.choice + "'.";
    for (const GroupSpec& group : key_table().groups())
      if (group.find(name)) return "; &" + group.name + " has a key of this name.";
    return ".";
  }

  DeckGroup finish(io::namelist::Place place) {
    DeckGroup group;
    group.name = spec_.name;
    group.place = place;
    for (KeyReader& reader : readers_) group.keys.push_back(reader.finish(place));
    return group;
  }

  const GroupSpec& spec_;
  Mistakes& mistakes_;
  std::string choice_;
  bool has_variant_ = true;
  std::vector<const KeySpec*> keys_;
  std::deque<KeyReader> readers_;
  std::map<std::string, int> first_line_;
};

}  // namespace

DeckGroup read_group(const io::namelist::Group& group, const GroupSpec& spec, Mistakes& mistakes) {
  return GroupReader(spec, mistakes).read(group);
}

DeckGroup default_group(const GroupSpec& spec, Mistakes& mistakes) {
  return GroupReader(spec, mistakes).read_nothing();
}

}  // namespace cleave::driver
