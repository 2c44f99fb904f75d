#include "scene/piece_grid.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "scene/index.hpp"

namespace cleave::driver {

PieceGrid::PieceGrid(const std::vector<Box>& boxes) {
  if (boxes.empty()) return;
  all_ = boxes.front();
  std::array<double, 3> mean{};  // size of a box
  for (const Box& box : boxes) {
    for (std::size_t k = 0; k < 3; ++k) {
      all_.lower[k] = std::min(all_.lower[k], box.lower[k]);
      all_.upper[k] = std::max(all_.upper[k], box.upper[k]);
      mean[k] += (box.upper[k] - box.lower[k]) / static_cast<double>(boxes.size());
    }
  }
  // As many cells along an axis as boxes lie side by side; at most about a cell a piece in all.
  const double most = std::cbrt(static_cast<double>(boxes.size()));
  double cells = 1;
  for (std::size_t k = 0; k < 3; ++k) {
    size_[k] = all_.upper[k] - all_.lower[k];
    const double side_by_side = mean[k] > 0 ? size_[k] / mean[k] : 1;
    count_[k] = std::max<Index>(1, static_cast<Index>(std::min(side_by_side, most * most)));
    cells *= static_cast<double>(count_[k]);
  }
  const double excess = cells / (8 * static_cast<double>(boxes.size()));
  if (excess > 1) {
    for (Index& count : count_)
      count =
          std::max<Index>(1, static_cast<Index>(static_cast<double>(count) / std::cbrt(excess)));
  }
  begin_.assign(at(count_[0] * count_[1] * count_[2]) + 1, 0);
  for (const Box& box : boxes) for_cells(box, [&](std::size_t cell) { ++begin_[cell + 1]; });
  std::partial_sum(begin_.begin(), begin_.end(), begin_.begin());
  pieces_.resize(at(begin_.back()));
  std::vector<std::int32_t> next(begin_.begin(), begin_.end() - 1);
  for (std::size_t piece = 0; piece < boxes.size(); ++piece) {
    for_cells(boxes[piece], [&](std::size_t cell) {
      pieces_[at(next[cell]++)] = static_cast<std::int32_t>(piece);
    });
  }
}

PieceGrid::Cell PieceGrid::cell_of(const double* x) const {
  Cell cell{};
  for (std::size_t k = 0; k < 3; ++k) {
    const double part = size_[k] > 0 ? (x[k] - all_.lower[k]) / size_[k] : 0;
    const double number = std::floor(part * static_cast<double>(count_[k]));
    cell[k] = static_cast<Index>(std::clamp(number, 0.0, static_cast<double>(count_[k] - 1)));
  }
  return cell;
}

template <class Visit>
void PieceGrid::for_cells(const Box& box, Visit visit) const {
  const Cell low = cell_of(box.lower), high = cell_of(box.upper);
  for (Index k = low[2]; k <= high[2]; ++k)
    for (Index j = low[1]; j <= high[1]; ++j)
      for (Index i = low[0]; i <= high[0]; ++i) visit(at((k * count_[1] + j) * count_[0] + i));
}

const std::vector<std::int32_t>& PieceGrid::near(const Box& box) {
  found_.clear();
  if (begin_.empty()) return found_;
  std::size_t cells = 0;
  for_cells(box, [&](std::size_t cell) {
    found_.insert(found_.end(), pieces_.begin() + begin_[cell], pieces_.begin() + begin_[cell + 1]);
    ++cells;
  });
  if (cells > 1) {
    std::sort(found_.begin(), found_.end());
    found_.erase(std::unique(found_.begin(), found_.end()), found_.end());
  }
  return found_;
}

}  // namespace cleave::driver
