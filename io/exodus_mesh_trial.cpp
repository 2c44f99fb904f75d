// A trial run in a child process, silent and without a core file.
#include "io/exodus_mesh_trial.hpp"

#include <fcntl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <csignal>
#include <exception>

namespace cleave::io {
namespace {

constexpr int kFinished = 71;  // no exit status that a library or sanitizer would choose

// The process may have handlers that belong to the parent's run.
void become_silent(unsigned long cpu_seconds) {
  for (const int signal : {SIGSEGV, SIGBUS, SIGABRT, SIGFPE, SIGILL, SIGXCPU})
    std::signal(signal, SIG_DFL);
  const rlimit no_core{0, 0};
  setrlimit(RLIMIT_CORE, &no_core);
  const rlimit cpu{cpu_seconds, cpu_seconds + 1};  // a child starts with none used
  setrlimit(RLIMIT_CPU, &cpu);
  const int nowhere = open("/dev/null", O_WRONLY);
  dup2(nowhere, STDOUT_FILENO);
  dup2(nowhere, STDERR_FILENO);
}

void write_all(int pipe, const std::string& text) {
  for (std::size_t done = 0; done < text.size();) {
    const ssize_t written = write(pipe, text.data() + done, text.size() - done);
    if (written < 0 && errno != EINTR) return;
    if (written > 0) done += static_cast<std::size_t>(written);
  }
}

std::string read_all(int pipe) {
  std::string text;
  std::array<char, 1024> part{};
  for (;;) {
    const ssize_t got = read(pipe, part.data(), part.size());
    if (got == 0 || (got < 0 && errno != EINTR)) return text;
    if (got > 0) text.append(part.data(), static_cast<std::size_t>(got));
  }
}

[[noreturn]] void run_child(const std::function<void()>& action, unsigned long cpu_seconds,
                            int pipe) {
  become_silent(cpu_seconds);
  try {
    action();
  } catch (const std::exception& error) {
    write_all(pipe, error.what());
  }
  _exit(kFinished);
}

}  // namespace

Trial try_in_child(const std::function<void()>& action, unsigned long cpu_seconds) {
  std::array<int, 2> ends{};
  if (pipe(ends.data()) != 0) return {};
  const pid_t child = fork();
  if (child == 0) run_child(action, cpu_seconds, ends[1]);
  close(ends[1]);
  Trial trial;
  if (child > 0) {
    trial.error = read_all(ends[0]);
    int status = 0;
    pid_t ended = 0;
    do {
      ended = waitpid(child, &status, 0);
    } while (ended < 0 && errno == EINTR);
    trial.crashed = ended == child && !(WIFEXITED(status) && WEXITSTATUS(status) == kFinished);
  }
  close(ends[0]);
  return trial;
}

}  // namespace cleave::io
