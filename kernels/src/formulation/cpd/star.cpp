#include "formulation/cpd/star.hpp"

#include <algorithm>

#include "core/instruction_set.hpp"

CLEAVE_DECLARE_KERNELS(cleave_call::CliqueKernels, kCliqueKernels)

namespace cleave::cpd {

namespace {

enum Array {
  kX = 0,
  kNow = 3,
  kRelativeX = 6,
  kRelative = 9,
  kForce = 12,
  kVelocity = 15,
  kEnergy = 18,
  kWeight,
  kCarries,
  kArrays
};
constexpr std::int32_t kSpare = 8;

}  // namespace

void StarScratch::expect(std::int32_t most) {
  // A multiple of a register, and one more.
  const std::size_t stride = (static_cast<std::size_t>(most) / 8 + 2) * 8;
  if (stride <= stride_) return;
  stride_ = stride;
  reals_.assign(stride_ * kArrays, 0.0);
  const std::size_t words = stride_ / 64 + 1;
  adjacent_.assign(words * stride_ + 1, 0);
  carrying_.assign(words * stride_ + 1, 0);
  rows_.assign(4 * 8 * stride_, 0.0);
  list.reserve(stride_);
}

const Star& StarScratch::lay(const peridynamics::Neighbourhood& hood, std::int64_t apex,
                             std::span<const std::int32_t> points, const double* x, const double* v,
                             bool signed_volume) {
  Star& s = star_;
  s = {};
  s.count = static_cast<std::int32_t>(points.size());
  s.words = s.count / 64 + 1;
  for (int d = 0; d < 3; ++d) {
    double *X = array(kX + d), *now = array(kNow + d), *velocity = array(kVelocity + d);
    for (std::size_t k = 0; k < points.size(); ++k) {
      const std::int64_t c = kVector * points[k] + d;
      X[k] = hood.X[c];
      now[k] = x[c];
      if (v != nullptr) velocity[k] = v[c] - v[kVector * apex + d];
    }
    s.X[d] = X;
    s.x[d] = now;
    s.velocity[d] = velocity;
    s.apex_X[d] = hood.X[kVector * apex + d];
    s.apex_x[d] = x[kVector * apex + d];
    s.C[d] = array(kRelativeX + d);
    s.c[d] = array(kRelative + d);
    s.f[d] = array(kForce + d);
    // Lanes beyond the end are loaded, weighed with zero.
    std::fill_n(X + points.size(), kSpare, s.apex_X[d]);
    std::fill_n(now + points.size(), kSpare, s.apex_x[d]);
    std::fill_n(velocity + points.size(), kSpare, 0.0);
  }
  s.e = array(kEnergy);
  s.rows = rows_.data();
  s.adjacent = adjacent_.data();
  s.square_limit = hood.square_limit;
  s.flat = kFlat * hood.horizon * hood.horizon * hood.horizon;
  s.signed_volume = signed_volume;
  CLEAVE_KERNELS(kCliqueKernels).chosen().relate(s);
  return s;
}

const Star& StarScratch::weigh(const peridynamics::Neighbourhood& hood,
                               const peridynamics::Damage& damage, std::int64_t apex,
                               std::span<const std::int32_t> points, const double* weight) {
  Star& s = star_;
  double *w = array(kWeight), *carries = array(kCarries);
  const auto words = static_cast<std::size_t>(s.words);
  std::copy_n(adjacent_.begin(), words * points.size(), carrying_.begin());
  const bool apex_whole = damage.whole(apex);
  for (std::size_t j = 0; j < points.size(); ++j) {
    w[j] = weight[points[j]];
    carries[j] = apex_whole || damage.intact(hood.find_half(apex, points[j])) ? 1.0 : 0.0;
    if (damage.whole(points[j])) continue;
    for (std::size_t k = j + 1; k < points.size(); ++k) {
      std::uint64_t& word = carrying_[words * j + k / 64];
      const std::uint64_t one = std::uint64_t{1} << (k % 64);
      if ((word & one) != 0 && !damage.intact(hood.find_half(points[j], points[k]))) word &= ~one;
    }
  }
  std::fill_n(w + points.size(), kSpare, 0.0);
  std::fill_n(carries + points.size(), kSpare, 0.0);
  s.weight = w;
  s.apex_weight = weight[apex];
  s.carries = carries;
  s.carrying = carrying_.data();
  return s;
}

}  // namespace cleave::cpd
