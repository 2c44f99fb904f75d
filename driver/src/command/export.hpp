// `cleave export`: one frame of a result for other programs, as CSV or as a VTK grid.
#pragma once

#include <string>

#include "command/export_data.hpp"
#include "command/export_table.hpp"

namespace cleave::driver {

// Words of the command line; empty: not given.
struct ExportRequest {
  std::string result;
  ExportPart part;
  std::string on;             // CSV: "particles" or "elements"
  std::string configuration;  // vtu: "current" or "reference"
  std::string format;         // "csv" or "vtu"
  std::string output;         // a file, or "-" for CSV to `screen`
};

// Returns the line that says which frame was taken and what was written. The file appears under its name
// when it is complete; the result is never written to.
// Throws DeckError or io::Error.
std::string export_result(const ExportRequest& request, const TextSink& screen);

}  // namespace cleave::driver
