// Scratch of one worker in which the neighbours of a point are laid side by side for the kernels.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/aligned.hpp"
#include "core/blocks.hpp"
#include "formulation/cpd/clique_kernels.hpp"
#include "formulation/peridynamics/damage.hpp"

namespace cleave::cpd {

inline constexpr double kFlat = 1e-9;  // of horizon^3 and horizon^2: smaller sets are no sets

class StarScratch {
 public:
  // For stars of up to so many neighbours.
  void expect(std::int32_t most);

  // The points of the list around the apex, positions x [m]; velocities too if v is not NULL.
  const Star& lay(const peridynamics::Neighbourhood& hood, std::int64_t apex,
                  std::span<const std::int32_t> list, const double* x, const double* v,
                  bool signed_volume);
  // Weights of conservative sums for the star laid last. weight (n); bonds carry as `damage` says.
  const Star& weigh(const peridynamics::Neighbourhood& hood, const peridynamics::Damage& damage,
                    std::int64_t apex, std::span<const std::int32_t> list, const double* weight);

  const Star& star() const { return star_; }

  std::vector<std::int32_t> list;  // for callers that have none of their own

 private:
  double* array(int k) { return reals_.data() + static_cast<std::size_t>(k) * stride_; }

  Star star_{};
  std::size_t stride_ = 0;
  AlignedReals reals_;  // arrays of stride_ numbers
  AlignedReals rows_;   // four rows of eight for each neighbour
  std::vector<std::uint64_t> adjacent_, carrying_;
};

}  // namespace cleave::cpd
