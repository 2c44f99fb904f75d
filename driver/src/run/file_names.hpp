// Names of the files of a run.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

#include "deck/deck.hpp"

namespace cleave::driver {

struct FileNames {
  std::filesystem::path directory;
  std::string base;

  // From run.directory and run.name; an empty name is the deck's file name without its ending.
  static FileNames of_deck(const Deck& deck);

  std::string resolved() const { return path(".resolved.nml"); }
  std::string results() const { return path(".exo"); }
  std::string history() const { return path(".history.nc"); }
  std::string history_csv() const { return path(".history.csv"); }
  std::string events() const { return path(".events.nc"); }
  std::string checkpoint(std::int64_t step) const {
    return path("." + std::to_string(step) + kCheckpointEnding);
  }
  std::string last_good() const { return path(std::string(".lastgood") + kCheckpointEnding); }

  static constexpr const char* kCheckpointEnding = ".checkpoint.nc";

 private:
  std::string path(const std::string& ending) const {
    return (directory / (base + ending)).lexically_normal().string();
  }
};

}  // namespace cleave::driver
