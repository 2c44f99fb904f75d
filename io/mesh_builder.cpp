// Puts a mesh together: node numbers, repeated cells, groups.
#include "io/mesh_builder.hpp"

#include <algorithm>
#include <array>
#include <functional>
#include <limits>
#include <numeric>

#include "io/error.hpp"

namespace cleave::io {
namespace {

using Corners = std::array<std::int64_t, 4>;

Corners sorted_corners(const CellBlock& block, std::int64_t cell) {
  const auto corners = static_cast<std::int64_t>(block.kind);
  Corners key{};
  for (std::int64_t k = 0; k < corners; ++k) {  // by insertion
    const std::int64_t node = block.nodes[static_cast<std::size_t>(cell * corners + k)];
    auto place = static_cast<std::size_t>(k);
    for (; place > 0 && key[place - 1] > node; --place) key[place] = key[place - 1];
    key[place] = node;
  }
  return key;
}

void sort_unique(std::vector<std::int64_t>& values) {
  const auto out_of_order =
      std::adjacent_find(values.begin(), values.end(), std::greater_equal<>{});
  if (out_of_order == values.end()) return;
  std::sort(values.begin(), values.end());
  values.erase(std::unique(values.begin(), values.end()), values.end());
}

// Sorted and unique, of values in 0..limit, by marks: linear, and a bit for each possible value.
class Marks {
 public:
  explicit Marks(std::int64_t limit) : marked_(static_cast<std::size_t>(limit), false) {}
  void set(std::int64_t value) {
    auto mark = marked_[static_cast<std::size_t>(value)];
    count_ += mark ? 0 : 1;
    mark = true;
  }
  std::vector<std::int64_t> values() const {
    std::vector<std::int64_t> values;
    values.reserve(count_);
    for (std::size_t value = 0; value < marked_.size(); ++value)
      if (marked_[value]) values.push_back(static_cast<std::int64_t>(value));
    return values;
  }

