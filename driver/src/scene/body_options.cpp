#include "scene/body_options.hpp"

#include <map>

#include "deck/kernel_tables.hpp"
#include "scene/format.hpp"

namespace cleave::driver {
namespace {

using Index = std::int64_t;

std::size_t at(Index i) { return static_cast<std::size_t>(i); }

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

// Every parameter of `owner`, given or default: a group that is present switches its subject on.
void set_parameters(const DeckGroup& group, const std::string& owner, const char* kernel_group,
                    Index body, Model& model) {
  for (const cleave_parameter& parameter : table_parameters(owner)) {
    if (parameter.type == CLEAVE_CHOICE) {
      check(cleave_body_set_choice(model.handle(), body, kernel_group, parameter.name,
                                   group.text(parameter.name).c_str()));
    } else {
      const double value = parameter.type == CLEAVE_INTEGER
                               ? static_cast<double>(group.integer(parameter.name))
                               : group.real(parameter.name);
      check(cleave_body_set_real(model.handle(), body, kernel_group, parameter.name, value));
    }
  }
}

const DeckGroup& material_of(const Deck& deck, const DeckGroup& body) {
  const DeckGroup* found = nullptr;
  std::vector<std::string> known;
  for (const DeckGroup* material : deck.all("material")) {
    const std::string& name = material->text("name");
    known.push_back(in_quotes(name));
    if (name != body.text("material")) continue;
    if (found != nullptr) {
      deck.fail(*material, "name",
                "two materials are called " + in_quotes(name) + "; give each its own name");
    }
    found = material;
  }
  if (found == nullptr) {
    deck.fail(body, "material",
              "there is no &material with name " + in_quotes(body.text("material")) +
                  "; known: " + list(known));
  }
  return *found;
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
  const DeckGroup& material = material_of(deck, group);
  Index body = 0;
  at_place(deck, group, [&] {
    cleave_body_spec spec{};
    check(cleave_body_spec_init(&spec));
    spec.formulation = value_of(CLEAVE_TABLE_FORMULATION, group.text("formulation"));
    spec.kinematics = kinematics_of(group.text("kinematics"));
    spec.material = value_of(CLEAVE_TABLE_MATERIAL, material.text("law"));
    spec.particles = geometry.particles();
    spec.X = geometry.X.data();
    spec.simplex_count = geometry.simplex_count();
    spec.simplices = geometry.simplices.data();
    spec.name = geometry.name.c_str();
    body = model.add_body(spec);
  });
  at_place(deck, material,
           [&] { set_parameters(material, material.text("law"), "material", body, model); });
}

}  // namespace

void add_bodies(const Deck& deck, const std::vector<BodyGeometry>& bodies, const Sets& sets,
                Model& model) {
  const auto groups = deck.all("body");
  for (std::size_t i = 0; i < groups.size(); ++i) add_body(deck, *groups[i], bodies[i], model);
  for (const cleave_table_entry& option : table_entries(CLEAVE_TABLE_GROUP)) {
    std::vector<const DeckGroup*> applied(bodies.size(), nullptr);
    for (const DeckGroup* group : deck.all(option.name)) {
      for (const Index body : sets.bodies(*group)) {
        if (applied[at(body)] != nullptr) {
          deck.fail(*group, "body " + in_quotes(bodies[at(body)].name) + " already has a &" +
                                option.name + " group in line " +
                                std::to_string(applied[at(body)]->place.line) +
                                "; name the body in each");
        }
        applied[at(body)] = group;
        at_place(deck, *group,
                 [&] { set_parameters(*group, option.name, option.name, body, model); });
      }
    }
  }
}

}  // namespace cleave::driver
