// Checkpoints as files in a directory: how many are kept, and which one a restart takes.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "io/archive.hpp"
#include "run/file_names.hpp"

namespace cleave::driver {

struct CheckpointFile {
  std::string path, base;
  std::int64_t step = 0;
};

// NAME.STEP.checkpoint.nc of a directory, newest step last.
std::vector<CheckpointFile> checkpoint_files(const std::filesystem::path& directory);
// The same, of one run.
std::vector<CheckpointFile> checkpoints_of(const FileNames& names);

// Removes the oldest of this run so that `keep` stay; those after `step` are not counted.
void remove_oldest(const FileNames& names, std::int64_t step, std::int64_t keep);

// A new run makes the checkpoints of an earlier one useless for its files: they are renamed to
// ....previous, in the place of those that had this name.
void set_aside(const FileNames& names);

// What a killed process left of a checkpoint that it was writing.
void remove_half_written(const FileNames& names);

// The checkpoint that a restart starts from; all of it was verified.
struct Loaded {
  std::string path;
  io::ArchiveHeader archive;
  std::vector<std::string> skipped;  // newer ones that did not verify, with the reason
};
// A file: that one. A directory: the newest that verifies. Throws io::Error or DeckError.
Loaded load_checkpoint(const std::string& file_or_directory);

}  // namespace cleave::driver
