#include "command/keys.hpp"

#include <algorithm>

#include "deck/key_table.hpp"
#include "deck/nearest_name.hpp"
#include "deck/restart_keys.hpp"

namespace cleave::driver {
namespace {

std::string repeat_text(const GroupSpec& group) {
  if (group.once) return "once";
  if (group.parameter_group) return "once for a body";
  return group.required ? "one or more" : "any number";
}

std::string default_text(const KeySpec& key) {
  if (key.required) return "required";
  return value_text(key.default_value);
}

// Range, choices, entries or the kind of name.
std::string allowed_column(const KeySpec& key, TextFormat format = TextFormat::text) {
  if (!key.allowed.refers.empty())
    return "name of a " + key_table().groups_naming(key.allowed.refers);
  if (!key.allowed.names.empty()) return "a name of its own";
  if (key.allowed.is_file) return "path relative to the deck";
  if (format == TextFormat::markdown && !key.allowed.choices.empty())
    return listed(key.allowed.choices, "`'", "'`");
  return allowed_text(key.allowed);
}

std::string units_text(const KeySpec& key) {
  return key.units.empty() ? key.units : in_brackets(key.units);
}

std::string with_source(const KeySpec& key) {
  return key.description + (key.source.empty() ? "" : " " + key.source);
}

// "real number [s], > 0; required" and the description below.
std::string key_lines(const GroupSpec& group, const KeySpec& key, std::size_t width) {
  std::string line = "  " + key.name;
  line.append(width - key.name.size() + 2, ' ');
  line += type_text(key.type);
  if (!key.units.empty() && key.units != "1") line.append(1, ' ').append(units_text(key));
  if (const std::string allowed = allowed_column(key); !allowed.empty()) line += ", " + allowed;
  if (const std::string value = default_text(key); !value.empty())
    line += key.required ? "; required" : "; default " + value;
  if (const std::string restart = restart_text(restart_rule(group.name, key.name));
      !restart.empty())
    line += "; " + restart;
  return line + '\n' + std::string(width + 4, ' ') + with_source(key) + '\n';
}

std::size_t widest_name(const GroupSpec& group) {
  std::size_t width = 0;
  for (const KeySpec& key : group.keys) width = std::max(width, key.name.size());
  for (const KeyVariant& variant : group.variants)
    for (const KeySpec& key : variant.keys) width = std::max(width, key.name.size());
  return width;
}

std::string group_text(const GroupSpec& group) {
  const std::size_t width = widest_name(group);
  std::string text =
      "&" + group.name + "  (" + repeat_text(group) + ")  " + group.description + '\n';
  for (const KeySpec& key : group.keys) text += key_lines(group, key, width);
  for (const KeyVariant& variant : group.variants) {
    text += "  with " + group.selector + " = '" + variant.choice + "' (" + variant.title + "):\n";
    for (const KeySpec& key : variant.keys) text += key_lines(group, key, width);
  }
  return text;
}

TextTable key_columns(const std::vector<KeySpec>& keys) {
  TextTable table{{"key", "type", "default", "units", "allowed", "description"}, {}};
  for (const KeySpec& key : keys)
    table.rows.push_back({code(key.name), type_text(key.type),
                          key.required ? "**required**" : code(default_text(key)), units_text(key),
                          allowed_column(key, TextFormat::markdown), with_source(key)});
  return table;
}

std::string group_markdown(const GroupSpec& group) {
  std::string text = "## `&" + group.name + "`\n\n" + group.description +
                     ". In a deck: " + repeat_text(group) + ".\n\n" +
                     to_markdown(key_columns(group.keys));
  for (const KeyVariant& variant : group.variants)
    text += "\n### With `" + group.selector + " = '" + variant.choice + "'`: " + variant.title +
            "\n\n" + to_markdown(key_columns(variant.keys));
  return text;
}

std::string group_listing(const GroupSpec& group, TextFormat format) {
  return format == TextFormat::markdown ? group_markdown(group) : group_text(group);
}

std::string key_listing(const GroupSpec& group, const KeySpec& key, TextFormat format) {
  if (format == TextFormat::markdown) return to_markdown(key_columns({key}));
  std::string text = "&" + group.name + '\n' + key_lines(group, key, key.name.size());
  if (!key.since.empty())
    text += std::string(key.name.size() + 4, ' ') + "since " + key.since + '\n';
  return text;
}

std::vector<std::string> all_keys(const GroupSpec& group) {
  std::vector<std::string> names;
  for (const KeySpec& key : group.keys) names.push_back(key.name);
  for (const KeyVariant& variant : group.variants)
    for (const KeySpec& key : variant.keys)
      if (std::find(names.begin(), names.end(), key.name) == names.end()) names.push_back(key.name);
  return names;
}

[[noreturn]] void unknown_group(const std::string& name) {
  std::string owners;
  for (const GroupSpec& group : key_table().groups())
    if (group.find(name)) owners += (owners.empty() ? "" : ", ") + group.name + "." + name;
  const auto known = key_table().group_names();
  throw DeckError("there is no group &" + name +
                  (owners.empty() ? did_you_mean(name, known, "&", "")
                                  : "; keys of this name: " + owners + ".") +
                  " Known groups: " + listed(known, "&") + ".");
}

const GroupSpec& group_called(const std::string& name) {
  if (const GroupSpec* group = key_table().find(name)) return *group;
  unknown_group(name);
}

}  // namespace

std::string keys_listing(const std::string& topic, TextFormat format) {
  if (topic.empty()) {
    std::string text;
    for (const GroupSpec& group : key_table().groups())
      text.append(text.empty() ? "" : "\n").append(group_listing(group, format));
    return text;
  }
  const std::size_t dot = topic.find('.');
  std::string group_name = topic.substr(0, dot);
  if (group_name.starts_with('&')) group_name.erase(0, 1);
  const GroupSpec& group = group_called(group_name);
  if (dot == std::string::npos) return group_listing(group, format);
  const std::string name = topic.substr(dot + 1);
  if (const KeySpec* key = group.find(name)) return key_listing(group, *key, format);
  const auto known = all_keys(group);
  throw DeckError("&" + group.name + " has no key \"" + name + "\"" + did_you_mean(name, known) +
                  " Known keys: " + listed(known) + ".");
}

std::string restart_listing(TextFormat format) {
  TextTable table{{"group", "key", "when", "what becomes of it"}, {}};
  for (const RestartKey& entry : restart_keys()) {
    for (const KeySpec& key : group_called(std::string(entry.group)).keys) {
      if (entry.key != "*" && entry.key != key.name) continue;
      const bool text = format == TextFormat::text;
      const std::string group = "&" + std::string(entry.group);
      table.rows.push_back({text ? group : code(group), text ? key.name : code(key.name),
                            restart_text(entry.rule), std::string(entry.effect)});
    }
  }
  return to_text(table, format);
}

std::string key_names() {
  std::string text;
  for (const GroupSpec& group : key_table().groups())
    for (const std::string& key : all_keys(group)) text += group.name + "." + key + '\n';
  return text;
}

}  // namespace cleave::driver
