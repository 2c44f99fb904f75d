// Finite-strain plasticity of metals in logarithmic strain and Kirchhoff stress, with a hardening and
// a volumetric law as parts: multiplicative split F = Fe Fp, Hencky elasticity of Be = Fe Fe^T, von
// Mises yield, radial return exact for any size of step. Batched without eigenvectors.
//
// History: Z = Cp^-1 - I and the equivalent plastic strain. With H = F - I and Z instead of F and
// Cp^-1 a strain of 1e-12 keeps its digits. Rigid rotation between steps costs no accuracy.
//
//   Be* - I = Y = F (I+Z) F^T - I ,  d = dev ln(I+Y) = 2 dev eps* ,  t = tr ln(I+Y) / 2
//   teq* = G sqrt(3/2 d:d) ,  phi* = teq* - tau_y(eps_p)
//   phi* <= 0: theta = 1; else 3 G dg + h(eps_p + dg) - h(eps_p) = phi* and theta = tau_y / teq*
//   tau = tau_m I + theta G d ,  P = tau F^-T
//   Z += F^-1 Be* (exp(-(1-theta) d) - I) F^-T ,  eps_p += dg
#pragma once

#include <cmath>
#include <span>

#include "core/tensor_functions.hpp"
#include "material/hardening.hpp"
#include "material/lane_point.hpp"

namespace cleave {

// Outside these a point is refused. Everything is dimensionless.
inline constexpr double kLargestLogStretch = 20;  // of ln b_a, an eigenvalue of Be*
inline constexpr double kLargestInput = 1e30;  // of |H| + |Z| + eps_p: products stay representable
inline constexpr int kReturnIterations = 50;
// Relative to phi* and to the increment: a few units of the last place.
inline constexpr double kReturnResidual = 4e-15, kReturnBracket = 4e-16, kStepResidual = 4e-16;

// What a volumetric law sees.
template <class R>
struct Volume {
  R log_ratio;                         // t = ln J (+ 1/2 ln det Cp^-1, which is round-off)
  R change;                            // J - 1
  R ratio;                             // J
  R shear_energy;                      // stored in the deviator at the end of the step [J m-3]
  R plastic;                           // work of the plastic flow in the step [J m-3]
  MaskOf<R> failed = R(0.0) > R(0.0);  // carries no tension any more
};
template <class R>
struct Spherical {
  R stress;         // tau_m = tr(tau)/3 [Pa]
  R energy;         // stored in the volume [J m-3]
  R viscous{0.0};   // dissipated in the step [J m-3]
  R released{0.0};  // dissipated in the step because the point has failed [J m-3]
};

// tau_m = kappa t.
class LogarithmicBulk {
 public:
  static constexpr std::array<FieldSpec, 0> kMemory{};
  static constexpr bool kBounded = false;       // whether admits() has to be asked
  static constexpr bool kFollowsVolume = true;  // tau_m depends on J and not on what else happens
  static constexpr bool kStiffens = false;      // whether it has a wave_speed_ratio
  static constexpr bool kUsesLength = false;
  explicit LogarithmicBulk(double kappa) : kappa_(kappa) {}
  template <class R, class M>
  Spherical<R> respond(const Volume<R>& v, M&, const Setting<R>&) const {
    const R stress = kappa_ * v.log_ratio;
    return {stress, 0.5 * (stress * v.log_ratio)};
  }
  // d tau_m / d ln J
  template <class M>
  double modulus(const Volume<double>&, const M&, const Setting<double>&) const {
    return kappa_;
  }

 private:
  double kappa_;
};

// The kernel of the law, in three dimensions.
template <class Hardening, class Bulk>
class ReturnMapping {
 public:
  static constexpr int kHardeningMemory = static_cast<int>(Hardening::kMemory.size());
  static constexpr int kBulkMemory = static_cast<int>(Bulk::kMemory.size());
  // Z (11 22 33 12 23 31), eps_p, memory of the hardening, memory of the bulk.
  static constexpr int kHistory = 7 + kHardeningMemory + kBulkMemory;

