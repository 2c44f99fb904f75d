// An exported frame as CSV: one line a particle, or one line an element.
#pragma once

#include <functional>
#include <string>
#include <string_view>

#include "command/export_data.hpp"

namespace cleave::driver {

using TextSink = std::function<void(std::string_view)>;

// id, reference position X Y Z, current position x y z, fields.
void write_particle_table(const ExportData& data, const TextSink& sink);
// id, block, centroids of the reference and the current nodes, numbers of the nodes, fields.
// Throws DeckError if no element is to be exported.
void write_element_table(const ExportData& data, const TextSink& sink);

}  // namespace cleave::driver
