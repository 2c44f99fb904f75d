#include "scene/geometry.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <limits>
#include <map>
#include <numeric>
#include <utility>

#include "io/error.hpp"
#include "io/lattice.hpp"
#include "io/lattice_cut.hpp"
#include "io/mesh.hpp"
#include "scene/cloud.hpp"
#include "scene/format.hpp"
#include "scene/index.hpp"
#include "scene/split.hpp"

namespace cleave::driver {
namespace {

io::LatticeSpec lattice_spec(const DeckGroup& group) {
  static const std::map<std::string, io::LatticeKind> kinds{
      {"square", io::LatticeKind::square},
      {"hexagonal", io::LatticeKind::hexagonal},
      {"cubic", io::LatticeKind::cubic},
      {"bcc", io::LatticeKind::bcc},
      {"fcc", io::LatticeKind::fcc}};
  static const std::map<std::string, io::ShapeKind> shapes{{"block", io::ShapeKind::block},
                                                           {"cylinder", io::ShapeKind::cylinder},
                                                           {"sphere", io::ShapeKind::sphere}};
  io::LatticeSpec spec;
  spec.lattice = kinds.at(group.text("type"));
  spec.shape = shapes.at(group.text("shape"));
  spec.spacing = group.real("spacing");
  const auto& origin = group.reals("origin");
  const auto& size = group.reals("size");
  std::copy_n(origin.begin(), 3, spec.origin.begin());
  std::copy_n(size.begin(), 3, spec.size.begin());
  if (has_cell_points(group)) {
    for (std::size_t k = 0; k < (spec.lattice == io::LatticeKind::square ? 2u : 3u); ++k) {
      spec.origin[k] += 0.5 * spec.spacing;
      spec.size[k] -= spec.spacing;
    }
  }
  spec.radius = group.real("radius");
  spec.height = group.real("height");
  spec.axis = group.text("axis")[0] - 'x';
  std::copy_n(group.reals("x_axis").begin(), 3, spec.x_axis.begin());
  std::copy_n(group.reals("y_axis").begin(), 3, spec.y_axis.begin());
  return spec;
}

io::Mesh read_mesh(const Deck& deck, const DeckGroup& group) {
  namespace fs = std::filesystem;
  const fs::path file(group.text("file"));
  const fs::path path = file.is_absolute() ? file : fs::path(deck.source.path).parent_path() / file;
  try {
    io::Mesh mesh = io::read_mesh(path.string());
    const double scale = group.real("scale");
    for (double& x : mesh.points) x *= scale;
    return mesh;
  } catch (const io::Error& error) {
    deck.fail(group, "file", error.what());
  }
}

// The lattice, cut to the mesh that it is to be inside of.
io::Mesh cut_lattice(const Deck& deck, const DeckGroup& group) {
  const std::string& inside = group.text("inside");
  io::LatticeSpec spec = lattice_spec(group);
  if (inside.empty()) return io::make_lattice(spec);
  const DeckGroup& source = named_group(deck, {"mesh", "lattice", "points"}, inside);
  if (source.name != "mesh")
    deck.fail(group, "inside", in_quotes(inside) + " is a &" + source.name + "; allowed: a &mesh");
  const io::Mesh outline = read_mesh(deck, source);
  const auto& size = group.reals("size");
  const bool no_size = std::all_of(size.begin(), size.end(), [](double a) { return a == 0; });
  if (spec.shape == io::ShapeKind::block && no_size) spec = io::around(spec, outline);
  io::Mesh lattice = io::make_lattice(spec);
  io::cut_to_outline(outline, spec.spacing, lattice);
  return lattice;
}

io::Mesh mesh_of(const Deck& deck, const DeckGroup& group) {
  if (group.name != "lattice") return read_mesh(deck, group);
  check_cell_points(deck, group);
  try {
    return cut_lattice(deck, group);
  } catch (const io::Error& error) {
    deck.fail(group, error.what());
  }
}

// Meshes by name, each read once and kept until its last body is made.
class Meshes {
 public:
  explicit Meshes(const Deck& deck) : deck_(deck) {
    for (const DeckGroup* body : deck.all("body")) ++bodies_left_[body->text("mesh")];
  }

