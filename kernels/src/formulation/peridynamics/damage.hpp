// Which bonds of a peridynamic body carry: cut before the start, broken by stretch, latched. It finds the
// bonds that break and keeps bits for the kernels; what their breaking releases is not known here.
//                                                                                     [PD damage, 12, 13]
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "core/thread_team.hpp"
#include "formulation/peridynamics/neighbourhood.hpp"

namespace cleave::peridynamics {

enum Status : std::int32_t { kIntact = 0, kBroken = 1, kCut = 2 };

class Damage {
 public:
  // Limits of the materials of the body, and of bonds between two of them; 0: the smaller one.
  void setup(Body& body, const Neighbourhood& hood, std::vector<double> limits, double between);
  // Bits and counts from the field bond_status.
  void rebuild();

  bool active() const { return active_; }
  // Of a bond: the critical stretch, or what else its formulation measures.
  double limit(std::int64_t i, std::int64_t p) const;
  // Of the weakest bond of each point.
  const double* least_limits() const { return least_.data(); }
  bool intact(std::int32_t half) const { return bit(half); }
  std::int32_t intact_count(std::int64_t i) const { return intact_[static_cast<std::size_t>(i)]; }
  bool whole(std::int64_t i) const { return intact_count(i) == hood_->count(i); }
  // Whether the bond may break: neither end in a zone without failure, not both ends driven.
  bool may_break(std::int64_t i, std::int64_t p) const;
  const std::uint64_t* bits() const { return bits_.data(); }
  std::int32_t status(std::int64_t bond) const { return status_[bond]; }

  // found(i, half, severity) for the intact bonds whose severity(i, p) is beyond the limit and that may break,
  // in the order of bonds. `flag` (n) tells the points with a candidate among the bonds to higher neighbours.
  template <class F, class G>
  void find(const std::vector<char>& flag, const F& severity, const G& found) const {
    for (std::int64_t i = 0; i < hood_->points; ++i) {
      if (flag[static_cast<std::size_t>(i)] == 0) continue;
      for (std::int32_t half = hood_->upper(i); half < hood_->last(i); ++half) {
        const std::int32_t p = hood_->neighbour(half);
        if (!bit(half) || !may_break(i, p)) continue;
        const double s = severity(i, p);
        if (s > limit(i, p)) found(i, half, s);
      }
    }
  }
  void mark(std::int32_t bond, Status status);
  // Bonds of a status.
  std::int64_t count(Status status) const { return counts_[static_cast<std::size_t>(status)]; }
  std::int64_t bytes() const;

 private:
  bool bit(std::int32_t half) const {
    return ((bits_[static_cast<std::size_t>(half) >> 6] >> (half & 63)) & 1u) != 0;
  }
  void clear(std::int64_t i, std::int32_t half);

  const Neighbourhood* hood_ = nullptr;
  std::int32_t* status_ = nullptr;    // (bonds), the field
  std::vector<std::uint64_t> bits_;   // 1: the half-bond carries; one word more than needed
  std::vector<std::int32_t> intact_;  // (n) bonds that carry
  std::vector<char> shield_;  // (n) 1: in a zone without failure, 2: driven in every direction
  std::array<std::int64_t, 3> counts_{};  // by status
  const std::int32_t* region_ = nullptr;  // (n) of the body, or NULL: one material
  std::vector<double> limits_;            // of each material
  double between_ = 0;
  std::vector<double> least_;  // (n)
  bool active_ = false;
};

// (l - L)/L
double stretch(const Neighbourhood& hood, const double* x, std::int64_t i, std::int64_t p);

// A bond as it moves: n = x_ij/l, zero where l is; rate of l [m s-1].
struct BondMotion {
  double L = 0, l = 0, stretch = 0, rate = 0;
  Vec<3> direction;
};
BondMotion bond_motion(const Neighbourhood& hood, const Body& body, std::int64_t i, std::int64_t p);

}  // namespace cleave::peridynamics
