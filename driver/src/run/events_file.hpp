// NAME.events.nc: when and why every bond broke, one record a bond.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "io/record_table.hpp"
#include "scene/scene.hpp"

namespace cleave::driver {

class EventsFile {
 public:
  void create(const std::string& path, const Scene& scene);
  void reopen(const std::string& path, const Scene& scene, std::int64_t records);
  // Takes the events of the last step from the model.
  void collect(const Scene& scene, Model& model, std::int64_t step);
  void flush() { table_->flush(); }
  void sync() { table_->sync(); }
  std::int64_t records() const { return table_->records(); }

 private:
  std::optional<io::RecordTable> table_;
};

}  // namespace cleave::driver
