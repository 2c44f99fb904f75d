// A body before it becomes a model: particles, simplices and named sets, in the numbering that
// files and events show. This is all that a checkpoint must carry so that the mesh file is not
// needed again.
#pragma once

#include <cstdint>
#include <initializer_list>
#include <string>
#include <vector>

#include "deck/deck.hpp"

namespace cleave::driver {

struct NamedSet {
  std::string name;
  std::vector<std::int64_t> particles;  // sorted, unique
};

struct BodyGeometry {
  std::string name;
  int dimension = 3;      // 2 or 3
  std::vector<double> X;  // (3, n) reference position [m]
  // (simplex_nodes, m): corners, then middles of edges 12 23 31; the largest array of a body, and
  // particles are fewer than 2^31
  std::vector<std::int32_t> simplices;
  bool quadratic = false;               // six-node triangles
  bool cloud = false;                   // no simplices: each entry is a particle by itself
  std::vector<double> volumes;          // (n) of the particles; empty: from the simplices
  std::vector<std::int64_t> point_ids;  // (n) number in the mesh file; split particles get new ones
  std::vector<NamedSet> groups;         // mesh groups that have particles in this body
  // Facets of every &precrack with shape = 'group' and mode = 'delete'; used once, before the first
  // step, and not part of a checkpoint.
  std::vector<std::vector<std::int64_t>> crack_facets;
  mutable double shortest_edge_found = 0;  // 0: not yet

  std::int64_t particles() const { return static_cast<std::int64_t>(X.size()) / 3; }
  std::int64_t simplex_nodes() const { return cloud ? 1 : quadratic ? 6 : dimension + 1; }
  std::int64_t simplex_count() const {
    return static_cast<std::int64_t>(simplices.size()) / simplex_nodes();
  }
  const NamedSet* find_group(const std::string& group) const;
};

// Adds the middles of all edges of triangles as particles; a middle belongs to the groups that both
// ends belong to. Numbers of new particles follow the others.
void make_quadratic(BodyGeometry& body);

// Length of the shortest edge of the simplices [m], of a cloud the side of the smallest volume; found at the
// first call.
double shortest_edge(const BodyGeometry& body);
// Lowest and highest coordinates (3 + 3).
struct Box {
  double lower[3], upper[3];
};
Box bounding_box(const BodyGeometry& body);

// The group of one of these kinds that has this name. The reader of decks has made sure of it.
const DeckGroup& named_group(const Deck& deck, std::initializer_list<const char*> kinds,
                             const std::string& name);

// Dimension of a value of body.kinematics.
int dimension_of(const std::string& kinematics);

// Reads the meshes of the deck and takes every &body from them: the nodes its simplices use,
// renumbered in the order of the mesh, scaled and translated; split pre-cracks are made here.
// Throws DeckError.
std::vector<BodyGeometry> take_bodies(const Deck& deck);

}  // namespace cleave::driver
