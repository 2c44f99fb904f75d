// The return mapping of log_strain_plasticity.hpp as a law of the tables: properties, history, plane
// conditions, tangent. What it is made of comes from two parts: a hardening, and an elasticity that
// names the properties, the wave speeds and the volumetric law.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <type_traits>

#include "material/consistent_tangent.hpp"
#include "material/kinematics.hpp"
#include "material/plane_stress.hpp"
#include "material/point_history.hpp"

namespace cleave {

template <class Hardening, class Elasticity>
class LogStrainLaw {
  using Bulk = typename Elasticity::Bulk;
  using Mapping = ReturnMapping<Hardening, Bulk>;

 public:
  static constexpr auto kParameters = joined(Elasticity::kParameters, Hardening::kParameters);
  static constexpr auto kHistory = joined(
      std::array{
          point_history("plastic_metric", 6, "1", false,
                        "Cp^-1 - I of the plastic right Cauchy-Green tensor Cp: 11 22 33 12 23 31"),
          point_history("equivalent_plastic_strain", 1, "1", true,
                        "accumulated plastic strain eps_p"),
      },
      Hardening::kMemory, Bulk::kMemory,
      std::array{
          point_history("thickness_strain", 1, "1", false, "F33 - 1 in plane stress; else 0"),
      });
  static constexpr const char* kDamage = Hardening::kDamage;
  // Without the thickness strain, which is 0 in lanes.
  static constexpr int kLaneHistory = Mapping::kHistory;
  static constexpr bool kAnswersByState =
      Bulk::kFollowsVolume && std::is_base_of_v<RateIndependent, Hardening>;
  static constexpr bool kUsesLength = Bulk::kUsesLength;

  LogStrainLaw(std::span<const double> p, Kinematics kinematics)
      : elasticity_(p.first(Elasticity::kParameters.size())),
        kinematics_(kinematics),
        mapping_(elasticity_.shear_modulus(),
                 make_hardening(p.subspan(Elasticity::kParameters.size()), elasticity_.density()),
                 elasticity_.bulk()) {}

  double density() const { return elasticity_.density(); }
  double youngs_modulus() const { return elasticity_.youngs_modulus(); }
  double shear_modulus() const { return elasticity_.shear_modulus(); }
  double wave_speed() const {
    const double g = shear_modulus(), plane_wave = elasticity_.bulk_modulus() + 4 * g / 3;
    const double modulus =
        kinematics_ == CLEAVE_PLANE_STRESS ? 4 * g * (1 - g / plane_wave) : plane_wave;
    return std::sqrt(modulus / density());
  }
  // Speed of sound over that of the undeformed material, with what the law's own viscosity adds.
  double wave_speed_ratio(double, const History& history) const requires Bulk::kStiffens {
    std::array<double, Bulk::kMemory.size()> memory;
    for (std::size_t k = 0; k < memory.size(); ++k)
      memory[k] = *history.variable[2 + Hardening::kMemory.size() + k];
    return mapping_.bulk().wave_speed_ratio(memory, 4 * shear_modulus() / 3);
  }

  // Plane stress has an outer iteration and is done point by point.
  bool in_lanes() const { return kinematics_ != CLEAVE_PLANE_STRESS; }
  template <class R>
  CLEAVE_INLINE void update(LanePoint<R, kLaneHistory>& point, const Setting<R>& setting) const {
    mapping_.update(point, setting);
  }

  template <int D>
  Response<Mat<D>> respond(const Mat<D>& h, const History& history,
                           const Increment& increment) const {
    OnePoint point = read(h, history);
    const Setting<double> setting{increment.dt, increment.length};
    Response<Mat<D>> r;
    r.valid = in_lanes() || find_thickness(point, setting);
    if (!r.valid) return r;
    mapping_.update(point, setting);
    r.valid = point.valid;
    if (!r.valid) return r;
    write(point, history);
    r.stress = extract<D>(point.p);
    r.stress_33 = kinematics_ == CLEAVE_PLANE_STRAIN ? point.p.zz : 0.0;
    r.energy = point.energy;
    r.plastic = point.plastic;
    r.viscous = point.viscous;
    return r;
  }

  // A_ijkl = dP_ij/dF_kl for the step from the committed history, which is left alone.
  template <int D>
  bool tangent(const Mat<D>& h, const History& committed, const Increment& increment,
               Tangent<D>& a) const requires Bulk::kFollowsVolume {
    OnePoint point = read(h, committed);
    const Setting<double> setting{increment.dt, increment.length};
    if (!in_lanes() && !find_thickness(point, setting)) return false;
    SpectralModuli moduli;
    if (!moduli.evaluate(mapping_, point, setting)) return false;
    if constexpr (D == 3) {
      moduli.nominal(a);
    } else {
      Tangent<3> solid;
      moduli.nominal(solid);
      if (kinematics_ == CLEAVE_PLANE_STRESS) {
        condense(solid, a);
      } else {
        restrict_to_plane(solid, a);
      }
    }
    return true;
  }

  // F33 in two dimensions, after the update.
  double thickness_stretch(const Mat<2>&, const History& history) const {
    return 1 + *history.variable[kHistory.size() - 1];
  }

 private:
  using OnePoint = LanePoint<double, kLaneHistory + 1>;  // with the thickness strain

  static Hardening make_hardening(std::span<const double> p, double density) {
    if constexpr (std::is_constructible_v<Hardening, std::span<const double>, double>) {
      return Hardening(p, density);
    } else {
      return Hardening(p);
    }
  }

  template <class F>
  static void each_component(const History& history, const F& f) {
    std::size_t place = 0;
    for (std::size_t k = 0; k < kHistory.size(); ++k)
      for (int c = 0; c < kHistory[k].components; ++c) f(place++, history.variable[k][c]);
  }
  template <int D>
  static OnePoint read(const Mat<D>& h, const History& history) {
    OnePoint point{};
    point.h = embed(h);
    each_component(history, [&](std::size_t place, double x) { point.history[place] = x; });
    return point;
  }
  static void write(const OnePoint& point, const History& history) {
    each_component(history, [&](std::size_t place, double& x) { x = point.history[place]; });
  }

  bool find_thickness(OnePoint& point, const Setting<double>& setting) const {
    double size = 0;  // a sum, no maximum: comparing a NaN would raise a flag
    for (const double x : {point.h.xx, point.h.xy, point.h.yx, point.h.yy}) size += std::fabs(x);
    for (std::size_t k = 0; k < 6; ++k) size += std::fabs(point.history[k]);
    double& thickness = point.history[kLaneHistory];
    double h33 = thickness;
    const auto trial = [&](double guess) {
      OnePoint at = point;
      at.h.zz = guess;
      SpectralModuli moduli;
      ThicknessTrial t;
      t.valid = moduli.evaluate(mapping_, at, setting);
      if (t.valid) {
        t.p33 = moduli.stress_33();
        t.slope = moduli.through_thickness();
      }
      return t;
    };
    if (!is_finite(size) || !is_finite(h33) || !solve_thickness(trial, size, h33)) return false;
    point.h.zz = h33;
    thickness = h33;
    return true;
  }

  Elasticity elasticity_;
  Kinematics kinematics_;
  Mapping mapping_;
};

}  // namespace cleave
