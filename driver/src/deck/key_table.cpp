#include "deck/key_table.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "deck/kernel_tables.hpp"
#include "deck/nearest_name.hpp"
#include "deck/number_text.hpp"
#include "deck/units.hpp"

namespace cleave::driver {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

char lower(char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; }

// Defaults are written as in a deck, so the deck's own reader reads them.
std::vector<io::namelist::Value> parse_default(const std::string& text) {
  return io::namelist::parse("&d k = " + text + " /", "keys.def")
      .groups.at(0)
      .assignments.at(0)
      .values;
}

double as_real(const io::namelist::Scalar& scalar) {
  if (const auto* i = std::get_if<std::int64_t>(&scalar)) return static_cast<double>(*i);
  return std::get<double>(scalar);
}

// Of a key that has no default: never used but of the right type.
KeyValue no_value(KeyType type) {
  switch (type) {
    case KeyType::text:
    case KeyType::choice:
      return std::string();
    case KeyType::texts:
      return std::vector<std::string>();
    case KeyType::reals:
      return std::vector<double>();
    case KeyType::real:
      return 0.0;
    case KeyType::integer:
      return std::int64_t{0};
    case KeyType::logical:
      return false;
  }
  return {};
}

KeyValue default_value(KeyType type, const std::string& text) {
  switch (type) {
    case KeyType::text:
    case KeyType::choice:
      return text;
    case KeyType::texts:
      return split(text, ',');
    case KeyType::reals: {
      std::vector<double> values;
      if (text.empty()) return values;
      for (const auto& value : parse_default(text)) values.push_back(as_real(value.scalar));
      return values;
    }
    case KeyType::real:
      return as_real(parse_default(text).at(0).scalar);
    case KeyType::integer:
      return std::get<std::int64_t>(parse_default(text).at(0).scalar);
    case KeyType::logical:
      return std::get<bool>(parse_default(text).at(0).scalar);
  }
  return {};
}

std::vector<std::string> choices_of_table(std::string_view range) {
  if (range == "@materials") return table_names(CLEAVE_TABLE_MATERIAL);
  if (range == "@formulations") return table_names(CLEAVE_TABLE_FORMULATION);
  if (range == "@units") return unit_set_names();
  throw std::logic_error("keys.def: unknown table \"" + std::string(range) + "\"");
}

KeySpec make_key(const char* name, KeyType type, const std::string& default_text, const char* units,
                 std::string_view range, const char* description, const char* since) {
  KeySpec key;
  key.name = name;
  key.type = type;
  key.required = default_text == "required";
  key.default_value = key.required ? no_value(type) : default_value(type, default_text);
  key.units = units;
  key.allowed = parse_allowed(type, range);
  if (range.starts_with('@')) key.allowed.choices = choices_of_table(range);
  key.description = description;
  key.since = since;
  return key;
}

KeySpec make_key(const cleave_parameter& parameter) {
  KeySpec key;
  key.name = parameter.name;
  key.required = parameter.required != 0;
  key.units = parameter.units;
  key.description = parameter.description;
  key.source = parameter.source;
  key.parameter = true;
  switch (parameter.type) {
    case CLEAVE_CHOICE:
      key.type = KeyType::choice;
      key.units.clear();
      key.allowed.choices = split(parameter.choices, '|');
      key.default_value = std::string(parameter.default_choice);
      return key;
    case CLEAVE_INTEGER:
      key.type = KeyType::integer;
      key.default_value = static_cast<std::int64_t>(std::llround(parameter.default_value));
      break;
    default:
      key.type = KeyType::real;
      key.default_value = parameter.default_value;
  }
  constexpr double kLargest = std::numeric_limits<double>::max();
  key.allowed.minimum = parameter.minimum <= -kLargest ? -kInfinity : parameter.minimum;
  key.allowed.maximum = parameter.maximum >= kLargest ? kInfinity : parameter.maximum;
  key.allowed.minimum_excluded = parameter.minimum_excluded != 0;
  key.allowed.maximum_excluded = parameter.maximum_excluded != 0;
  return key;
}

void append_parameters(const std::string& owner, std::vector<KeySpec>& keys) {
  for (const cleave_parameter& parameter : table_parameters(owner))
    keys.push_back(make_key(parameter));
}

void add_variants(GroupSpec& group) {
  group.selector = group.keys.back().name;
  for (const cleave_table_entry& law : table_entries(CLEAVE_TABLE_MATERIAL)) {
    KeyVariant variant{law.name, law.title, {}};
    append_parameters(law.name, variant.keys);
    group.variants.push_back(std::move(variant));
  }
}

enum class Repeat { once, some, many };

class Builder {
 public:
  explicit Builder(std::vector<GroupSpec>& groups) : groups_(groups) {}

  void group(const char* name, Repeat repeat, const char* description) {
    GroupSpec spec;
    spec.name = name;
    spec.description = description;
    spec.once = repeat == Repeat::once;
    spec.required = repeat == Repeat::some;
    groups_.push_back(std::move(spec));
  }

