#include "formulation/cpd/lattice_bonds.hpp"

#include <map>

#include "formulation/peridynamics/bits.hpp"

namespace cleave::cpd {

namespace {

constexpr std::int64_t kEight = 8;

LatticeBonds::Cell between(const LatticeBonds::Cell& a, const LatticeBonds::Cell& b) {
  return {b[0] - a[0], b[1] - a[1], b[2] - a[2]};
}

}  // namespace

// Cells and what they reach, with room for an eight that begins in the last.
std::int64_t LatticeBonds::bit(const Cell& cell) const {
  const std::int64_t across = shape_[0] + 2 * reach_ + kEight, rows = shape_[1] + 2 * reach_;
  return (cell[2] * rows + cell[1] + reach_) * across + cell[0] + reach_;
}

void LatticeBonds::setup(const Cell& shape, std::int32_t reach, const std::vector<Cell>& ahead,
                         const std::vector<ShapePair>& pairs, const std::vector<ShapeThird>& thirds,
                         double limit) {
  *this = {};
  shape_ = shape;
  reach_ = reach;
  const std::size_t n = ahead.size();
  std::map<Cell, std::int32_t> place;
  for (std::size_t a = 0; a < n; ++a) {
    place[ahead[a]] = static_cast<std::int32_t>(a);
    bonds_.push_back({0, static_cast<std::int32_t>(a)});
  }
  std::vector<std::int32_t> number(n * n, -1);
  for (std::size_t a = 0; a < n; ++a)
    for (std::size_t b = a + 1; b < n; ++b) {
      const Cell step = between(ahead[a], ahead[b]);
      double square = 0;
      for (const std::int32_t along : step) square += static_cast<double>(along * along);
      if (!(square < limit)) continue;
      number[a * n + b] = static_cast<std::int32_t>(bonds_.size() - n);
      bonds_.push_back({bit(ahead[a]) - bit({}), place.at(step)});
    }
  for (const ShapePair& pair : pairs) {
    of_pairs_.push_back(number[pair.a * n + pair.b]);
    for (std::int32_t t = pair.first; t < pair.last; ++t) {
      const std::size_t c = thirds[static_cast<std::size_t>(t)].member;
      of_thirds_.push_back(number[pair.a * n + c]);
      of_thirds_.push_back(number[pair.b * n + c]);
    }
  }
  plane_ = bit({0, 0, shape_[2] + reach_}) / 64 + 2;
  carry_.assign(static_cast<std::size_t>(plane_) * n, ~std::uint64_t{0});
}

void LatticeBonds::set(const Cell& cell, std::int32_t place, bool carries) {
  std::uint64_t* plane = carry_.data() + plane_ * place;
  const std::int64_t at = bit(cell);
  if (peridynamics::bit_of(plane, at) == carries) return;
  peridynamics::set_bit(plane, at, carries);
  broken_ += carries ? -1 : 1;
}

bool LatticeBonds::look_up(const Cell& cell, std::uint8_t* bytes) const {
  if (broken_ == 0) return false;
  const std::int64_t at = bit(cell);
  unsigned all = 0xffu;
  for (std::size_t k = 0; k < bonds_.size(); ++k) {
    const Bond& bond = bonds_[k];
    const unsigned byte =
        peridynamics::eight_bits(carry_.data() + plane_ * bond.place, at + bond.distance);
    bytes[k] = static_cast<std::uint8_t>(byte);
    all &= byte;
  }
  return all != 0xffu;
}

std::int64_t LatticeBonds::bytes() const {
  return static_cast<std::int64_t>(
      carry_.capacity() * sizeof(std::uint64_t) + bonds_.capacity() * sizeof(Bond) +
      (of_pairs_.capacity() + of_thirds_.capacity()) * sizeof(std::int32_t));
}

}  // namespace cleave::cpd
