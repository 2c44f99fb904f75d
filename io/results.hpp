// Results over time in Exodus II: opens in ParaView, VisIt and VTK.
//
// Nodes are particles (displacement in the variables DISPLX/Y/Z, so that readers can deform the
// mesh); elements are simplices, or spheres for bodies without simplices. Deleted simplices stay, with the
// element variable "status" 0. The same layout and frames give the same bytes. Between frames no
// file is open: what has been written is complete and can be read by others, whatever happens next.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "io/mesh.hpp"

namespace cleave::io {

struct ResultBlock {
  std::string name;
  CellKind kind = CellKind::triangle;  // point: Exodus "SPHERE"
  std::vector<std::int64_t> nodes;     // (corners, n) 0-based, over all nodes of the file
};

struct ResultVariable {
  std::string name, units, description;  // scalars: a vector v is written as v_x, v_y, v_z
};

// Blocks and node sets without members do not appear in the file.
struct ResultLayout {
  std::string title;                    // cut to 80 characters by the format
  int dimension = 3;                    // 2 or 3
  std::vector<double> points;           // (3, n)
  std::vector<std::int64_t> point_ids;  // (n) 1-based numbers shown to users
  std::vector<ResultBlock> blocks;
  std::vector<MeshGroup> node_sets;  // name and nodes are used
  std::vector<ResultVariable> nodal, element, global;
  // Name and text, stored as info records "name: text"; a line that is too long for a record ends in
  // a backslash and goes on in the next one.
  std::vector<std::pair<std::string, std::string>> information;
};

class ResultsWriter {
 public:
  // Makes a new file; an old one is replaced once the new one is complete up to its first frame.
  // Throws io::Error.
  static ResultsWriter create(const std::string& path, ResultLayout layout);
  // Keeps the first `frames` frames and continues after them: the bytes are those of a file never longer.
  // Throws io::Error if there are fewer, or if sizes or variables differ from the layout's.
  static ResultsWriter reopen(const std::string& path, ResultLayout layout, std::int64_t frames);
  ResultsWriter(ResultsWriter&&) noexcept;
  ResultsWriter& operator=(ResultsWriter&&) noexcept;
  ~ResultsWriter();

  // A frame on its way into the file, so that its values need not be in memory together. Every value
  // of every variable is put once, in pieces of any size and order; then finish(), after which
  // readers see the frame and a kill of the process does not lose it. A frame that goes away before
  // (disk full, ...) leaves the file as it was, and another can be begun.
  class Frame {
   public:
    ~Frame();
    Frame(Frame&&) noexcept;
    // Of points first, first + 1, ...
    void put_nodal(std::size_t variable, std::int64_t first, std::span<const double> values);
    // Of elements first, first + 1, ... of all blocks in order.
    void put_element(std::size_t variable, std::int64_t first, std::span<const double> values);
    void finish();

   private:
    friend class ResultsWriter;
    struct State;
    explicit Frame(std::unique_ptr<State> state);
    std::unique_ptr<State> state_;
  };
  Frame begin_frame(double time, std::span<const double> global);
  // A frame whose values are in memory: nodal[v] is (n points), element[v] is (n elements of all
  // blocks in order), global (n globals).
  void write_frame(double time, std::span<const std::vector<double>> nodal,
                   std::span<const std::vector<double>> element, std::span<const double> global);
  // Waits for the disk: the frames survive a loss of power. Call it before a checkpoint that counts
  // on them.
  void sync();
  std::int64_t frames() const;

 private:
  struct Impl;
  explicit ResultsWriter(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

// What `cleave info` prints: sizes, complete frames with their times, variables.
struct ResultSummary {
  std::string title;
  int dimension = 0;
  std::int64_t points = 0, elements = 0;
  std::vector<double> times;
  std::vector<std::string> nodal, element, global;
};
// Throws io::Error if the file is not Exodus II (netCDF classic, as Cleave writes it) or damaged.
ResultSummary summarise_results(const std::string& path);

}  // namespace cleave::io
