#include "run/checkpoint_writer.hpp"

#include "io/error.hpp"
#include "run/checkpoint_files.hpp"
#include "run/run.hpp"
#include "scene/format.hpp"

namespace cleave::driver {

CheckpointWriter::CheckpointWriter(const DeckGroup& keys)
    : keep_(keys.integer("keep")), stop_on_failure_(keys.text("on_failure") == "stop") {}

bool CheckpointWriter::write(const FileNames& names, std::int64_t step,
                             const std::function<void(const std::string& path)>& put) {
  const std::string path = names.checkpoint(step);
  try {
    put(path);
  } catch (const io::Error& error) {
    failure_ = "no checkpoint after step " + number(step) + ": " + error.what();
    if (!stop_on_failure_) return false;
    throw RunError(failure_ + "\nThe run stops, as on_failure = 'stop' of &checkpoint asks. " +
                   advice(names));
  }
  newest_ = path;
  remove_oldest(names, step, keep_);
  return true;
}

std::string CheckpointWriter::advice(const FileNames& names) {
  const std::vector<CheckpointFile> files = checkpoints_of(names);
  if (files.empty()) return "There is no older checkpoint to continue from";
  return "Continue from the last good one with: cleave restart " +
         names.checkpoint(files.back().step);
}

}  // namespace cleave::driver
