#include "io/exodus_definition.hpp"

#include <netcdf.h>

#include <algorithm>
#include <array>
#include <limits>
#include <set>

#include "io/error.hpp"
#include "io/exodus_file.hpp"

namespace cleave::io {
namespace {

constexpr std::size_t kLongestName = 255;  // netCDF: 256 with the end mark
constexpr std::int64_t kLargestCount =
    std::numeric_limits<std::int32_t>::max();  // in the file: int32

const char* topology(CellKind kind) {
  switch (kind) {
    case CellKind::point:
      return "SPHERE";
    case CellKind::line:
      return "BAR2";
    case CellKind::triangle:
      return "TRI3";
    case CellKind::tetrahedron:
      return "TETRA";
    case CellKind::triangle6:
      return "TRI6";
  }
  return "UNKNOWN";
}

// The Exodus library takes texts as arrays of char*, and reads them only.
class Texts {
 public:
  explicit Texts(std::vector<std::string> texts) : texts_(std::move(texts)) {
    for (std::string& text : texts_) pointers_.push_back(text.data());
  }
  char** data() { return pointers_.data(); }
  int count() const { return static_cast<int>(texts_.size()); }

 private:
  std::vector<std::string> texts_;
  std::vector<char*> pointers_;
};

template <class Items>
std::vector<std::string> names_of(const Items& items) {
  std::vector<std::string> names;
  for (const auto& item : items) names.push_back(item.name);
  return names;
}

// ---- checks ----------------------------------------------------------------------------------

template <class Items>
void check_names(const std::string& path, const std::string& what, const Items& items) {
  std::set<std::string> seen;
  for (const auto& item : items) {
    if (item.name.empty() || item.name.size() > kLongestName) {
      throw Error(path + ": " + what + " '" + item.name.substr(0, 40) + "' has a name of " +
                  std::to_string(item.name.size()) + " characters; allowed are 1 to 255");
    }
    if (!seen.insert(item.name).second) {
      throw Error(path + ": two of the " + what + "s have the name '" + item.name +
                  "'; names are unique");
    }
  }
}

void check_nodes(const std::string& path, const std::string& what,
                 const std::vector<std::int64_t>& nodes, std::int64_t points) {
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    if (nodes[i] < 0 || nodes[i] >= points) {
      throw Error(path + ": " + what + ": node " + std::to_string(nodes[i]) + " at index " +
                  std::to_string(i) + " is outside 0 to " + std::to_string(points - 1));
    }
  }
}

std::int64_t corners(const ResultBlock& block) { return static_cast<int>(block.kind); }
std::int64_t count(const ResultBlock& block) { return std::ssize(block.nodes) / corners(block); }

void check_sizes(const std::string& path, const ResultLayout& layout) {
  const std::int64_t points = std::ssize(layout.points) / 3;
  std::int64_t elements = 0;
  for (const ResultBlock& block : layout.blocks) elements += count(block);
  if (layout.dimension != 2 && layout.dimension != 3) {
    throw Error(path + ": results have 2 or 3 dimensions, not " + std::to_string(layout.dimension));
  }
  if (points == 0 || std::ssize(layout.points) % 3 != 0) {
    throw Error(path + ": results need points, three coordinates each; " +
                std::to_string(layout.points.size()) + " coordinates were given");
  }
  if (points > kLargestCount || elements > kLargestCount) {
    throw Error(
        path + ": " + std::to_string(points) + " points and " + std::to_string(elements) +
        " elements are more than the 2147483647 that an Exodus file holds; write fewer bodies");
  }
  if (std::ssize(layout.point_ids) != points) {
    throw Error(path + ": " + std::to_string(layout.point_ids.size()) + " point numbers for " +
                std::to_string(points) + " points; there must be one a point");
  }
}

// ---- writing ---------------------------------------------------------------------------------

template <class Items>
std::size_t longest_name(const Items& items, std::size_t least) {
  for (const auto& item : items) least = std::max(least, item.name.size());
  return least;
}

void define_sizes(const ExodusFile& file, const ResultLayout& layout) {
  std::size_t longest = MAX_NAME_LENGTH;
  longest = longest_name(layout.blocks, longest_name(layout.node_sets, longest));
  longest = longest_name(layout.nodal, longest_name(layout.element, longest));
  longest = longest_name(layout.global, longest);
  file.check(ex_set_max_name_length(file.id(), static_cast<int>(longest)),
             "set the length of names");

  ex_init_params sizes{};
  layout.title.copy(sizes.title, MAX_LINE_LENGTH);
  sizes.num_dim = layout.dimension;
  sizes.num_nodes = std::ssize(layout.points) / 3;
  for (const ResultBlock& block : layout.blocks) sizes.num_elem += count(block);
  sizes.num_elem_blk = std::ssize(layout.blocks);
  sizes.num_node_sets = std::ssize(layout.node_sets);
  file.check(ex_put_init_ext(file.id(), &sizes), "write the sizes");
}

void put_records(const ExodusFile& file, const ResultLayout& layout) {
  // No date: the same run gives the same bytes.
  std::array<std::string, 4> texts{"Cleave", CLEAVE_VERSION, "not dated", "not timed"};
  char* qa[1][4] = {{texts[0].data(), texts[1].data(), texts[2].data(), texts[3].data()}};
  file.check(ex_put_qa(file.id(), 1, qa), "write the name of the program");
  Texts records(information_records(layout));
  if (records.count() > 0) {
    file.check(ex_put_info(file.id(), records.count(), records.data()), "write the info records");
  }
}

// Points and elements go through buffers of this many, not through a second copy of the mesh.
constexpr std::int64_t kPiece = std::int64_t{1} << 16;

// Calls visit(first, count) for pieces of `all`.
template <class Visit>
void for_pieces(std::int64_t all, Visit visit) {
  for (std::int64_t first = 0; first < all; first += kPiece)
    visit(first, std::min(kPiece, all - first));
}

void put_points(const ExodusFile& file, const ResultLayout& layout) {
  std::array<std::vector<double>, 3> x;
  for_pieces(std::ssize(layout.point_ids), [&](std::int64_t first, std::int64_t count) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      x[axis].resize(static_cast<std::size_t>(count));
      for (std::size_t i = 0; i < x[axis].size(); ++i)
        x[axis][i] = layout.points[3 * (static_cast<std::size_t>(first) + i) + axis];
    }
    const double* z = layout.dimension == 3 ? x[2].data() : nullptr;
    file.check(ex_put_partial_coord(file.id(), first + 1, count, x[0].data(), x[1].data(), z),
               "write the points");
  });
  std::vector<std::string> names{"x", "y", "z"};
  names.resize(static_cast<std::size_t>(layout.dimension));
  Texts axes(names);
  file.check(ex_put_coord_names(file.id(), axes.data()), "write the names of the axes");
  file.check(ex_put_id_map(file.id(), EX_NODE_MAP, layout.point_ids.data()),
             "write the numbers of the points");
}

