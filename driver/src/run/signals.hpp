// Signals during a run. SIGUSR1: write a checkpoint and go on. SIGTERM, SIGINT: finish the step,
// write a checkpoint, stop.
#pragma once

#include <array>
#include <csignal>

namespace cleave::driver {

// While it lives: a second SIGINT has its usual effect, at once; any more SIGTERM is the same
// request, as queues send it to every process of a job and again; a file that grows beyond the
// size limit of the shell is an error of that file and not the end (SIGXFSZ). The former handlers
// come back afterwards, but that of SIGTERM where a stop was asked for: one that comes between the
// end of the run and that of the program changes no exit code.
class Signals {
 public:
  Signals();
  ~Signals();
  Signals(const Signals&) = delete;
  Signals& operator=(const Signals&) = delete;

  bool stop_requested() const;
  // True once for one or more SIGUSR1 since the last call.
  bool take_write_request();

 private:
  std::array<struct sigaction, 4> former_;
};

}  // namespace cleave::driver
