#include "scene/surface.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <numeric>
#include <utility>

#include "scene/index.hpp"

namespace cleave::driver {
namespace {

// A facet in the list of its lowest particle.
struct Candidate {
  std::array<std::int32_t, 2> others;  // its other particles, sorted; in two dimensions -1 first
  std::int32_t opposite;               // particle of the simplex that is not in the facet
};

// Calls visit(lowest, candidate) for the facets of simplices whose particles are all in the set.
template <class Visit>
void for_candidates(const BodyGeometry& body, const std::vector<char>& inside, Visit visit) {
  const int corners = body.dimension + 1;
  for (Index s = 0; s < body.simplex_count(); ++s) {
    const std::int32_t* v = &body.simplices[at(s * body.simplex_nodes())];
    const auto outside = std::count_if(
        v, v + corners, [&](std::int32_t particle) { return inside[at(particle)] == 0; });
    if (outside > 1) continue;
    for (int opposite = 0; opposite < corners; ++opposite) {
      if (outside == 1 && inside[at(v[opposite])] != 0) continue;
      std::array<std::int32_t, 3> facet{-1, -1, -1};
      std::size_t count = 0;
      for (int a = 0; a < corners; ++a) {
        if (a != opposite) facet[count++] = v[a];
      }
      std::sort(facet.begin(), facet.end());
      if (body.dimension == 2) std::swap(facet[0], facet[1]);  // -1, lower, upper
      visit(facet[0], Candidate{{facet[1], facet[2]}, v[opposite]});
    }
  }
}

// The candidates of lowest particle i: list[begin[i]] to list[begin[i + 1]].
struct Candidates {
  std::vector<Index> begin;
  std::vector<Candidate> list;
};

Candidates find_candidates(const BodyGeometry& body, const std::vector<char>& inside) {
  Candidates found{std::vector<Index>(at(body.particles()) + 1, 0), {}};
  for_candidates(body, inside, [&](Index lowest, const Candidate&) { ++found.begin[at(lowest)]; });
  std::inclusive_scan(found.begin.begin(), found.begin.end(), found.begin.begin());
  found.list.resize(at(found.begin.back()));
  // From the back, so that `begin` becomes what its name says.
  for_candidates(body, inside, [&](Index lowest, const Candidate& candidate) {
    found.list[at(--found.begin[at(lowest)])] = candidate;
  });
  return found;
}

// Appends the particles of the facet, in the sense that the normal points away from the simplex.
void add_outwards(const BodyGeometry& body, Index lowest, const Candidate& candidate,
                  std::vector<Index>& facets) {
  std::array<Index, 3> nodes{lowest, candidate.others[0], candidate.others[1]};
  if (body.dimension == 2) nodes = {lowest, candidate.others[1], -1};
  const double* x[3] = {};
  for (std::size_t a = 0; a < at(body.dimension); ++a) x[a] = &body.X[at(3 * nodes[a])];
  double area[3];
  area_vector(body.dimension, x, area);
  const double* inner = &body.X[at(3 * Index{candidate.opposite})];
  const double outwards = area[0] * (x[0][0] - inner[0]) + area[1] * (x[0][1] - inner[1]) +
                          area[2] * (x[0][2] - inner[2]);
  if (outwards < 0) std::swap(nodes[0], nodes[1]);
  facets.insert(facets.end(), nodes.begin(), nodes.begin() + body.dimension);
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
  Candidates found = find_candidates(body, inside);
  std::vector<Index> facets;
  for (std::size_t lowest = 0; lowest + 1 < found.begin.size(); ++lowest) {
    const auto first = found.list.begin() + found.begin[lowest];
    const auto last = found.list.begin() + found.begin[lowest + 1];
    std::sort(first, last,
              [](const Candidate& a, const Candidate& b) { return a.others < b.others; });
    for (auto i = first; i != last;) {
      const auto next =
          std::find_if(i, last, [&](const Candidate& other) { return other.others != i->others; });
      if (next == i + 1) add_outwards(body, static_cast<Index>(lowest), *i, facets);
      i = next;
    }
  }
  return facets;
}

}  // namespace cleave::driver