  void key(const char* group, KeySpec spec, std::string_view range) {
    GroupSpec& owner = groups_.back();
    if (owner.name != group)
      throw std::logic_error("keys.def: " + spec.name + " is not below its group");
    owner.keys.push_back(std::move(spec));
    if (range == "@materials") add_variants(owner);
  }

  // Parameter groups in the order of the kernels' table, each beginning with this key.
  void parameter_key(const KeySpec& spec) {
    for (const cleave_table_entry& entry : table_entries(CLEAVE_TABLE_GROUP)) {
      GroupSpec group;
      group.name = entry.name;
      group.description = entry.title;
      group.parameter_group = true;
      group.keys.push_back(spec);
      append_parameters(entry.name, group.keys);
      groups_.push_back(std::move(group));
    }
  }

 private:
  std::vector<GroupSpec>& groups_;
};

struct ValueText {
  std::string operator()(double v) const { return std::isnan(v) ? "" : real_text(v); }
  std::string operator()(std::int64_t v) const { return std::to_string(v); }
  std::string operator()(bool v) const { return v ? ".true." : ".false."; }
  std::string operator()(const std::string& v) const {
    std::string text = "'";
    for (const char c : v) text += c == '\'' ? std::string("''") : std::string(1, c);
    return text + "'";
  }
  template <class T>
  std::string operator()(const std::vector<T>& values) const {
    std::string text;
    for (const T& v : values) text += (text.empty() ? "" : ", ") + (*this)(v);
    return text;
  }
};

}  // namespace

KeyTable::KeyTable() {
  Builder builder(groups_);
#define CLEAVE_GROUP(group_, repeat, description) \
  builder.group(#group_, Repeat::repeat, description);
#define CLEAVE_KEY(group_, key_, type, default_, units, range, description, since)                 \
  builder.key(#group_, make_key(#key_, KeyType::type, default_, units, range, description, since), \
              range);
#define CLEAVE_PARAMETER_KEY(key_, type, default_, units, range, description, since) \
  builder.parameter_key(make_key(#key_, KeyType::type, default_, units, range, description, since));
#include "deck/keys.def"
}

const KeyTable& key_table() {
  static const KeyTable table;
  return table;
}

const GroupSpec* KeyTable::find(std::string_view group) const {
  for (const GroupSpec& spec : groups_)
    if (same_name(spec.name, group)) return &spec;
  return nullptr;
}

std::vector<std::string> KeyTable::group_names() const {
  std::vector<std::string> names;
  for (const GroupSpec& spec : groups_) names.push_back(spec.name);
  return names;
}

std::string KeyTable::groups_naming(std::string_view kind) const {
  std::string text;
  for (const GroupSpec& group : groups_)
    for (const KeySpec& key : group.keys)
      if (key.allowed.names == kind) text += (text.empty() ? "&" : " or &") + group.name;
  return text;
}

std::vector<const KeySpec*> GroupSpec::keys_of(std::string_view choice) const {
  std::vector<const KeySpec*> list;
  for (const KeySpec& key : keys) list.push_back(&key);
  for (const KeyVariant& variant : variants)
    if (variant.choice == choice)
      for (const KeySpec& key : variant.keys) list.push_back(&key);
  return list;
}

const KeySpec* GroupSpec::find(std::string_view key) const {
  const auto search = [&](const std::vector<KeySpec>& list) -> const KeySpec* {
    const auto at = std::find_if(list.begin(), list.end(),
                                 [&](const KeySpec& spec) { return same_name(spec.name, key); });
    return at == list.end() ? nullptr : &*at;
  };
  if (const KeySpec* own = search(keys)) return own;
  for (const KeyVariant& variant : variants)
    if (const KeySpec* found = search(variant.keys)) return found;
  return nullptr;
}

std::vector<const KeySpec*> key_specs(const DeckGroup& group) {
  const GroupSpec* spec = key_table().find(group.name);
  if (!spec) throw std::logic_error("&" + group.name + " is not in keys.def");
  return spec->keys_of(spec->selector.empty() ? "" : group.text(spec->selector.c_str()));
}

bool same_name(std::string_view a, std::string_view b) {
  return a.size() == b.size() && std::equal(a.begin(), a.end(), b.begin(),
                                            [](char x, char y) { return lower(x) == lower(y); });
}

std::string value_text(const KeyValue& value) { return std::visit(ValueText{}, value); }

std::string wanted_text(const KeySpec& key) {
  std::string text;
  switch (key.type) {
    case KeyType::choice:
      return "one of " + allowed_text(key.allowed);
    case KeyType::logical:
      return ".true. or .false.";
    case KeyType::text:
      text = "a text in quotes";
      break;
    case KeyType::integer:
      text = "an integer";
      break;
    default:
      text = std::string("a ") + type_text(key.type);
  }
  if (!key.units.empty() && key.units != "1") text += " [" + key.units + "]";
  const std::string range = allowed_text(key.allowed);
  if (!range.empty()) text += (is_list(key.type) ? " of " : " ") + range;
  return text;
}

}  // namespace cleave::driver
