// What a run tells the person who waits: a banner, a status line per interval, a last line. On
// standard output; with --quiet only warnings, on standard error. On a terminal the status line is
// rewritten in place with a bar.
#pragma once

#include <chrono>
#include <string>
#include <vector>

#include "run/stepping.hpp"
#include "run/time_step.hpp"
#include "scene/scene.hpp"

namespace cleave::driver {

class Progress {
 public:
  Progress(bool quiet, const DeckGroup& run);

  void banner(const Scene& scene, const TimeStep& step, std::int64_t first_step);
  void note(const std::string& line);
  void warn(const std::string& text);

  // Whether the wall time between status lines has passed.
  bool due() const;
  void status(const Model& model, const Clock& clock, std::int64_t step, const cleave_energies& e);
  // One static increment: while it is sought, now and then, and what it took.
  void relaxing(const Clock& clock, std::int64_t step, const StepReport& so_far);
  void solving(const Clock& clock, std::int64_t step, double time, const StepReport& so_far);
  void increment_done(const Clock& clock, std::int64_t step, const StepReport& report);
  void finish(const std::string& what, const std::vector<std::string>& files);

  double seconds() const;  // since the run began

 private:
  using WallClock = std::chrono::steady_clock;
  void print(const std::string& text, bool stays);

  bool quiet_, terminal_;
  double every_;
  WallClock::time_point begin_, last_, last_relaxing_;
  std::int64_t first_step_ = 0, last_step_ = 0, particles_ = 0;
  int warnings_ = 0;
  bool line_open_ = false;
};

// Hours, minutes and seconds: "2:05:09", "0:17", below ten seconds "1.2 s".
std::string duration_text(double seconds);
// Bytes: "12.3 MB".
std::string bytes_text(std::int64_t bytes);

}  // namespace cleave::driver
