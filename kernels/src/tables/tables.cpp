#include "tables/tables.hpp"

#include <array>
#include <vector>

#include "core/error.hpp"
#include "formulation/cbm/parameters.hpp"
#include "formulation/meshless/parameters.hpp"
#include "formulation/peridynamics/parameters.hpp"
#include "formulation/vcpm/parameters.hpp"
#include "material/material.hpp"

namespace cleave {

namespace {

constexpr std::array kStatus = {
#define CLEAVE_STATUS(name, value, text) TableEntry{CLEAVE_##name, #name, text, ""},
#include "cleave/tables/status.def"
};

constexpr std::array kFormulations = {
#define CLEAVE_FORMULATION(name, value, type, title, source) \
  TableEntry{CLEAVE_FORMULATION_##name, #name, title, source},
#include "cleave/tables/formulations.def"
};

constexpr std::array kGroups = {
#define CLEAVE_GROUP(name, specs, title, source) ParameterGroup{#name, title, source, specs},
#include "tables/groups.def"
};

#define CLEAVE_FIELD_SPEC(name, relation, components, type, units, lifetime, exchange, output, \
                          rebuild, description)                                                \
  FieldSpec{#name,                                                                             \
            CLEAVE_RELATION_##relation,                                                        \
            components,                                                                        \
            CLEAVE_##type,                                                                     \
            units,                                                                             \
            CLEAVE_LIFETIME_##lifetime,                                                        \
            Exchange::exchange,                                                                \
            output != 0,                                                                       \
            rebuild,                                                                           \
            description},
constexpr std::array kCoreFields = {
#define CLEAVE_FIELD CLEAVE_FIELD_SPEC
#include "tables/fields.def"
};
constexpr std::array kCbmFields = {
#define CLEAVE_FIELD CLEAVE_FIELD_SPEC
#include "formulation/cbm/fields.def"
};
constexpr std::array kKernelMethodFields = {
#define CLEAVE_FIELD CLEAVE_FIELD_SPEC
#include "formulation/meshless/fields.def"
};
constexpr std::array kFemFields = {
#define CLEAVE_FIELD CLEAVE_FIELD_SPEC
#include "formulation/fem/fields.def"
};
constexpr std::array kPeridynamicFields = {
#define CLEAVE_FIELD CLEAVE_FIELD_SPEC
#include "formulation/peridynamics/fields.def"
};

constexpr std::array kVcpmFields = {
#define CLEAVE_FIELD CLEAVE_FIELD_SPEC
#include "formulation/peridynamics/fields.def"
#define CLEAVE_FIELD CLEAVE_FIELD_SPEC
#include "formulation/vcpm/fields.def"
};

std::vector<FieldOwner> make_field_owners() {
  std::vector<FieldOwner> owners = {
      {"core", kCoreFields},         {"cbm", kCbmFields},         {"tlsph", kKernelMethodFields},
      {"nosb", kKernelMethodFields}, {"fem", kFemFields},         {"bond_pd", kPeridynamicFields},
      {"cpd", kPeridynamicFields},   {"lps", kPeridynamicFields}, {"vcpm", kVcpmFields}};
  for (const auto& m : material_table()) owners.push_back({m.name, m.history});
  return owners;
}

}  // namespace

std::span<const TableEntry> status_table() { return kStatus; }
std::span<const TableEntry> formulation_table() { return kFormulations; }
std::span<const ParameterGroup> parameter_groups() { return kGroups; }

std::span<const ParameterSpec> parameters_of(std::string_view owner) {
  for (const auto& m : material_table())
    if (owner == m.name) return m.parameters;
  for (const auto& g : kGroups)
    if (owner == g.name) return g.specs;
  std::string known;
  for (const auto& m : material_table()) known += text(known.empty() ? "" : ", ", m.name);
  for (const auto& g : kGroups) known += text(", ", g.name);
  throw Error(CLEAVE_UNKNOWN_NAME,
              text("'", owner, "' has no parameters; known material laws and groups: ", known));
}

std::span<const FieldOwner> field_owners() {
  static const std::vector<FieldOwner> owners = make_field_owners();
  return owners;
}

std::span<const FieldSpec> fields_of(std::string_view owner) {
  for (const auto& o : field_owners()) {
    if (owner == o.name) return o.specs;
  }
  return {};
}

std::uint64_t field_table_fingerprint() {
  std::uint64_t hash = 14695981039346656037ull;
  const auto mix = [&hash](std::string_view s) {
    for (const char c : s) hash = (hash ^ static_cast<unsigned char>(c)) * 1099511628211ull;
    hash = (hash ^ 0xffu) * 1099511628211ull;  // end of column
  };
  for (const auto& owner : field_owners()) {
    for (const auto& f : owner.specs) {
      mix(owner.name);
      mix(f.name);
      mix(f.units);
      mix(text(f.relation, ' ', f.components, ' ', f.type, ' ', f.lifetime));
    }
  }
  return hash;
}

}  // namespace cleave