  const io::Mesh& get(const std::string& name) {
    const auto [entry, is_new] = meshes_.try_emplace(name);
    if (is_new) entry->second = mesh_of(deck_, named_group(deck_, {"mesh", "lattice"}, name));
    return entry->second;
  }
  void used(const std::string& name) {
    if (--bodies_left_.at(name) == 0) meshes_.erase(name);
  }

 private:
  const Deck& deck_;
  std::map<std::string, io::Mesh> meshes_;
  std::map<std::string, int> bodies_left_;
};

std::vector<std::string> group_names(const io::Mesh& mesh, int dimension) {
  std::vector<std::string> names;
  for (const auto& group : mesh.groups) {
    if (group.dimension == dimension) names.push_back(group.name);
  }
  return names;
}

// The cells of a body, numbers in the block of their kind.
std::vector<Index> cells_of(const Deck& deck, const DeckGroup& body, const io::Mesh& mesh,
                            int dimension) {
  const io::CellBlock& block = dimension == 2 ? mesh.triangles : mesh.tetrahedra;
  const std::string& set = body.text("set");
  const char* cells = dimension == 2 ? "triangles" : "tetrahedra";
  if (set.empty()) {
    if (block.count() == 0) {
      deck.fail(body, "mesh",
                "the mesh has no " + std::string(cells) + " for a body with kinematics " +
                    in_quotes(body.text("kinematics")) + "; it has " +
                    number(mesh.triangles.count()) + " triangles and " +
                    number(mesh.tetrahedra.count()) + " tetrahedra");
    }
    std::vector<Index> all(at(block.count()));
    std::iota(all.begin(), all.end(), Index{0});
    return all;
  }
  const io::MeshGroup* group = mesh.find_group(set);
  if (group == nullptr || group->dimension != dimension || group->cells.empty()) {
    deck.fail(body, "set",
              in_quotes(set) + " is not a group of " + cells + " of the mesh; known groups of " +
                  cells + ": " + list(group_names(mesh, dimension)));
  }
  return group->cells;
}

// A plane body lies in a plane of constant z; z is then dropped.
void flatten(const Deck& deck, const DeckGroup& group, BodyGeometry& body) {
  const Box box = bounding_box(body);
  const double extent = std::max(box.upper[0] - box.lower[0], box.upper[1] - box.lower[1]);
  if (box.upper[2] - box.lower[2] > 1e-9 * extent) {  // far above the rounding of a mesh file
    deck.fail(group, "kinematics",
              "a plane body needs points with one z; here z runs from " + number(box.lower[2]) +
                  " to " + number(box.upper[2]) + ". Use kinematics = '3d' or another mesh");
  }
  for (Index i = 0; i < body.particles(); ++i) body.X[at(3 * i + 2)] = 0.0;
}

void check_body_name(const Deck& deck, const DeckGroup& group) {
  const std::string& name = group.text("name");
  // A name in an archive; '-' is not allowed there.
  const bool plain = is_column_name(name) && name.find('-') == std::string::npos;
  if (!plain) {
    deck.fail(group, "name",
              in_quotes(name) + " cannot name a body in files; use letters, digits, _ and .");
  }
}

// New number of every mesh node, -1 if the body does not use it; gives the body its simplices.
std::vector<Index> take_simplices(const Deck& deck, const DeckGroup& group, const io::Mesh& mesh,
                                  BodyGeometry& body) {
  const std::vector<Index> cells = cells_of(deck, group, mesh, body.dimension);
  const io::CellBlock& block = body.dimension == 2 ? mesh.triangles : mesh.tetrahedra;
  const Index corners = body.dimension + 1;
  std::vector<Index> number_of(at(mesh.point_count()), -1);
  for (const Index cell : cells)
    for (Index a = 0; a < corners; ++a) number_of[at(block.nodes[at(cell * corners + a)])] = 0;
  Index count = 0;
  for (Index& entry : number_of) {
    if (entry == 0) entry = count++;
  }
  if (count > std::numeric_limits<std::int32_t>::max()) {
    deck.fail(group, "mesh",
              "the body would have " + number(count) +
                  " particles, more than the 2147483647 that are possible; divide it");
  }
  body.X.reserve(3 * at(count));
  body.point_ids.reserve(at(count));
  body.simplices.reserve(cells.size() * at(corners));
  for (const Index cell : cells)
    for (Index a = 0; a < corners; ++a)
      body.simplices.push_back(
          static_cast<std::int32_t>(number_of[at(block.nodes[at(cell * corners + a)])]));
  return number_of;
}

BodyGeometry take_points(const Deck& deck, const DeckGroup& group, const DeckGroup& source) {
  BodyGeometry body = read_points(deck, source, dimension_of(group.text("kinematics")));
  body.name = group.text("name");
  const auto& shift = group.reals("translate");
  for (std::size_t c = 0; c < body.X.size(); ++c) body.X[c] += shift[c % 3];
  if (body.dimension == 2) flatten(deck, group, body);
  return body;
}

BodyGeometry take_body(const Deck& deck, const DeckGroup& group, const io::Mesh& mesh,
                       std::vector<Index>& crack_use) {
  BodyGeometry body;
  body.name = group.text("name");
  body.dimension = dimension_of(group.text("kinematics"));
  const std::vector<Index> number_of = take_simplices(deck, group, mesh, body);
  const auto& shift = group.reals("translate");
  for (Index node = 0; node < mesh.point_count(); ++node) {
    if (number_of[at(node)] < 0) continue;
    for (Index k = 0; k < 3; ++k) body.X.push_back(mesh.points[at(3 * node + k)] + shift[at(k)]);
    body.point_ids.push_back(mesh.point_ids.empty() ? node + 1 : mesh.point_ids[at(node)]);
  }
  if (body.dimension == 2) flatten(deck, group, body);
  for (const io::MeshGroup& mesh_group : mesh.groups) {
    NamedSet set{mesh_group.name, {}};
    for (const Index node : mesh_group.nodes) {
      if (number_of[at(node)] >= 0) set.particles.push_back(number_of[at(node)]);
    }
    if (!set.particles.empty()) body.groups.push_back(std::move(set));
  }
  take_mesh_cracks(deck, mesh, number_of, body, crack_use);
  if (group.text("elements") == "quadratic") {
    if (body.dimension != 2 || group.text("formulation") != "fem") {
      deck.fail(group, "elements",
                "quadratic elements are six-node triangles of formulation 'fem' in a plane; use "
                "elements = 'linear'");
    }
    make_quadratic(body);
  }
  return body;
}

}  // namespace

const NamedSet* BodyGeometry::find_group(const std::string& group) const {
  for (const NamedSet& set : groups) {
    if (set.name == group) return &set;
  }
  return nullptr;
}

namespace {

// Edges by their ends: those of each lower end are chained, of which there are a few.
class Edges {
 public:
  explicit Edges(Index particles) : first_(at(particles), -1) {}

