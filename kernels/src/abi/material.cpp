// What a host asks of a law before it calls it: how much history, which of it is the damage, how fast are
// waves.
#include <string_view>

#include "abi/material_checks.hpp"

using namespace cleave;
using namespace cleave::abi;

extern "C" {

int32_t cleave_material_history_count(int32_t material, int64_t* count) {
  return guarded("cleave_material_history_count",
                 [&] { required(count, "count") = history_count(find_material(material)); });
}

int32_t cleave_material_damage_place(int32_t material, int64_t* place) {
  return guarded("cleave_material_damage_place", [&] {
    const MaterialEntry& entry = find_material(material);
    std::int64_t& found = required(place, "place") = -1;
    if (entry.damage == nullptr) return;
    std::int64_t components = 0;
    for (const auto& h : entry.history) {
      if (std::string_view(h.name) == entry.damage) found = components;
      components += h.components;
    }
  });
}

int32_t cleave_material_wave_speed(int32_t material, int32_t kinematics, int64_t property_count,
                                   const double* properties, double* speed) {
  return guarded("cleave_material_wave_speed", [&] {
    const Material made = make_checked(material, kinematics, property_count, properties);
    required(speed, "speed") = with_law(made, [](const auto& law) { return law.wave_speed(); });
  });
}

}  // extern "C"
