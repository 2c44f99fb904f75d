#include "scene/body_options.hpp"

#include <cmath>
#include <map>

#include "deck/kernel_tables.hpp"
#include "scene/format.hpp"
#include "scene/index.hpp"

namespace cleave::driver {
namespace {

std::int32_t kinematics_of(const std::string& name) {
  static const std::map<std::string, std::int32_t> values{{"3d", CLEAVE_3D},
                                                          {"plane_strain", CLEAVE_PLANE_STRAIN},
                                                          {"plane_stress", CLEAVE_PLANE_STRESS}};
  return values.at(name);
}

std::int32_t value_of(std::int32_t table, const std::string& name) {
  std::int32_t value = 0;
  check(cleave_table_find(table, name.c_str(), &value));
  return value;
}

// Every parameter of the group, given or default: a group that is present switches its subject on.
void set_parameters(const DeckGroup& group, const char* kernel_group, Index body, Model& model) {
  for (const DeckKey& key : group.keys) {
    if (!key.parameter) continue;
    const char* name = key.name.c_str();
    if (const auto* choice = std::get_if<std::string>(&key.value)) {
      check(cleave_body_set_choice(model.handle(), body, kernel_group, name, choice->c_str()));
    } else {
      const auto* integer = std::get_if<std::int64_t>(&key.value);
      const double value =
          integer != nullptr ? static_cast<double>(*integer) : std::get<double>(key.value);
      // A default that is not a number is computed by the kernels.
      if (!std::isfinite(value)) continue;
      check(cleave_body_set_real(model.handle(), body, kernel_group, name, value));
    }
  }
}

// Runs a call of the kernels; an error is answered with the place of `group`.
template <class Call>
void at_place(const Deck& deck, const DeckGroup& group, Call call) {
  try {
    call();
  } catch (const KernelError& error) {
    deck.fail(group, error.what());
  }
}

void add_body(const Deck& deck, const DeckGroup& group, const BodyGeometry& geometry,
              Model& model) {
  const DeckGroup& material = named_group(deck, {"material"}, group.text("material"));
  Index body = 0;
  at_place(deck, group, [&] {
    cleave_body_spec spec{};
    check(cleave_body_spec_init(&spec));
    spec.formulation = value_of(CLEAVE_TABLE_FORMULATION, group.text("formulation"));
    spec.kinematics = kinematics_of(group.text("kinematics"));
    spec.material = value_of(CLEAVE_TABLE_MATERIAL, material.text("law"));
    spec.particles = geometry.particles();
    spec.X = geometry.X.data();
    std::vector<Index> simplices;
    if (!geometry.cloud) {
      simplices.assign(geometry.simplices.begin(), geometry.simplices.end());
      spec.simplex_count = geometry.simplex_count();
      spec.simplices = simplices.data();
      spec.simplex_nodes = static_cast<std::int32_t>(geometry.simplex_nodes());
    }
    spec.name = geometry.name.c_str();
    body = model.add_body(spec);
    if (!geometry.volumes.empty())
      check(cleave_body_volumes(model.handle(), body, std::ssize(geometry.volumes),
                                geometry.volumes.data()));
  });
  at_place(deck, material, [&] { set_parameters(material, "material", body, model); });
}

// Another material for the particles of a &region.
void add_region(const Deck& deck, const DeckGroup& group, const Sets& sets, Model& model) {
  const DeckGroup& material = named_group(deck, {"material"}, group.text("material"));
  const std::string& law = material.text("law");
  std::vector<double> properties;
  for (const cleave_parameter& parameter : table_parameters(law))
    properties.push_back(material.real(parameter.name));
  for (const Selection& selection : sets.select(group)) {
    at_place(deck, group, [&] {
      check(cleave_body_region(model.handle(), selection.body, std::ssize(selection.particles),
                               selection.particles.data(), value_of(CLEAVE_TABLE_MATERIAL, law),
                               std::ssize(properties), properties.data(),
                               group.real("critical_strain"), group.real("Gf")));
    });
  }
}

}  // namespace

void add_bodies(const Deck& deck, const std::vector<BodyGeometry>& bodies, const Sets& sets,
                Model& model) {
  const auto groups = deck.all("body");
  for (std::size_t i = 0; i < groups.size(); ++i) add_body(deck, *groups[i], bodies[i], model);
  for (const DeckGroup* region : deck.all("region")) add_region(deck, *region, sets, model);
  for (const cleave_table_entry& option : table_entries(CLEAVE_TABLE_GROUP)) {
    for (const DeckGroup* group : deck.all(option.name)) {
      for (const Index body : sets.bodies(*group)) {
        at_place(deck, *group, [&] { set_parameters(*group, option.name, body, model); });
      }
    }
  }
}

}  // namespace cleave::driver
