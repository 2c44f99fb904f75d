// Finds files named on the command line, or says which ones there are.
#pragma once

#include <string>

namespace cleave::driver {

// `path` if it is a readable file; else throws DeckError that names the nearest file with the same
// ending in that directory.
std::string existing_file(const std::string& path, const std::string& what);

// The same for a file or a directory.
std::string existing_path(const std::string& path, const std::string& what);

}  // namespace cleave::driver