  // The number of the edge; new ones are numbered in order.
  std::pair<Index, bool> find_or_add(Index a, Index b) {
    const auto [lower, upper] = std::minmax(a, b);
    Index edge = first_[at(lower)];
    while (edge >= 0 && edges_[at(edge)].upper != upper) edge = edges_[at(edge)].next;
    if (edge >= 0) return {edge, false};
    edges_.push_back({lower, upper, first_[at(lower)]});
    first_[at(lower)] = std::ssize(edges_) - 1;
    return {first_[at(lower)], true};
  }

  struct Edge {
    Index lower, upper, next;
  };
  const std::vector<Edge>& all() const { return edges_; }

 private:
  std::vector<Index> first_;
  std::vector<Edge> edges_;
};

}  // namespace

void make_quadratic(BodyGeometry& body) {
  const Index corners = body.particles();
  Edges edges(corners);
  std::vector<std::int32_t> nodes;
  nodes.reserve(2 * body.simplices.size());
  Index last_id = *std::max_element(body.point_ids.begin(), body.point_ids.end());
  for (Index s = 0; s < body.simplex_count(); ++s) {
    const std::int32_t* v = &body.simplices[at(s * body.simplex_nodes())];
    nodes.insert(nodes.end(), v, v + 3);
    for (int a = 0; a < 3; ++a) {
      const auto [edge, is_new] = edges.find_or_add(v[a], v[(a + 1) % 3]);
      nodes.push_back(static_cast<std::int32_t>(corners + edge));
      if (!is_new) continue;
      const auto& ends = edges.all()[at(edge)];
      for (Index k = 0; k < 3; ++k) {
        body.X.push_back(0.5 * (body.X[at(3 * ends.lower + k)] + body.X[at(3 * ends.upper + k)]));
      }
      body.point_ids.push_back(++last_id);
    }
  }
  for (NamedSet& group : body.groups) {
    std::vector<char> inside(at(corners), 0);
    for (const Index particle : group.particles) inside[at(particle)] = 1;
    for (std::size_t e = 0; e < edges.all().size(); ++e) {
      const auto& ends = edges.all()[e];
      if (inside[at(ends.lower)] != 0 && inside[at(ends.upper)] != 0)
        group.particles.push_back(corners + static_cast<Index>(e));
    }
  }
  body.simplices = std::move(nodes);
  body.quadratic = true;
}

double shortest_edge(const BodyGeometry& body) {
  if (body.shortest_edge_found > 0) return body.shortest_edge_found;
  if (body.cloud) {
    const double least = *std::min_element(body.volumes.begin(), body.volumes.end());
    body.shortest_edge_found = std::pow(least, 1.0 / body.dimension);
    return body.shortest_edge_found;
  }
  double square = std::numeric_limits<double>::infinity();
  std::array<double, 3> shortest{};
  const int corners = body.dimension + 1;
  for (Index s = 0; s < body.simplex_count(); ++s) {
    const std::int32_t* v = &body.simplices[at(s * body.simplex_nodes())];
    for (int a = 0; a < corners; ++a) {
      for (int b = a + 1; b < corners; ++b) {
        const double* p = &body.X[at(3 * Index{v[a]})];
        const double* q = &body.X[at(3 * Index{v[b]})];
        const std::array d{q[0] - p[0], q[1] - p[1], q[2] - p[2]};
        const double found = d[0] * d[0] + d[1] * d[1] + d[2] * d[2];
        if (found < square) {
          square = found;
          shortest = d;
        }
      }
    }
  }
  body.shortest_edge_found = std::hypot(shortest[0], shortest[1], shortest[2]);
  return body.shortest_edge_found;
}

Box bounding_box(const BodyGeometry& body) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  Box box{{kInfinity, kInfinity, kInfinity}, {-kInfinity, -kInfinity, -kInfinity}};
  for (Index i = 0; i < body.particles(); ++i) {
    for (int k = 0; k < 3; ++k) {
      box.lower[k] = std::min(box.lower[k], body.X[at(3 * i + k)]);
      box.upper[k] = std::max(box.upper[k], body.X[at(3 * i + k)]);
    }
  }
  return box;
}

