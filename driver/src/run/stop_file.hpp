// The stop file: a file whose appearance in the run's directory asks the run to stop with a
// checkpoint, from any machine that sees the directory.
#pragma once

#include <filesystem>

#include "deck/deck.hpp"
#include "run/file_names.hpp"

namespace cleave::driver {

class StopFile {
 public:
  // By checkpoint.stop_file. Throws DeckError for a name that is a path or one of the run's own
  // files, which would be removed.
  StopFile(const Deck& deck, const FileNames& names);

  // Throws DeckError if it is there before the run: the run would remove what it has not seen come.
  void refuse_leftover(const Deck& deck) const;
  // Looks at most once a second; `wall` in seconds.
  bool appeared(double wall);
  void remove() const;

 private:
  std::filesystem::path path_;  // empty: none
  double next_look_ = 0;
};

}  // namespace cleave::driver
