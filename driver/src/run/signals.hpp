// SIGINT and SIGTERM during a run: finish the step, write a checkpoint, stop.
#pragma once

#include <csignal>

namespace cleave::driver {

// While it lives, the first SIGINT or SIGTERM sets a flag; a second one has its usual effect. The
// former handlers come back afterwards.
class StopRequest {
 public:
  StopRequest();
  ~StopRequest();
  StopRequest(const StopRequest&) = delete;
  StopRequest& operator=(const StopRequest&) = delete;
  bool requested() const;

 private:
  struct sigaction old_interrupt_, old_terminate_;
};

}  // namespace cleave::driver
