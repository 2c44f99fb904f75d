// The table of all namelist groups and keys: keys.def joined with the parameter tables of the
// kernels. It says what a deck may contain; it holds no deck.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "deck/deck.hpp"
#include "deck/key_range.hpp"

namespace cleave::driver {

struct KeySpec {
  std::string name;
  KeyType type = KeyType::real;
  bool required = false;
  KeyValue
      default_value;  // required: a value of the right type; NaN: computed from other parameters
  std::string units;  // "" or "1" if there are none
  Allowed allowed;
  std::string description;
  std::string since;       // version; "" for parameters of the kernels
  std::string source;      // equation tag; "" for keys of keys.def
  bool parameter = false;  // comes from cleave_parameter_get
};

// Keys that a group has besides its own when its selector key has this value.
struct KeyVariant {
  std::string choice, title;
  std::vector<KeySpec> keys;
};

struct GroupSpec {
  std::string name, description;
  bool once = false;             // at most one in a deck; added with defaults if missing
  bool required = false;         // at least one
  bool parameter_group = false;  // of CLEAVE_TABLE_GROUP; applies to one body or to all
  std::vector<KeySpec> keys;
  std::string selector;  // the key whose choice picks a variant; "" if there are none
  std::vector<KeyVariant> variants;

  // The group's own keys and those of the variant `choice` ("": none), in table order.
  std::vector<const KeySpec*> keys_of(std::string_view choice) const;
  const KeySpec* find(std::string_view key) const;  // own keys and all variants; any case
};

class KeyTable {
 public:
  const std::vector<GroupSpec>& groups() const { return groups_; }
  const GroupSpec* find(std::string_view group) const;  // any case; nullptr if unknown
  std::vector<std::string> group_names() const;
  // Groups with a key that gives names of this kind: "&mesh or &lattice or &points".
  std::string groups_naming(std::string_view kind) const;

 private:
  friend const KeyTable& key_table();
  KeyTable();
  std::vector<GroupSpec> groups_;
};

// Built once, on first use, and never changed.
const KeyTable& key_table();

// Specs of the keys of a group of a deck, one for one.
std::vector<const KeySpec*> key_specs(const DeckGroup& group);

// Namelist names do not tell upper from lower case.
bool same_name(std::string_view a, std::string_view b);

// A value as it would be written in a deck; "" for an empty list or a value to be computed.
std::string value_text(const KeyValue& value);

// "real number [Pa], > 0" and the like: what a key wants.
std::string wanted_text(const KeySpec& key);

}  // namespace cleave::driver
