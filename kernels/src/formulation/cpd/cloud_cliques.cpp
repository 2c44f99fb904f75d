#include "formulation/cpd/cloud_cliques.hpp"

#include <algorithm>

#include "core/bisection.hpp"
#include "core/instruction_set.hpp"

CLEAVE_DECLARE_KERNELS(cleave_call::CliqueKernels, kCliqueKernels)

namespace cleave::cpd {

namespace {

constexpr std::int64_t kPoints = 128;  // of a block

}  // namespace

void CloudCliques::setup(const peridynamics::Neighbourhood& hood) {
  const std::int64_t blocks = std::max<std::int64_t>(1, hood.points / kPoints);
  Blocking cut = bisect(hood.X, hood.points, hood.dimension, blocks);
  order_ = std::move(cut.order);
  begin_ = std::move(cut.begin);
  const auto n = static_cast<std::size_t>(hood.points);
  rank_.resize(n);
  for (std::size_t k = 0; k < n; ++k)
    rank_[static_cast<std::size_t>(order_[k])] = static_cast<std::int32_t>(k);
  slot_begin_.assign(1, 0);
  slot_point_.clear();
  for (std::size_t b = 0; b + 1 < begin_.size(); ++b) {
    const auto first = slot_point_.size();
    for (std::int32_t k = begin_[b]; k < begin_[b + 1]; ++k) {
      const std::int32_t i = order_[static_cast<std::size_t>(k)];
      for (auto half = hood.first(i); half < hood.last(i); ++half) {
        const std::int32_t p = hood.neighbour(half);
        if (rank_[static_cast<std::size_t>(p)] >= begin_[b + 1]) slot_point_.push_back(p);
      }
    }
    const auto from = slot_point_.begin() + static_cast<std::ptrdiff_t>(first);
    std::sort(from, slot_point_.end());
    slot_point_.erase(std::unique(from, slot_point_.end()), slot_point_.end());
    slot_begin_.push_back(static_cast<std::int32_t>(slot_point_.size()));
  }
  slots_.assign(4 * slot_point_.size(), 0.0);
  incoming_begin_.assign(n + 1, 0);
  for (const std::int32_t p : slot_point_) ++incoming_begin_[static_cast<std::size_t>(p) + 1];
  for (std::size_t i = 0; i < n; ++i) incoming_begin_[i + 1] += incoming_begin_[i];
  incoming_.resize(slot_point_.size());
  std::vector<std::int32_t> next(incoming_begin_.begin(), incoming_begin_.end() - 1);
  for (std::size_t slot = 0; slot < slot_point_.size(); ++slot) {
    incoming_[static_cast<std::size_t>(next[static_cast<std::size_t>(slot_point_[slot])]++)] =
        static_cast<std::int32_t>(slot);
  }
}

void CloudCliques::sum_block(const peridynamics::Neighbourhood& hood,
                             const peridynamics::Damage& damage, const Task& task,
                             std::int32_t block, StarScratch& scratch, double* sums) {
  const auto b = static_cast<std::size_t>(block);
  const auto slots = slot_point_.begin() + slot_begin_[b],
             slots_end = slot_point_.begin() + slot_begin_[b + 1];
  std::fill(slots_.begin() + 4 * static_cast<std::ptrdiff_t>(slot_begin_[b]),
            slots_.begin() + 4 * static_cast<std::ptrdiff_t>(slot_begin_[b + 1]), 0.0);
  for (std::int32_t k = begin_[b]; k < begin_[b + 1]; ++k)
    std::fill_n(sums + 4 * static_cast<std::int64_t>(order_[static_cast<std::size_t>(k)]), 4, 0.0);
  const auto& kernels = CLEAVE_KERNELS(kCliqueKernels).chosen();
  for (std::int32_t k = begin_[b]; k < begin_[b + 1]; ++k) {
    const std::int32_t i = order_[static_cast<std::size_t>(k)];
    scratch.list.clear();
    for (auto half = hood.first(i); half < hood.last(i); ++half) {
      const std::int32_t p = hood.neighbour(half);
      if (rank_[static_cast<std::size_t>(p)] > k) scratch.list.push_back(p);
    }
    if (scratch.list.size() < 3) continue;
    scratch.lay(hood, i, scratch.list, task.x, nullptr, task.signed_volume);
    const Star& star = task.weight == nullptr
                           ? scratch.star()
                           : scratch.weigh(hood, damage, i, scratch.list, task.weight);
    double apex[4];
    kernels.cliques(star, apex);
    for (int c = 0; c < 4; ++c) sums[4 * static_cast<std::int64_t>(i) + c] += apex[c];
    auto slot = slots;  // the list ascends, and so do the slots
    for (std::size_t j = 0; j < scratch.list.size(); ++j) {
      const std::int32_t p = scratch.list[j];
      double* to = sums + 4 * static_cast<std::int64_t>(p);
      if (rank_[static_cast<std::size_t>(p)] >= begin_[b + 1]) {
        slot = std::lower_bound(slot, slots_end, p);
        to = slots_.data() + 4 * (slot - slot_point_.begin());
      }
      for (int d = 0; d < 3; ++d) to[d] += star.f[d][j];
      to[3] += star.e[j];
    }
  }
}

void CloudCliques::sum(const peridynamics::Neighbourhood& hood, const peridynamics::Damage& damage,
                       const Task& task, ThreadTeam& team, std::vector<StarScratch>& scratch,
                       double* sums) {
  team.for_blocks(static_cast<std::int64_t>(begin_.size()) - 1,
                  [&](std::int64_t block, int worker) {
                    sum_block(hood, damage, task, static_cast<std::int32_t>(block),
                              scratch[static_cast<std::size_t>(worker)], sums);
                  });
  for_blocks(team, hood.points, [&](std::int64_t, std::int64_t first, std::int64_t last) {
    for (std::int64_t i = first; i < last; ++i)
      for (auto k = incoming_begin_[static_cast<std::size_t>(i)];
           k < incoming_begin_[static_cast<std::size_t>(i) + 1]; ++k) {
        const double* from =
            slots_.data() + 4 * static_cast<std::int64_t>(incoming_[static_cast<std::size_t>(k)]);
        for (int c = 0; c < 4; ++c) sums[4 * i + c] += from[c];
      }
  });
}

std::int64_t CloudCliques::bytes() const {
  return static_cast<std::int64_t>((order_.capacity() + begin_.capacity() + rank_.capacity() +
                                    slot_point_.capacity() + slot_begin_.capacity() +
                                    incoming_.capacity() + incoming_begin_.capacity()) *
                                       sizeof(std::int32_t) +
                                   slots_.capacity() * sizeof(double));
}

}  // namespace cleave::cpd
