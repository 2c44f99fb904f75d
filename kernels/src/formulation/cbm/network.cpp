#include "formulation/cbm/network.hpp"

#include <cmath>
#include <limits>

namespace cleave::cbm {

void Network::build(Body& body) {
  const int corner_count = body.dimension() + 1;
  simplices = static_cast<std::int64_t>(body.given_simplices.size()) / corner_count;
  body.fields.allocate(CLEAVE_RELATION_SIMPLEX, simplices);
  X = body.point.X;
  corners = body.fields.integer("simplex_particles");
  alive = body.fields.integer("simplex_alive");
  incidence = make_incidence(body.particles, simplices, body.given_simplices.data(), corner_count,
                             corner_count, body.index_base);
  for (std::int64_t s = 0; s < simplices; ++s) {
    for (int a = 0; a < kStride; ++a) {
      corners[kStride * s + a] =
          a < corner_count
              ? static_cast<std::int32_t>(
                    body.given_simplices[static_cast<std::size_t>(corner_count * s + a)])
              : -1;
    }
    alive[s] = 1;
  }
  check_simplices(body);
  make_rows(body);

  body.fields.allocate(CLEAVE_RELATION_HALF_BOND, static_cast<std::int64_t>(neighbour.size()));
  body.fields.allocate(CLEAVE_RELATION_BOND, static_cast<std::int64_t>(neighbour.size()) / 2);
  ends = body.fields.integer("bond_ends");
  status = body.fields.integer("bond_status");
  length = body.fields.real("bond_length");
  critical = body.fields.real("critical_strain");
  zeta = body.fields.real("bond_vector");
  weight = body.fields.real("bond_weight");
  volume = body.point.volume;
  make_bonds();
  ThreadTeam alone;
  rebuild(body, alone);
}

void Network::check_simplices(const Body& body) const {
  for (std::int64_t s = 0; s < simplices; ++s) {
    const std::int32_t* c = corners + kStride * s;
    if (body.dimension() == 2 ? is_degenerate<2>(X, c) : is_degenerate<3>(X, c)) {
      throw Error(CLEAVE_BAD_SIMPLEX,
                  text(body.label(), ": simplex ", body.number(s), " of particles ",
                       body.number(c[0]), ' ', body.number(c[1]), ' ', body.number(c[2]),
                       body.dimension() == 3 ? text(' ', body.number(c[3])) : "", " near (",
                       X[kVector * c[0]], ", ", X[kVector * c[0] + 1], ", ", X[kVector * c[0] + 2],
                       ") is degenerate: its volume is below 1e-12 of a cube on its longest edge; "
                       "repair the mesh there"));
    }
  }
  for (std::int64_t i = 0; i < body.particles; ++i) {
    if (incidence.begin[static_cast<std::size_t>(i)] ==
        incidence.begin[static_cast<std::size_t>(i + 1)]) {
      throw Error(CLEAVE_BAD_SIMPLEX,
                  text(body.label(), ": ", body.particle_label(i),
                       " belongs to no simplex, so it has no mass; leave it out"));
    }
  }
}

void Network::make_rows(const Body& body) {
  std::vector<std::int32_t> found;
  row_begin.assign(static_cast<std::size_t>(body.particles + 1), 0);
  neighbour.clear();
  for (std::int64_t i = 0; i < body.particles; ++i) {
    collect_neighbours(incidence, corners, body.dimension() + 1, kStride, i, found);
    neighbour.insert(neighbour.end(), found.begin(), found.end());
    if (neighbour.size() > static_cast<std::size_t>(std::numeric_limits<std::int32_t>::max())) {
      throw Error(CLEAVE_BAD_ARGUMENT,
                  text(body.label(), " has more than 2^31 half-bonds; split it into bodies"));
    }
    row_begin[static_cast<std::size_t>(i + 1)] = static_cast<std::int32_t>(neighbour.size());
  }
  reverse.resize(neighbour.size());
  fill_reverse(body.particles, row_begin.data(), neighbour.data(), reverse.data());
}

void Network::make_bonds() {
  bond_of_half.resize(neighbour.size());
  std::int32_t bond = 0;
  for (std::size_t i = 0; i + 1 < row_begin.size(); ++i) {
    for (auto b = static_cast<std::size_t>(row_begin[i]);
         b < static_cast<std::size_t>(row_begin[i + 1]); ++b) {
      if (neighbour[b] < static_cast<std::int32_t>(i)) continue;
      ends[2 * bond] = static_cast<std::int32_t>(i);
      ends[2 * bond + 1] = neighbour[b];
      bond_of_half[b] = bond;
      bond_of_half[static_cast<std::size_t>(reverse[b])] = bond;
      ++bond;
    }
  }
  bonds = bond;
}

void Network::rebuild(const Body& body, ThreadTeam& team) {
  const bool plane = body.dimension() == 2;
  for_blocks(team, body.particles, [&](std::int64_t, std::int64_t first, std::int64_t last) {
    for (std::int64_t i = first; i < last; ++i) plane ? rebuild_row_of<2>(i) : rebuild_row_of<3>(i);
  });
  for_blocks(team, bonds, [&](std::int64_t, std::int64_t first, std::int64_t last) {
    for (std::int64_t b = first; b < last; ++b) {
      const Vec<3> d = difference<3>(X, ends[2 * b], ends[2 * b + 1]);  // in two dimensions X3 = 0
      length[b] = std::sqrt(dot(d, d));
    }
  });
}

bool Network::on_live_simplex(std::int32_t bond, int corner_count) const {
  bool found = false;
  for_live_simplices(bond, corner_count, [&](std::int32_t) { found = true; });
  return found;
}

std::int32_t Network::find_bond(std::int64_t i, std::int64_t p) const {
  const auto n = static_cast<std::int64_t>(row_begin.size()) - 1;
  if (i < 0 || p < 0 || i >= n || p >= n) return -1;
  const std::int32_t b =
      find_half_bond(row_begin.data(), neighbour.data(), i, static_cast<std::int32_t>(p));
  return b < 0 ? -1 : bond_of_half[static_cast<std::size_t>(b)];
}

std::int64_t Network::bytes() const {
  return static_cast<std::int64_t>(incidence.begin.capacity() * sizeof(std::int64_t) +
                                   (incidence.simplex.capacity() + row_begin.capacity() +
                                    neighbour.capacity() + reverse.capacity() +
                                    bond_of_half.capacity()) *
                                       sizeof(std::int32_t));
}

}  // namespace cleave::cbm
