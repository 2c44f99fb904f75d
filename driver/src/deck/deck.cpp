#include "deck/deck.hpp"

#include <algorithm>

#include "deck/mistakes.hpp"
#include "deck/unit_text.hpp"

namespace cleave::driver {
namespace {

template <class T>
const T& value_as(const DeckGroup& group, const char* name) {
  const T* value = std::get_if<T>(&group.key(name).value);
  if (!value)
    throw std::logic_error("key " + std::string(name) + " of &" + group.name +
                           " is asked for as another type than keys.def gives it");
  return *value;
}

}  // namespace

const DeckKey& DeckGroup::key(const char* name_wanted) const {
  const auto at = std::find_if(keys.begin(), keys.end(),
                               [&](const DeckKey& k) { return k.name == name_wanted; });
  if (at == keys.end())
    throw std::logic_error("&" + name + " has no key " + std::string(name_wanted) + " in keys.def");
  return *at;
}

double DeckGroup::real(const char* key_name) const { return value_as<double>(*this, key_name); }
std::int64_t DeckGroup::integer(const char* key_name) const {
  return value_as<std::int64_t>(*this, key_name);
}
bool DeckGroup::logical(const char* key_name) const { return value_as<bool>(*this, key_name); }
const std::string& DeckGroup::text(const char* key_name) const {
  return value_as<std::string>(*this, key_name);
}
const std::vector<double>& DeckGroup::reals(const char* key_name) const {
  return value_as<std::vector<double>>(*this, key_name);
}
const std::vector<std::string>& DeckGroup::texts(const char* key_name) const {
  return value_as<std::vector<std::string>>(*this, key_name);
}
bool DeckGroup::given(const char* key_name) const { return key(key_name).given; }

const DeckGroup& Deck::one(const char* group) const {
  for (const DeckGroup& g : groups)
    if (g.name == group) return g;
  throw std::logic_error("the deck has no &" + std::string(group));
}

std::vector<const DeckGroup*> Deck::all(const char* group) const {
  std::vector<const DeckGroup*> list;
  for (const DeckGroup& g : groups)
    if (g.name == group) list.push_back(&g);
  return list;
}

std::string Deck::units() const {
  for (const DeckGroup* run : all("run"))
    if (const auto* name = std::get_if<std::string>(&run->key("units").value)) return *name;
  return {};
}

std::string Deck::in_units(const std::string& message) const {
  return UnitText(units()).in_message(message);
}

void Deck::fail(const DeckGroup& group, const char* key, const std::string& message) const {
  throw DeckError(message_at(source, group.key(key).place, in_units(message)));
}

void Deck::fail(const DeckGroup& group, const std::string& message) const {
  throw DeckError(message_at(source, group.place, in_units(message)));
}

}  // namespace cleave::driver
