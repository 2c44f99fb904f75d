#include "run/progress.hpp"

#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <set>

#include "deck/kernel_tables.hpp"
#include "scene/format.hpp"

namespace cleave::driver {
namespace {

// Largest of the energies that the balance is made of.
double energy_scale(const cleave_energies& e) {
  return std::max({std::abs(e.external + e.reaction), std::abs(e.kinetic), std::abs(e.elastic),
                   std::abs(e.plastic), std::abs(e.fracture)});
}

std::string bar(double fraction) {
  constexpr int kWidth = 20;
  const int filled = static_cast<int>(fraction * kWidth);
  return "[" + std::string(static_cast<std::size_t>(filled), '#') +
         std::string(static_cast<std::size_t>(kWidth - filled), '-') + "] ";
}

// The papers whose methods this run uses, from the tables.
std::set<std::string> sources(const Deck& deck) {
  std::set<std::string> found;
  const auto add = [&](cleave_table table, const std::string& name) {
    for (const cleave_table_entry& entry : table_entries(table)) {
      if (name == entry.name && *entry.source != '\0') {
        found.insert(name + ": " + entry.source);
      }
    }
  };
  for (const DeckGroup* body : deck.all("body")) {
    add(CLEAVE_TABLE_FORMULATION, body->text("formulation"));
  }
  for (const DeckGroup* material : deck.all("material")) {
    add(CLEAVE_TABLE_MATERIAL, material->text("law"));
  }
  for (const cleave_table_entry& group : table_entries(CLEAVE_TABLE_GROUP)) {
    if (!deck.all(group.name).empty()) add(CLEAVE_TABLE_GROUP, group.name);
  }
  return found;
}

std::string relaxation_text(const Clock& clock, std::int64_t step, const StepReport& report) {
  const auto count = [](std::int64_t n, const std::string& one) {
    return number(n) + " " + one + (n == 1 ? "" : "s");
  };
  return "increment " + number(step) + "/" + number(clock.steps) + ": " +
         count(report.iterations, "iteration") + ", residual " + number(report.residual, 2) + ", " +
         count(report.broken, "bond") + " broken in " + count(report.rounds, "round");
}

}  // namespace

std::string duration_text(double seconds) {
  if (seconds < 9.95) return number(seconds, 2) + " s";
  const auto total = static_cast<std::int64_t>(std::llround(std::min(seconds, 1e12)));
  const auto two = [](std::int64_t n) { return (n < 10 ? "0" : "") + std::to_string(n); };
  const std::string tail = two(total % 60);
  if (total < 3600) return std::to_string(total / 60) + ":" + tail;
  return std::to_string(total / 3600) + ":" + two(total / 60 % 60) + ":" + tail;
}

std::string bytes_text(std::int64_t bytes) {
  const double value = static_cast<double>(bytes);
  if (value < 1e6) return number(value / 1e3, 3) + " kB";
  return value < 1e9 ? number(value / 1e6, 3) + " MB" : number(value / 1e9, 3) + " GB";
}

Progress::Progress(bool quiet, const DeckGroup& run)
    : quiet_(quiet),
      terminal_(isatty(STDOUT_FILENO) != 0),
      every_(run.real("status_every")),
      begin_(WallClock::now()),
      last_(begin_),
      last_relaxing_(begin_) {}

void Progress::print(const std::string& text, bool stays) {
  if (quiet_) return;
  std::string out;
  if (terminal_ && line_open_) out += "\r\033[K";
  out += text;
  line_open_ = !stays && terminal_;
  if (!line_open_) out += "\n";
  std::fputs(out.c_str(), stdout);
  std::fflush(stdout);
}

void Progress::note(const std::string& line) { print(line, true); }

void Progress::warn(const std::string& text) {
  ++warnings_;
  if (quiet_) std::fputs(("cleave: warning: " + text + "\n").c_str(), stderr);
  print("warning: " + text, true);
}

void Progress::banner(const Scene& scene, const TimeStep& step, std::int64_t first_step) {
  const Deck& deck = scene.deck();
  const DeckGroup& run = deck.one("run");
  const cleave_counts counts = scene.model().total_counts();
  particles_ = counts.particles;
  first_step_ = last_step_ = first_step;
  const std::string title = run.text("title");
  note("cleave " + std::string(cleave_version()) + ": " + deck.source.path +
       (title.empty() ? "" : " (" + title + ")"));
  note("  " + std::to_string(scene.bodies().size()) +
       (scene.bodies().size() == 1 ? " body, " : " bodies, ") + number(counts.particles) +
       " particles, " + number(counts.bonds) + " bonds, " + number(counts.simplices) +
       " simplices, " + bytes_text(scene.model().memory()));
  const bool statics = run.text("mode") == "static";
  note((statics ? "  load increment " + number(step.clock.dt) + ", "
                : "  step " + number(step.clock.dt) + " (stable " + number(step.stable) + "), ") +
       number(step.clock.steps) + (statics ? " increments to t = " : " steps to t = ") +
       number(step.clock.time(step.clock.steps)) +
       (first_step > 0 ? ", continued after step " + number(first_step) : ""));
  for (const std::string& source : sources(deck)) note("  method " + source);
  if (statics && deck.one("static").text("method") == "relaxation")
    note("  method relaxation: Kilic and Madenci, Theor. Appl. Fract. Mech. 53 (2010) 194");
  for (const std::string& warning : step.warnings) warn(warning);
  begin_ = last_ = WallClock::now();
}

bool Progress::due() const {
  return std::chrono::duration<double>(WallClock::now() - last_).count() >= every_;
}

double Progress::seconds() const {
  return std::chrono::duration<double>(WallClock::now() - begin_).count();
}

void Progress::status(const Model& model, const Clock& clock, std::int64_t step,
                      const cleave_energies& e) {
  const auto now = WallClock::now();
  const double since = std::chrono::duration<double>(now - last_).count();
  const double all = std::chrono::duration<double>(now - begin_).count();
  const auto done = static_cast<double>(step - last_step_);
  const double rate = since > 0 ? done * static_cast<double>(particles_) / since : 0;
  const auto in_all = static_cast<double>(step - first_step_);
  const double left = in_all > 0 ? all * static_cast<double>(clock.steps - step) / in_all : 0;
  last_ = now;
  last_step_ = step;
  if (quiet_) return;
  const cleave_counts counts = model.total_counts();
  const double scale = energy_scale(e);
  const double fraction = static_cast<double>(step) / static_cast<double>(clock.steps);
  std::string line = terminal_ ? bar(fraction) : "";
  line += "step " + number(step) + "/" + number(clock.steps) + " " + number(100 * fraction, 3) +
          "%  t " + number(clock.time(step), 4) + "  dt " + number(clock.dt, 4) + "  kinetic " +
          number(e.kinetic, 4) + "  stored " + number(e.elastic + e.plastic + e.stabilisation, 4) +
          "  fracture " + number(e.fracture, 4) + "  balance " +
          number(scale > 0 ? e.balance / scale : 0.0, 2) + "  broken " + number(counts.broken);
  line += "  " + number(rate / 1e6, 3) + " M/s  ETA " + duration_text(left);
  print(line, false);
}

void Progress::relaxing(const Clock& clock, std::int64_t step, const StepReport& so_far) {
  const auto now = WallClock::now();
  if (std::chrono::duration<double>(now - last_relaxing_).count() < every_) return;
  last_relaxing_ = now;
  print(relaxation_text(clock, step, so_far) + ", relaxing", false);
}

void Progress::solving(const Clock& clock, std::int64_t step, double time,
                       const StepReport& so_far) {
  const auto now = WallClock::now();
  if (std::chrono::duration<double>(now - last_relaxing_).count() < every_) return;
  last_relaxing_ = now;
  print(relaxation_text(clock, step, so_far) + ", t = " + number(time), false);
}

void Progress::increment_done(const Clock& clock, std::int64_t step, const StepReport& report) {
  last_relaxing_ = WallClock::now();
  note(relaxation_text(clock, step, report));
}

void Progress::finish(const std::string& what, const std::vector<std::string>& files) {
  if (terminal_ && line_open_) note("");
  note(what + ", " + std::to_string(warnings_) + (warnings_ == 1 ? " warning" : " warnings") +
       ", wall time " + duration_text(seconds()) + "; files: " + list(files));
}

}  // namespace cleave::driver
