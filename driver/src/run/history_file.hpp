// NAME.history.nc and .csv: energies, counts, momentum, reactions and probes over time.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "io/record_table.hpp"
#include "run/file_names.hpp"
#include "run/schedule.hpp"
#include "run/stepping.hpp"
#include "scene/scene.hpp"

namespace cleave::driver {

// Columns: step, time; the energies of cleave_energies; broken, inert, isolated, inverted;
// momentum; for every prescribed motion its reaction_NAME_x.., for every force its force_NAME_x..;
// for every section its force and moment; in relaxation what the increment took; probes.
class HistoryFile {
 public:
  // Throws DeckError: an unknown field or place of a probe, two columns of one name.
  explicit HistoryFile(const Scene& scene);

  void create(const FileNames& names, const Scene& scene, const Clock& clock);
  void reopen(const FileNames& names, const Scene& scene, std::int64_t records);
  // report: of the step that led here.
  void write(Scene& scene, std::int64_t step, double time, const cleave_energies& energies,
             const StepReport& report);
  void flush() { table_->flush(); }
  void sync() { table_->sync(); }
  std::int64_t records() const { return table_->records(); }

 private:
  struct Probe {
    std::int64_t body = 0;
    std::string field;
    bool integer = false;
    std::int64_t components = 1;
    std::vector<std::int64_t> written;    // components that are written
    std::vector<std::int64_t> particles;  // one, or a set
    std::vector<double> weights;          // sum 1
    // Interpolated: where the point lies; else -1.
    std::int64_t simplex = -1;
    std::vector<double> place;  // barycentric coordinates (4)
  };
  void add_column(const std::string& name, const std::string& units, const std::string& text,
                  bool is_integer = false);
  void add_loads(const Scene& scene);
  void add_sections(const Scene& scene);
  void place_probe(const Scene& scene, const DeckGroup& group, Probe& probe) const;
  void add_probe(const Scene& scene, const DeckGroup& group);
  void add_momentum(const Model& model);
  void add_probe_values(const Model& model, const Probe& probe);
  std::string csv_path(const FileNames& names, const Scene& scene) const;

  std::vector<io::Column> columns_;
  std::vector<Probe> probes_;
  std::vector<std::vector<double>> mass_;  // of every body
  std::vector<double> record_, real_;
  std::vector<std::int64_t> integer_;
  std::string units_;
  bool relaxes_;
  std::optional<io::RecordTable> table_;
};

}  // namespace cleave::driver
