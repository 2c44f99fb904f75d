// `cleave info`: what a checkpoint, a result file or a history holds.
#pragma once

#include <string>

namespace cleave::driver {

// Throws io::Error if the file cannot be read or is none of these.
std::string file_description(const std::string& path);

}  // namespace cleave::driver
