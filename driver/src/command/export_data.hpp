// One frame of a result, cut down to what is exported: a body, elements that are alive, fields.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "command/export_fields.hpp"
#include "io/results_read.hpp"

namespace cleave::driver {

// Which part of a result; empty texts leave it open.
struct ExportPart {
  std::string step;            // "last", "first" or the number of a frame from 1; empty: last
  std::optional<double> time;  // the frame nearest to it, instead of step
  std::string block;           // only this body
  bool alive = false;          // without deleted elements
  std::vector<std::string> fields;
};

struct ExportElement {
  std::size_t block = 0;
  std::size_t in_block = 0;  // number in the block, from 0
  std::size_t in_file = 0;   // among the elements of all blocks, from 0
};

struct ExportData {
  io::StoredResults results;
  std::int64_t frame = 0;  // from 0
  double time = 0;
  ExportFields fields;
  // By variable of the file; those that are not read are empty.
  std::vector<std::vector<double>> nodal, element;
  std::vector<double> current;  // (3, n points) X + u
  std::string length_units;
  std::vector<std::size_t> particles;  // that are exported
  std::vector<ExportElement> elements;

  // Nodes of an element, as points of the file.
  std::span<const std::int64_t> nodes(const ExportElement& of) const;
};

// Throws DeckError if the file has no such frame, body or field; io::Error if it cannot be read.
ExportData read_export_data(const std::string& path, const ExportPart& part);

}  // namespace cleave::driver
