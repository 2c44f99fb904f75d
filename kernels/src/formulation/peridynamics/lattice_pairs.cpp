#include "formulation/peridynamics/lattice_pairs.hpp"

#include <algorithm>
#include <bit>
#include <cmath>

#include "core/blocks.hpp"
#include "core/instruction_set.hpp"

CLEAVE_DECLARE_KERNELS(cleave_call::LatticePairKernels, kLatticePairKernels)

namespace cleave::peridynamics {

namespace {

constexpr std::int32_t kEight = 8;
// Of (l/L)^2: points may be off their lattice by 1e-6 spacings.
constexpr double kMargin = 1e-5;
// Of neighbours of eight points, see list_inside.
constexpr std::size_t kRowsTogether = 8;

std::int32_t whole_eights(std::int32_t n) { return (n + kEight - 1) / kEight; }

double square_of(const std::array<std::int32_t, 3>& step) {
  double sum = 0;
  for (const std::int32_t along : step) sum += static_cast<double>(along) * along;
  return sum;
}

// Slab by slab: middle, then slow, then fast.
bool is_ahead(const std::array<std::int32_t, 3>& step) {
  if (step[1] != 0) return step[1] > 0;
  if (step[2] != 0) return step[2] > 0;
  return step[0] > 0;
}

}  // namespace

bool LatticePairs::setup(const Neighbourhood& hood, const Lattice& lattice, int directions) {
  *this = {};
  spacing_ = lattice.spacing;
  directions_ = directions;
  axis_ = axes_by_length(lattice);
  for (std::size_t k = 0; k < 3; ++k) shape_[k] = lattice.shape[axis_[k]];
  const double limit = hood.square_limit / (spacing_ * spacing_);
  while (static_cast<double>((reach_ + 1) * (reach_ + 1)) < limit) ++reach_;
  if (reach_ == 0) {
    *this = {};
    return false;
  }
  eights_ = whole_eights(shape_[0]);
  before_ = kEight * whole_eights(reach_);  // own eights begin on a cache line
  width_ = 2 * before_ + kEight * eights_;
  stride_ = static_cast<std::int64_t>(kLines) * width_;
  list_steps(limit);
  list_rows();
  values_.assign(rows_.size() * static_cast<std::size_t>(stride_), 0.0);
  std::vector<char> there(values_.size(), 0);
  for (std::int64_t i = 0; i < hood.points; ++i) {
    Cell cell;
    for (std::size_t k = 0; k < 3; ++k)
      cell[k] = lattice.cell[static_cast<std::size_t>(3 * i) + axis_[k]];
    place_.push_back(place_of(cell));
    there[static_cast<std::size_t>(place_.back())] = 1;
  }
  if (find_bonds(hood, there)) return true;
  *this = {};
  return false;
}

void LatticePairs::list_steps(double limit) {
  const std::int32_t side = 2 * reach_ + 1;
  number_.assign(static_cast<std::size_t>(side * side * side), -1);
  for (std::int32_t fast = -reach_; fast <= reach_; ++fast)
    for (std::int32_t middle = 0; middle <= reach_; ++middle)
      for (std::int32_t slow = -reach_; slow <= reach_; ++slow) {
        const Cell cell{fast, middle, slow};
        const double square = square_of(cell);
        if (!is_ahead(cell) || !(square < limit)) continue;
        number_[step_at(cell)] = static_cast<std::int32_t>(steps_.size());
        PairStep step{};
        for (std::size_t k = 0; k < 3; ++k) step.D[axis_[k]] = cell[k];
        step.square = square;
        step.inverse_square = 1 / square;
        step.inverse = 1 / std::sqrt(square);
        step.distance = (static_cast<std::int64_t>(middle) * shape_[2] + slow) * stride_ + fast;
        steps_.push_back(step);
        cells_.push_back(cell);
      }
}

// Steps that stay in the body, for some rows of neighbours at a time: few enough to stay in the nearest cache. Among
// these, places along the fast axis are the outer loop: forces on neighbours of which the lanes overlap are then added
// long after each other, not before the last ones have reached the cache.
void LatticePairs::list_inside(const Cell& faces) {
  std::vector<std::pair<std::int32_t, std::int32_t>> rows;  // middle and slow
  for (std::int32_t middle = 0; middle <= faces[0]; ++middle)
    for (std::int32_t slow = -faces[1]; slow <= faces[2]; ++slow) rows.emplace_back(middle, slow);
  for (std::size_t first = 0; first < rows.size(); first += kRowsTogether) {
    const std::size_t last = std::min(rows.size(), first + kRowsTogether);
    for (std::int32_t fast = -reach_; fast <= reach_; ++fast)
      for (std::size_t k = first; k < last; ++k) {
        const std::int32_t number = number_[step_at({fast, rows[k].first, rows[k].second})];
        if (number >= 0) lists_.push_back(number);
      }
  }
}

void LatticePairs::list_rows() {
  std::map<Cell, Row> known;  // by the distances to the faces
  for (std::int32_t middle = 0; middle < shape_[1]; ++middle)
    for (std::int32_t slow = 0; slow < shape_[2]; ++slow) {
      const Cell faces{std::min(reach_, shape_[1] - 1 - middle), std::min(reach_, slow),
                       std::min(reach_, shape_[2] - 1 - slow)};
      const auto [entry, is_new] = known.try_emplace(faces);
      if (is_new) {
        entry->second.list = static_cast<std::int32_t>(lists_.size());
        list_inside(faces);
        entry->second.steps = static_cast<std::int32_t>(lists_.size()) - entry->second.list;
      }
      rows_.push_back(entry->second);
    }
}

// Of all points that are there. A horizon on a shell whose distances rounding moves to both sides gives another
// number of bonds than whole shells: a shell is taken whole here, so an equal number means the same bonds.
bool LatticePairs::find_bonds(const Neighbourhood& hood, const std::vector<char>& there) {
  const std::size_t eights = rows_.size() * static_cast<std::size_t>(eights_);
  carries_.assign(eights * steps_.size(), 0);
  whole_.assign(eights, 0);
  damaged_.assign(place_.size(), 0);
  std::int64_t bonds = 0;
  for (std::size_t row = 0; row < rows_.size(); ++row)
    for (std::int32_t n = 0; n < eights_; ++n) {
      const auto eight = static_cast<std::int64_t>(row) * eights_ + n;
      const std::int64_t at = static_cast<std::int64_t>(row) * stride_ + before_ + n * kEight;
      for (std::int32_t k = 0; k < rows_[row].steps; ++k) {
        const auto step =
            static_cast<std::size_t>(lists_[static_cast<std::size_t>(rows_[row].list + k)]);
        unsigned byte = 0;
        for (std::int64_t l = 0; l < kEight; ++l) {
          const bool both = there[static_cast<std::size_t>(at + l)] != 0 &&
                            there[static_cast<std::size_t>(at + l + steps_[step].distance)] != 0;
          byte |= (both ? 1u : 0u) << l;
        }
        carries_[static_cast<std::size_t>(eight) * steps_.size() + step] =
            static_cast<std::uint8_t>(byte);
        bonds += std::popcount(byte);
      }
      find_whole(eight);
    }
  return bonds == hood.bonds();
}

void LatticePairs::find_whole(std::int64_t eight) {
  const Row& row = rows_[static_cast<std::size_t>(eight / eights_)];
  const std::uint8_t* carries = carries_.data() + eight * std::ssize(steps_);
  const std::int32_t* list = lists_.data() + row.list;
  whole_[static_cast<std::size_t>(eight)] =
      std::all_of(list, list + row.steps, [&](std::int32_t k) { return carries[k] == 0xff; }) ? 1
                                                                                              : 0;
}

void LatticePairs::weigh(const Neighbourhood& hood, const PairWeights& weights,
                         const double* limit) {
  const auto n = static_cast<std::size_t>(hood.points);
  const auto right = std::span(weights.right, n);
  const bool alike =
      weights.form == PairForm::product &&
      std::all_of(right.begin(), right.end(), [&](double r) { return r == right[0]; });
  form_ = alike ? cleave_call::kAlikeForm : static_cast<int>(weights.form);
  outer_.resize(n);
  half_.resize(n);
  const bool shared = weights.alpha != nullptr;
  for (std::int64_t row = 0; row < std::ssize(rows_); ++row) {
    double* first = values_.data() + row * stride_;
    std::fill_n(first + kAlpha * width_, width_, 1.0);
    std::fill_n(first + kReach * width_, width_, kUnbounded);
  }
  for (std::size_t i = 0; i < n; ++i) {
    const auto at = static_cast<std::size_t>(place_[i]);
    const auto line = static_cast<std::size_t>(width_);
    values_[at + kRight * line] = weights.right[i];
    if (shared) values_[at + kAlpha * line] = weights.alpha[i];
    outer_[i] = weights.form == PairForm::sum ? 1.0 : weights.left[i] * (alike ? right[i] : 1.0);
    half_[i] = 0.25 * outer_[i] * spacing_ / hood.volume[i];
    values_[at + kReach * line] = (1 + limit[i]) * (1 + limit[i]) * (1 - kMargin) - 1;
  }
}

void LatticePairs::connect(const Neighbourhood& hood, const Damage& damage, std::int64_t i) {
  const auto own = static_cast<std::size_t>(i);
  if (damaged_[own] == 0 && damage.whole(i)) return;
  damaged_[own] = damage.whole(i) ? 0 : 1;
  const std::int64_t at = place_[own], eight = eight_of(at);
  const Cell cell = cell_of(at);
  const auto bit = static_cast<unsigned>(cell[0] % kEight);
  for (std::int32_t b = hood.first(i); b < hood.last(i); ++b) {
    Cell step = cell_of(place_[static_cast<std::size_t>(hood.neighbour(b))]);
    for (std::size_t k = 0; k < 3; ++k) step[k] -= cell[k];
    const std::int32_t number = number_[step_at(step)];
    if (number < 0) continue;
    std::uint8_t& byte = carries_[static_cast<std::size_t>(eight * std::ssize(steps_)) +
                                  static_cast<std::size_t>(number)];
    const unsigned kept = byte & ~(1u << bit);
    byte = static_cast<std::uint8_t>(kept | ((damage.intact(b) ? 1u : 0u) << bit));
  }
  find_whole(eight);
}

void LatticePairs::take(const double* u, std::int64_t first, std::int64_t last) {
  const double inverse = 1 / spacing_;
  for (std::int64_t i = first; i < last; ++i) {
    double* to = values_.data() + place_[static_cast<std::size_t>(i)];
    for (std::int64_t k = 0; k < directions_; ++k) to[k * width_] = inverse * u[kVector * i + k];
  }
}

// f(row) for all rows; of two that give forces to one, in the same order always.
template <class F>
void LatticePairs::for_rows(ThreadTeam& team, const F& f) const {
  const std::int32_t slabs = (shape_[1] + reach_ - 1) / reach_;
  for (std::int32_t first : {0, 1})
    team.for_blocks((slabs - first + 1) / 2, [&](std::int64_t pair) {
      const auto begin = static_cast<std::int32_t>(2 * pair + first) * reach_,
                 end = std::min(begin + reach_, shape_[1]);
      for (std::int32_t slow = 0; slow < shape_[2]; ++slow)
        for (std::int32_t middle = begin; middle < end; ++middle) {
          const std::int64_t row = static_cast<std::int64_t>(middle) * shape_[2] + slow;
          const Row& r = rows_[static_cast<std::size_t>(row)];
          f(PairRow{lists_.data() + r.list, r.steps, eights_, row * stride_ + before_,
                    row * eights_});
        }
    });
}

PairRows LatticePairs::arrays() {
  PairRows a{};
  double* line[kLines];
  for (std::int64_t k = 0; k < kLines; ++k) line[k] = values_.data() + k * width_;
  a.steps = steps_.data();
  a.step_count = static_cast<std::int32_t>(steps_.size());
  a.carries = carries_.data();
  a.whole = whole_.data();
  for (int k = 0; k < 3; ++k) {
    a.u[k] = line[kU + k];
    a.f[k] = line[kForce + k];
  }
  a.right = line[kRight];
  a.alpha = line[kAlpha];
  a.e = line[kEnergy];
  a.reach = line[kReach];
  return a;
}

void LatticePairs::act(ThreadTeam& team, double* force, double* energy) {
  const PairRows a = arrays();
  const auto pull = CLEAVE_KERNELS(kLatticePairKernels).chosen().force[form_][directions_ - 2];
  for_rows(team, [&](const PairRow& row) { pull(a, row); });
  for_blocks(team, std::ssize(place_), [&](std::int64_t, std::int64_t first, std::int64_t last) {
    for (std::int64_t i = first; i < last; ++i) {
      const auto own = static_cast<std::size_t>(i);
      const std::int64_t at = place_[own];
      for (int k = 0; k < 3; ++k) {  // and empty for the next sums
        force[kVector * i + k] = outer_[own] * a.f[k][at];
        a.f[k][at] = 0;
      }
      energy[i] = half_[own] * a.e[at];
      a.e[at] = 0;
    }
  });
}

void LatticePairs::flag_stretched(ThreadTeam& team, std::vector<char>& flag) {
  const PairRows a = arrays();
  const auto look = CLEAVE_KERNELS(kLatticePairKernels).chosen().stretched[directions_ - 2];
  for_rows(team, [&](const PairRow& row) { look(a, row); });
  for_blocks(team, std::ssize(place_), [&](std::int64_t, std::int64_t first, std::int64_t last) {
    for (auto i = static_cast<std::size_t>(first); i < static_cast<std::size_t>(last); ++i) {
      flag[i] = a.e[place_[i]] > 0 ? 1 : 0;
      a.e[place_[i]] = 0;
    }
  });
}

std::int64_t LatticePairs::place_of(const Cell& cell) const {
  return (static_cast<std::int64_t>(cell[1]) * shape_[2] + cell[2]) * stride_ + before_ + cell[0];
}
LatticePairs::Cell LatticePairs::cell_of(std::int64_t place) const {
  const std::int64_t row = row_of(place);
  return {static_cast<std::int32_t>(place % stride_) - before_,
          static_cast<std::int32_t>(row / shape_[2]), static_cast<std::int32_t>(row % shape_[2])};
}
std::int64_t LatticePairs::eight_of(std::int64_t place) const {
  return row_of(place) * eights_ + (place % stride_ - before_) / kEight;
}
std::size_t LatticePairs::step_at(const Cell& step) const {
  const std::int32_t side = 2 * reach_ + 1;
  return static_cast<std::size_t>(((step[1] + reach_) * side + step[2] + reach_) * side + step[0] +
                                  reach_);
}

std::int64_t LatticePairs::bytes() const {
  return static_cast<std::int64_t>(
      (values_.capacity() + outer_.capacity() + half_.capacity()) * sizeof(double) +
      (number_.capacity() + lists_.capacity()) * sizeof(std::int32_t) +
      place_.capacity() * sizeof(std::int64_t) + rows_.capacity() * sizeof(Row) +
      steps_.capacity() * (sizeof(PairStep) + sizeof(Cell)) + carries_.capacity() +
      whole_.capacity() + damaged_.capacity());
}

}  // namespace cleave::peridynamics
