// J2 plasticity of metals at finite strain with a choice of hardening: the return mapping as a law of
// the tables. Isotropic, independent of the rate; not for shocks (no equation of state), not for
// cyclic loads that need kinematic hardening.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

#include "core/field.hpp"
#include "material/consistent_tangent.hpp"
#include "material/kinematics.hpp"
#include "material/plane_stress.hpp"
#include "material/table_hardening.hpp"

namespace cleave {

template <class Hardening>
class J2Plasticity {
  static constexpr std::array kElastic = {
      required_parameter("rho", "kg m-3", kPositive, "mass density in the reference configuration"),
      required_parameter("E", "Pa", kPositive, "Young's modulus"),
      required_parameter("nu", "1", Range{-1.0, 0.5, true, true}, "Poisson's ratio"),
  };
  static constexpr FieldSpec history_field(const char* name, int components, bool output,
                                           const char* description) {
    return {name,
            CLEAVE_RELATION_INTEGRATION_POINT,
            components,
            CLEAVE_REAL,
            "1",
            CLEAVE_LIFETIME_STATE,
            Exchange::none,
            output,
            "",
            description};
  }
  using Mapping = ReturnMapping<Hardening, LogarithmicBulk>;

 public:
  static constexpr auto kParameters = [] {
    std::array<ParameterSpec, kElastic.size() + Hardening::kParameters.size()> all{};
    std::copy(kElastic.begin(), kElastic.end(), all.begin());
    std::copy(Hardening::kParameters.begin(), Hardening::kParameters.end(),
              all.begin() + kElastic.size());
    return all;
  }();
  static constexpr std::array kHistory = {
      history_field("plastic_metric", 6, false,
                    "Cp^-1 - I of the plastic right Cauchy-Green tensor Cp: 11 22 33 12 23 31"),
      history_field("equivalent_plastic_strain", 1, true, "accumulated plastic strain eps_p"),
      history_field("thickness_strain", 1, false, "F33 - 1 in plane stress; else 0"),
  };
  static constexpr int kLaneHistory = 8;
  static constexpr bool kUsesLength = false;

  J2Plasticity(std::span<const double> p, Kinematics kinematics)
      : density_(p[0]),
        youngs_(p[1]),
        nu_(p[2]),
        kinematics_(kinematics),
        mapping_(p[1] / (2 * (1 + p[2])), Hardening(p.subspan(kElastic.size())),
                 LogarithmicBulk(p[1] / (3 * (1 - 2 * p[2])))) {}

  double density() const { return density_; }
  double youngs_modulus() const { return youngs_; }
  double shear_modulus() const { return mapping_.shear_modulus(); }
  double wave_speed() const {
    const double modulus = kinematics_ == CLEAVE_PLANE_STRESS
                               ? youngs_ / (1 - nu_ * nu_)
                               : youngs_ * (1 - nu_) / ((1 + nu_) * (1 - 2 * nu_));
    return std::sqrt(modulus / density_);
  }

  // Plane stress has an outer iteration and is done point by point.
  bool in_lanes() const { return kinematics_ != CLEAVE_PLANE_STRESS; }
  template <class R>
  void update(LanePoint<R, kLaneHistory>& point, const Setting<R>& setting) const {
    mapping_.update(point, setting);
  }

  template <int D>
  Response<Mat<D>> respond(const Mat<D>& h, const History& history,
                           const Increment& increment) const {
    LanePoint<double, kLaneHistory> point = read(h, history);
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
    return r;
  }

  // A_ijkl = dP_ij/dF_kl for the step from the committed history, which is left alone.
  template <int D>
  bool tangent(const Mat<D>& h, const History& committed, const Increment& increment,
               Tangent<D>& a) const {
    LanePoint<double, kLaneHistory> point = read(h, committed);
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
    return 1 + *history.variable[2];
  }

 private:
  template <int D>
  static LanePoint<double, kLaneHistory> read(const Mat<D>& h, const History& history) {
    LanePoint<double, kLaneHistory> point{};
    point.h = embed(h);
    std::copy(history.variable[0], history.variable[0] + 6, point.history.begin());
    point.history[6] = *history.variable[1];
    point.history[7] = *history.variable[2];
    return point;
  }
  static void write(const LanePoint<double, kLaneHistory>& point, const History& history) {
    std::copy(point.history.begin(), point.history.begin() + 6, history.variable[0]);
    *history.variable[1] = point.history[6];
    *history.variable[2] = point.history[7];
  }

  bool find_thickness(LanePoint<double, kLaneHistory>& point,
                      const Setting<double>& setting) const {
    double size = 0;  // a sum, no maximum: comparing a NaN would raise a flag
    for (const double x : {point.h.xx, point.h.xy, point.h.yx, point.h.yy}) size += std::fabs(x);
    for (std::size_t k = 0; k < 6; ++k) size += std::fabs(point.history[k]);
    double h33 = point.history[7];
    const auto trial = [&](double guess) {
      LanePoint<double, kLaneHistory> at = point;
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
    point.history[7] = h33;
    return true;
  }

  double density_, youngs_, nu_;
  Kinematics kinematics_;
  Mapping mapping_;
};

using J2Voce = J2Plasticity<VoceHardening>;
using J2Power = J2Plasticity<PowerHardening>;
using J2Table = J2Plasticity<TableHardening>;

}  // namespace cleave
