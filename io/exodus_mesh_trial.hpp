// A trial run of what may crash. Internal to io.
#pragma once

#include <functional>
#include <string>

namespace cleave::io {

struct Trial {
  bool crashed = false;
  std::string error;  // of the exception, if `action` threw one
};

// Runs `action` in a child process first. For the HDF5 library, which crashes on some damaged files
// (and leaks memory on others): only if the trial went well should the caller do the same itself.
// If no child can be started, the trial counts as gone well.
Trial try_in_child(const std::function<void()>& action);

}  // namespace cleave::io
