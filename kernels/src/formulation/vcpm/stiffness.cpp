// The Hessian of the energy of all cells, part by part: each bond as a spring with what its force does when it
// turns, and each particle's volume as one matrix of rank one over it and its neighbours, which together are
// the published elements of ten particles.                                           [VCPM stiffness]
#include <cmath>
#include <vector>

#include "formulation/vcpm/vcpm.hpp"

namespace cleave::vcpm {

bool VolumeCompensatedParticles::holds(const Body&, std::int64_t i) const {
  return damage_.intact_count(i) > 0;
}

template <class Carries>
void VolumeCompensatedParticles::add_parts(const Body& body, const Carries& carries,
                                           StiffnessSink& sink) const {
  const int D = dimension_;
  const auto d = static_cast<std::size_t>(D);
  const double scale = lattice_.cell * modulus_;
  std::vector<double> matrix(4 * d * d), slope, volume;
  std::vector<std::int32_t> particles;
  for (std::int64_t i = 0; i < hood_.points; ++i) {
    particles.assign(1, static_cast<std::int32_t>(i));
    slope.assign(d, 0.0);  // of theta_i with the displacements
    for (auto half = hood_.first(i); half < hood_.last(i); ++half) {
      if (!carries(half)) continue;
      const std::int32_t p = hood_.neighbour(half);
      const Bond b = bond(body, i, p, half);
      const double share =
          b.integrity * 0.5 * factor_[static_cast<std::size_t>(i)] * b.shell->weight;
      for (int k = 0; k < D; ++k) slope[static_cast<std::size_t>(k)] -= share * b.direction[k];
      for (int k = 0; k < D; ++k) slope.push_back(share * b.direction[k]);
      particles.push_back(p);
      if (p < i) continue;
      const double stiff = b.integrity * 0.5 * b.shell->stiffness;
      const double length = hood_.length(i, p) + b.elongation;
      const double turn =
          geometry_ == Geometry::finite && length > 0 ? force(b, i, p) / length : 0.0;
      for (std::size_t r = 0; r < 2 * d; ++r)
        for (std::size_t c = 0; c < 2 * d; ++c) {
          const int j = static_cast<int>(r % d), k = static_cast<int>(c % d);
          const double nn = b.direction[j] * b.direction[k];
          const double value = stiff * nn + turn * ((j == k ? 1 : 0) - nn);
          matrix[2 * d * r + c] = (r < d) == (c < d) ? value : -value;
        }
      const std::int32_t ends[2] = {static_cast<std::int32_t>(i), p};
      sink.add(ends, matrix.data());
    }
    if (scale == 0) continue;  // nu = 1/4: springs alone
    const std::size_t size = slope.size();
    volume.resize(size * size);
    for (std::size_t r = 0; r < size; ++r)
      for (std::size_t c = 0; c < size; ++c) volume[size * r + c] = scale * slope[r] * slope[c];
    sink.add(particles, volume.data());
  }
}

void VolumeCompensatedParticles::add_stiffness(const Body& body, StiffnessSink& sink) const {
  add_parts(
      body, [this](std::int32_t half) { return damage_.intact(half); }, sink);
}

void VolumeCompensatedParticles::add_stiffness_after(const Body& body, std::int64_t broken,
                                                     StiffnessSink& sink) const {
  std::vector<char> carries(static_cast<std::size_t>(hood_.half_bonds()));
  hood_.for_bonds(0, hood_.bonds(),
                  [&](std::int32_t bond, std::int64_t i, std::int32_t p, std::int32_t half) {
                    if (!carried(bond, broken)) return;
                    carries[static_cast<std::size_t>(half)] = 1;
                    carries[static_cast<std::size_t>(hood_.find_half(p, i))] = 1;
                  });
  add_parts(
      body, [&](std::int32_t half) { return carries[static_cast<std::size_t>(half)] != 0; }, sink);
}

}  // namespace cleave::vcpm
