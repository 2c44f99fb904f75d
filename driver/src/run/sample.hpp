// `cleave sample`: fields of a checkpoint at given points, for comparing discretisations and for plots.
#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace cleave::driver {

struct SampleRequest {
  std::string checkpoint;           // file, or directory: its newest that verifies
  std::string points;               // CSV with columns X, Y (and Z): reference positions
  std::string body;                 // empty: the only one
  std::vector<std::string> fields;  // stored and derived fields of particles and integration points
};

// Writes CSV to `out`: X, Y, Z, inside (0 or 1), fields; one line a point, zero outside of the body.
// Throws DeckError or io::Error.
void sample_checkpoint(const SampleRequest& request,
                       const std::function<void(std::string_view)>& out);

}  // namespace cleave::driver
