#include "command/tables.hpp"

#include <array>

#include "deck/kernel_tables.hpp"
#include "deck/key_table.hpp"
#include "deck/nearest_name.hpp"
#include "deck/number_text.hpp"
#include "deck/units.hpp"

namespace cleave::driver {
namespace {

const char* relation_text(std::int32_t relation) {
  switch (relation) {
    case CLEAVE_RELATION_BODY:
      return "body";
    case CLEAVE_RELATION_POINT:
      return "particle";
    case CLEAVE_RELATION_BOND:
      return "bond";
    case CLEAVE_RELATION_SIMPLEX:
      return "simplex";
    case CLEAVE_RELATION_INTEGRATION_POINT:
      return "integration point";
    case CLEAVE_RELATION_HALF_BOND:
      return "half-bond";
    default:
      return "?";
  }
}

const char* lifetime_text(std::int32_t lifetime) {
  switch (lifetime) {
    case CLEAVE_LIFETIME_SETUP:
      return "setup";
    case CLEAVE_LIFETIME_STATE:
      return "state";
    case CLEAVE_LIFETIME_CACHE:
      return "cache";
    case CLEAVE_LIFETIME_SCRATCH:
      return "scratch";
    case CLEAVE_LIFETIME_DERIVED:
      return "derived";
    default:
      return "?";
  }
}

std::string shape_text(const cleave_field& field) {
  const char* type = field.type == CLEAVE_INTEGER ? "integer" : "real";
  switch (field.components) {
    case 1:
      return std::string(type) + " scalar";
    case 3:
      return std::string(type) + " vector";
    case 9:
      return std::string(type) + " tensor";
    default:
      return std::string(type) + " x " + std::to_string(field.components);
  }
}

std::string name_in(const char* name, TextFormat format) {
  return format == TextFormat::markdown ? code(name) : name;
}

TextTable fields(TextFormat format) {
  TextTable table{
      {"field", "units", "of each", "shape", "lifetime", "written", "owner", "description"}, {}};
  for (const cleave_field& field : table_fields()) {
    std::string description = field.description;
    if (*field.rebuild != '\0') description += " (from: " + std::string(field.rebuild) + ")";
    table.rows.push_back(
        {name_in(field.name, format), in_brackets(field.units), relation_text(field.relation),
         shape_text(field), lifetime_text(field.lifetime),
         field.output != 0 ? "by default" : "on request", field.owner, description});
  }
  return table;
}

TextTable entries(cleave_table which, TextFormat format) {
  TextTable table{{"name", "what it is", "source"}, {}};
  for (const cleave_table_entry& entry : table_entries(which))
    table.rows.push_back({name_in(entry.name, format), entry.title, entry.source});
  return table;
}

TextTable status(TextFormat format) {
  TextTable table{{"code", "name", "meaning"}, {}};
  for (const cleave_table_entry& entry : table_entries(CLEAVE_TABLE_STATUS))
    table.rows.push_back({std::to_string(entry.value),
                          name_in(("CLEAVE_" + std::string(entry.name)).c_str(), format),
                          entry.title});
  return table;
}

TextTable units(TextFormat format) {
  TextTable table{{"units", "mass [kg]", "length [m]", "time [s]", "force, stress, energy"}, {}};
  for (const UnitSet& set : unit_sets())
    table.rows.push_back({name_in(set.name, format), short_text(set.mass), short_text(set.length),
                          short_text(set.time), set.derived});
  return table;
}

struct Listing {
  const char* name;
  TextTable (*make)(TextFormat);
};

constexpr std::array kListings = {
    Listing{"fields", fields},
    Listing{"materials", [](TextFormat f) { return entries(CLEAVE_TABLE_MATERIAL, f); }},
    Listing{"formulations", [](TextFormat f) { return entries(CLEAVE_TABLE_FORMULATION, f); }},
    Listing{"groups", [](TextFormat f) { return entries(CLEAVE_TABLE_GROUP, f); }},
    Listing{"status", status},
    Listing{"units", units},
};

}  // namespace

std::vector<std::string> listed_tables() {
  std::vector<std::string> names;
  for (const Listing& listing : kListings) names.emplace_back(listing.name);
  return names;
}

std::string table_listing(const std::string& name, TextFormat format) {
  for (const Listing& listing : kListings)
    if (name == listing.name) return to_text(listing.make(format), format);
  throw DeckError("there is no table \"" + name + "\"" + did_you_mean(name, listed_tables()) +
                  " Known tables: " + listed(listed_tables()) + ".");
}

}  // namespace cleave::driver
