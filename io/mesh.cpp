// Meshes: look-up of groups, and telling the formats of files apart.
#include "io/mesh.hpp"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <memory>
#include <string_view>
#include <system_error>

#include "io/error.hpp"
#include "io/exodus_mesh.hpp"
#include "io/gmsh.hpp"

namespace cleave::io {
namespace {

// A file in memory. Not a string, which would be filled with zeros first.
struct Content {
  std::unique_ptr<char[]> bytes;
  std::size_t size = 0;
  std::string_view text() const { return {bytes.get(), size}; }
};

Content read_file(const std::string& path) {
  std::error_code error;
  const auto status = std::filesystem::status(path, error);
  if (!std::filesystem::exists(status))
    throw Error(path + ": there is no such mesh file; check the path");
  if (!std::filesystem::is_regular_file(status)) throw Error(path + ": not a file");
  const auto size = std::filesystem::file_size(path, error);
  std::ifstream stream(path, std::ios::binary);
  if (error || !stream) throw Error(path + ": the mesh file cannot be opened for reading");
  Content content{std::make_unique_for_overwrite<char[]>(size), 0};
  stream.read(content.bytes.get(), static_cast<std::streamsize>(size));
  content.size = static_cast<std::size_t>(stream.gcount());
  return content;
}

[[noreturn]] void fail_unknown(const std::string& path, bool is_empty) {
  const bool is_geometry = path.ends_with(".geo") || path.ends_with(".step") ||
                           path.ends_with(".stp") || path.ends_with(".brep");
  if (is_geometry)
    throw Error(
        path +
        ": this is a geometry, not a mesh; mesh it first: \"gmsh -2 GEOMETRY -format msh41 -o "
        "MESH\" (-3 for a solid)");
  throw Error(path + (is_empty ? ": the file is empty" : ": not a mesh file that can be read") +
              "; expected Gmsh MSH 2.2 or 4.1 (beginning with $MeshFormat) or Exodus II");
}

// "1:left" -> 1 and "left"; -1 if the name does not begin with a dimension.
int split_dimension(std::string_view& name) {
  if (name.size() < 3 || name[0] < '0' || name[0] > '3' || name[1] != ':') return -1;
  const int dimension = name[0] - '0';
  name.remove_prefix(2);
  return dimension;
}

}  // namespace

const MeshGroup* Mesh::find_group(const std::string& name) const {
  const auto named = [&](const MeshGroup& group) { return group.name == name; };
  const auto exact = std::find_if(groups.rbegin(), groups.rend(), named);
  if (exact != groups.rend()) return &*exact;

  std::string_view rest = name;
  const int dimension = split_dimension(rest);
  for (const MeshGroup& group : groups)
    if (group.dimension == dimension && group.name == rest) return &group;
  return nullptr;
}

std::string Mesh::skipped_summary() const {
  std::string text;
  for (const SkippedCells& cells : skipped)
    text += (text.empty() ? "" : ", ") + std::to_string(cells.count) + " " + cells.type;
  return text;
}

Mesh read_mesh(const std::string& path) {
  Content content = read_file(path);
  const std::string_view data = content.text();
  const auto read_netcdf = [&](NetcdfForm form) {
    content.bytes.reset();  // the library reads the file itself
    return read_exodus_mesh(path, form, content.size);
  };
  if (data.starts_with("CDF")) return read_netcdf(NetcdfForm::classic);
  if (data.starts_with("\211HDF")) return read_netcdf(NetcdfForm::hdf5);
  const std::size_t text = data.find_first_not_of(" \t\r\n");
  if (text == std::string::npos || data[text] != '$') fail_unknown(path, data.empty());
  return gmsh::read(path, data);
}

}  // namespace cleave::io
