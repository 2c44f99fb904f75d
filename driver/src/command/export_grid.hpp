// An exported frame as a grid with vectors and tensors, for VTK.
#pragma once

#include "command/export_data.hpp"
#include "io/vtu.hpp"

namespace cleave::driver {

enum class Configuration { current, reference };

// Points at their current or reference positions. Point data: id, reference_position, displacement and the
// chosen fields; cell data: id, block (from 1), status and the chosen fields. Tensors of plane bodies
// get their zero components back. Without elements every particle is a vertex.
// Throws DeckError for elements that VTK has no cell for.
io::VtuGrid export_grid(const ExportData& data, Configuration configuration);

}  // namespace cleave::driver
