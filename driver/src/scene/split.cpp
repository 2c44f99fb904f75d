#include "scene/split.hpp"

#include <algorithm>
#include <array>
#include <map>
#include <set>

#include "scene/format.hpp"
#include "scene/index.hpp"

namespace cleave::driver {
namespace {

using Facet = std::array<Index, 3>;  // sorted; first entry -1 in two dimensions

Facet sorted_facet(const Index* nodes, int dimension) {
  Facet facet{nodes[0], nodes[1], dimension == 3 ? nodes[2] : -1};
  std::sort(facet.begin(), facet.end());
  return facet;
}

std::set<Facet> facet_set(const std::vector<Index>& facets, int dimension) {
  std::set<Facet> set;
  for (std::size_t i = 0; i + 1 < facets.size(); i += static_cast<std::size_t>(dimension)) {
    set.insert(sorted_facet(&facets[i], dimension));
  }
  return set;
}

// The simplices of every particle in `particles`.
std::map<Index, std::vector<Index>> simplices_around(const std::vector<Index>& particles,
                                                     const BodyGeometry& body) {
  std::vector<char> wanted(at(body.particles()), 0);
  for (const Index particle : particles) wanted[at(particle)] = 1;
  std::map<Index, std::vector<Index>> around;
  const int corners = body.dimension + 1;
  for (Index s = 0; s < body.simplex_count(); ++s) {
    for (int a = 0; a < corners; ++a) {
      const Index particle = body.simplices[at(s * corners + a)];
      if (wanted[at(particle)] != 0) around[particle].push_back(s);
    }
  }
  return around;
}

// Numbers, from 0, the groups of simplices around `particle` that hang together through facets that
// contain it and are not part of the crack.
std::vector<int> groups_around(Index particle, const std::vector<Index>& simplices,
                               const std::set<Facet>& crack, const BodyGeometry& body) {
  const int corners = body.dimension + 1;
  std::map<Facet, std::vector<std::size_t>> sharing;
  for (std::size_t k = 0; k < simplices.size(); ++k) {
    const std::int32_t* v = &body.simplices[at(simplices[k] * corners)];
    for (int opposite = 0; opposite < corners; ++opposite) {
      if (v[opposite] == particle) continue;
      std::array<Index, 3> nodes{-1, -1, -1};
      std::size_t count = 0;
      for (int a = 0; a < corners; ++a) {
        if (a != opposite) nodes[count++] = v[a];
      }
      const Facet facet = sorted_facet(nodes.data(), body.dimension);
      if (crack.count(facet) == 0) sharing[facet].push_back(k);
    }
  }
  std::vector<int> group(simplices.size(), -1);
  int groups = 0;
  for (std::size_t start = 0; start < simplices.size(); ++start) {
    if (group[start] >= 0) continue;
    group[start] = groups;
    for (bool grown = true; grown;) {  // a particle has a few dozen simplices at most
      grown = false;
      for (const auto& [facet, members] : sharing) {
        const bool touches = std::any_of(members.begin(), members.end(),
                                         [&](std::size_t k) { return group[k] == groups; });
        for (const std::size_t k : members) {
          if (touches && group[k] < 0) {
            group[k] = groups;
            grown = true;
          }
        }
      }
    }
    ++groups;
  }
  return group;
}

Index add_copy(Index particle, Index id, BodyGeometry& body) {
  const Index copy = body.particles();
  for (Index k = 0; k < 3; ++k) body.X.push_back(body.X[at(3 * particle + k)]);
  body.point_ids.push_back(id);
  for (NamedSet& set : body.groups) {
    if (std::binary_search(set.particles.begin(), set.particles.end(), particle)) {
      set.particles.push_back(copy);  // the highest number: stays sorted
    }
  }
  return copy;
}

// Facets of the mesh group that lie in the body.
std::vector<Index> facets_in(const io::Mesh& mesh, const io::MeshGroup& group,
                             const std::vector<Index>& number_of, int dimension) {
  const io::CellBlock& block = dimension == 2 ? mesh.lines : mesh.triangles;
  std::vector<Index> facets;
  for (const Index cell : group.cells) {
    const Index* nodes = &block.nodes[at(cell * dimension)];
    if (std::all_of(nodes, nodes + dimension, [&](Index n) { return number_of[at(n)] >= 0; })) {
      for (int a = 0; a < dimension; ++a) facets.push_back(number_of[at(nodes[a])]);
    }
  }
  return facets;
}

std::vector<Index> crack_facets(const Deck& deck, const DeckGroup& precrack, const io::Mesh& mesh,
                                const std::vector<Index>& number_of, const BodyGeometry& body) {
  const std::string& name = precrack.text("set");
  const io::MeshGroup* group = mesh.find_group(name);
  if (group == nullptr && precrack.text("body").empty() && deck.all("body").size() > 1) return {};
  if (group == nullptr || group->dimension != body.dimension - 1) {
    std::vector<std::string> known;
    for (const auto& other : mesh.groups) {
      if (other.dimension == body.dimension - 1) known.push_back(other.name);
    }
    deck.fail(precrack, "set",
              in_quotes(name) + " is not a mesh group of " +
                  (body.dimension == 2 ? "lines" : "triangles") + "; known: " + list(known));
  }
  return facets_in(mesh, *group, number_of, body.dimension);
}

}  // namespace

Index split_along(const std::vector<Index>& facets, BodyGeometry& body) {
  const std::set<Facet> crack = facet_set(facets, body.dimension);
  // The groups are found in the mesh as it was, before any particle is doubled.
  const auto around = simplices_around(facets, body);
  std::map<Index, std::vector<int>> groups;
  for (const auto& [particle, simplices] : around) {
    groups[particle] = groups_around(particle, simplices, crack, body);
  }
  const Index last_id = *std::max_element(body.point_ids.begin(), body.point_ids.end());
  Index added = 0;
  const int corners = body.dimension + 1;
  for (const auto& [particle, simplices] : around) {
    std::map<int, Index> copy_of{{0, particle}};
    const auto& group = groups[particle];
    for (std::size_t k = 0; k < simplices.size(); ++k) {
      const auto [entry, is_new] = copy_of.try_emplace(group[k], 0);
      if (is_new) {
        entry->second = add_copy(particle, last_id + ++added, body);
      }
      for (int a = 0; a < corners; ++a) {
        std::int32_t& corner = body.simplices[at(simplices[k] * corners + a)];
        if (corner == particle) corner = static_cast<std::int32_t>(entry->second);
      }
    }
  }
  return added;
}

void take_mesh_cracks(const Deck& deck, const io::Mesh& mesh, const std::vector<Index>& number_of,
                      BodyGeometry& body, std::vector<Index>& used) {
  const auto precracks = deck.all("precrack");
  for (std::size_t i = 0; i < precracks.size(); ++i) {
    const DeckGroup& precrack = *precracks[i];
    const bool by_group = precrack.text("shape") == "group";
    if (!by_group && precrack.text("mode") == "split") {
      deck.fail(precrack, "mode",
                "mode = 'split' needs a crack that the mesh follows: shape = 'group' and the name "
                "of a mesh group of lines or triangles in set");
    }
    const std::string& name = precrack.text("body");
    if (!by_group || (!name.empty() && name != body.name)) continue;
    const std::vector<Index> facets = crack_facets(deck, precrack, mesh, number_of, body);
    used[i] += static_cast<Index>(facets.size()) / body.dimension;
    if (precrack.text("mode") == "delete") {
      body.crack_facets.push_back(facets);
    } else if (!facets.empty() && split_along(facets, body) == 0) {
      deck.fail(precrack, "set",
                "the mesh group " + in_quotes(precrack.text("set")) +
                    " separates nothing in body " + in_quotes(body.name) +
                    ": it lies on the surface, or has no particle that is not a crack tip");
    }
  }
}

}  // namespace cleave::driver