// Blocks and sets are numbered from 1 in Exodus.
ex_entity_id entity(std::size_t index) { return static_cast<ex_entity_id>(index) + 1; }

std::vector<std::int64_t> one_based(std::vector<std::int64_t> nodes) {
  for (std::int64_t& node : nodes) ++node;
  return nodes;
}

void define_blocks_and_sets(const ExodusFile& file, const ResultLayout& layout) {
  for (std::size_t i = 0; i < layout.blocks.size(); ++i) {
    const ResultBlock& block = layout.blocks[i];
    file.check(ex_put_block(file.id(), EX_ELEM_BLOCK, entity(i), topology(block.kind), count(block),
                            corners(block), 0, 0, 0),
               "define the block '" + block.name + "'");
  }
  for (std::size_t i = 0; i < layout.node_sets.size(); ++i) {
    const MeshGroup& set = layout.node_sets[i];
    file.check(ex_put_set_param(file.id(), EX_NODE_SET, entity(i), std::ssize(set.nodes), 0),
               "define the node set '" + set.name + "'");
  }
}

// The library has no call for a part of the elements.
void put_elements(const ExodusFile& file, const ResultBlock& block, const std::string& stored_as) {
  const std::string operation = "write the elements of the block '" + block.name + "'";
  int id = -1;
  file.check_netcdf(nc_inq_varid(file.id(), stored_as.c_str(), &id), operation);
  const auto width = static_cast<std::size_t>(corners(block));
  std::vector<long long> nodes;
  for_pieces(count(block), [&](std::int64_t first, std::int64_t elements) {
    const auto begin = block.nodes.begin() + first * corners(block);
    nodes.resize(static_cast<std::size_t>(elements) * width);
    std::transform(begin, begin + std::ssize(nodes), nodes.begin(),
                   [](std::int64_t node) { return node + 1; });
    const std::array<std::size_t, 2> start{static_cast<std::size_t>(first), 0};
    const std::array<std::size_t, 2> extent{static_cast<std::size_t>(elements), width};
    file.check_netcdf(
        nc_put_vara_longlong(file.id(), id, start.data(), extent.data(), nodes.data()), operation);
  });
}

