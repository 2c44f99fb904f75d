// Writes one file of each kind into the folder given, for the checks with other programs' readers.
// The numbers are simple functions of index and frame, which the checks know too.
#include <cmath>
#include <string>

#include "io/record_table.hpp"
#include "io/results.hpp"
#include "sample_archive.hpp"

namespace {

using namespace cleave::io;

constexpr int kFrames = 4, kRecords = 5000;

void write_table(const std::string& folder) {
  RecordTable table = RecordTable::create(folder + "/history.nc", folder + "/history.csv",
                                          {{"step", "1", "number of the step", true},
                                           {"time", "ms", "time at the end of the step", false},
                                           {"balance", "mJ", "energy balance", false}},
                                          {{"units", "mm-ms-g-MPa"}});
  for (int i = 0; i < kRecords; ++i) {
    const double balance = i == 7 ? std::nan("") : std::ldexp(1.0 / (i + 1), -i / 10);
    table.append(std::vector<double>{10.0 * i, i / 3.0, balance});
  }
  table.flush();
}

// Displacement of node n in frame f along axis a: (f + 1) * (a + 1) * (n + 1) / 16.
void write_frames(ResultsWriter& results, std::size_t points, std::size_t elements, int dimension) {
  for (int f = 0; f < kFrames; ++f) {
    std::vector<std::vector<double>> nodal(static_cast<std::size_t>(dimension) + 1,
                                           std::vector<double>(points));
    for (std::size_t a = 0; a < nodal.size(); ++a) {
      for (std::size_t n = 0; n < points; ++n) {
        nodal[a][n] = (f + 1.0) * static_cast<double>((a + 1) * (n + 1)) / 16;
      }
    }
    // Frame f has lost its first f elements.
    std::vector<std::vector<double>> element(2, std::vector<double>(elements));
    for (std::size_t e = 0; e < elements; ++e) {
      element[0][e] = e < static_cast<std::size_t>(f) ? 0 : 1;
      element[1][e] = 100.0 * f + static_cast<double>(e);
    }
    results.write_frame(0.25 * f, nodal, element, std::vector<double>{0.5 * f, 1e-6});
  }
}

ResultLayout layout_without_mesh(int dimension) {
  ResultLayout layout;
  layout.title = "sample in " + std::to_string(dimension) + " dimensions";
  layout.dimension = dimension;
  for (const char axis : std::string("XYZ").substr(0, static_cast<std::size_t>(dimension))) {
    layout.nodal.push_back({std::string("DISPL") + axis, "mm", "displacement"});
  }
  layout.nodal.push_back({"a_nodal_variable_with_a_name_longer_than_32_characters", "1", "long"});
  layout.element = {{"status", "1", "1 whole, 0 deleted"}, {"stress_xx", "MPa", "Cauchy stress"}};
  layout.global = {{"kinetic_energy", "mJ", "kinetic energy"}, {"dt", "ms", "time step"}};
  layout.information = {{"units", "mm-ms-g-MPa"}, {"deck", "&run\n  end_time = 1\n/"}};
  return layout;
}

void write_solid(const std::string& folder) {
  ResultLayout layout = layout_without_mesh(3);
  layout.points = {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 1, 1, 1, 7, 8, 9, 9, 8, 7};
  layout.point_ids = {101, 102, 103, 104, 105, 7, 8};
  layout.blocks = {{"solid", CellKind::tetrahedron, {0, 1, 2, 3, 1, 2, 3, 4}},
                   {"block_with_a_name_that_is_longer_than_32_characters", CellKind::point, {5, 6}},
                   {"rod", CellKind::line, {4, 5}}};
  layout.node_sets = {{"base", 0, {0, 1, 2}, {}}, {"tip", 0, {4}, {}}};
  ResultsWriter results = ResultsWriter::create(folder + "/solid.exo", layout);
  write_frames(results, 7, 5, 3);
}

void write_plate(const std::string& folder) {
  ResultLayout layout = layout_without_mesh(2);
  layout.points = {0, 0, 0, 2, 0, 0, 2, 1, 0, 0, 1, 0};
  layout.point_ids = {1, 2, 3, 4};
  layout.blocks = {{"plate", CellKind::triangle, {0, 1, 2, 0, 2, 3}}};
  ResultsWriter results = ResultsWriter::create(folder + "/plate.exo", layout);
  write_frames(results, 4, 2, 2);
}

}  // namespace

int main(int count, char** arguments) {
  if (count != 2) return 2;
  const std::string folder = arguments[1];
  write_table(folder);
  write_solid(folder);
  write_plate(folder);
  write_archive(folder + "/archive.nc", sample_archive());
  return 0;
}
