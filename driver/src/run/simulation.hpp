// One run: the time loop, and what happens after every step (events, history, results, checkpoints,
// progress). What is simulated is in the scene.
#pragma once

#include <string>
#include <vector>

#include "run/checkpoint.hpp"
#include "run/checkpoint_trigger.hpp"
#include "run/checkpoint_writer.hpp"
#include "run/events_file.hpp"
#include "run/file_names.hpp"
#include "run/history_file.hpp"
#include "run/progress.hpp"
#include "run/results_file.hpp"
#include "run/run.hpp"
#include "run/schedule.hpp"
#include "run/signals.hpp"
#include "run/stepping.hpp"
#include "run/stop_file.hpp"
#include "run/time_step.hpp"
#include "scene/scene.hpp"

namespace cleave::driver {

class Simulation {
 public:
  Simulation(Scene& scene, const TimeStep& step, FileNames names, const RunOptions& options);

  // From time 0, with new files. Returns the exit code; throws RunError.
  int run();
  // After a checkpoint whose fields are in the model, with its files continued.
  int resume(const CheckpointHeader& header, const std::vector<std::string>& notes);

 private:
  int loop(std::int64_t first_step);
  // Until the end, or until a checkpoint and a stop are asked for; returns why, or "".
  std::string steps(std::int64_t& step, Signals& signals);
  // From step to step + 1; returns why it was stopped half-way, or "".
  std::string one_step(std::int64_t step, Signals& signals);
  void after_step(std::int64_t step);
  void write_outputs(std::int64_t step);
  // False: it could not be written, and the run may go on.
  bool write_checkpoint(std::int64_t step);
  int stop(std::int64_t step, const std::string& why);
  void keep_good_state(std::int64_t step);
  void keep(std::int64_t step);
  void record_event(std::int64_t step, double time);
  // Now and then, brings records that wait in memory to the files, where they are read while the run goes on.
  void publish_records();
  // Found once a step. Throws KernelError if the ledger is not finite, which any bad value ends in.
  const cleave_energies& finite_energies(std::int64_t step);
  [[noreturn]] void fail(std::int64_t step, const std::string& what);
  Cursors cursors() const;
  std::vector<std::string> file_list() const;

  Scene& scene_;
  TimeStep step_;
  Stepping stepping_;
  FileNames names_;
  Progress progress_;
  ResultsFile results_;
  HistoryFile history_;
  EventsFile events_;
  Schedule result_schedule_, history_schedule_;
  CheckpointTrigger trigger_;
  CheckpointWriter writer_;
  StopFile stop_file_;
  bool checkpoint_at_end_;
  Snapshot good_;  // the last state known to be finite
  double snapshot_seconds_ = 0;
  std::int64_t published_ = 0;  // records in the files, of both tables
  double publish_at_ = 0;       // of the seconds since the run began
  bool publishing_failed_ = false;
  StepReport report_;  // of the last step
  cleave_energies energies_{};
  std::int64_t energies_step_ = -1;  // the step they belong to
};

}  // namespace cleave::driver
