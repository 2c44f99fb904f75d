#include "run/stop_file.hpp"

#include <algorithm>

#include "scene/format.hpp"

namespace cleave::driver {
namespace {

namespace fs = std::filesystem;

bool is_of_run(const std::string& name, const FileNames& names) {
  const std::string own[] = {names.resolved(), names.results(), names.history(),
                             names.history_csv(), names.events()};
  return name.find(FileNames::kCheckpointEnding) != std::string::npos ||
         std::any_of(std::begin(own), std::end(own),
                     [&](const std::string& path) { return fs::path(path).filename() == name; });
}

}  // namespace

StopFile::StopFile(const Deck& deck, const FileNames& names) {
  const DeckGroup& keys = deck.one("checkpoint");
  const std::string name = keys.text("stop_file");
  if (name.empty()) return;
  if (name.find('/') != std::string::npos || name == "." || name == "..") {
    deck.fail(keys, "stop_file",
              in_quotes(name) + " is a path; give a name, it is looked for in the run's directory");
  }
  if (is_of_run(name, names)) {
    deck.fail(keys, "stop_file",
              in_quotes(name) + " is a file of the run itself; give another name, as " +
                  in_quotes(names.base + ".stop"));
  }
  path_ = names.directory / name;
}

void StopFile::refuse_leftover(const Deck& deck) const {
  std::error_code ignored;
  if (path_.empty() || !fs::exists(path_, ignored)) return;
  deck.fail(deck.one("checkpoint"), "stop_file",
            in_quotes(path_.string()) +
                " is there already, so that the run would stop at once; remove it to run");
}

bool StopFile::appeared(double wall) {
  constexpr double kPause = 1;  // s: a look may cost a question to a file server
  if (path_.empty() || wall < next_look_) return false;
  next_look_ = wall + kPause;
  std::error_code ignored;
  return fs::exists(path_, ignored);
}

void StopFile::remove() const {
  std::error_code ignored;  // the next run says that it is there
  if (!path_.empty()) fs::remove(path_, ignored);
}

}  // namespace cleave::driver
