#include "formulation/cpd/hood_numbers.hpp"

#include <cmath>
#include <unordered_map>

#include "core/instruction_set.hpp"
#include "formulation/cpd/star.hpp"

CLEAVE_DECLARE_KERNELS(cleave_call::CliqueKernels, kCliqueKernels)

namespace cleave::cpd {

namespace {

using peridynamics::Neighbourhood;

constexpr double kAlike = 1e-6;  // of the horizon: places that differ less are one

// Of the places of all neighbours around the point.
std::uint64_t signature(const Neighbourhood& hood, std::int64_t i) {
  const double scale = 1 / (kAlike * hood.horizon);
  std::uint64_t sum = static_cast<std::uint64_t>(hood.count(i));
  for (auto b = hood.first(i); b < hood.last(i); ++b) {
    const Vec<3> d = difference<3>(hood.X, i, hood.neighbour(b));
    std::uint64_t hash = 14695981039346656037ull;
    for (int k = 0; k < 3; ++k) {
      hash ^=
          static_cast<std::uint64_t>(static_cast<std::int64_t>(std::floor(d[k] * scale + 0.25)));
      hash *= 0x9e3779b97f4a7c15ull;
      hash ^= hash >> 29;
    }
    sum += hash * 0xbf58476d1ce4e5b9ull;  // whatever the order of neighbours
  }
  return sum;
}

double distance(const double* X, std::int64_t a, std::int64_t b) {
  const Vec<3> d = difference<3>(X, a, b);
  return std::sqrt(dot(d, d));
}

void add_pairs(const Neighbourhood& hood, std::int64_t i, HoodNumbers& n) {
  const double flat = kFlat * hood.horizon * hood.horizon;
  for (auto b = hood.first(i); b < hood.last(i); ++b)
    for (auto c = b + 1; c < hood.last(i); ++c) {
      const std::int32_t j = hood.neighbour(b), k = hood.neighbour(c);
      if (!hood.adjacent(j, k)) continue;
      const Vec<3> p = difference<3>(hood.X, i, j), q = difference<3>(hood.X, i, k);
      const double x = p[1] * q[2] - p[2] * q[1], y = p[2] * q[0] - p[0] * q[2],
                   z = p[0] * q[1] - p[1] * q[0], area = std::sqrt(x * x + y * y + z * z);
      if (!(area > flat)) continue;
      const double own = distance(hood.X, j, k);
      n.pairs += 1;
      n.area += area;
      n.pair_rate += own * (own + distance(hood.X, i, j) + distance(hood.X, i, k)) / area;
    }
  if (n.pairs > 0) n.area /= n.pairs;
}

void add_triples(const Neighbourhood& hood, std::int64_t i, StarScratch& scratch, HoodNumbers& n) {
  const std::span<const std::int32_t> row(hood.rows.neighbour.data() + hood.first(i),
                                          static_cast<std::size_t>(hood.count(i)));
  StarNumbers numbers{};
  CLEAVE_KERNELS(kCliqueKernels)
      .chosen()
      .numbers(scratch.lay(hood, i, row, hood.X, nullptr, false), numbers);
  n.triples = numbers.count;
  n.volume = numbers.count > 0 ? numbers.volume / numbers.count : 0.0;
  n.triple_rate = numbers.rate;
}

}  // namespace

std::vector<HoodNumbers> hood_numbers(const Neighbourhood& hood) {
  std::vector<HoodNumbers> all(static_cast<std::size_t>(hood.points));
  if (hood.dimension == 1) return all;
  StarScratch scratch;
  scratch.expect(hood.most_neighbours());
  std::unordered_map<std::uint64_t, std::int64_t> known;
  for (std::int64_t i = 0; i < hood.points; ++i) {
    HoodNumbers& n = all[static_cast<std::size_t>(i)];
    const auto [entry, is_new] = known.try_emplace(signature(hood, i), i);
    if (!is_new) {
      n = all[static_cast<std::size_t>(entry->second)];
      continue;
    }
    add_pairs(hood, i, n);
    if (hood.dimension == 3) add_triples(hood, i, scratch, n);
  }
  return all;
}

}  // namespace cleave::cpd
