#include "run/run.hpp"

#include <algorithm>

#include "deck/units.hpp"
#include "run/checkpoint_files.hpp"
#include "run/simulation.hpp"
#include "scene/format.hpp"

namespace cleave::driver {
namespace {

int threads_of(const Deck& deck, const RunOptions& options) {
  return options.threads > 0 ? options.threads
                             : static_cast<int>(deck.one("run").integer("threads"));
}

// The deck that a restart follows, with the text of the checkpoint if no other is given.
Deck restart_deck(const CheckpointHeader& header, const std::string& deck_path) {
  return deck_path.empty() ? parse_deck(header.deck_text, header.deck_path) : read_deck(deck_path);
}

// Steps and increments are counted on from the checkpoint: their size and meaning stay.
void keep_mode(const Deck& deck, const CheckpointHeader& header) {
  const std::string was = parse_deck(header.deck_text, header.deck_path).one("run").text("mode");
  const DeckGroup& run = deck.one("run");
  if (run.text("mode") == was) return;
  deck.fail(run, "mode",
            "the checkpoint is of a run with mode = " + in_quotes(was) + "; a restart keeps it");
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
  Scene scene = Scene::from_deck(deck, threads_of(deck, options));
  const TimeStep step = choose_time_step(scene);
  Simulation simulation(scene, step, names, options.quiet);
  return simulation.run();
}

int restart_run(const std::string& checkpoint_or_directory, const std::string& deck_path,
                const RunOptions& options) {
  Loaded loaded = load_checkpoint(checkpoint_or_directory);
  const CheckpointHeader header = header_of(loaded.archive, loaded.path);
  const Deck deck = restart_deck(header, deck_path);
  keep_mode(deck, header);
  Scene scene = Scene::from_bodies(deck, bodies_of(loaded.archive, deck, loaded.path),
                                   threads_of(deck, options));
  restore_fields(loaded.archive, header, deck_path.empty(), scene, loaded.path);
  loaded.archive = {};  // as large as the model
  TimeStep step;
  step.clock = {header.dt, deck_path.empty()
                               ? header.steps
                               : steps_to_end(deck.one("run").real("t_end"), header.dt)};
  step.stable = scene.stable_step();
  const FileNames names = names_beside(deck, loaded.path);
  std::vector<std::string> notes;
  for (const std::string& skipped : loaded.skipped) notes.push_back("skipped " + skipped);
  Simulation simulation(scene, step, names, options.quiet);
  return simulation.resume(header, notes);
}

}  // namespace cleave::driver
