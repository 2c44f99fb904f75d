#include "run/restart_deck.hpp"

#include <algorithm>
#include <charconv>
#include <fstream>
#include <sstream>

#include "deck/deck_difference.hpp"
#include "deck/mistakes.hpp"
#include "deck/restart_keys.hpp"
#include "io/new_file.hpp"
#include "run/time_step.hpp"
#include "scene/curve.hpp"
#include "scene/format.hpp"
#include "scene/motions.hpp"

namespace cleave::driver {
namespace {

constexpr const char* kChanged = "! Restarted after step ";

void set_text(Deck& deck, const DeckGroup& group, const char* key, std::string text) {
  const auto place = static_cast<std::size_t>(&group - deck.groups.data());
  for (DeckKey& k : deck.groups[place].keys)
    if (k.name == key) k.value = std::move(text);
}

// Names that are left open follow from the deck's file name and from places in it: a deck that writes
// them down is the same, and a deck in another file goes on with the run's name.
void fill_names(Deck& deck, const std::string& base) {
  const DeckGroup& run = deck.one("run");
  if (!run.given("name") || run.text("name").empty()) set_text(deck, run, "name", base);
  for (const DeckGroup* load : deck.all("load"))
    set_text(deck, *load, "name", load_name(deck, *load));
}

// A motion knows where it will be one step on, so that step has to be without the load, too.
bool acts_by(const Deck& deck, const DeckGroup& load, double time) {
  return load.real("value") != 0 && !Curve::of_load(deck, load).is_zero_until(time);
}

class Policy {
 public:
  Policy(const CheckpointHeader& header, const Deck& before, const Deck& after)
      : header_(header), before_(before), after_(after) {}

  // Empty: allowed.
  std::string objection(const DeckDifference& difference) const {
    if (difference.before == nullptr)
      return "is not in the deck of the checkpoint; a restart adds no groups" + columns(difference);
    if (difference.after == nullptr)
      return "of the checkpoint's deck is left out; a restart drops no groups" +
             columns(difference);
    const std::string values = "key " + difference.key + ": the checkpoint has " +
                               difference.old_value + ", this deck " + difference.new_value;
    switch (restart_rule(difference.after->name, difference.key)) {
      case RestartRule::never:
        return values;
      case RestartRule::always:
        return {};
      case RestartRule::on:
        return difference.after->logical(difference.key.c_str())
                   ? ""
                   : values + "; it can be switched on at a restart, not off";
      case RestartRule::later:
        return early(difference, values);
    }
    return values;
  }

 private:
  static std::string columns(const DeckDifference& difference) {
    const std::string& name = (difference.after ? difference.after : difference.before)->name;
    const bool in_history =
        name == "load" || name == "probe" || name == "section" || name == "wall";
    return in_history ? ", because the history keeps its columns" : "";
  }

  std::string early(const DeckDifference& difference, const std::string& values) const {
    const double time = static_cast<double>(header_.step + 1) * header_.dt;
    const bool old_acts = acts_by(before_, *difference.before, time);
    if (!old_acts && !acts_by(after_, *difference.after, time)) return {};
    return values + "; a load may change at a restart only while it is zero, and " +
           (old_acts ? "that of the checkpoint" : "this one") +
           " acts by the end of the next step (" + "time " + number(time) + ")";
  }

  const CheckpointHeader& header_;
  const Deck& before_;
  const Deck& after_;
};

[[noreturn]] void refuse(const Deck& deck,
                         const std::vector<std::pair<DeckDifference, std::string>>& objections) {
  constexpr std::size_t kMostShown = 10;
  std::string text;
  for (std::size_t i = 0; i < std::min(objections.size(), kMostShown); ++i) {
    const auto& [difference, why] = objections[i];
    io::namelist::Place place{};
    if (difference.after != nullptr)
      place = difference.key.empty() ? difference.after->place
                                     : difference.after->key(difference.key.c_str()).place;
    text += message_at(deck.source, place, difference.group + ", " + why) + '\n';
  }
  if (objections.size() > kMostShown)
    text += "... and " + std::to_string(objections.size() - kMostShown) + " more differences\n";
  throw DeckError(text + "A restart may change only " + restart_key_list() +
                  " (cleave keys --restart). Take these values of the checkpoint's deck (cleave "
                  "info --deck CHECKPOINT), or start a new run with this deck.");
}

void check_end(const Deck& deck, const CheckpointHeader& header) {
  const DeckGroup& run = deck.one("run");
  if (steps_to_end(run.real("t_end"), header.dt) > header.step) return;
  deck.fail(run, "t_end",
            "the run is at time " + number(static_cast<double>(header.step) * header.dt) +
                " (step " + number(header.step) +
                ") in this checkpoint; give a later t_end, or name an earlier checkpoint");
}

// Lines of earlier restarts that still hold when the run goes on after `step`.
std::string earlier_changes(const std::string& path, std::int64_t step) {
  std::ifstream file(path);
  std::string kept;
  const std::string_view start = kChanged;
  for (std::string line; std::getline(file, line) && line.starts_with(start);) {
    std::int64_t at = 0;
    std::from_chars(line.data() + start.size(), line.data() + line.size(), at);
    if (at < step) kept += line + '\n';
  }
  return kept;
}

}  // namespace

RestartDeck restart_deck(const CheckpointHeader& header, std::optional<Deck> other) {
  Deck of_checkpoint = deck_of(header);
  if (!other) return {std::move(of_checkpoint), {}};
  Deck before = of_checkpoint, after = std::move(*other);
  const std::string base = FileNames::of_deck(before).base;
  fill_names(before, base);
  fill_names(after, base);
  const Policy policy(header, before, after);
  RestartDeck restart;
  std::vector<std::pair<DeckDifference, std::string>> objections;
  for (const DeckDifference& difference : differences(before, after)) {
    restart.changes.push_back(difference_line(difference));
    const std::string why = policy.objection(difference);
    if (!why.empty()) objections.emplace_back(difference, why);
  }
  if (!objections.empty()) refuse(after, objections);
  if (!restart.changes.empty()) check_end(after, header);
  restart.deck = restart.changes.empty() ? std::move(of_checkpoint) : std::move(after);
  return restart;
}

void write_changes(const RestartDeck& restart, const FileNames& names, std::int64_t step) {
  if (restart.changes.empty()) return;
  std::string text = earlier_changes(names.resolved(), step);
  for (const std::string& change : restart.changes)
    text += kChanged + std::to_string(step) + ": " + change + '\n';
  text += restart.deck.resolved(names.directory.string());
  io::NewFile file(names.resolved());
  io::create_empty_file(file.temporary_path());
  io::append_to_file(file.temporary_path(), text);
  io::sync_file(file.temporary_path());
  file.commit();
}

}  // namespace cleave::driver
