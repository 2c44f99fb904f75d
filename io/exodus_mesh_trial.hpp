// A trial run of what may crash. Internal to io.
#pragma once

#include <functional>
#include <string>

namespace cleave::io {

struct Trial {
  bool crashed = false;  // or did not come to an end
  std::string error;     // of the exception, if `action` threw one
};

// Runs `action` in a child process first. For the HDF5 library, which crashes on some damaged files
// (and leaks memory or never returns on others): only if the trial went well should the caller do the
// same itself. The child is ended after that much processor time. If no child can be started, the
// trial counts as gone well.
Trial try_in_child(const std::function<void()>& action, unsigned long cpu_seconds);

}  // namespace cleave::io
