// Work in a child process that is killed, to see what it leaves in its files.
#pragma once

#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdint>
#include <stdexcept>

// Runs `work(report)` in a child. The child calls report() after each step it is sure of; after the
// step `last` and another `microseconds` it is killed. Returns the number of steps reported in all.
template <class Work>
std::int64_t steps_before_kill(Work&& work, std::int64_t last, unsigned microseconds) {
  int ends[2];
  if (pipe(ends) != 0) throw std::runtime_error("no pipe");
  const pid_t child = fork();
  if (child < 0) throw std::runtime_error("no child process");
  if (child == 0) {
    close(ends[0]);
    work([&] {
      if (write(ends[1], "x", 1) != 1) _exit(1);
    });
    pause();  // killed here at the latest
    _exit(0);
  }
  close(ends[1]);
  std::int64_t steps = 0;
  char step = 0;
  while (steps < last && read(ends[0], &step, 1) == 1) ++steps;
  usleep(microseconds);
  kill(child, SIGKILL);
  while (read(ends[0], &step, 1) == 1) ++steps;
  close(ends[0]);
  waitpid(child, nullptr, 0);
  return steps;
}
