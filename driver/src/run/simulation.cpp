#include "run/simulation.hpp"

#include <algorithm>
#include <cmath>
#include <fstream>

#include "io/error.hpp"
#include "run/checkpoint_files.hpp"
#include "run/wall_time.hpp"
#include "scene/format.hpp"
#include "scene/index.hpp"

namespace cleave::driver {
namespace {

// Both keys zero: about a thousand records a run.
Schedule history_schedule(const Deck& deck, const Clock& clock) {
  const Schedule asked(deck.one("history"), clock.dt);
  if (!asked.never()) return asked;
  return Schedule(0.0, std::max<Index>(1, (clock.steps + 500) / 1000), clock.dt);
}

WallKeys wall_keys(const DeckGroup& checkpoint, const RunOptions& options) {
  return {checkpoint.real("every_wall"),
          options.wall_limit.value_or(checkpoint.real("wall_limit"))};
}

void write_text(const std::string& path, const std::string& text) {
  std::ofstream file(path, std::ios::binary | std::ios::trunc);
  file << text;
  file.close();
  if (!file)
    throw io::Error(path + ": cannot be written; is the disk full or the place read-only?");
}

void make_directory(const std::filesystem::path& directory) {
  std::error_code error;
  std::filesystem::create_directories(directory, error);
  if (!std::filesystem::is_directory(directory)) {
    throw io::Error(directory.string() + ": the directory cannot be made: " + error.message());
  }
}

}  // namespace

Simulation::Simulation(Scene& scene, const TimeStep& step, FileNames names,
                       const RunOptions& options)
    : scene_(scene),
      step_(step),
      stepping_(scene.deck()),
      names_(std::move(names)),
      progress_(options.quiet, scene.deck().one("run")),
      results_(scene),
      history_(scene),
      result_schedule_(scene.deck().one("output"), step.clock.dt),
      history_schedule_(history_schedule(scene.deck(), step.clock)),
      trigger_(Schedule(scene.deck().one("checkpoint"), step.clock.dt),
               wall_keys(scene.deck().one("checkpoint"), options), scene.model().memory()),
      writer_(scene.deck().one("checkpoint")),
      stop_file_(scene.deck(), names_),
      checkpoint_at_end_(scene.deck().one("checkpoint").logical("at_end")) {}

int Simulation::run() {
  make_directory(names_.directory);
  set_aside(names_);
  remove_half_written(names_);
  write_text(names_.resolved(), scene_.deck().resolved(names_.directory.string()));
  results_.create(names_.results(), scene_);
  history_.create(names_, scene_, step_.clock);
  events_.create(names_.events(), scene_);
  progress_.banner(scene_, step_, 0);
  try {
    stepping_.start(scene_, step_.clock.dt);
    const cleave_energies energies = finite_energies(0);
    history_.write(scene_, 0, 0.0, energies, {});
    results_.write_frame(scene_, 0.0, energies);
  } catch (const KernelError& error) {
    throw RunError("the run failed at its start: " + scene_.deck().in_units(error.what()));
  }
  return loop(0);
}

int Simulation::resume(const CheckpointHeader& header, const std::vector<std::string>& notes) {
  remove_half_written(names_);
  results_.reopen(names_.results(), scene_, header.cursors.frames);
  history_.reopen(names_, scene_, header.cursors.history);
  events_.reopen(names_.events(), scene_, header.cursors.events);
  progress_.banner(scene_, step_, header.step);
  for (const std::string& note : notes) progress_.warn(note);
  return loop(header.step);
}

int Simulation::loop(Index first_step) {
  Signals signals;
  Index step = first_step;
  keep(step);
  trigger_.begin(seconds_since_start());
  try {
    const std::string stopped = steps(step, signals);
    if (!stopped.empty()) return stop(step, stopped);
    if (checkpoint_at_end_ && step > first_step) write_checkpoint(step);
    stop_file_.remove();
  } catch (const KernelError& error) {
    fail(step, scene_.deck().in_units(error.what()));
  } catch (const io::Error& error) {
    fail(step, error.what());
  }
  const auto counts = scene_.model().total_counts();
  progress_.finish("done: " + number(step) + " steps to t = " + number(step_.clock.time(step)) +
                       ", " + number(counts.broken) + " bonds broken",
                   file_list());
  return 0;
}

std::string Simulation::steps(Index& step, Signals& signals) {
  const Index last = step_.clock.steps;
  std::string stopped;
  while (step < last && stopped.empty()) {
    stopped = one_step(step, signals);
    if (!stopped.empty()) break;
    ++step;
    after_step(step);
    const double wall = seconds_since_start();
    const CheckpointVerdict verdict = trigger_.after_step(
        step, wall,
        {signals.take_write_request(), signals.stop_requested(), stop_file_.appeared(wall)});
    if (verdict.action == CheckpointAction::stop && step < last) {
      stopped = verdict.why;
    } else if (verdict.action != CheckpointAction::none && !(step == last && checkpoint_at_end_)) {
      const bool written = write_checkpoint(step);
      if (written && !verdict.why.empty()) progress_.note(verdict.why + ": " + writer_.newest());
    }
  }
  if (step == last) progress_.status(scene_.model(), step_.clock, step, finite_energies(step));
  events_.flush();
  history_.flush();
  return stopped;
}

// Stopped half-way a relaxation goes back to the last increment, from which it begins anew; Newton's method goes
// on from the event.
std::string Simulation::one_step(Index step, Signals& signals) {
  std::string why;
  StepWatch watch;
  watch.relaxing = [&](const StepReport& so_far) {
    progress_.relaxing(step_.clock, step + 1, so_far);
    publish_records();
    const double wall = seconds_since_start();
    why = trigger_.within_step(wall, {false, signals.stop_requested(), stop_file_.appeared(wall)})
              .why;
    return why.empty();
  };
  watch.event = [&](double time, const StepReport& so_far) {
    record_event(step, time);
    progress_.solving(step_.clock, step + 1, time, so_far);
    const double wall = seconds_since_start();
    const CheckpointVerdict verdict = trigger_.at_event(
        wall, {signals.take_write_request(), signals.stop_requested(), stop_file_.appeared(wall)});
    if (verdict.action == CheckpointAction::stop) why = verdict.why;
    if (verdict.action == CheckpointAction::write && write_checkpoint(step) && !verdict.why.empty())
      progress_.note(verdict.why + ": " + writer_.newest());
    return why.empty();
  };
  report_ = stepping_.step(scene_, step_.clock, step, watch);
  if (!report_.finished) return why;
  if (stepping_.relaxes() || report_.rounds > 0)
    progress_.increment_done(step_.clock, step + 1, report_);
  return "";
}

// An equilibrium on the way to the next step.
void Simulation::record_event(Index step, double time) {
  events_.collect(scene_, scene_.model(), step + 1);
  energies_step_ = -1;
  history_.write(scene_, step, time, finite_energies(step), {});
  energies_step_ = -1;
  keep(step);
  publish_records();
}

void Simulation::after_step(Index step) {
  events_.collect(scene_, scene_.model(), step);
  write_outputs(step);
  publish_records();
  if (stepping_.is_static()) {  // dear enough for a copy: a later increment may fail or be stopped
    finite_energies(step);
    keep(step);
  }
  if (progress_.due()) {
    const cleave_energies energies = finite_energies(step);
    if (!stepping_.is_static()) keep(step);
    progress_.status(scene_.model(), step_.clock, step, energies);
  }
}

void Simulation::write_outputs(Index step) {
  const bool last = step == step_.clock.steps;
  const double time = step_.clock.time(step);
  const bool record = last || history_schedule_.due(step);
  const bool frame = last || result_schedule_.due(step);
  if (!record && !frame) return;
  const cleave_energies energies = finite_energies(step);
  if (record) history_.write(scene_, step, time, energies, report_);
  if (frame) results_.write_frame(scene_, time, energies);
  if (record && !stepping_.is_static()) keep_good_state(step);
}

// A disk that is full now may have room when the records must be there, for a checkpoint or at the end.
void Simulation::publish_records() {
  constexpr double kEvery = 2;     // seconds
  constexpr double kShare = 0.01;  // of the wall time at most
  const Index records = history_.records() + events_.records();
  if (records == published_) return;
  const double begin = progress_.seconds();
  if (begin < publish_at_) return;
  try {
    events_.flush();
    history_.flush();
    published_ = records;
  } catch (const io::Error& error) {
    if (!publishing_failed_) progress_.warn(std::string("records wait in memory: ") + error.what());
    publishing_failed_ = true;
  }
  const double end = progress_.seconds();
  publish_at_ = end + std::max(kEvery, (end - begin) / kShare);
}

void Simulation::keep(Index step) {
  good_.take(scene_, step, stepping_.is_static() ? scene_.model().time() : step_.clock.time(step),
             cursors());
}

// A copy at every record costs little in a long run and much in one with a record a step.
void Simulation::keep_good_state(Index step) {
  constexpr double kShare = 0.02;  // of the wall time
  const double begin = progress_.seconds();
  if (snapshot_seconds_ > kShare * begin) return;
  keep(step);
  snapshot_seconds_ += progress_.seconds() - begin;
}

const cleave_energies& Simulation::finite_energies(Index step) {
  if (step == energies_step_) return energies_;
  energies_ = scene_.model().energies();
  if (std::isfinite(energies_.kinetic) && std::isfinite(energies_.balance)) {
    energies_step_ = step;
    return energies_;
  }
  std::string what = not_finite(scene_);
  if (what.empty()) what = "the energies are not finite";
  throw KernelError(what + " at step " + number(step) + ", time " + number(step_.clock.time(step)),
                    CLEAVE_NOT_FINITE);
}

bool Simulation::write_checkpoint(Index step) {
  const double begin = seconds_since_start();
  if (!stepping_
           .is_static()) {  // there it is kept already, and the model may be half-way to the next
    finite_energies(step);
    keep(step);
  }
  const bool written = writer_.write(names_, step, [this](const std::string& path) {
    // The checkpoint counts on these records: they must be on the disk before it is.
    events_.sync();
    history_.sync();
    results_.sync();
    good_.write(path, scene_, step_.clock);
  });
  trigger_.attempted(begin, seconds_since_start());
  if (!written) progress_.warn(writer_.failure());
  return written;
}

// 3 promises a checkpoint to continue from.
int Simulation::stop(Index step, const std::string& why) {
  const std::string when = why + " after step " + number(step) + " of " + number(step_.clock.steps);
  if (!write_checkpoint(step)) {
    throw RunError(when + ", but there is " + writer_.failure() + "\n" +
                   CheckpointWriter::advice(names_));
  }
  stop_file_.remove();
  progress_.finish(when + "; continue with: cleave restart " + writer_.newest(), file_list());
  return 3;
}

void Simulation::fail(Index step, const std::string& what) {
  std::string text = "the run failed in step " + number(step + 1) + " (time " +
                     number(step_.clock.time(step + 1)) + "): " + what;
  try {
    events_.flush();
    history_.flush();
    good_.write(names_.last_good(), scene_, step_.clock);
    text += "\nThe last good state, after step " + number(good_.step()) + " at time " +
            number(good_.time()) + ", is in " + names_.last_good();
  } catch (const std::exception& error) {
    text += "\nThe last good state could not be written: " + std::string(error.what());
  }
  throw RunError(text);
}

Cursors Simulation::cursors() const {
  return {results_.frames(), history_.records(), events_.records()};
}

std::vector<std::string> Simulation::file_list() const {
  std::vector<std::string> files{names_.results(), names_.history(), names_.events()};
  if (!writer_.newest().empty()) files.push_back(writer_.newest());
  return files;
}

}  // namespace cleave::driver
