#include "formulation/cbm/block_search.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace cleave::cbm {

namespace {
std::size_t at(std::int64_t k) { return static_cast<std::size_t>(k); }

// Bonds that may break in a step before a list has to grow.
constexpr std::size_t kReserve = 65536;
}  // namespace

void BlockSearch::setup(const BlockNetwork& blocks, bool active) {
  active_ = active;
  margins_.assign(blocks.blocks.size(), {});
  if (active) broken_.reserve(kReserve);
}

void BlockSearch::forget() { std::fill(margins_.begin(), margins_.end(), Margin{}); }

void BlockSearch::moved(const BlockNetwork& blocks, const std::vector<VelocityBox>& boxes,
                        double dt) {
  if (!active_) return;
  for (std::size_t b = 0; b < margins_.size(); ++b) {
    VelocityBox box = boxes[b];
    for (const std::int32_t other : blocks.blocks[b].beside)
      for (int k = 0; k < 3; ++k) {
        box.low[k] = std::fmin(box.low[k], boxes[at(other)].low[k]);
        box.high[k] = std::fmax(box.high[k], boxes[at(other)].high[k]);
      }
    double square = 0;
    for (int k = 0; k < 3; ++k) {
      const double range = box.high[k] - box.low[k];
      if (range > 0) square += range * range;
    }
    margins_[b].travel += dt * std::sqrt(square);
    margins_[b].steps += 1;
  }
}

// A step rounds u and x by a few units of their last place; 1e-14 of the coordinates is more than 40.
bool BlockSearch::safe(const Margin& m) const {
  const double rounding = 1e-14 * (m.extent + m.travel) * (m.steps + 4);
  return m.travel * (1 + 1e-9) + rounding < m.slack;
}

// slack = min(L - |x|) >= min(L^2 - |x|^2) / (2 max L) over bonds with a criterion.
template <int D>
void BlockSearch::look(const Network& network, const BlockNetwork& blocks, const Block& block,
                       const double* X, const double* u, double* x, Margin& margin,
                       std::vector<std::int32_t>& found) const {
  double least = std::numeric_limits<double>::infinity(), extent = 0;
  float longest = 0;
  const auto place = [&](std::int64_t local) -> std::int64_t {
    return local < block.own ? block.first + local : block.foreign[at(local - block.own)];
  };
  for (std::int64_t l = 0; l < block.locals(); ++l) {
    const std::int64_t p = place(l);
    for (int k = 0; k < D; ++k) {
      const double displacement = u[D * p + k];
      x[D * l + k] = X[D * p + k] + displacement;
      extent = std::fmax(extent, std::fabs(X[D * p + k]) + std::fabs(displacement));
    }
  }
  const auto meets = [&](std::int64_t i, std::int64_t p, double square) {
    const std::int32_t first = blocks.given[at(place(i))], second = blocks.given[at(place(p))];
    const std::int32_t bond = network.find_bond(first, second);
    const double limit = (1 + network.critical[bond]) * network.length(first, second);
    return network.status[bond] == kIntact && square >= limit * limit ? bond : -1;
  };
  const auto test = [&](std::int64_t i, std::int64_t p, float limit) {
    double square = 0;
    for (int k = 0; k < D; ++k) {
      const double d = x[D * p + k] - x[D * i + k];
      square += d * d;
    }
    const double left = limit - square;
    least = left < least ? left : least;
    if (limit < std::numeric_limits<float>::max()) longest = std::max(longest, limit);
    if (left > 0) return;
    const std::int32_t bond = meets(i, p, square);
    if (bond >= 0) found.push_back(bond);
  };
  for (std::int64_t i = 0; i < block.own; ++i) {
    const auto row = [i](const BlockBonds& bonds, const auto& f) {
      for (std::int32_t b = bonds.begin[at(i)]; b < bonds.begin[at(i)] + bonds.count[at(i)]; ++b)
        f(b);
    };
    row(block.twins,
        [&](std::int32_t b) { test(i, block.twins.end[at(b)], block.twins.square_limit[at(b)]); });
    row(block.halves, [&](std::int32_t b) {
      const std::int64_t p = block.halves.end[at(b)];
      if (place(i) < place(p)) test(i, p, block.halves.square_limit[at(b)]);
    });
  }
  margin.slack = longest > 0 ? least / (2 * std::sqrt(static_cast<double>(longest)) * (1 + 1e-6))
                             : std::numeric_limits<double>::infinity();
  margin.travel = margin.steps = 0;
  margin.extent = extent;
}

template <int D>
const std::vector<std::int32_t>& BlockSearch::find(const BlockNetwork& blocks,
                                                   const Network& network, const double* X,
                                                   const double* u, ThreadTeam& team) {
  broken_.clear();
  if (!active_) return broken_;
  while (static_cast<int>(workers_.size()) < team.size()) {
    workers_.push_back(
        {std::vector<double>(at(D * static_cast<std::int64_t>(blocks.largest))), {}});
    workers_.back().found.reserve(kReserve);
  }
  for (Worker& worker : workers_) worker.found.clear();
  team.for_blocks(static_cast<std::int64_t>(margins_.size()), [&](std::int64_t b, int worker) {
    if (safe(margins_[at(b)])) return;
    Worker& w = workers_[at(worker)];
    look<D>(network, blocks, blocks.blocks[at(b)], X, u, w.x.data(), margins_[at(b)], w.found);
  });
  for (const Worker& worker : workers_)
    broken_.insert(broken_.end(), worker.found.begin(), worker.found.end());
  std::sort(broken_.begin(), broken_.end());
  return broken_;
}

template const std::vector<std::int32_t>& BlockSearch::find<2>(const BlockNetwork&, const Network&,
                                                               const double*, const double*,
                                                               ThreadTeam&);
template const std::vector<std::int32_t>& BlockSearch::find<3>(const BlockNetwork&, const Network&,
                                                               const double*, const double*,
                                                               ThreadTeam&);

}  // namespace cleave::cbm
