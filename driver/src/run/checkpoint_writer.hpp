// Gives the checkpoints of a run their names, keeps as many as the deck says, and knows what is to be
// done when one cannot be written. When they are due: checkpoint_trigger.hpp; what is in them:
// checkpoint.hpp.
#pragma once

#include <cstdint>
#include <functional>
#include <string>

#include "deck/deck.hpp"
#include "run/file_names.hpp"

namespace cleave::driver {

class CheckpointWriter {
 public:
  explicit CheckpointWriter(const DeckGroup& keys);

  // `put` writes that of the step under a path. True: it is there and the oldest are removed. False:
  // `put` has thrown io::Error, the older ones are as they were, and failure() says why; with
  // on_failure = 'stop' that throws RunError.
  bool write(const FileNames& names, std::int64_t step,
             const std::function<void(const std::string& path)>& put);
  const std::string& failure() const { return failure_; }
  // How to go on with the newest of this run.
  static std::string advice(const FileNames& names);

  const std::string& newest() const { return newest_; }

 private:
  std::int64_t keep_;
  bool stop_on_failure_;
  std::string newest_, failure_;
};

}  // namespace cleave::driver
