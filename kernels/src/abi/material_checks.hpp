// What the array calls of material laws share: the checks of what the caller gave, and where his history
// stands.
#pragma once

#include "abi/checks.hpp"
#include "material/material.hpp"
#include "material/stress.hpp"

namespace cleave::abi {

inline void check_kinematics(std::int32_t kinematics) {
  if (kinematics < CLEAVE_3D || kinematics > CLEAVE_PLANE_STRESS) {
    throw Error(CLEAVE_BAD_ARGUMENT,
                text("kinematics is ", kinematics, "; see enum cleave_kinematics (1 to 3)"));
  }
}

inline Material make_checked(std::int32_t material, std::int32_t kinematics, std::int64_t count,
                             const double* properties) {
  check_kinematics(kinematics);
  const MaterialEntry& entry = find_material(material);
  if (count != static_cast<std::int64_t>(entry.parameters.size())) {
    throw Error(CLEAVE_BAD_ARGUMENT,
                text("law ", entry.name, " takes ", entry.parameters.size(), " properties, not ",
                     count, "; see cleave_parameter_get"));
  }
  required(properties, "properties");
  for (std::size_t k = 0; k < entry.parameters.size(); ++k) {
    const ParameterSpec& spec = entry.parameters[k];
    if (!allowed(spec, properties[k]))
      refuse_value(text("material law ", entry.name), spec, properties[k]);
  }
  return entry.make({properties, entry.parameters.size()}, static_cast<Kinematics>(kinematics));
}

inline std::int64_t history_count(const MaterialEntry& entry) {
  std::int64_t total = 0;
  for (const auto& h : entry.history) total += h.components;
  return total;
}

// All variables of a point one after another; point and component strides in doubles.
inline HistoryArrays history_arrays(const MaterialEntry& entry, double* history, std::int64_t point,
                                    std::int64_t component) {
  HistoryArrays arrays;
  arrays.component_stride = component;
  std::int64_t offset = 0;
  for (std::size_t k = 0; k < entry.history.size(); ++k) {
    arrays.base[k] = &required(history, "history") + component * offset;
    arrays.stride[k] = point;
    offset += entry.history[k].components;
  }
  return arrays;
}

}  // namespace cleave::abi
