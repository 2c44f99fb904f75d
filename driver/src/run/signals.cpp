#include "run/signals.hpp"

#include <iterator>
#include <tuple>

namespace cleave::driver {
namespace {

// A handler can reach nothing else.
volatile std::sig_atomic_t stop_flag = 0;
volatile std::sig_atomic_t write_flag = 0;

void ask_to_stop(int) { stop_flag = 1; }
void ask_to_write(int) { write_flag = 1; }

struct Handler {
  int signal;
  void (*handle)(int);
  int flags;
};
const Handler handlers[] = {{SIGINT, ask_to_stop, static_cast<int>(SA_RESETHAND) | SA_RESTART},
                            {SIGTERM, ask_to_stop, SA_RESTART},
                            {SIGUSR1, ask_to_write, SA_RESTART},
                            {SIGXFSZ, SIG_IGN, 0}};

}  // namespace

Signals::Signals() {
  static_assert(std::size(handlers) == std::tuple_size_v<decltype(former_)>);
  stop_flag = 0;
  write_flag = 0;
  for (std::size_t i = 0; i < former_.size(); ++i) {
    struct sigaction action = {};
    action.sa_handler = handlers[i].handle;
    action.sa_flags = handlers[i].flags;
    sigemptyset(&action.sa_mask);
    sigaction(handlers[i].signal, &action, &former_[i]);
  }
}

Signals::~Signals() {
  for (std::size_t i = 0; i < former_.size(); ++i) {
    if (stop_requested() && handlers[i].signal == SIGTERM) continue;
    sigaction(handlers[i].signal, &former_[i], nullptr);
  }
}

bool Signals::stop_requested() const { return stop_flag != 0; }

bool Signals::take_write_request() {
  if (write_flag == 0) return false;
  write_flag = 0;  // before the state is taken: a later signal asks for a later state
  return true;
}

}  // namespace cleave::driver