  ReturnMapping(double shear_modulus, const Hardening& hardening, const Bulk& bulk)
      : shear_(shear_modulus),
        inverse_shear_(1 / shear_modulus),
        bracket_((1 + 1e-15) / (3 * shear_ + std::min(0.0, hardening.least_slope()))),
        hardening_(hardening),
        bulk_(bulk) {
    if (!(hardening.least_slope() > -3 * shear_)) {
      throw Error(
          CLEAVE_BAD_ARGUMENT,
          text("the yield stress falls by ", -hardening.least_slope(),
               " per plastic strain, which no return mapping can follow; allowed: less than "
               "3 G = ",
               3 * shear_, "; soften more slowly"));
    }
  }

  // The history array may be longer than kHistory; what follows is left alone.
  template <class R, int kComponents>
  CLEAVE_INLINE void update(LanePoint<R, kComponents>& point, const Setting<R>& setting) const {
    const Cofactor<R> c = admit(point);
    auto& history = point.history;
    point.unchanged = kHistory == 7;
    const Symmetric<R> z = metric(history);
    const R ratio = 1.0 + c.volume_change, inverse = 1.0 / ratio;
    Setting<R> here = setting;
    here.volume_ratio = ratio;
    const Symmetric<R> y = push_forward_minus_identity(point.h, z);
    Symmetric<R> d = log_of(y, c.volume_change, kLargestLogStretch, point.valid);
    const R twice_t = trace(d);
    d = plus_spherical(d, twice_t * (-1.0 / 3));
    const R dd = squared_norm(d);

    R theta(1.0);
    point.plastic = R(0.0);
    std::array<R, kHardeningMemory> memory = part<0>(history);
    const R strain = history[6];
    R bound = hardening_.lower_bound(strain, memory);
    if constexpr (Hardening::kCauchy) bound = bound * ratio;
    Flowing<R> flow{};
    // Squares, relative to the modulus, spare the root where nothing flows; kBelow: their rounding.
    const R ratio_of_bound = (kBelow * inverse_shear_) * bound;
    if (any(1.5 * dd > ratio_of_bound * ratio_of_bound)) {
      flow = flow_of(strain, memory, here, shear_ * square_root(1.5 * dd));
      if (any(flow.active)) advance_metric(point, flow, c, y, d);
      theta = flow.theta;
    }
    const R shear_energy = (0.25 * shear_) * (theta * theta * dd);
    std::array<R, kBulkMemory> bulk_memory = part<1>(history);
    Volume<R> volume{0.5 * twice_t, c.volume_change, ratio, shear_energy, point.plastic};
    if constexpr (Hardening::kFails) volume.failed = hardening_.failed(memory);
    if constexpr (Bulk::kBounded) point.valid = point.valid & bulk_.admits(volume, bulk_memory);
    const Spherical<R> spherical = bulk_.respond(volume, bulk_memory, here);
    const Symmetric<R> tau = plus_spherical(scaled(theta * shear_, d), spherical.stress);
    point.p = multiply(scaled(inverse, tau), c.cofactor);
    point.energy = spherical.energy + shear_energy;
    point.plastic = point.plastic + spherical.released;
    point.viscous = spherical.viscous;
    if constexpr (kHardeningMemory > 0)
      finish(flow, Flow<R>{flow.work, spherical.stress, flow.yield, ratio, shear_energy}, memory);
    set_part<0>(history, memory);
    set_part<1>(history, bulk_memory);
  }

  // Z, eps_p and the work of a step in which some lanes flow.
  template <class R, int kComponents, class F>
  CLEAVE_INLINE static void advance_metric(LanePoint<R, kComponents>& point, const F& flow,
                                           const Cofactor<R>& c, const Symmetric<R>& y,
                                           const Symmetric<R>& d) {
    auto& history = point.history;
    point.valid = point.valid & flow.converged;
    point.plastic = flow.work;
    point.unchanged = false;
    history[6] = select(flow.active, history[6] + flow.increment, history[6]);
    const Symmetric<R> e = expm1_of_deviator(scaled(-flow.removed, d));
    const R inverse = 1.0 / (1.0 + c.volume_change);
    const Symmetric<R> change =
        scaled(inverse * inverse, pull_back(c.cofactor, e + commuting_product(y, e)));
    const Symmetric<R> z = metric(history);
    set_metric(history, select(flow.active, z + change, z));
  }

