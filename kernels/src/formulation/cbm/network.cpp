#include "formulation/cbm/network.hpp"

#include <cmath>
#include <limits>

namespace cleave::cbm {

namespace {

std::size_t at(std::int64_t k) { return static_cast<std::size_t>(k); }

}  // namespace

void Network::build(Body& body, ThreadTeam& team) {
  dimension = body.dimension();
  const int corner_count = dimension + 1;
  simplices = static_cast<std::int64_t>(body.given_simplices.size()) / corner_count;
  body.fields.allocate(CLEAVE_RELATION_SIMPLEX, simplices);
  X = body.point.X;
  corners = body.fields.integer("simplex_particles");
  alive = body.fields.integer("simplex_alive");
  incidence = make_incidence(body.particles, simplices, body.given_simplices.data(), corner_count,
                             corner_count, body.index_base);
  for_blocks(team, simplices, [&](std::int64_t, std::int64_t first, std::int64_t last) {
    for (std::int64_t s = first; s < last; ++s) {
      const std::int64_t* given = body.given_simplices.data() + corner_count * s;
      for (int a = 0; a < kStride; ++a)
        corners[kStride * s + a] = a < corner_count ? static_cast<std::int32_t>(given[a]) : -1;
      alive[s] = 1;
    }
  });
  check_simplices(body, team);
  make_rows(body, team);
  body.fields.allocate(CLEAVE_RELATION_HALF_BOND, static_cast<std::int64_t>(neighbour.size()));
  body.fields.allocate(CLEAVE_RELATION_BOND, bonds);
  status = body.fields.integer("bond_status");
  critical = body.fields.real("critical_strain");
  volume = body.point.volume;
  drop_rows();
  rebuild(team);
}

void Network::check_simplices(const Body& body, ThreadTeam& team) const {
  std::vector<std::int64_t> flat(at(block_count(simplices)), -1);
  for_blocks(team, simplices, [&](std::int64_t block, std::int64_t first, std::int64_t last) {
    for (std::int64_t s = last - 1; s >= first; --s) {
      const std::int32_t* c = corners + kStride * s;
      if (dimension == 2 ? is_degenerate<2>(X, c) : is_degenerate<3>(X, c)) flat[at(block)] = s;
    }
  });
  for (const std::int64_t s : flat) {
    if (s < 0) continue;
    const std::int32_t* c = corners + kStride * s;
    throw Error(CLEAVE_BAD_SIMPLEX,
                text(body.label(), ": simplex ", body.number(s), " of particles ",
                     body.number(c[0]), ' ', body.number(c[1]), ' ', body.number(c[2]),
                     dimension == 3 ? text(' ', body.number(c[3])) : "", " near (",
                     X[kVector * c[0]], ", ", X[kVector * c[0] + 1], ", ", X[kVector * c[0] + 2],
                     ") is degenerate: its volume is below 1e-12 of a cube on its longest edge; "
                     "repair the mesh there"));
  }
  for (std::int64_t i = 0; i < body.particles; ++i) {
    if (incidence.begin[at(i)] == incidence.begin[at(i + 1)]) {
      throw Error(CLEAVE_BAD_SIMPLEX,
                  text(body.label(), ": ", body.particle_label(i),
                       " belongs to no simplex, so it has no mass; leave it out"));
    }
  }
}

// Neighbours of every particle, block by block of particles, then one behind the other.
void Network::make_rows(const Body& body, ThreadTeam& team) {
  const std::int64_t n = body.particles;
  std::vector<std::vector<std::int32_t>> found(at(block_count(n)));
  row_begin.assign(at(n + 1), 0);
  first_bond.assign(at(n + 1), 0);
  for_blocks(team, n, [&](std::int64_t block, std::int64_t first, std::int64_t last) {
    std::vector<std::int32_t> row;
    for (std::int64_t i = first; i < last; ++i) {
      collect_neighbours(incidence, corners, dimension + 1, kStride, i, row);
      found[at(block)].insert(found[at(block)].end(), row.begin(), row.end());
      row_begin[at(i + 1)] = static_cast<std::int32_t>(row.size());
      first_bond[at(i + 1)] = static_cast<std::int32_t>(
          row.end() - std::upper_bound(row.begin(), row.end(), static_cast<std::int32_t>(i)));
    }
  });
  std::size_t halves = 0;
  for (const auto& list : found) halves += list.size();
  if (halves > at(std::numeric_limits<std::int32_t>::max())) {
    throw Error(CLEAVE_BAD_ARGUMENT,
                text(body.label(), " has more than 2^31 half-bonds; split it into bodies"));
  }
  for (std::int64_t i = 0; i < n; ++i) {
    row_begin[at(i + 1)] += row_begin[at(i)];
    first_bond[at(i + 1)] += first_bond[at(i)];
  }
  bonds = first_bond.back();
  neighbour.resize(halves);
  for_blocks(team, n, [&](std::int64_t block, std::int64_t first, std::int64_t) {
    std::copy(found[at(block)].begin(), found[at(block)].end(),
              neighbour.begin() + row_begin[at(first)]);
    std::vector<std::int32_t>().swap(found[at(block)]);
  });
}

// Omega_i as form_row gives it, to the bit.
template <int D>
double Network::live_volume(std::int64_t i) const {
  double sum = 0;
  for (auto k = incidence.begin[at(i)]; k < incidence.begin[at(i + 1)]; ++k) {
    const std::int64_t s = incidence.simplex[at(k)];
    if (alive[s] != 0) sum += simplex_volume<D>(X, corners + kStride * s) / (D + 1);
  }
  return sum;
}

void Network::rebuild_row(std::int64_t i) {
  if (!keeps_rows_) {
    volume[i] = dimension == 2 ? live_volume<2>(i) : live_volume<3>(i);
    return;
  }
  const std::span<const std::int32_t> row = neighbours(i);
  const std::int64_t first = row_begin[at(i)];
  double* zeta = rows_.zeta.data() + kVector * first;
  volume[i] = dimension == 2 ? form_row<2>(i, zeta, nullptr) : form_row<3>(i, zeta, nullptr);
  for (std::size_t k = 0; k < row.size(); ++k)
    rows_.weight[at(first) + k] = weight(i, row[k], zeta + kVector * k);
}

double Network::weight(std::int64_t i, std::int64_t p, const double* zeta) const {
  return dimension == 2 ? dot(load_vector<2>(zeta, 0), difference<2>(X, i, p))
                        : dot(load_vector<3>(zeta, 0), difference<3>(X, i, p));
}

void Network::rebuild(ThreadTeam& team) {
  for_blocks(team, static_cast<std::int64_t>(row_begin.size()) - 1,
             [&](std::int64_t, std::int64_t first, std::int64_t last) {
               for (std::int64_t i = first; i < last; ++i) rebuild_row(i);
             });
}

void Network::rebuild(std::span<const std::int32_t> particles) {
  for (const std::int32_t i : particles) rebuild_row(i);
}

void Network::keep_rows(ThreadTeam& team) {
  if (keeps_rows_) return;
  keeps_rows_ = true;
  const auto n = static_cast<std::int64_t>(row_begin.size()) - 1;
  rows_.reverse.resize(neighbour.size());
  rows_.bond.resize(neighbour.size());
  rows_.zeta.resize(kVector * neighbour.size());
  rows_.weight.resize(neighbour.size());
  rows_.length.resize(at(bonds));
  for_blocks(team, n, [&](std::int64_t, std::int64_t first, std::int64_t last) {
    for (std::int64_t i = first; i < last; ++i) {
      for (std::int32_t b = row_begin[at(i)]; b < row_begin[at(i) + 1]; ++b) {
        const std::int32_t p = neighbour[at(b)];
        rows_.reverse[at(b)] =
            find_half_bond(row_begin.data(), neighbour.data(), p, static_cast<std::int32_t>(i));
        rows_.bond[at(b)] = find_bond(i, p);
      }
    }
    for_bonds(first, last, [&](std::int32_t bond, std::int32_t i, std::int32_t p) {
      rows_.length[at(bond)] = length(i, p);
    });
  });
  rebuild(team);
}

void Network::drop_rows() {
  keeps_rows_ = false;
  rows_ = {};
}

std::array<std::int32_t, 2> Network::ends(std::int32_t bond) const {
  const auto after = std::upper_bound(first_bond.begin(), first_bond.end(), bond);
  const auto i = static_cast<std::int32_t>(after - first_bond.begin()) - 1;
  return {i, upper_neighbours(i)[at(bond - first_bond[at(i)])]};
}

std::int32_t Network::find_bond(std::int64_t i, std::int64_t p) const {
  const auto n = static_cast<std::int64_t>(row_begin.size()) - 1;
  if (i > p) std::swap(i, p);
  if (i < 0 || p >= n) return -1;
  const std::span<const std::int32_t> upper = upper_neighbours(i);
  const auto found = std::lower_bound(upper.begin(), upper.end(), p);
  if (found == upper.end() || *found != p) return -1;
  return first_bond[at(i)] + static_cast<std::int32_t>(found - upper.begin());
}

double Network::length(std::int64_t i, std::int64_t p) const {
  const Vec<3> d = difference<3>(X, i, p);  // in two dimensions X3 = 0
  return std::sqrt(dot(d, d));
}

void Network::copy_lengths(std::int64_t first, std::int64_t last, double* values) const {
  for (std::int64_t b = first; b < last; ++b) {
    const auto [i, p] = ends(static_cast<std::int32_t>(b));
    *values++ = length(i, p);
  }
}

void Network::copy_ends(std::int64_t first, std::int64_t last, std::int64_t* values) const {
  for (std::int64_t b = first; b < last; ++b)
    for (const std::int32_t end : ends(static_cast<std::int32_t>(b))) *values++ = end;
}

template <class F>
void Network::for_half_bonds(std::int64_t first, std::int64_t last, const F& f) const {
  if (first >= last) return;
  std::vector<double> zeta;
  const auto row_of_first = std::upper_bound(row_begin.begin(), row_begin.end(), first) - 1;
  for (std::int64_t i = row_of_first - row_begin.begin(); row_begin[at(i)] < last; ++i) {
    const std::span<const std::int32_t> row = neighbours(i);
    zeta.resize(kVector * row.size());
    dimension == 2 ? form_row<2>(i, zeta.data(), nullptr) : form_row<3>(i, zeta.data(), nullptr);
    for (std::size_t k = 0; k < row.size(); ++k) {
      const std::int64_t half = row_begin[at(i)] + static_cast<std::int64_t>(k);
      if (half >= first && half < last) f(half, i, row[k], zeta.data() + kVector * k);
    }
    if (at(i) + 2 == row_begin.size()) break;
  }
}

void Network::copy_vectors(std::int64_t first, std::int64_t last, double* values) const {
  for_half_bonds(first, last,
                 [&](std::int64_t half, std::int64_t, std::int32_t, const double* zeta) {
                   std::copy_n(zeta, kVector, values + kVector * (half - first));
                 });
}

void Network::copy_weights(std::int64_t first, std::int64_t last, double* values) const {
  for_half_bonds(first, last,
                 [&](std::int64_t half, std::int64_t i, std::int32_t p, const double* zeta) {
                   values[half - first] = weight(i, p, zeta);
                 });
}

std::int32_t Network::longest_row() const {
  std::int32_t longest = 0;
  for (std::size_t i = 0; i + 1 < row_begin.size(); ++i)
    longest = std::max(longest, row_begin[i + 1] - row_begin[i]);
  return longest;
}

std::int64_t Network::bytes() const {
  return static_cast<std::int64_t>(
      incidence.begin.capacity() * sizeof(std::int64_t) +
      (incidence.simplex.capacity() + row_begin.capacity() + neighbour.capacity() +
       first_bond.capacity() + rows_.reverse.capacity() + rows_.bond.capacity()) *
          sizeof(std::int32_t) +
      (rows_.zeta.capacity() + rows_.weight.capacity() + rows_.length.capacity()) * sizeof(double));
}

}  // namespace cleave::cbm