 private:
  std::vector<bool> marked_;
  std::size_t count_ = 0;
};

constexpr std::int64_t kMany = 32;  // marking costs a bit a possible value

void sort_unique(std::vector<std::int64_t>& values, std::int64_t limit) {
  if (std::ssize(values) < limit / kMany) return sort_unique(values);
  Marks marks(limit);
  for (const std::int64_t value : values) marks.set(value);
  values = marks.values();
}

// Sorted and unique: the given nodes and the corners of the cells.
std::vector<std::int64_t> nodes_of(std::vector<std::int64_t> nodes, const CellBlock& block,
                                   std::span<const std::int64_t> cells, std::int64_t point_count) {
  const auto corners = static_cast<std::ptrdiff_t>(block.kind);
  const auto for_corners = [&](auto visit) {
    for (const std::int64_t cell : cells)
      for (auto corner = cell * corners; corner < (cell + 1) * corners; ++corner)
        visit(block.nodes[static_cast<std::size_t>(corner)]);
  };
  if (std::ssize(cells) * corners < point_count / kMany) {
    for_corners([&](std::int64_t node) { nodes.push_back(node); });
    sort_unique(nodes, point_count);
    return nodes;
  }
  Marks marks(point_count);
  for (const std::int64_t node : nodes) marks.set(node);
  for_corners([&](std::int64_t node) { marks.set(node); });
  return marks.values();
}

std::int64_t smallest_corner(const CellBlock& block, std::int64_t cell) {
  const auto corners = static_cast<std::int64_t>(block.kind);
  const auto begin = block.nodes.begin() + cell * corners;
  return *std::min_element(begin, begin + corners);
}

// Cells by their smallest corner: those of node n are cell[begin[n]] to cell[begin[n + 1]], in order.
struct Buckets {
  std::vector<std::uint32_t> begin, cell;
};

Buckets by_smallest_corner(const CellBlock& block, std::int64_t point_count) {
  Buckets buckets;
  const std::int64_t cells = block.count();
  if (cells >= std::numeric_limits<std::uint32_t>::max())
    throw Error("a mesh of " + std::to_string(cells) +
                " cells of one kind; at most 4294967294 can be read; divide it");
  buckets.begin.assign(static_cast<std::size_t>(point_count) + 1, 0);
  buckets.cell.resize(static_cast<std::size_t>(cells));
  const auto end_of = [&](std::int64_t cell) -> std::uint32_t& {
    return buckets.begin[static_cast<std::size_t>(smallest_corner(block, cell))];
  };
  for (std::int64_t cell = 0; cell < cells; ++cell) ++end_of(cell);
  std::inclusive_scan(buckets.begin.begin(), buckets.begin.end(), buckets.begin.begin());
  for (std::int64_t cell = cells; cell-- > 0;)  // from the back: the ends become beginnings
    buckets.cell[--end_of(cell)] = static_cast<std::uint32_t>(cell);
  return buckets;
}

// For every cell the first cell with the same corners; empty if no cell occurs twice. Only cells that
// share their smallest corner are compared.
std::vector<std::int64_t> first_equals(const CellBlock& block, std::int64_t point_count) {
  std::vector<std::int64_t> equal;
  const Buckets buckets = by_smallest_corner(block, point_count);
  std::vector<std::pair<Corners, std::int64_t>> keys;
  for (std::size_t node = 0; node + 1 < buckets.begin.size(); ++node) {
    keys.clear();
    for (std::size_t k = buckets.begin[node]; k < buckets.begin[node + 1]; ++k)
      keys.emplace_back(sorted_corners(block, buckets.cell[k]), buckets.cell[k]);
    std::sort(keys.begin(), keys.end());
    std::size_t first = 0;
    for (std::size_t i = 1; i < keys.size(); ++i) {
      if (keys[i].first != keys[first].first) {
        first = i;
        continue;
      }
      if (equal.empty()) {
        equal.resize(buckets.cell.size());
        std::iota(equal.begin(), equal.end(), std::int64_t{0});
      }
      equal[static_cast<std::size_t>(keys[i].second)] = keys[first].second;
    }
  }
  return equal;
}

}  // namespace

std::int64_t NodeNumbers::build(std::span<const std::int64_t> ids) {
  consecutive_ = true;
  table_.clear();
  sorted_.clear();
  count_ = static_cast<std::int64_t>(ids.size());
  if (ids.empty()) return -1;

  const auto [low, high] = std::minmax_element(ids.begin(), ids.end());
  first_ = *low;
  for (std::size_t i = 0; consecutive_ && i < ids.size(); ++i)
    consecutive_ = ids[i] - first_ == static_cast<std::int64_t>(i);
  if (consecutive_) return -1;

  constexpr std::int64_t kDense = 4;  // a table up to four times the number of nodes
  if (*high - first_ < kDense * count_) {
    table_.assign(static_cast<std::size_t>(*high - first_ + 1), -1);
    for (std::size_t i = 0; i < ids.size(); ++i) {
      std::int64_t& entry = table_[static_cast<std::size_t>(ids[i] - first_)];
      if (entry >= 0) return ids[i];
      entry = static_cast<std::int64_t>(i);
    }
    return -1;
  }
  sorted_.reserve(ids.size());
  for (std::size_t i = 0; i < ids.size(); ++i)
    sorted_.emplace_back(ids[i], static_cast<std::int64_t>(i));
  std::sort(sorted_.begin(), sorted_.end());
  const auto twice =
      std::adjacent_find(sorted_.begin(), sorted_.end(),
                         [](const auto& a, const auto& b) { return a.first == b.first; });
  return twice == sorted_.end() ? -1 : twice->first;
}

std::int64_t NodeNumbers::lookup(std::int64_t id) const {
  if (!table_.empty()) {
    if (id < first_ || id - first_ >= static_cast<std::int64_t>(table_.size())) return -1;
    return table_[static_cast<std::size_t>(id - first_)];
  }
  const auto at = std::lower_bound(sorted_.begin(), sorted_.end(), std::pair{id, std::int64_t{0}});
  return at != sorted_.end() && at->first == id ? at->second : -1;
}

std::vector<std::int64_t> remove_repeated_cells(CellBlock& block, std::int64_t point_count) {
  std::vector<std::int64_t> index = first_equals(block, point_count);
  if (index.empty()) return {};
  const auto corners = static_cast<std::size_t>(block.kind);
  std::size_t kept = 0;
  for (std::size_t cell = 0; cell < index.size(); ++cell) {
    const auto first = static_cast<std::size_t>(index[cell]);
    if (first != cell) {
      index[cell] = index[first];  // smaller than `cell`: already new
      continue;
    }
    std::copy_n(block.nodes.begin() + static_cast<std::ptrdiff_t>(cell * corners), corners,
                block.nodes.begin() + static_cast<std::ptrdiff_t>(kept * corners));
    index[cell] = static_cast<std::int64_t>(kept++);
  }
  block.nodes.resize(kept * corners);
  return index;
}

void MeshBuilder::expect_cells(CellKind kind, std::int64_t count) {
  std::vector<std::int64_t>& nodes = block(kind).nodes;
  const std::size_t wanted =
      nodes.size() + static_cast<std::size_t>(count * static_cast<std::int64_t>(kind));
  // Not less than doubled: there may be many small blocks.
  if (wanted > nodes.capacity()) nodes.reserve(std::max(wanted, 2 * nodes.capacity()));
}

CellBlock& MeshBuilder::block(CellKind kind) {
  if (kind == CellKind::line) return mesh_.lines;
  return kind == CellKind::triangle ? mesh_.triangles : mesh_.tetrahedra;
}

MeshBuilder::Group MeshBuilder::group(const std::string& name, int dimension) {
  const auto [at, is_new] = group_numbers_.try_emplace({dimension, name}, members_.size());
  if (is_new) members_.emplace_back();
  return at->second;
}

void MeshBuilder::add_cells(Group group, std::int64_t first, std::int64_t last) {
  if (first == last) return;
  auto& ranges = members_[group].ranges;
  if (!ranges.empty() && ranges.back().second == first)
    ranges.back().second = last;
  else
    ranges.emplace_back(first, last);
}

MeshGroup MeshBuilder::finish_group(const std::string& name, int dimension, Members& members,
                                    std::span<const std::vector<std::int64_t>> new_index) {
  MeshGroup result{name, dimension, std::move(members.nodes), {}};
  if (dimension > 0) {
    const std::vector<std::int64_t>& renumbered =
        new_index[static_cast<std::size_t>(dimension) - 1];
    std::int64_t count = 0;
    for (const auto& [first, last] : members.ranges) count += last - first;
    result.cells.reserve(static_cast<std::size_t>(count));
    for (const auto& [first, last] : members.ranges)
      for (std::int64_t cell = first; cell < last; ++cell)
        result.cells.push_back(renumbered.empty() ? cell
                                                  : renumbered[static_cast<std::size_t>(cell)]);
    sort_unique(result.cells);
    const CellBlock& cells = block(static_cast<CellKind>(dimension + 1));
    result.nodes = nodes_of(std::move(result.nodes), cells, result.cells, mesh_.point_count());
  } else {
    sort_unique(result.nodes, mesh_.point_count());
  }
  return result;
}

Mesh MeshBuilder::finish() {
  const std::array<std::vector<std::int64_t>, 3> new_index = {
      remove_repeated_cells(mesh_.lines, mesh_.point_count()),
      remove_repeated_cells(mesh_.triangles, mesh_.point_count()),
      remove_repeated_cells(mesh_.tetrahedra, mesh_.point_count())};
  for (const auto& [key, number] : group_numbers_)
    mesh_.groups.push_back(finish_group(key.second, key.first, members_[number], new_index));
  for (const auto& [type, count] : skipped_) mesh_.skipped.push_back({type, count});
  return std::move(mesh_);
}

}  // namespace cleave::io
