#include "run/checkpoint_trigger.hpp"

#include <algorithm>

#include "run/progress.hpp"

namespace cleave::driver {
namespace {

// Writing, flushing, reading back and comparing: what a busy network disk does.
constexpr double kSlowDisk = 50e6;  // bytes/s
// Disks are shared: the next checkpoint may take longer than all before, ...
constexpr double kMargin = 1.5;
// ... a small one by the time in which a busy disk answers at all.
constexpr double kLatency = 0.5;  // s
constexpr int kRecentSteps = 1000;

}  // namespace

void RecentSlowest::add(double seconds) {
  if (count_ == kRecentSteps) {
    before_ = now_;
    now_ = 0;
    count_ = 0;
  }
  now_ = std::max(now_, seconds);
  ++count_;
}

CheckpointTrigger::CheckpointTrigger(const Schedule& schedule, const WallKeys& wall,
                                     std::int64_t bytes)
    : schedule_(schedule), wall_(wall), cost_(static_cast<double>(bytes) / kSlowDisk) {}

void CheckpointTrigger::begin(double wall) { last_attempt_ = step_began_ = wall; }

CheckpointVerdict CheckpointTrigger::after_step(std::int64_t step, double wall,
                                                const CheckpointRequests& requests) {
  using enum CheckpointAction;
  slowest_step_.add(wall - step_began_);
  step_began_ = wall;
  if (requests.stop) return {stop, "stopped on request"};
  if (requests.stop_file) return {stop, "stopped by the stop file"};
  const bool due = requests.write || schedule_.due(step) ||
                   (wall_.every > 0 && wall - last_attempt_ >= wall_.every);
  // One that is due takes the time for that before the limit: then it is the last.
  const double needed = due ? checkpoint_time() + reserve() : reserve();
  if (wall_.limit > 0 && wall + needed > wall_.limit) {
    return {stop, "stopped for the wall-time limit of " + duration_text(wall_.limit)};
  }
  if (requests.write) return {write, "checkpoint written on request"};
  if (due) return {write, {}};
  return {};
}

CheckpointVerdict CheckpointTrigger::within_step(double wall,
                                                 const CheckpointRequests& requests) const {
  using enum CheckpointAction;
  if (requests.stop) return {stop, "stopped on request"};
  if (requests.stop_file) return {stop, "stopped by the stop file"};
  if (wall_.limit > 0 && wall + checkpoint_time() > wall_.limit)
    return {stop, "stopped for the wall-time limit of " + duration_text(wall_.limit)};
  return {};
}

CheckpointVerdict CheckpointTrigger::at_event(double wall,
                                              const CheckpointRequests& requests) const {
  using enum CheckpointAction;
  CheckpointVerdict verdict = within_step(wall, requests);
  if (verdict.action == stop) return verdict;
  if (requests.write) return {write, "checkpoint written on request"};
  if (wall_.every > 0 && wall - last_attempt_ >= wall_.every) return {write, {}};
  return {};
}

void CheckpointTrigger::attempted(double from, double to) {
  cost_ = measured_ ? std::max(cost_, to - from) : to - from;
  measured_ = true;
  last_attempt_ = step_began_ = to;
}

double CheckpointTrigger::checkpoint_time() const { return kMargin * cost_ + kLatency; }

double CheckpointTrigger::reserve() const { return slowest_step_.value() + checkpoint_time(); }

}  // namespace cleave::driver
