// A fluid under shock: the pressure of mie_gruneisen_bulk.hpp and nothing else. For water, air bubbles
// excepted, and for solids far above their strength. Carries no shear: a formulation in reference
// coordinates holds it together only as long as its shape stays near the initial one.
#pragma once

#include <array>
#include <span>

#include "core/symmetric.hpp"
#include "material/mie_gruneisen_bulk.hpp"

namespace cleave {

class MieGruneisen {
 public:
  static constexpr auto kParameters = kShockParameters;
  static constexpr auto kHistory = MieGruneisenBulk::kMemory;
  static constexpr int kLaneHistory = static_cast<int>(kHistory.size());
  static constexpr bool kUsesLength = true;

  // Throws UNSUPPORTED in plane stress.
  MieGruneisen(std::span<const double> p, Kinematics kinematics)
      : density_(p[0]),
        speed_(p[1]),
        kinematics_(kinematics),
        bulk_({p[0], p[1], p[2], p[3], p[4], p[5], p[6]}) {
    if (kinematics == CLEAVE_PLANE_STRESS) {
      throw Error(CLEAVE_UNSUPPORTED,
                  "law mie_gruneisen has no plane stress: a fluid sheet without pressure across "
                  "carries nothing; use plane_strain or 3d");
    }
  }

  double density() const { return density_; }
  double youngs_modulus() const { return 0; }
  double shear_modulus() const { return 0; }
  double wave_speed() const { return speed_; }
  double wave_speed_ratio(double, const History& history) const {
    return bulk_.wave_speed_ratio(read(history), 0.0);
  }

  bool in_lanes() const { return true; }
  template <class R>
  void update(LanePoint<R, kLaneHistory>& point, const Setting<R>& setting) const {
    refuse(point);
    const Cofactor<R> c = cofactor_of(point.h);
    const R ratio = 1.0 + c.volume_change;
    const Volume<R> volume{R(0.0), c.volume_change, ratio, R(0.0), R(0.0)};
    point.valid = point.valid & bulk_.admits(volume, point.history);
    const Spherical<R> spherical = bulk_.respond(volume, point.history, setting);
    const R scale = spherical.stress / ratio;
    const Full<R>& f = c.cofactor;
    point.p = {scale * f.xx, scale * f.xy, scale * f.xz, scale * f.yx, scale * f.yy,
               scale * f.yz, scale * f.zx, scale * f.zy, scale * f.zz};
    point.energy = spherical.energy;
    point.plastic = R(0.0);
    point.viscous = spherical.viscous;
  }

  template <int D>
  Response<Mat<D>> respond(const Mat<D>& h, const History& history,
                           const Increment& increment) const {
    LanePoint<double, kLaneHistory> point{};
    point.h = embed(h);
    point.history = read(history);
    update(point, Setting<double>{increment.dt, increment.length});
    Response<Mat<D>> r;
    r.valid = point.valid;
    if (!r.valid) return r;
    for (std::size_t k = 0; k < kHistory.size(); ++k) *history.variable[k] = point.history[k];
    r.stress = extract<D>(point.p);
    r.stress_33 = kinematics_ == CLEAVE_PLANE_STRAIN ? point.p.zz : 0.0;
    r.energy = point.energy;
    r.viscous = point.viscous;
    return r;
  }

  double thickness_stretch(const Mat<2>&, const History&) const { return 1.0; }

 private:
  static std::array<double, kLaneHistory> read(const History& history) {
    std::array<double, kLaneHistory> values;
    for (std::size_t k = 0; k < values.size(); ++k) values[k] = *history.variable[k];
    return values;
  }
  // Clears lanes that nothing may be computed with.
  template <class R>
  static void refuse(LanePoint<R, kLaneHistory>& point) {
    const Full<R>& h = point.h;
    R size = ((absolute(h.xx) + absolute(h.xy)) + (absolute(h.xz) + absolute(h.yx))) +
             ((absolute(h.yy) + absolute(h.yz)) + (absolute(h.zx) + absolute(h.zy))) +
             absolute(h.zz);
    for (const R& x : point.history) size = size + absolute(x);
    MaskOf<R> valid = is_finite(size);
    size = select(valid, size, R(0.0));
    valid = valid & (size < kLargestInput);
    point.h = select(valid, point.h, Full<R>{});
    valid = valid & (cofactor_of(point.h).volume_change > -1.0);
    point.h = select(valid, point.h, Full<R>{});
    for (R& x : point.history) x = select(valid, x, R(0.0));
    point.valid = valid;
  }

  double density_, speed_;
  Kinematics kinematics_;
  MieGruneisenBulk bulk_;
};

}  // namespace cleave
