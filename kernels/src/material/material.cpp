#include "material/material.hpp"

#include "core/error.hpp"

namespace cleave {

namespace {

template <class Law>
Material make_law(std::span<const double> properties, Kinematics kinematics) {
  return Law(properties, kinematics);
}

template <class Law>
constexpr const char* damage_of() {
  if constexpr (requires { Law::kDamage; }) {
    return Law::kDamage;
  } else {
    return nullptr;
  }
}

constexpr std::array kTable = {
#define CLEAVE_MATERIAL(name, value, type, title, source)                        \
  MaterialEntry{CLEAVE_MATERIAL_##name, #name,          title,           source, \
                type::kParameters,      type::kHistory, &make_law<type>, damage_of<type>()},
#include "cleave/tables/materials.def"
};

}  // namespace

std::span<const MaterialEntry> material_table() { return kTable; }

const MaterialEntry& find_material(std::int32_t value) {
  for (const auto& m : kTable)
    if (m.value == value) return m;
  std::string known;
  for (const auto& m : kTable) {
    known += text(known.empty() ? "" : ", ", m.name, " = ", static_cast<int>(m.value));
  }
  throw Error(CLEAVE_UNKNOWN_NAME,
              text("material law ", value, " is unknown; known laws: ", known));
}

}  // namespace cleave
