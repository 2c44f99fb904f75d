// When a checkpoint is due, and when a run has to stop with one.
//
// It decides and does nothing: it is told the step, the wall time and what was asked for from
// outside. Steps and simulated time are judged apart from wall time; neither changes a result.
#pragma once

#include <cstdint>
#include <string>

#include "run/schedule.hpp"

namespace cleave::driver {

// What has been asked for from outside the run.
struct CheckpointRequests {
  bool write = false, stop = false;  // by a signal
  bool stop_file = false;
};

enum class CheckpointAction { none, write, stop };

struct CheckpointVerdict {
  CheckpointAction action = CheckpointAction::none;
  std::string why;  // "stopped ..." or "checkpoint written ..."; empty for what the deck plans
};

// Limits in seconds of wall time; 0: none.
struct WallKeys {
  double every = 0;
  double limit = 0;  // counted from the start of the program
};

// The slowest of the last one to two thousand steps.
class RecentSlowest {
 public:
  void add(double seconds);
  double value() const { return before_ > now_ ? before_ : now_; }

 private:
  double before_ = 0, now_ = 0;
  int count_ = 0;
};

class CheckpointTrigger {
 public:
  // `bytes`: about the size of a checkpoint, for the cost of one before any was written.
  CheckpointTrigger(const Schedule& schedule, const WallKeys& wall, std::int64_t bytes);

  // Wall times are seconds since the start of the program.
  void begin(double wall);
  // After every step. The limit is judged after a step only, so that a run that is started over and
  // over makes progress even if its set-up takes all the time.
  CheckpointVerdict after_step(std::int64_t step, double wall, const CheckpointRequests& requests);
  // In the middle of a step that takes long, whose start is kept: stop, or none.
  CheckpointVerdict within_step(double wall, const CheckpointRequests& requests) const;
  // The same where the run can go on from the present state: written too when asked for, or by wall time.
  CheckpointVerdict at_event(double wall, const CheckpointRequests& requests) const;
  // A checkpoint was written, or tried in vain, between these wall times.
  void attempted(double from, double to);

  // Wall time kept free for one more step and a checkpoint.
  double reserve() const;

 private:
  double checkpoint_time() const;

  Schedule schedule_;
  WallKeys wall_;
  double cost_;  // of a checkpoint: estimated, then the longest so far
  bool measured_ = false;
  double last_attempt_ = 0, step_began_ = 0;
  RecentSlowest slowest_step_;
};

}  // namespace cleave::driver
