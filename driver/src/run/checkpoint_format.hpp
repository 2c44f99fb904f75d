// What the writer and the reader of checkpoints agree on: format, names of arrays, order of fields.
// Internal to run.
#pragma once

#include <cstdint>
#include <string>

#include "scene/index.hpp"
#include "scene/scene.hpp"

namespace cleave::driver {

inline constexpr std::int64_t kCheckpointFormat = 2;

// Of the fields table, as text.
std::string fields_fingerprint();

inline std::string array_name(const Scene& scene, Index body, const cleave_field& field) {
  return scene.bodies()[at(body)].name + "/" + field.name;
}

// Calls visit(body, field) for every field of the given lifetime, in a fixed order.
template <class Visit>
void for_fields(const Scene& scene, std::int32_t lifetime, Visit visit) {
  for (Index body = 0; body < scene.model().bodies(); ++body) {
    for (const cleave_field& field : scene.model().fields(body)) {
      if (field.lifetime == lifetime) visit(body, field);
    }
  }
}

}  // namespace cleave::driver
