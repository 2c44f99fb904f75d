#include "run/file_names.hpp"

namespace cleave::driver {

FileNames FileNames::of_deck(const Deck& deck) {
  const DeckGroup& run = deck.one("run");
  FileNames names;
  names.directory = run.text("directory").empty() ? "." : run.text("directory");
  names.base = run.text("name");
  if (names.base.empty()) names.base = std::filesystem::path(deck.source.path).stem().string();
  if (names.base.find('/') != std::string::npos) {
    deck.fail(run, "name",
              "name is the base of file names and holds no '/'; use directory for the "
              "place");
  }
  return names;
}

}  // namespace cleave::driver
