#include "scene/cloud.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <numeric>

#include "scene/csv_columns.hpp"
#include "scene/format.hpp"
#include "scene/index.hpp"
#include "scene/region.hpp"

namespace cleave::driver {
namespace {

double volume_of(const BodyGeometry& body, const std::int32_t* v) {
  std::array<std::array<double, 3>, 3> edge{};
  for (int a = 0; a < body.dimension; ++a)
    for (int k = 0; k < 3; ++k)
      edge[at(a)][at(k)] = body.X[at(3 * Index{v[a + 1]} + k)] - body.X[at(3 * Index{v[0]} + k)];
  const auto& [a, b, c] = edge;
  if (body.dimension == 2) return std::abs(a[0] * b[1] - a[1] * b[0]) / 2;
  return std::abs(a[0] * (b[1] * c[2] - b[2] * c[1]) - a[1] * (b[0] * c[2] - b[2] * c[0]) +
                  a[2] * (b[0] * c[1] - b[1] * c[0])) /
         6;
}

void make_cloud(BodyGeometry& body) {
  body.cloud = true;
  body.simplices.resize(at(body.particles()));
  std::iota(body.simplices.begin(), body.simplices.end(), 0);
}

// Column of the file; zeros if it is missing and may be.
std::vector<double> column(const CsvColumns& csv, const std::string& name, bool required) {
  std::vector<double> values(csv.rows.size(), 0.0);
  const auto found = std::find(csv.names.begin(), csv.names.end(), name);
  if (found == csv.names.end()) {
    if (!required) return values;
    throw DeckError(csv.path + ":1: there is no column " + name +
                    "; points need the columns X, Y, Z (space only) and volume");
  }
  const auto place = static_cast<std::size_t>(found - csv.names.begin());
  for (std::size_t row = 0; row < values.size(); ++row) values[row] = csv.rows[row][place];
  return values;
}

// Keeps particles and simplices; new numbers follow the old order.
void keep(BodyGeometry& body, const std::vector<char>& kept) {
  std::vector<std::int32_t> number_of(kept.size(), -1);
  std::int32_t count = 0;
  for (std::size_t i = 0; i < kept.size(); ++i) {
    if (kept[i] == 0) continue;
    number_of[i] = count;
    const auto to = at(count);
    for (std::size_t k = 0; k < 3; ++k) body.X[3 * to + k] = body.X[3 * i + k];
    body.point_ids[to] = body.point_ids[i];
    if (!body.volumes.empty()) body.volumes[to] = body.volumes[i];
    ++count;
  }
  body.X.resize(at(3 * Index{count}));
  body.point_ids.resize(at(count));
  if (!body.volumes.empty()) body.volumes.resize(at(count));
  const auto renumber = [&](auto& list, std::size_t together) {
    std::size_t out = 0;
    for (std::size_t s = 0; s + together <= list.size(); s += together) {
      const bool whole = std::all_of(list.begin() + static_cast<std::ptrdiff_t>(s),
                                     list.begin() + static_cast<std::ptrdiff_t>(s + together),
                                     [&](auto i) { return number_of[at(Index{i})] >= 0; });
      for (std::size_t a = 0; whole && a < together; ++a)
        list[out++] = number_of[at(Index{list[s + a]})];
    }
    list.resize(out);
  };
  renumber(body.simplices, at(body.simplex_nodes()));
  for (NamedSet& group : body.groups) renumber(group.particles, 1);
  std::erase_if(body.groups, [](const NamedSet& group) { return group.particles.empty(); });
  for (auto& facets : body.crack_facets) renumber(facets, at(Index{body.dimension}));
  body.shortest_edge_found = 0;
}

}  // namespace

bool has_cell_points(const DeckGroup& group) {
  return group.name == "lattice" && group.text("points") == "centres";
}

// Points in the middle of cells: the lattice of their own is half a spacing smaller on each side.
void check_cell_points(const Deck& deck, const DeckGroup& group) {
  if (!has_cell_points(group)) return;
  const std::string& type = group.text("type");
  const bool is_turned = group.given("x_axis") || group.given("y_axis");
  if ((type != "square" && type != "cubic") || group.text("shape") != "block" || is_turned ||
      !group.text("inside").empty()) {
    deck.fail(group, "points",
              "points = 'centres' is for blocks of a square or cubic lattice along the axes; use "
              "points = 'corners', or a file of points");
  }
  for (std::size_t k = 0; k < (type == "square" ? 2u : 3u); ++k) {
    if (group.reals("size")[k] > 1.5 * group.real("spacing")) continue;
    deck.fail(group, "size",
              "points = 'centres' needs two cells or more along each axis; along " +
                  std::string(1, "xyz"[k]) + " the size is " + number(group.reals("size")[k]) +
                  " and the spacing " + number(group.real("spacing")));
  }
}

void take_volumes(const Deck& deck, const DeckGroup& group, const DeckGroup& source,
                  BodyGeometry& body) {
  const bool cells = group.text("particles") == "cells";
  if (cells && has_cell_points(source)) {
    deck.fail(
        group, "particles",
        "the points of the lattice are the middles of its cells already; use particles = 'nodes'");
  }
  if (cells && group.text("elements") == "quadratic") {
    deck.fail(group, "particles", "particles = 'cells' has no elements; use elements = 'linear'");
  }
  if (cells) turn_cells_into_points(body);
  if (has_cell_points(source)) {
    body.volumes.assign(at(body.particles()), std::pow(source.real("spacing"), body.dimension));
  }
}

BodyGeometry read_points(const Deck& deck, const DeckGroup& points, int dimension) {
  namespace fs = std::filesystem;
  const fs::path file(points.text("file"));
  const fs::path path = file.is_absolute() ? file : fs::path(deck.source.path).parent_path() / file;
  CsvColumns csv;
  try {
    csv = read_csv_columns(path.string());
  } catch (const DeckError& error) {
    deck.fail(points, "file", error.what());
  }
  BodyGeometry body;
  body.dimension = dimension;
  const double scale = points.real("scale");
  const std::array position{column(csv, "X", true), column(csv, "Y", true),
                            column(csv, "Z", dimension == 3)};
  body.volumes = column(csv, "volume", true);
  for (std::size_t row = 0; row < csv.rows.size(); ++row) {
    for (const auto& along : position) body.X.push_back(scale * along[row]);
    body.point_ids.push_back(static_cast<Index>(row) + 1);
    body.volumes[row] *= std::pow(scale, dimension);
    if (!(body.volumes[row] > 0)) {
      deck.fail(points, "file",
                csv.place(row) + ": the volume of a point is " + number(csv.rows[row].back()) +
                    "; allowed: > 0; leave the point out");
    }
  }
  make_cloud(body);
  return body;
}

void turn_cells_into_points(BodyGeometry& body) {
  const Index corners = body.dimension + 1;
  BodyGeometry cells;
  cells.name = body.name;
  cells.dimension = body.dimension;
  for (Index s = 0; s < body.simplex_count(); ++s) {
    const std::int32_t* v = &body.simplices[at(s * corners)];
    for (Index k = 0; k < 3; ++k) {
      double sum = 0;
      for (Index a = 0; a < corners; ++a) sum += body.X[at(3 * Index{v[a]} + k)];
      cells.X.push_back(sum / static_cast<double>(corners));
    }
    cells.point_ids.push_back(s + 1);
    cells.volumes.push_back(volume_of(body, v));
  }
  for (const NamedSet& group : body.groups) {
    std::vector<char> inside(at(body.particles()), 0);
    for (const Index i : group.particles) inside[at(i)] = 1;
    NamedSet set{group.name, {}};
    for (Index s = 0; s < body.simplex_count(); ++s) {
      const std::int32_t* v = &body.simplices[at(s * corners)];
      if (std::all_of(v, v + corners, [&](std::int32_t i) { return inside[at(i)] != 0; }))
        set.particles.push_back(s);
    }
    if (!set.particles.empty()) cells.groups.push_back(std::move(set));
  }
  make_cloud(cells);
  body = std::move(cells);
}

void cut_notches(const Deck& deck, std::vector<BodyGeometry>& bodies) {
  for (const DeckGroup* notch : deck.all("notch")) {
    const Region region(deck, *notch);
    Index removed = 0;
    for (BodyGeometry& body : bodies) {
      if (!notch->text("body").empty() && notch->text("body") != body.name) continue;
      const double margin = notch->real("tolerance") * shortest_edge(body);
      std::vector<char> kept(at(body.particles()), 1);
      for (Index i = 0; i < body.particles(); ++i) {
        if (!region.contains(&body.X[at(3 * i)], margin)) continue;
        kept[at(i)] = 0;
        ++removed;
      }
      if (std::find(kept.begin(), kept.end(), 1) == kept.end()) {
        deck.fail(*notch, "this notch takes all particles of body " + in_quotes(body.name));
      }
      keep(body, kept);
      if (!body.volumes.empty()) continue;
      // Without a simplex a particle of a mesh has no volume.
      std::vector<char> used(at(body.particles()), 0);
      for (const std::int32_t i : body.simplices) used[at(Index{i})] = 1;
      keep(body, used);
    }
    if (removed == 0) deck.fail(*notch, "this notch holds no particle");
  }
}

}  // namespace cleave::driver