  double shear_modulus() const { return shear_; }
  const Hardening& hardening() const { return hardening_; }
  const Bulk& bulk() const { return bulk_; }

  // Radial return of a trial equivalent stress; lanes that do not yield have theta = 1.
  template <class R>
  struct Flowing {
    MaskOf<R> active = R(0.0) > R(0.0), converged = active;
    R increment{0.0};            // dg
    R theta{1.0}, removed{0.0};  // removed = 1 - theta, without its cancellation
    R work{0.0}, yield{0.0}, slope{0.0};
    typename Hardening::template Start<R> start;
  };
  template <class R, class M>
  CLEAVE_INLINE Flowing<R> flow_of(const R& strain, const M& memory, const Setting<R>& setting,
                                   const R& equivalent) const {
    Flowing<R> f;
    f.start = hardening_.start(strain, memory, setting);
    const R excess = equivalent - f.start.yield;
    f.active = excess > 0.0;
    f.converged = !f.active;
    if (!any(f.active)) return f;
    const R phi = select(f.active, excess, R(0.0)), safe = select(f.active, equivalent, R(1.0));
    R rise;
    solve(phi, f, rise);
    f.yield = f.start.yield + rise;
    const R inverse = 1.0 / safe;
    f.theta = select(f.active, f.yield * inverse, R(1.0));
    f.removed = select(f.active, (3 * shear_) * f.increment * inverse, R(0.0));
    f.work = select(f.active, hardening_.work(f.start, f.increment, rise), R(0.0));
    return f;
  }

 private:
  // Sets `valid`, and clears lanes that nothing may be computed with, so that no operation traps.
  template <class R, int kComponents>
  CLEAVE_INLINE static Cofactor<R> admit(LanePoint<R, kComponents>& point) {
    point.valid = R(0.0) <= R(0.0);
    if (!plain(point)) refuse_extreme(point);
    return upright_cofactor(point.h, point.valid);
  }
  // Whether all is small and of the right sign in all lanes: the common case, found without arithmetic.
  template <class R, int kComponents>
  CLEAVE_INLINE static bool plain(const LanePoint<R, kComponents>& point) {
    const R joined = join_bits(join_bits(point.h), join_bits(metric(point.history)));
    const R strain = point.history[6];
    if (any_reaches_two(join_bits(joined, strain)) || any_negative(strain)) return false;
    if constexpr (kHistory == 7) return true;
    R others(0.0);
    for (std::size_t k = 7; k < kHistory; ++k) others = others + absolute(point.history[k]);
    return all(is_finite(others)) && all(others < 0.5 * kLargestInput);
  }
  template <class R, int kComponents>
  [[gnu::noinline]] static void refuse_extreme(LanePoint<R, kComponents>& point) {
    R size = sum_of_sizes(point.h);
    for (std::size_t k = 0; k < kHistory; ++k) size = size + absolute(point.history[k]);
    point.valid = is_finite(size);
    if (!all(point.valid)) {
      clear(point, point.valid);
      size = select(point.valid, size, R(0.0));
    }
    point.valid = point.valid & (point.history[6] >= 0.0) & (size < kLargestInput);
    if (!all(point.valid)) clear(point, point.valid);
  }
  template <class R, int kComponents>
  [[gnu::noinline, gnu::cold]] static void clear(LanePoint<R, kComponents>& point,
                                                 const MaskOf<R>& keep) {
    point.h = select(keep, point.h, Full<R>{});
    for (std::size_t k = 0; k < kHistory; ++k)
      point.history[k] = select(keep, point.history[k], R(0.0));
  }

