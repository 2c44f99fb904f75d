#include "formulation/cpd/lattice_cliques.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>

#include "core/instruction_set.hpp"

CLEAVE_DECLARE_KERNELS(cleave_call::LatticeKernels, kLatticeKernels)

namespace cleave::cpd {

namespace {

// Own rows of a tile. Its arrays with what it reaches are three times as large at 3.015 spacings.
constexpr std::int32_t kMiddles = 8, kSlows = 4;
constexpr std::int32_t kEight = 8;
enum : char { kEmpty, kSome, kFull };  // an eight: no point, some members missing, all there
// Shapes are few at usual horizons: 8832 at 3.015 spacings.
constexpr std::size_t kMostThirds = 4000000;

using Cell = std::array<std::int32_t, 3>;

double square_distance(const Cell& a, const Cell& b) {
  double sum = 0;
  for (std::size_t k = 0; k < 3; ++k) sum += static_cast<double>((a[k] - b[k]) * (a[k] - b[k]));
  return sum;
}

std::int32_t volume_of(const Cell& a, const Cell& b, const Cell& c) {
  return (a[1] * b[2] - a[2] * b[1]) * c[0] + (a[2] * b[0] - a[0] * b[2]) * c[1] +
         (a[0] * b[1] - a[1] * b[0]) * c[2];
}

// Cells within the reach that come after the origin: slow, then middle, then fast.
std::vector<Cell> cells_ahead(std::int32_t reach, double limit) {
  std::vector<Cell> cells;
  for (std::int32_t z = 0; z <= reach; ++z)
    for (std::int32_t y = -reach; y <= reach; ++y)
      for (std::int32_t x = -reach; x <= reach; ++x) {
        const bool ahead = z > 0 || y > 0 || (y == 0 && x > 0);
        if (ahead && !(z == 0 && y < 0) && square_distance({x, y, z}, {}) < limit)
          cells.push_back({x, y, z});
      }
  return cells;
}

}  // namespace

bool LatticeCliques::setup(const peridynamics::Neighbourhood& hood,
                           const peridynamics::Lattice& lattice, bool signed_volume) {
  *this = {};
  spacing_ = lattice.spacing;
  signed_volume_ = signed_volume;
  axis_ = peridynamics::axes_by_length(lattice);
  for (std::size_t k = 0; k < 3; ++k) shape_[k] = lattice.shape[axis_[k]];
  const double limit = hood.square_limit / (spacing_ * spacing_);
  while (static_cast<double>((reach_ + 1) * (reach_ + 1)) < limit) ++reach_;
  width_ = (shape_[0] + kEight - 1) / kEight * kEight + 2 * reach_;
  point_.assign(static_cast<std::size_t>(shape_[0]) * static_cast<std::size_t>(shape_[1]) *
                    static_cast<std::size_t>(shape_[2]),
                -1);
  cell_.resize(static_cast<std::size_t>(hood.points));
  for (std::int64_t i = 0; i < hood.points; ++i) {
    std::size_t place = 0;
    for (std::size_t k = 0; k < 3; ++k)
      cell_[static_cast<std::size_t>(i)][k] =
          lattice.cell[static_cast<std::size_t>(3 * i) + axis_[k]];
    for (std::size_t k = 3; k-- > 0;)
      place = place * static_cast<std::size_t>(shape_[k]) +
              static_cast<std::size_t>(cell_[static_cast<std::size_t>(i)][k]);
    point_[place] = static_cast<std::int32_t>(i);
  }
  if (!list_shapes(limit)) {
    *this = {};
    return false;
  }
  bonds_.setup(shape_, reach_, ahead_.members, ahead_.pairs, ahead_.thirds, limit);
  make_tiles();
  return true;
}

bool LatticeCliques::ShapeList::make(std::vector<Cell> cells, double limit) {
  members = std::move(cells);
  if (members.size() > std::numeric_limits<std::uint16_t>::max()) return false;
  const auto near = [&](std::size_t a, std::size_t b) {
    return square_distance(members[a], members[b]) < limit;
  };
  for (std::size_t a = 0; a < members.size(); ++a)
    for (std::size_t b = a + 1; b < members.size(); ++b) {
      if (!near(a, b)) continue;
      const auto first = static_cast<std::int32_t>(thirds.size());
      for (std::size_t c = b + 1; c < members.size(); ++c) {
        const std::int32_t V = volume_of(members[a], members[b], members[c]);
        if (V == 0 || !near(a, c) || !near(b, c)) continue;
        if (std::abs(V) > std::numeric_limits<std::int16_t>::max()) return false;
        thirds.push_back({static_cast<std::uint16_t>(c), static_cast<std::int16_t>(V)});
      }
      const auto last = static_cast<std::int32_t>(thirds.size());
      if (last > first)
        pairs.push_back(
            {static_cast<std::uint16_t>(a), static_cast<std::uint16_t>(b), first, last});
      if (thirds.size() > kMostThirds) return false;
    }
  return !thirds.empty();
}

bool LatticeCliques::list_shapes(double limit) {
  const std::vector<Cell> ahead = cells_ahead(reach_, limit);
  std::vector<Cell> all = ahead;
  for (const Cell& c : ahead) all.push_back({-c[0], -c[1], -c[2]});
  if (!ahead_.make(ahead, limit) || !around_.make(all, limit)) return false;
  for (const ShapeThird& third : around_.thirds)
    largest_volume_ = std::max(largest_volume_, std::abs(std::int32_t{third.volume}));
  for (std::int32_t V = -largest_volume_; V <= largest_volume_; ++V) {
    volume_.push_back(V);
    inverse_.push_back(V == 0 ? 0.0 : 1.0 / std::abs(V));
  }
  for (const Cell& c : all)
    for (const std::int32_t along : c) around_cells_.push_back(along);
  // Every tile is as wide as the widest, with rows outside of the body.
  for (const Cell& c : ahead)
    distance_.push_back((c[2] * (kMiddles + 2 * reach_) + c[1]) * width_ + c[0]);
  member_at_.assign(static_cast<std::size_t>(side() * side() * side()), -1);
  for (std::size_t m = 0; m < all.size(); ++m)
    member_at_[place_of(all[m])] = static_cast<std::int32_t>(m);
  return true;
}

void LatticeCliques::connect(const peridynamics::Neighbourhood& hood,
                             const peridynamics::Damage& damage, std::int64_t i) {
  const Cell& own = cell_[static_cast<std::size_t>(i)];
  for (std::int32_t b = hood.first(i); b < hood.last(i); ++b) {
    Cell step = cell_[static_cast<std::size_t>(hood.neighbour(b))];
    for (std::size_t k = 0; k < 3; ++k) step[k] -= own[k];
    const std::int32_t place = member_at_[place_of(step)];
    if (place < static_cast<std::int32_t>(ahead_.members.size()))
      bonds_.set(own, place, damage.intact(b));
  }
}

std::size_t LatticeCliques::place_of(const Cell& c) const {
  return static_cast<std::size_t>(((c[2] + reach_) * side() + c[1] + reach_) * side() + c[0] +
                                  reach_);
}

Shapes LatticeCliques::shapes_of(const ShapeList& list) const {
  return {distance_.data(),   static_cast<std::int32_t>(list.members.size()),
          list.pairs.data(),  static_cast<std::int32_t>(list.pairs.size()),
          list.thirds.data(), volume_.data(),
          inverse_.data(),    largest_volume_,
          signed_volume_,     bonds_.of_pairs(),
          bonds_.of_thirds()};
}

void LatticeCliques::make_tiles() {
  for (std::int32_t slow = 0; slow < shape_[2]; slow += kSlows)
    for (std::int32_t middle = 0; middle < shape_[1]; middle += kMiddles) {
      Tile tile;
      tile.middle = middle;
      tile.slow = slow;
      tile.slows = std::min(kSlows, shape_[2] - slow);
      const auto size = static_cast<std::size_t>(local_rows(tile) * width_);
      for (auto& along : tile.f) along.assign(size, 0.0);
      tile.e.assign(size, 0.0);
      sort_eights(tile);
      tiles_.push_back(std::move(tile));
    }
  const auto rows = static_cast<std::size_t>(shape_[1]) * static_cast<std::size_t>(shape_[2]);
  std::vector<std::vector<Part>> of_row(rows);
  for (std::size_t t = 0; t < tiles_.size(); ++t) {
    for (std::int32_t row = 0; row < static_cast<std::int32_t>(local_rows(tiles_[t])); ++row) {
      const Cell start = row_start(tiles_[t], row);
      if (start[1] < 0 || start[1] >= shape_[1] || start[2] >= shape_[2]) continue;
      of_row[static_cast<std::size_t>(start[2]) * static_cast<std::size_t>(shape_[1]) +
             static_cast<std::size_t>(start[1])]
          .push_back({static_cast<std::int32_t>(t), row});
    }
  }
  part_begin_.assign(1, 0);
  for (const auto& list : of_row) {
    parts_.insert(parts_.end(), list.begin(), list.end());
    part_begin_.push_back(static_cast<std::int32_t>(parts_.size()));
  }
}

LatticeCliques::Cell LatticeCliques::row_start(const Tile& tile, std::int32_t row) const {
  const std::int32_t across = kMiddles + 2 * reach_;
  return {-reach_, tile.middle - reach_ + row % across, tile.slow + row / across};
}

std::int64_t LatticeCliques::local_rows(const Tile& tile) const {
  return static_cast<std::int64_t>(kMiddles + 2 * reach_) * (tile.slows + reach_);
}

std::int32_t LatticeCliques::point_at(std::int32_t fast, std::int32_t middle,
                                      std::int32_t slow) const {
  if (fast < 0 || fast >= shape_[0] || middle < 0 || middle >= shape_[1] || slow < 0 ||
      slow >= shape_[2])
    return -1;
  return point_[(static_cast<std::size_t>(slow) * static_cast<std::size_t>(shape_[1]) +
                 static_cast<std::size_t>(middle)) *
                    static_cast<std::size_t>(shape_[0]) +
                static_cast<std::size_t>(fast)];
}

void LatticeCliques::sort_eights(Tile& tile) const {
  for (std::int32_t s = tile.slow; s < tile.slow + tile.slows; ++s)
    for (std::int32_t m = tile.middle; m < tile.middle + kMiddles; ++m)
      for (std::int32_t first = 0; first < shape_[0]; first += kEight) {
        bool any = false, full = true;
        for (std::int32_t f = first; f < first + kEight; ++f) {
          const bool here = point_at(f, m, s) >= 0;
          any = any || here;
          full = full && here &&
                 std::all_of(ahead_.members.begin(), ahead_.members.end(), [&](const Cell& c) {
                   return point_at(f + c[0], m + c[1], s + c[2]) >= 0;
                 });
        }
        tile.eights.push_back(!any ? kEmpty : full ? kFull : kSome);
      }
}

// The places of all points that a tile reaches, in spacings, and which of them are there.
void LatticeCliques::take_places(const Tile& tile, const double* u, const double* weight,
                                 Scratch& scratch) const {
  const double inverse = 1 / spacing_;
  std::size_t place = 0;
  for (std::int32_t row = 0; row < static_cast<std::int32_t>(local_rows(tile)); ++row) {
    const Cell start = row_start(tile, row);
    for (std::int32_t f = 0; f < width_; ++f, ++place) {
      const std::int32_t point = point_at(start[0] + f, start[1], start[2]);
      // Counted from the tile, so that fewer digits go into the place.
      const double cell[3] = {static_cast<double>(start[0] + f),
                              static_cast<double>(start[1] - tile.middle),
                              static_cast<double>(start[2] - tile.slow)};
      scratch.there[place] = point < 0 ? 0.0 : 1.0;
      if (weight != nullptr) scratch.weight[place] = point < 0 ? 0.0 : 0.25 * weight[point];
      for (std::size_t k = 0; k < 3; ++k) {
        scratch.x[k][place] = cell[k];
        if (point >= 0)
          scratch.x[k][place] += u[kVector * point + static_cast<std::int64_t>(axis_[k])] * inverse;
      }
    }
  }
}

void LatticeCliques::sum_tile(Tile& tile, const double* u, const double* weight,
                              Scratch& scratch) const {
  for (auto& along : tile.f) std::fill(along.begin(), along.end(), 0.0);
  std::fill(tile.e.begin(), tile.e.end(), 0.0);
  take_places(tile, u, weight, scratch);
  const Shapes shapes = shapes_of(ahead_);
  const LatticeTile arrays{{scratch.x[0].data(), scratch.x[1].data(), scratch.x[2].data()},
                           scratch.there.data(),
                           {tile.f[0].data(), tile.f[1].data(), tile.f[2].data()},
                           tile.e.data(),
                           weight == nullptr ? nullptr : scratch.weight.data()};
  const auto& kernels = CLEAVE_KERNELS(kLatticeKernels).chosen();
  const char* kind = tile.eights.data();
  for (std::int32_t s = 0; s < tile.slows; ++s)
    for (std::int32_t m = 0; m < kMiddles; ++m)
      for (std::int32_t first = 0; first < shape_[0]; first += kEight) {
        const char what = *kind++;
        if (what == kEmpty) continue;
        const std::int64_t row = s * (kMiddles + 2 * reach_) + m + reach_;
        const bool damaged =
            bonds_.look_up({first, tile.middle + m, tile.slow + s}, scratch.carries.data());
        kernels.eight(shapes, arrays, row * width_ + reach_ + first, what == kFull,
                      scratch.bench.data(), damaged ? scratch.carries.data() : nullptr);
      }
}

void LatticeCliques::expect_workers(int workers) {
  while (active() && scratch_.size() < static_cast<std::size_t>(workers)) {
    Scratch& s = scratch_.emplace_back();
    for (auto& along : s.x) along.assign(tiles_.front().e.size(), 0.0);
    s.there.assign(tiles_.front().e.size(), 0.0);
    s.weight.assign(tiles_.front().e.size(), 0.0);
    s.bench.assign(72 * ahead_.members.size(), 0.0);
    s.carries.assign(bonds_.count(), 0xff);
    s.around.assign(32 * around_.members.size(), 0.0);
  }
}

void LatticeCliques::sum(const double* u, const double* weight, ThreadTeam& team, double* sums) {
  team.for_blocks(static_cast<std::int64_t>(tiles_.size()), [&](std::int64_t tile, int worker) {
    sum_tile(tiles_[static_cast<std::size_t>(tile)], u, weight,
             scratch_[static_cast<std::size_t>(worker)]);
  });
  const double area = spacing_ * spacing_,
               half_volume = (weight == nullptr ? 0.5 : 0.125) * area * spacing_;
  team.for_blocks(static_cast<std::int64_t>(part_begin_.size()) - 1, [&](std::int64_t row) {
    const auto r = static_cast<std::size_t>(row);
    for (std::int32_t f = 0; f < shape_[0]; ++f) {
      const std::int32_t point =
          point_[r * static_cast<std::size_t>(shape_[0]) + static_cast<std::size_t>(f)];
      if (point < 0) continue;
      double sum[4] = {};
      for (auto k = static_cast<std::size_t>(part_begin_[r]);
           k < static_cast<std::size_t>(part_begin_[r + 1]); ++k) {
        const Tile& tile = tiles_[static_cast<std::size_t>(parts_[k].tile)];
        const auto at = static_cast<std::size_t>(parts_[k].row) * static_cast<std::size_t>(width_) +
                        static_cast<std::size_t>(reach_ + f);
        for (std::size_t d = 0; d < 3; ++d) sum[d] += tile.f[d][at];
        sum[3] += tile.e[at];
      }
      double* to = sums + 4 * static_cast<std::int64_t>(point);
      for (std::size_t d = 0; d < 3; ++d) to[axis_[d]] = area * sum[d];
      to[3] = half_volume * sum[3];
    }
  });
}

void LatticeCliques::lay_around(const peridynamics::Neighbourhood& hood,
                                const peridynamics::Damage& damage,
                                std::span<const std::int32_t> points, const double* u,
                                AlignedReals& bench) const {
  std::fill(bench.begin(), bench.end(), 0.0);
  const double inverse = 1 / spacing_;
  for (std::size_t l = 0; l < points.size(); ++l) {
    const std::int64_t i = points[l];
    const Cell& own = cell_[static_cast<std::size_t>(i)];
    for (std::int32_t b = hood.first(i); b < hood.last(i); ++b) {
      if (!damage.intact(b)) continue;
      const std::int32_t p = hood.neighbour(b);
      Cell step = cell_[static_cast<std::size_t>(p)];
      for (std::size_t k = 0; k < 3; ++k) step[k] -= own[k];
      double* to = bench.data() + 32 * member_at_[place_of(step)] + l;
      for (std::size_t k = 0; k < 3; ++k) {
        const auto c = static_cast<std::int64_t>(axis_[k]);
        to[kEight * k] = step[k] + (u[kVector * p + c] - u[kVector * i + c]) * inverse;
      }
      to[kEight * 3] = 1;
    }
  }
}

void LatticeCliques::stress_sums(const peridynamics::Neighbourhood& hood,
                                 const peridynamics::Damage& damage,
                                 std::span<const std::int32_t> points, const double* u, int worker,
                                 Mat<3>* sums) const {
  AlignedReals& bench = scratch_[static_cast<std::size_t>(worker)].around;
  lay_around(hood, damage, points, u, bench);
  alignas(64) double found[9 * kEight];
  CLEAVE_KERNELS(kLatticeKernels)
      .chosen()
      .stress(shapes_of(around_), around_cells_.data(), bench.data(), found);
  const double volume = spacing_ * spacing_ * spacing_;
  for (std::size_t l = 0; l < points.size(); ++l)
    for (std::size_t r = 0; r < 3; ++r)
      for (std::size_t c = 0; c < 3; ++c)
        sums[l](static_cast<int>(axis_[r]), static_cast<int>(axis_[c])) =
            volume * found[kEight * (3 * r + c) + l];
}

std::int64_t LatticeCliques::bytes() const {
  std::size_t bytes = point_.capacity() * sizeof(std::int32_t) +
                      (ahead_.thirds.capacity() + around_.thirds.capacity()) * sizeof(ShapeThird) +
                      cell_.capacity() * sizeof(Cell) + parts_.capacity() * sizeof(Part) +
                      around_cells_.capacity() * sizeof(double);
  for (const Tile& tile : tiles_)
    bytes += 4 * tile.e.capacity() * sizeof(double) + tile.eights.capacity();
  for (const Scratch& s : scratch_)
    bytes += (5 * s.there.capacity() + s.bench.capacity() + s.around.capacity()) * sizeof(double);
  return static_cast<std::int64_t>(bytes) + bonds_.bytes();
}

}  // namespace cleave::cpd