const DeckGroup& named_group(const Deck& deck, std::initializer_list<const char*> kinds,
                             const std::string& name) {
  for (const char* kind : kinds) {
    for (const DeckGroup* group : deck.all(kind)) {
      if (group->text("name") == name) return *group;
    }
  }
  throw std::logic_error("the deck was accepted without a group called " + name);
}

int dimension_of(const std::string& kinematics) { return kinematics == "3d" ? 3 : 2; }

std::vector<BodyGeometry> take_bodies(const Deck& deck) {
  const auto groups = deck.all("body");
  Meshes meshes(deck);
  std::vector<BodyGeometry> bodies;
  const auto precracks = deck.all("precrack");
  std::vector<Index> crack_use(precracks.size(), 0);
  for (const DeckGroup* group : groups) {
    check_body_name(deck, *group);
    const std::string& mesh = group->text("mesh");
    const DeckGroup& source = named_group(deck, {"mesh", "lattice", "points"}, mesh);
    if (source.name == "points") {
      bodies.push_back(take_points(deck, *group, source));
      continue;
    }
    bodies.push_back(take_body(deck, *group, meshes.get(mesh), crack_use));
    take_volumes(deck, *group, source, bodies.back());
    meshes.used(mesh);
  }
  cut_notches(deck, bodies);
  for (std::size_t i = 0; i < precracks.size(); ++i) {
    if (precracks[i]->text("shape") == "group" && crack_use[i] == 0) {
      deck.fail(*precracks[i], "set",
                "no line or triangle of the mesh group " + in_quotes(precracks[i]->text("set")) +
                    " lies in the body it applies to");
    }
  }
  return bodies;
}

}  // namespace cleave::driver