  // r(x) = phi* - 3 G x - (h(e+x) - h(e)) = 0 inside a bracket, by Newton's method, for smooth h by
  // Halley's. A lane stops for itself: at a residual or step of the size of round-off, or (smooth h) when
  // the step now taken leaves a residual of that size, which needs no other evaluation.
  template <class R>
  CLEAVE_INLINE void solve(const R& phi, Flowing<R>& f, R& rise) const {
    const double three_g = 3 * shear_;
    R low(0.0), high = phi * bracket_;
    R x = smaller(hardening_.first_guess(f.start, phi, three_g), high);
    rise = R(0.0);
    for (int n = 0;; ++n) {
      R rise_here, slope_here;
      hardening_.advance(f.start, x, rise_here, slope_here);
      rise = select(f.converged, rise, rise_here);
      f.slope = select(f.converged, f.slope, slope_here);
      const R r = (phi - three_g * x) - rise;
      const R inverse = 1.0 / (three_g + f.slope);
      R step = r * inverse;
      if constexpr (Hardening::kSmooth) {
        const R bend = hardening_.bend(f.start, x, f.slope), size = absolute(step);
        // What terms of third order leave of r: of the series of h, and of that of the step.
        const R cubic = hardening_.third(f.start) * (1.0 / 6) + 0.5 * (bend * bend) * inverse;
        step = step - 0.5 * (bend * inverse) * (step * step);
        const MaskOf<R> last = (cubic * (size * size * size) <= kStepResidual * phi) & !f.converged;
        rise = select(last, rise + step * (f.slope + 0.5 * bend * step), rise);
        f.slope = select(last, f.slope + bend * step, f.slope);
        x = select(last, x + step, x);
        f.converged = f.converged | last;
        if (all(f.converged)) break;
      }
      const MaskOf<R> too_small = r > 0.0;
      low = select(too_small & !f.converged, x, low);
      high = select(too_small | f.converged, high, x);
      R next = x + step;
      f.converged = f.converged | (absolute(r) <= kReturnResidual * phi) |
                    (absolute(step) <= kReturnBracket * x) | (high - low <= kReturnBracket * x);
      if (all(f.converged) || n == kReturnIterations) break;
      next = select((next > low) & (next < high), next, 0.5 * (low + high));
      x = select(f.converged, x, next);
    }
    f.increment = x;
  }

  template <class R>
  void finish(const Flowing<R>& f, const Flow<R>& flow,
              std::array<R, kHardeningMemory>& memory) const {
    if (!any(f.active)) return;
    const auto before = memory;
    hardening_.finish(f.start, f.increment, flow, memory);
    for (std::size_t k = 0; k < memory.size(); ++k)
      memory[k] = select(f.active, memory[k], before[k]);
  }

  template <int kPart, class A>
  static auto part(const A& history) {
    using R = typename A::value_type;
    constexpr std::size_t begin = kPart == 0 ? 7 : 7 + kHardeningMemory;
    std::array<R, kPart == 0 ? kHardeningMemory : kBulkMemory> memory{};
    for (std::size_t k = 0; k < memory.size(); ++k) memory[k] = history[begin + k];
    return memory;
  }
  template <int kPart, class A, class M>
  static void set_part(A& history, const M& memory) {
    constexpr std::size_t begin = kPart == 0 ? 7 : 7 + kHardeningMemory;
    for (std::size_t k = 0; k < memory.size(); ++k) history[begin + k] = memory[k];
  }

 public:
  template <class A>
  static Symmetric<typename A::value_type> metric(const A& v) {
    return {v[0], v[1], v[2], v[3], v[4], v[5]};
  }

 private:
  template <class A, class R>
  static void set_metric(A& v, const Symmetric<R>& z) {
    v[0] = z.xx;
    v[1] = z.yy;
    v[2] = z.zz;
    v[3] = z.xy;
    v[4] = z.yz;
    v[5] = z.zx;
  }

  static constexpr double kBelow = 1 - 1e-12;
  double shear_, inverse_shear_;
  double bracket_;  // the root is below this times phi*
  Hardening hardening_;
  Bulk bulk_;
};

}  // namespace cleave
