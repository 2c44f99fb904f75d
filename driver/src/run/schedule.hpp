// When something is due: by step counts and simulated time, never by running sums.
#pragma once

#include <cmath>
#include <cstdint>

#include "deck/deck.hpp"

namespace cleave::driver {

// Time of step n is n * dt.
struct Clock {
  double dt = 0;
  std::int64_t steps = 0;  // of the whole run
  double time(std::int64_t step) const { return static_cast<double>(step) * dt; }
};

class Schedule {
 public:
  // From the keys every_time and every_steps of a group; both zero: never.
  Schedule(const DeckGroup& group, double dt)
      : Schedule(group.real("every_time"), group.integer("every_steps"), dt) {}
  Schedule(double every_time, std::int64_t every_steps, double dt)
      : every_time_(every_time), every_steps_(every_steps), dt_(dt) {}

  bool never() const { return every_time_ <= 0 && every_steps_ <= 0; }
  // By time: at the first step that reaches a multiple of every_time, within a millionth of a step.
  bool due(std::int64_t step) const {
    if (every_steps_ > 0 && step % every_steps_ == 0) return true;
    return every_time_ > 0 && multiples(step) > multiples(step - 1);
  }

 private:
  double multiples(std::int64_t step) const {
    return std::floor((static_cast<double>(step) + 1e-6) * dt_ / every_time_);
  }
  double every_time_;
  std::int64_t every_steps_;
  double dt_;
};

}  // namespace cleave::driver
