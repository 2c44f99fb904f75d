#include "command/export_fields.hpp"

#include <algorithm>
#include <string_view>

#include "deck/deck.hpp"
#include "deck/nearest_name.hpp"

namespace cleave::driver {
namespace {

enum class Suffix { none, axis, pair, number };

// "cauchy_stress_xy" is "cauchy_stress" and "xy".
struct Part {
  std::string base, component;
  Suffix suffix = Suffix::none;
};

bool all_in(std::string_view text, std::string_view letters) {
  return text.find_first_not_of(letters) == std::string_view::npos;
}

Part split(const std::string& name) {
  for (const char* axis : {"x", "y", "z"}) {
    const char upper = static_cast<char>(*axis - 'a' + 'A');
    if (name == std::string("DISPL") + upper) return {"displacement", axis, Suffix::axis};
  }
  const std::size_t mark = name.rfind('_');
  if (mark == std::string::npos || mark == 0 || mark + 1 == name.size()) return {name, "", {}};
  const std::string component = name.substr(mark + 1);
  Suffix suffix = Suffix::none;
  if (component.size() <= 2 && all_in(component, "xyz")) {
    suffix = component.size() == 1 ? Suffix::axis : Suffix::pair;
  } else if (all_in(component, "0123456789")) {
    suffix = Suffix::number;
  }
  if (suffix == Suffix::none) return {name, "", suffix};
  return {name.substr(0, mark), component, suffix};
}

ExportField single(const ExportField& field, std::size_t component) {
  return {field.column(component), field.units, {}, {field.variables[component]}};
}

// The field that goes by `name`, or the component of one; nothing if there is none.
std::vector<ExportField> find_field(const std::vector<ExportField>& fields,
                                    const std::vector<io::ResultVariable>& variables,
                                    const std::string& name) {
  for (const ExportField& field : fields) {
    if (field.name == name) return {field};
    for (std::size_t c = 0; c < field.variables.size(); ++c) {
      const std::string& stored = variables[field.variables[c]].name;
      if (field.column(c) == name || stored == name) return {single(field, c)};
    }
  }
  return {};
}

std::vector<std::string> names_of(const std::vector<ExportField>& fields) {
  std::vector<std::string> names;
  for (const ExportField& field : fields) names.push_back(field.name);
  return names;
}

[[noreturn]] void refuse(const io::StoredResults& results, const std::string& name,
                         const ExportFields& all) {
  const std::vector<std::string> nodal = names_of(all.nodal), element = names_of(all.element);
  std::vector<std::string> known = nodal;
  known.insert(known.end(), element.begin(), element.end());
  const auto shown = [](const std::vector<std::string>& names) {
    return names.empty() ? "none" : listed(names);
  };
  throw DeckError(results.path + ": there is no field \"" + name + "\"" +
                  did_you_mean(name, known) + " Fields of particles: " + shown(nodal) +
                  ". Fields of elements: " + shown(element) +
                  ". The key `fields` of &output says what a run writes.");
}

void add_once(std::vector<ExportField>& fields, const std::vector<ExportField>& found) {
  for (const ExportField& field : found) {
    const bool known = std::any_of(fields.begin(), fields.end(),
                                   [&](const ExportField& f) { return f.name == field.name; });
    if (!known) fields.push_back(field);
  }
}

}  // namespace

std::string ExportField::column(std::size_t component) const {
  return components.empty() ? name : name + '_' + components[component];
}

std::vector<ExportField> joined_fields(const std::vector<io::ResultVariable>& variables) {
  std::vector<ExportField> fields;
  Part last;
  for (std::size_t v = 0; v < variables.size(); ++v) {
    const Part part = split(variables[v].name);
    const bool follows = part.suffix != Suffix::none && !fields.empty() &&
                         part.suffix == last.suffix && part.base == last.base;
    if (!follows) fields.push_back({part.base, variables[v].units, {}, {}});
    ExportField& field = fields.back();
    if (part.suffix != Suffix::none) field.components.push_back(part.component);
    field.variables.push_back(v);
    last = part;
  }
  for (ExportField& field : fields) {  // a lone "history_3" is no vector
    if (field.components.size() == 1) field = single(field, 0);
  }
  return fields;
}

ExportFields chosen_fields(const io::StoredResults& results,
                           const std::vector<std::string>& names) {
  const ExportFields all{joined_fields(results.nodal), joined_fields(results.element)};
  if (names.empty()) return all;
  ExportFields chosen;
  for (const std::string& name : names) {
    // In a deck the status of elements is the field simplex_alive.
    const std::string wanted = name == "simplex_alive" ? "status" : name;
    const auto nodal = find_field(all.nodal, results.nodal, wanted);
    const auto element = find_field(all.element, results.element, wanted);
    if (nodal.empty() && element.empty()) refuse(results, name, all);
    add_once(chosen.nodal, nodal);
    add_once(chosen.element, element);
  }
  return chosen;
}

}  // namespace cleave::driver
