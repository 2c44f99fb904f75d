// The results of a run over time: which fields go into NAME.exo, under which names, frame by frame.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "io/results.hpp"
#include "run/file_names.hpp"
#include "scene/scene.hpp"

namespace cleave::driver {

class ResultsFile {
 public:
  // Chooses the fields; throws DeckError where the deck asks for one that there is not.
  explicit ResultsFile(const Scene& scene);

  void create(const std::string& path);
  // Continues after `frames` frames.
  void reopen(const std::string& path, std::int64_t frames);
  void write_frame(const Scene& scene, double time, const cleave_energies& energies);
  void sync() { writer_->sync(); }
  std::int64_t frames() const { return writer_ ? writer_->frames() : 0; }

 private:
  struct Source {  // one field; its components go to consecutive variables
    std::string field;
    bool integer;
    std::int64_t components;
    std::vector<std::int64_t> written;  // components that are written
  };
  void add_field(const Scene& scene, const cleave_field& field);
  void fill(const Scene& scene, const Source& source, std::vector<std::vector<double>>& variables,
            std::size_t first);

  io::ResultLayout layout_;
  std::vector<Source> nodal_, element_;
  std::vector<std::vector<double>> nodal_values_, element_values_;
  std::vector<double> real_;
  std::vector<std::int64_t> integer_;
  std::optional<io::ResultsWriter> writer_;
};

}  // namespace cleave::driver
