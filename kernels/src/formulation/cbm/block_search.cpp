#include "formulation/cbm/block_search.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>

namespace cleave::cbm {

namespace {
std::size_t at(std::int64_t k) { return static_cast<std::size_t>(k); }

// Bonds that may break in a step before a list has to grow.
constexpr std::size_t kReserve = 65536;

// 1 / (2 L (1 + 1e-6)) of the largest length L that a limit of the block allows: with it
// (L_b^2 - |x|^2) / (L_b + |x|) >= (L_b^2 - |x|^2) / (2 L) bounds what a bond b inside its limit may grow.
double scale_of(const Block& block) {
  float longest = 0;
  for (const BlockBonds* bonds : {&block.twins, &block.halves})
    for (const float limit : bonds->square_limit)
      if (limit < std::numeric_limits<float>::infinity()) longest = std::max(longest, limit);
  return longest > 0 ? 1 / (2 * std::sqrt(static_cast<double>(longest)) * (1 + 1e-6)) : 1.0;
}

BlockRows rows_of(const BlockBonds& b) {
  return {b.begin.data(), b.count.data(), b.end.data(), nullptr, nullptr};
}

std::int32_t place_of(const Block& block, std::int32_t local) {
  return local < block.own ? block.first + local : block.foreign[at(local - block.own)];
}

}  // namespace

void BlockSearch::setup(const BlockNetwork& blocks, bool active) {
  active_ = active;
  if (!active) return;
  margins_.assign(blocks.blocks.size(), {});
  slack_.assign(blocks.place.size(), 0.0F);
  waiting_.assign(blocks.blocks.size(), 0);
  broken_.reserve(kReserve);
}

std::int64_t BlockSearch::bytes() const {
  return static_cast<std::int64_t>(slack_.size() * sizeof(float));
}

void BlockSearch::start(const BlockNetwork& blocks, std::span<const double> X,
                        std::span<const double> u) {
  if (!active_) return;
  double extent = 0;
  for (std::size_t c = 0; c < X.size(); ++c)
    extent = std::fmax(extent, std::fabs(X[c]) + std::fabs(u[c]));
  std::fill(slack_.begin(), slack_.end(), 0.0F);
  for (std::size_t b = 0; b < margins_.size(); ++b) {
    margins_[b] = {};
    margins_[b].scale = scale_of(blocks.blocks[b]);
    margins_[b].extent = extent;
  }
  for (Worker& worker : workers_) worker.found.clear();
  started_ = true;
}

void BlockSearch::expect(const SearchBody& body, ThreadTeam& team) {
  if (!active_) return;
  started_ = false;
  while (static_cast<int>(workers_.size()) < team.size()) {
    workers_.emplace_back();
    const std::int64_t stride = body.dimension == 3 ? kStride<3> : kStride<2>;
    workers_.back().x.assign(at(stride * body.blocks.largest), 0.0);
    workers_.back().found.reserve(kReserve);
  }
  for (std::size_t b = 0; b < margins_.size(); ++b)
    waiting_[b] = 1 + static_cast<std::int32_t>(body.blocks.blocks[b].beside.size());
}

void BlockSearch::advanced(const SearchBody& body, const std::vector<VelocityBox>& boxes, double dt,
                           std::int64_t b, int worker) {
  if (!active_) return;
  const auto arrived = [&](std::int32_t other) {
    const std::size_t o = at(other);
    if (std::atomic_ref(waiting_[o]).fetch_sub(1, std::memory_order_acq_rel) != 1) return;
    widen(body.blocks, boxes, dt, o);
    if (margins_[o].used() >= margins_[o].least) look(body, o, workers_[at(worker)]);
  };
  for (const std::int32_t other : body.blocks.blocks[at(b)].beside) arrived(other);
  arrived(static_cast<std::int32_t>(b));
}

// What bonds of a block can have grown by in a step dt v.
void BlockSearch::widen(const BlockNetwork& blocks, const std::vector<VelocityBox>& boxes,
                        double dt, std::size_t b) {
  VelocityBox box = boxes[b];
  for (const std::int32_t other : blocks.blocks[b].beside)
    for (int k = 0; k < 3; ++k) {
      box.low[k] = std::fmin(box.low[k], boxes[at(other)].low[k]);
      box.high[k] = std::fmax(box.high[k], boxes[at(other)].high[k]);
    }
  double square = 0, speed = 0;
  for (int k = 0; k < 3; ++k) {
    const double range = box.high[k] - box.low[k];
    if (range > 0) square += range * range;
    speed = std::max({speed, std::fabs(box.low[k]), std::fabs(box.high[k])});
  }
  margins_[b].travel += dt * std::sqrt(square);
  margins_[b].extent += dt * speed;
  margins_[b].steps += 1;
}

// A step rounds u and x by a few units of their last place; 1e-14 of the coordinates is more than 40.
double BlockSearch::Margin::used() const {
  return travel * (1 + 1e-9) + 1e-14 * extent * (steps + 4);
}

template <int D>
void BlockSearch::find_in_row(const SearchBody& body, const Block& block, std::int32_t i,
                              Worker& worker) {
  const Network& network = body.network;
  const BlockNetwork& blocks = body.blocks;
  const std::int32_t place = place_of(block, i);
  const auto test = [&](const BlockBonds& bonds, std::int32_t b) {
    const std::int32_t p = bonds.end[at(b)], other = place_of(block, p);
    if (other < place) return;  // the other half's
    double square = 0;
    for (int k = 0; k < D; ++k) {
      const double d = worker.x[at(kStride<D> * p + k)] - worker.x[at(kStride<D> * i + k)];
      square += d * d;
    }
    if (static_cast<double>(bonds.square_limit[at(b)]) > square) return;
    const std::int32_t first = blocks.given[at(place)], second = blocks.given[at(other)];
    const std::int32_t bond = network.find_bond(first, second);
    const double limit = (1 + network.critical[bond]) * network.length(first, second);
    if (network.status[bond] == kIntact && square >= limit * limit) worker.found.push_back(bond);
  };
  for (const BlockBonds* bonds : {&block.twins, &block.halves})
    for (std::int32_t b = 0; b < bonds->count[at(i)]; ++b) test(*bonds, bonds->begin[at(i)] + b);
}

void BlockSearch::look(const SearchBody& body, std::size_t b, Worker& worker) {
  const Block& block = body.blocks.blocks[b];
  Margin& margin = margins_[b];
  float* slack = slack_.data() + block.first;
  const double used = margin.used();
  for (std::int32_t i = 0; i < block.own; ++i)
    slack[i] = static_cast<float>((slack[i] - used) * (1 - 1e-6));
  body.kernels.look[body.dimension - 2](
      {block.first, block.own, block.locals(), block.foreign.data(), rows_of(block.twins),
       rows_of(block.halves), block.twins.square_limit.data(), block.halves.square_limit.data(),
       margin.scale, body.X, body.u, worker.x.data(), slack});
  float least = std::numeric_limits<float>::infinity();
  for (std::int32_t i = 0; i < block.own; ++i) {
    least = std::min(least, slack[i]);
    if (slack[i] > 0) continue;
    body.dimension == 3 ? find_in_row<3>(body, block, i, worker)
                        : find_in_row<2>(body, block, i, worker);
  }
  margin.least = least;
  margin.travel = margin.steps = 0;
}

const std::vector<std::int32_t>& BlockSearch::find(const SearchBody& body, ThreadTeam& team) {
  broken_.clear();
  if (!active_) return broken_;
  if (started_) {
    expect(body, team);
    team.for_blocks(static_cast<std::int64_t>(margins_.size()),
                    [&](std::int64_t b, int worker) { look(body, at(b), workers_[at(worker)]); });
  }
  for (Worker& worker : workers_) {
    broken_.insert(broken_.end(), worker.found.begin(), worker.found.end());
    worker.found.clear();
  }
  std::sort(broken_.begin(), broken_.end());
  return broken_;
}

}  // namespace cleave::cbm
