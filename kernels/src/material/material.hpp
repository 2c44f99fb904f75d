// All laws of the materials table as one value, and the table as data.
//
// A law is a class with: static kParameters, static kHistory, a constructor from property values
// and kinematics, density, youngs_modulus, shear_modulus, wave_speed, respond<D>,
// thickness_stretch; kDamage, the name of its damage variable, if it has one; kAnswersByState, true if
// stress and energy after a step follow from the deformation and the history then, without rates.
// `respond` writes its history only if its answer is valid. Loops over points visit the variant once
// and then call the law directly.
#pragma once

#include <span>
#include <variant>

#include "core/error.hpp"
#include "material/j2.hpp"
#include "material/johnson_cook.hpp"
#include "material/linear_elastic.hpp"
#include "material/mie_gruneisen.hpp"
#include "material/neo_hooke.hpp"
#include "material/svk.hpp"

namespace cleave {

// One alternative a table line; monostate until the properties are known.
using Material = std::variant<std::monostate
#define CLEAVE_MATERIAL(name, value, type, title, source) , type
#include "cleave/tables/materials.def"
                              >;

struct MaterialEntry {
  cleave_material value;
  const char* name;
  const char* title;
  const char* source;
  std::span<const ParameterSpec> parameters;
  std::span<const FieldSpec> history;
  Material (*make)(std::span<const double>, Kinematics);
  const char* damage;  // history variable that is 1 where the material has failed; NULL: none
};

std::span<const MaterialEntry> material_table();
// Throws UNKNOWN_NAME with the known laws.
const MaterialEntry& find_material(std::int32_t value);

// Calls f(law). The law must have been made.
template <class F>
auto with_law(const Material& material, const F& f) {
  return std::visit(
      [&](const auto& law) -> decltype(f(std::get<1>(material))) {
        if constexpr (std::is_same_v<std::decay_t<decltype(law)>, std::monostate>) {
          throw Error(CLEAVE_INTERNAL, "a material law was used before it was made");
        } else {
          return f(law);
        }
      },
      material);
}

}  // namespace cleave
