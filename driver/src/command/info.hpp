// `cleave info`: what a checkpoint or a result file holds.
#pragma once

#include <string>

namespace cleave::driver {

// Throws io::Error if the file cannot be read or is none of these.
std::string file_description(const std::string& path);

}  // namespace cleave::driver
