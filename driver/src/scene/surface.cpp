#include "scene/surface.hpp"

#include <algorithm>
#include <array>
#include <utility>

#include "scene/index.hpp"

namespace cleave::driver {
namespace {

struct Candidate {
  std::array<Index, 3> key;  // sorted particles; -1 first in two dimensions
  Index opposite;            // particle of the simplex that is not in the facet
};

// Facets of simplices whose particles are all in the set.
std::vector<Candidate> candidates(const BodyGeometry& body, const std::vector<char>& inside) {
  std::vector<Candidate> found;
  const int corners = body.dimension + 1;
  for (Index s = 0; s < body.simplex_count(); ++s) {
    const Index* v = &body.simplices[at(s * body.simplex_nodes())];
    for (int opposite = 0; opposite < corners; ++opposite) {
      Candidate candidate{{-1, -1, -1}, v[opposite]};
      std::size_t count = 0;
      bool all = true;
      for (int a = 0; a < corners; ++a) {
        if (a == opposite) continue;
        candidate.key[count++] = v[a];
        all = all && inside[at(v[a])] != 0;
      }
      if (!all) continue;
      std::sort(candidate.key.begin(), candidate.key.end());
      found.push_back(candidate);
    }
  }
  return found;
}

}  // namespace

void area_vector(int dimension, const double* const* x, double* area) {
  const double a[3] = {x[1][0] - x[0][0], x[1][1] - x[0][1], x[1][2] - x[0][2]};
  if (dimension == 2) {
    area[0] = a[1];
    area[1] = -a[0];
    area[2] = 0;
    return;
  }
  const double b[3] = {x[2][0] - x[0][0], x[2][1] - x[0][1], x[2][2] - x[0][2]};
  area[0] = 0.5 * (a[1] * b[2] - a[2] * b[1]);
  area[1] = 0.5 * (a[2] * b[0] - a[0] * b[2]);
  area[2] = 0.5 * (a[0] * b[1] - a[1] * b[0]);
}

std::vector<Index> surface_facets(const BodyGeometry& body, const std::vector<Index>& particles) {
  std::vector<char> inside(at(body.particles()), 0);
  for (const Index particle : particles) inside[at(particle)] = 1;
  std::vector<Candidate> found = candidates(body, inside);
  std::sort(found.begin(), found.end(),
            [](const Candidate& a, const Candidate& b) { return a.key < b.key; });
  std::vector<Candidate> single;
  for (std::size_t i = 0; i < found.size();) {
    std::size_t next = i + 1;
    while (next < found.size() && found[next].key == found[i].key) ++next;
    if (next == i + 1) single.push_back(found[i]);
    i = next;
  }

  std::vector<Index> facets;
  for (const Candidate& candidate : single) {
    std::array<Index, 3> nodes = candidate.key;
    if (body.dimension == 2) nodes = {nodes[1], nodes[2], -1};
    const auto count = at(body.dimension);
    const double* x[3] = {};
    for (std::size_t a = 0; a < count; ++a) x[a] = &body.X[at(3 * nodes[a])];
    double area[3];
    area_vector(body.dimension, x, area);
    const double* inner = &body.X[at(3 * candidate.opposite)];
    const double outwards = area[0] * (x[0][0] - inner[0]) + area[1] * (x[0][1] - inner[1]) +
                            area[2] * (x[0][2] - inner[2]);
    if (outwards < 0) std::swap(nodes[0], nodes[1]);
    facets.insert(facets.end(), nodes.begin(), nodes.begin() + body.dimension);
  }
  return facets;
}

}  // namespace cleave::driver
