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

  void create(const std::string& path, const Scene& scene);
  // Continues after `frames` frames.
  void reopen(const std::string& path, const Scene& scene, std::int64_t frames);
  void write_frame(const Scene& scene, double time, const cleave_energies& energies);
  void sync() { writer_->sync(); }
  std::int64_t frames() const { return writer_ ? writer_->frames() : 0; }

 private:
  struct Source {  // one field; its components go to consecutive variables
    std::string field;
    bool integer, nodal;
    std::int64_t components;
    std::size_t variable;               // number of the first one
    std::vector<std::int64_t> written;  // components that are written
  };
  void add_field(const Scene& scene, const cleave_field& field);
  io::ResultLayout layout_with_mesh(const Scene& scene) const;
  void put(const Scene& scene, const Source& source, io::ResultsWriter::Frame& frame);
  void read(const Scene& scene, const Source& source, std::int64_t body, std::int64_t first,
            std::int64_t last);

  io::ResultLayout layout_;  // without points and elements: the scene has them
  std::vector<Source> sources_;
  // One block of a field, and one of a variable.
  std::vector<double> real_, variable_;
  std::vector<std::int64_t> integer_;
  std::optional<io::ResultsWriter> writer_;
};

}  // namespace cleave::driver
