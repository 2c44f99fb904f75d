// A trial run of what may crash. Internal to io.
#pragma once

#include <functional>

namespace cleave::io {

// Runs `action` in a child process and tells whether it came to an end there, be it with an
// exception. For the HDF5 library, which crashes on some damaged files: after the trial the caller can
// do the same itself. True if no child can be started.
bool survives(const std::function<void()>& action);

}  // namespace cleave::io
