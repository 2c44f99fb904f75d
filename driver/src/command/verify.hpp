// `cleave info --verify FILE` and `cleave info DIR`: whether files of a run are whole. What is in them
// is told by info.hpp.
#pragma once

#include <functional>
#include <string>

namespace cleave::driver {

struct Verification {
  bool good = false;
  std::string text;  // a line for every thing that fails
};

// Called now and then while a large file is read.
using VerifySay = std::function<void(const std::string& line)>;

// A checkpoint: every checksum. Results, histories and events carry none: their length against what
// their header promises. Throws io::Error if there is no file, DeckError if it is none of these.
Verification verify_file(const std::string& path, const VerifySay& say);

// The checkpoints of a directory, newest first, with their state. Throws DeckError if there is none.
Verification verify_directory(const std::string& path, const VerifySay& say);

}  // namespace cleave::driver