void put_blocks(const ExodusFile& file, const ResultLayout& layout) {
  if (layout.blocks.empty()) return;
  Texts names(names_of(layout.blocks));
  file.check(ex_put_names(file.id(), EX_ELEM_BLOCK, names.data()), "write the names of the blocks");
  for (std::size_t i = 0; i < layout.blocks.size(); ++i) {
    put_elements(file, layout.blocks[i], "connect" + std::to_string(i + 1));
  }
}

void put_node_sets(const ExodusFile& file, const ResultLayout& layout) {
  if (layout.node_sets.empty()) return;
  Texts names(names_of(layout.node_sets));
  file.check(ex_put_names(file.id(), EX_NODE_SET, names.data()),
             "write the names of the node sets");
  for (std::size_t i = 0; i < layout.node_sets.size(); ++i) {
    const std::vector<std::int64_t> nodes = one_based(layout.node_sets[i].nodes);
    file.check(ex_put_set(file.id(), EX_NODE_SET, entity(i), nodes.data(), nullptr),
               "write the node set '" + layout.node_sets[i].name + "'");
  }
}

void put_variable_names(const ExodusFile& file, ex_entity_type type,
                        const std::vector<ResultVariable>& variables) {
  if (variables.empty()) return;
  Texts names(names_of(variables));
  file.check(ex_put_variable_names(file.id(), type, names.count(), names.data()),
             "write the names of the variables");
}

// Exodus has no place for units; attributes of the netCDF variables do not disturb its readers.
void put_units(const ExodusFile& file, const std::string& stored_as,
               const ResultVariable& variable) {
  const std::string operation = "write the units of '" + variable.name + "'";
  const auto put = [&](int id, const char* name, const std::string& text) {
    file.check_netcdf(nc_put_att_text(file.id(), id, name, text.size(), text.data()), operation);
  };
  int id = -1;
  file.check_netcdf(nc_inq_varid(file.id(), stored_as.c_str(), &id), operation);
  put(id, "units", variable.units);
  put(id, "long_name", variable.description);
}

