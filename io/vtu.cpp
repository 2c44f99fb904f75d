#include "io/vtu.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>
#include <span>
#include <string_view>

#include "io/error.hpp"
#include "io/new_file.hpp"

namespace cleave::io {
namespace {

// The text goes to the file in pieces of this size: a grid of millions of points is not held twice.
constexpr std::size_t kPieceBytes = std::size_t{1} << 22;

class Base64 {
 public:
  explicit Base64(std::string& text) : text_(text) {}

  void add(std::span<const unsigned char> bytes) {
    for (const unsigned char byte : bytes) {
      group_[held_++] = byte;
      if (held_ == 3) put_group();
    }
  }
  // The last group may be incomplete; '=' stands for what is missing.
  void finish() {
    const std::size_t missing = 3 - held_;
    if (held_ == 0) return;
    while (held_ < 3) group_[held_++] = 0;
    put_group();
    text_.replace(text_.size() - missing, missing, missing, '=');
  }

 private:
  void put_group() {
    constexpr std::string_view kDigits =
        "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    const unsigned value = group_[0] << 16 | group_[1] << 8 | group_[2];
    for (const unsigned shift : {18u, 12u, 6u, 0u}) text_ += kDigits[value >> shift & 63u];
    held_ = 0;
  }

  std::string& text_;
  std::array<unsigned, 3> group_{};
  std::size_t held_ = 0;
};

std::string escaped(std::string_view text) {
  std::string safe;
  for (const char c : text) {
    switch (c) {
      case '&':
        safe += "&amp;";
        break;
      case '<':
        safe += "&lt;";
        break;
      case '>':
        safe += "&gt;";
        break;
      case '"':
        safe += "&quot;";
        break;
      default:
        safe += static_cast<unsigned char>(c) < 0x20 ? ' ' : c;  // control marks are not XML
    }
  }
  return safe;
}

template <class Number>
constexpr const char* type_name() {
  if constexpr (std::is_same_v<Number, double>) return "Float64";
  if constexpr (std::is_same_v<Number, std::int64_t>) return "Int64";
  return "UInt8";
}

class Writer {
 public:
  explicit Writer(const std::string& path) : path_(path) { create_empty_file(path); }

  void add(const std::string& text) { text_ += text; }

  template <class Number>
  void add_array(const std::string& name, const std::string& attributes,
                 std::span<const Number> values, const std::string& behind = "") {
    add("<DataArray type=\"" + std::string(type_name<Number>()) + "\" Name=\"" + escaped(name) +
        "\"" + attributes + " format=\"binary\">\n");
    const std::uint64_t size = values.size_bytes();
    Base64 code(text_);
    code.add(bytes_of(&size, 1));
    constexpr std::size_t kAtOnce = kPieceBytes / sizeof(Number);
    for (std::size_t first = 0; first < values.size(); first += kAtOnce) {
      code.add(bytes_of(values.data() + first, std::min(kAtOnce, values.size() - first)));
      flush();
    }
    code.finish();
    add('\n' + behind + "</DataArray>\n");
  }

  void add_array(const VtuArray& array) {
    std::string attributes, units;
    if (!array.components.empty()) {
      attributes = " NumberOfComponents=\"" + std::to_string(array.components.size()) + '"';
    }
    for (std::size_t c = 0; c < array.components.size(); ++c) {
      attributes +=
          " ComponentName" + std::to_string(c) + "=\"" + escaped(array.components[c]) + '"';
    }
    if (!array.units.empty()) {
      units = "<InformationKey name=\"UNITS_LABEL\" location=\"vtkDataArray\">" +
              escaped(array.units) + "</InformationKey>\n";
    }
    std::visit(
        [&](const auto& values) { add_array(array.name, attributes, std::span(values), units); },
        array.values);
  }

  void finish() {
    flush();
    sync_file(path_);
  }

