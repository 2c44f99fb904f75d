#include "run/run.hpp"

#include <cstdio>

#include "run/checkpoint_files.hpp"
#include "run/restart_deck.hpp"
#include "run/simulation.hpp"
#include "run/stop_file.hpp"
#include "run/threads.hpp"

namespace cleave::driver {
namespace {

void say(const RestartDeck& restart, const std::string& checkpoint, const RunOptions& options) {
  if (options.quiet || restart.changes.empty()) return;
  std::string text = restart.deck.source.path + ": changes to the deck of " + checkpoint + ":\n";
  for (const std::string& change : restart.changes) text += "  " + change + '\n';
  std::fputs(text.c_str(), stdout);
  std::fflush(stdout);
}

FileNames names_beside(const Deck& deck, const std::string& checkpoint) {
  FileNames names = FileNames::of_deck(deck);
  names.directory = std::filesystem::path(checkpoint).parent_path();
  if (names.directory.empty()) names.directory = ".";
  return names;
}

}  // namespace

int run_deck(const Deck& deck, const RunOptions& options) {
  const FileNames names = FileNames::of_deck(deck);
  StopFile(deck, names).refuse_leftover(deck);  // before a long set-up
  Scene scene = Scene::from_deck(deck, threads_of(deck, options));
  const TimeStep step = choose_time_step(scene);
  Simulation simulation(scene, step, names, options);
  return simulation.run();
}

int restart_run(const std::string& checkpoint_or_directory, const std::string& deck_path,
                const RunOptions& options) {
  const Loaded loaded = load_checkpoint(checkpoint_or_directory);
  const CheckpointHeader header = header_of(loaded.archive, loaded.path);
  std::optional<Deck> other;
  if (!deck_path.empty()) other = read_deck(deck_path);
  const RestartDeck restart = restart_deck(header, std::move(other));
  const Deck& deck = restart.deck;
  say(restart, loaded.path, options);
  const FileNames names = names_beside(deck, loaded.path);
  StopFile(deck, names).refuse_leftover(deck);
  Scene scene = Scene::from_bodies(deck, bodies_of(loaded.archive, deck, loaded.path),
                                   threads_of(deck, options));
  restore_fields(loaded.archive, header, scene, loaded.path);
  TimeStep step;
  step.clock = {header.dt, restart.changes.empty()
                               ? header.steps
                               : steps_to_end(deck.one("run").real("t_end"), header.dt)};
  step.stable = scene.stable_step();
  std::vector<std::string> notes;
  for (const std::string& skipped : loaded.skipped) notes.push_back("skipped " + skipped);
  Simulation simulation(scene, step, names, options);
  write_changes(restart, names, header.step);
  return simulation.resume(header, notes);
}

}  // namespace cleave::driver