void put_all_units(const ExodusFile& file, const ResultLayout& layout) {
  file.check_netcdf(nc_redef(file.id()), "write the units");
  for (std::size_t v = 0; v < layout.nodal.size(); ++v) {
    put_units(file, "vals_nod_var" + std::to_string(v + 1), layout.nodal[v]);
  }
  for (std::size_t v = 0; v < layout.element.size(); ++v) {
    for (std::size_t b = 0; b < layout.blocks.size(); ++b) {
      put_units(file, "vals_elem_var" + std::to_string(v + 1) + "eb" + std::to_string(b + 1),
                layout.element[v]);
    }
  }
  // All globals share one netCDF variable: its units are a list.
  ResultVariable all;
  for (const ResultVariable& variable : layout.global) {
    all.units += (all.units.empty() ? "" : "; ") + variable.name + " [" + variable.units + "]";
    all.description +=
        (all.description.empty() ? "" : "; ") + variable.name + ": " + variable.description;
  }
  if (!layout.global.empty()) put_units(file, "vals_glo_var", all);
  file.check_netcdf(nc_enddef(file.id()), "write the units");
}

void define_variables(const ExodusFile& file, const ResultLayout& layout) {
  const int blocks = static_cast<int>(layout.blocks.size());
  const int element = blocks > 0 ? static_cast<int>(layout.element.size()) : 0;
  std::vector<int> everywhere(static_cast<std::size_t>(blocks * element), 1);
  file.check(ex_put_all_var_param(file.id(), static_cast<int>(layout.global.size()),
                                  static_cast<int>(layout.nodal.size()), element,
                                  everywhere.empty() ? nullptr : everywhere.data(), 0, nullptr, 0,
                                  nullptr),
             "define the variables");
  put_variable_names(file, EX_GLOBAL, layout.global);
  put_variable_names(file, EX_NODAL, layout.nodal);
  if (element > 0) put_variable_names(file, EX_ELEM_BLOCK, layout.element);
  put_all_units(file, layout);
}

}  // namespace

void check_layout(const std::string& path, const ResultLayout& layout) {
  check_sizes(path, layout);
  check_names(path, "block", layout.blocks);
  check_names(path, "node set", layout.node_sets);
  check_names(path, "nodal variable", layout.nodal);
  check_names(path, "element variable", layout.element);
  check_names(path, "global variable", layout.global);
  const std::int64_t points = std::ssize(layout.points) / 3;
  for (const ResultBlock& block : layout.blocks) {
    check_nodes(path, "block '" + block.name + "'", block.nodes, points);
    if (std::ssize(block.nodes) % corners(block) != 0) {
      throw Error(path + ": block '" + block.name + "' has " + std::to_string(block.nodes.size()) +
                  " nodes, which is not a multiple of " + std::to_string(corners(block)));
    }
  }
  for (const MeshGroup& set : layout.node_sets) {
    check_nodes(path, "node set '" + set.name + "'", set.nodes, points);
  }
}

void write_exodus_definition(const std::string& path, const ResultLayout& layout) {
  ExodusFile file = ExodusFile::create(path);
  // Definitions first: a later one moves all data behind it.
  define_sizes(file, layout);
  define_blocks_and_sets(file, layout);
  define_variables(file, layout);
  put_records(file, layout);
  put_blocks(file, layout);
  put_node_sets(file, layout);
  put_points(file, layout);
  file.close();
}

std::vector<std::string> information_records(const ResultLayout& layout) {
  constexpr std::size_t kLength = MAX_LINE_LENGTH;
  std::vector<std::string> records;
  for (const auto& [name, text] : layout.information) {
    std::string rest = name + ": " + text + '\n';
    while (!rest.empty()) {
      const std::size_t end = rest.find('\n');
      std::string line = rest.substr(0, end);
      rest.erase(0, end + 1);
      while (line.size() > kLength) {
        std::size_t cut = kLength - 1;
        // not inside a UTF-8 character, whose following bytes are 10xxxxxx
        while (cut > 1 && (static_cast<unsigned char>(line[cut]) & 0xc0) == 0x80) --cut;
        records.push_back(line.substr(0, cut) + '\\');
        line.erase(0, cut);
      }
      records.push_back(line);
    }
  }
  return records;
}

}  // namespace cleave::io