 private:
  template <class Number>
  static std::span<const unsigned char> bytes_of(const Number* values, std::size_t count) {
    return {reinterpret_cast<const unsigned char*>(values), count * sizeof(Number)};
  }
  void flush() {
    append_to_file(path_, text_);
    text_.clear();
  }

  std::string path_, text_;
};

std::size_t size_of(const VtuArray& array) {
  return std::visit([](const auto& values) { return values.size(); }, array.values);
}

void check_arrays(const std::string& path, const std::vector<VtuArray>& arrays, std::size_t count,
                  const char* what) {
  for (const VtuArray& array : arrays) {
    const std::size_t needed = count * std::max<std::size_t>(1, array.components.size());
    if (size_of(array) != needed) {
      throw Error(path + ": array '" + array.name + "' has " + std::to_string(size_of(array)) +
                  " values, " + std::to_string(needed) + " are needed for " +
                  std::to_string(count) + " " + what);
    }
  }
}

void check_grid(const std::string& path, const VtuGrid& grid) {
  const std::size_t points = grid.points.size() / 3, cells = grid.types.size();
  const std::size_t listed = grid.connectivity.size();
  bool good = grid.points.size() % 3 == 0 && grid.offsets.size() == cells &&
              std::is_sorted(grid.offsets.begin(), grid.offsets.end()) &&
              (cells == 0 ? listed == 0 : grid.offsets.back() == std::ssize(grid.connectivity));
  for (const std::int64_t point : grid.connectivity) {
    good = good && point >= 0 && point < static_cast<std::int64_t>(points);
  }
  if (!good) {
    throw Error(path + ": the cells of the grid contradict its " + std::to_string(points) +
                " points");
  }
  check_arrays(path, grid.point_data, points, "points");
  check_arrays(path, grid.cell_data, cells, "cells");
}

void add_arrays(Writer& writer, const char* element, const std::vector<VtuArray>& arrays) {
  writer.add(std::string("<") + element + ">\n");
  for (const VtuArray& array : arrays) writer.add_array(array);
  writer.add(std::string("</") + element + ">\n");
}

void add_cells(Writer& writer, const VtuGrid& grid) {
  std::vector<std::uint8_t> types(grid.types.size());
  std::transform(grid.types.begin(), grid.types.end(), types.begin(),
                 [](VtkCell type) { return static_cast<std::uint8_t>(type); });
  writer.add("<Cells>\n");
  writer.add_array<std::int64_t>("connectivity", "", grid.connectivity);
  writer.add_array<std::int64_t>("offsets", "", grid.offsets);
  writer.add_array<std::uint8_t>("types", "", types);
  writer.add("</Cells>\n");
}

}  // namespace

void write_vtu(const std::string& path, const VtuGrid& grid) {
  check_grid(path, grid);
  NewFile file(path);
  Writer writer(file.temporary_path());
  const bool little = std::endian::native == std::endian::little;
  writer.add(
      "<?xml version=\"1.0\"?>\n<VTKFile type=\"UnstructuredGrid\" version=\"1.0\" byte_order=\"" +
      std::string(little ? "LittleEndian" : "BigEndian") +
      "\" header_type=\"UInt64\">\n<UnstructuredGrid>\n");
  writer.add("<FieldData>\n");  // ParaView shows a file's time by this name
  writer.add_array<double>("TimeValue", " NumberOfTuples=\"1\"", std::array{grid.time});
  writer.add("</FieldData>\n<Piece NumberOfPoints=\"" + std::to_string(grid.points.size() / 3) +
             "\" NumberOfCells=\"" + std::to_string(grid.types.size()) + "\">\n");
  add_arrays(writer, "PointData", grid.point_data);
  add_arrays(writer, "CellData", grid.cell_data);
  writer.add("<Points>\n");
  writer.add_array<double>("Points", " NumberOfComponents=\"3\"", grid.points);
  writer.add("</Points>\n");
  add_cells(writer, grid);
  writer.add("</Piece>\n</UnstructuredGrid>\n</VTKFile>\n");
  writer.finish();
  file.commit();
}

}  // namespace cleave::io
