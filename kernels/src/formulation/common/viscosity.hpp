// Artificial viscosity of bonds in its three forms. All act on the rate of the bond
//   rate_ip = v_ip . x_ip / (|x_ip|^2 + 0.01 l^2),  positive when it extends             [CBM 22]
// through the pressure beta l rho0 c0 rate [CBM 21], which pulls separating ends together.
//
// Published with the opposite sign of the elastic force [CBM 23]; corrected here. It acts across
// every bond that still carries a simplex, never across an open crack.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>

#include "core/gradient_operator.hpp"
#include "core/parameter.hpp"

namespace cleave {

// Which l a bond uses, also in the critical strain.
enum class LengthMode { constant, local };
enum class ViscosityForm { none, frozen, central, paper };

inline constexpr std::array kViscosityParameters = {
    choice_parameter("form", "none|frozen|central|paper", "frozen",
                     "frozen: central force with reference bond weights, dissipates for any "
                     "motion; central: central force with deformed bond vectors, clipped; paper: "
                     "the published form with corrected sign, conserves no angular momentum",
                     "[CBM 23]"),
    real_parameter("beta", "1", kNotNegative, 0.5, "coefficient", "[CBM 21]"),
    choice_parameter("length_mode", "constant|local", "constant",
                     "l in the viscous pressure: one length for all bonds, or each bond's own "
                     "reference length"),
    real_parameter("length", "m", kNotNegative, 0.0,
                   "l of length_mode constant: the spacing of the refined region", "[CBM 21]"),
};

// Coefficient beta rho0 c0 [Pa s m-1] and the length l of a bond.
template <class Index>
struct BondRate {
  double beta_rho_c = 0;
  double length = 0;                    // constant l [m] ...
  const double* lengths = nullptr;      // ... or, if not NULL, l of every undirected bond
  const Index* bond_of_half = nullptr;  // needed with lengths

  double length_of(Index half) const {
    return lengths == nullptr ? length : lengths[bond_of_half[half]];
  }
};

// Force on i: + pressure (w_ip J_i + w_pi J_p) x_ip / |x_ip|^2, J clipped at 0. Central, so both
// momenta are exact; its power is never positive; needs no gradient of the other end.
// [in]     x, v   (3,n)  current position [m], velocity [m s-1]
// [in]     ratio  (n)    det F [1]
// [in]     w      (h)    bond weights [m3]
// [in,out] f      (3,n)  force [N], added to
template <int D, class Operator, class Index, class Positions, class Velocities, class Forces>
void viscous_force_frozen(const Operator& g, const BondRate<Index>& rate, const double* w,
                          const Positions& x, const Velocities& v, const double* ratio,
                          std::int64_t first, std::int64_t last, const Forces& f) {
  const auto clipped = [ratio](std::int64_t i) { return ratio[i] > 0 ? ratio[i] : 0.0; };
  for (std::int64_t i = first; i < last; ++i) {
    Vec<D> sum;
    for (auto b = g.begin(i); b < g.end(i); ++b) {
      const std::int64_t p = g.particle(b);
      const double weight = w[b] * clipped(i) + w[g.back(b)] * clipped(p);
      const Vec<D> xip = difference<D>(x, i, p);
      const double square = dot(xip, xip);
      if (!(weight > 0) || !(square > 0)) continue;  // no live simplex, or no direction
      const double l = rate.length_of(b);
      const double approach = dot(difference<D>(v, i, p), xip);
      const double scale =
          rate.beta_rho_c * l * approach * weight / ((square + 0.01 * l * l) * square);
      for (int k = 0; k < D; ++k) sum[k] += scale * xip[k];
    }
    add_vector(sum, f, i);
  }
}

// Force on i: + pressure g_ip with g_ip = J_i F_i^-T zeta_ip - J_p F_p^-T zeta_pi: form "paper",
// [CBM 23] with the right sign. Form "central" takes its clipped projection max(0, g_ip . n) n on
// the bond direction, for which the power of every pair is never positive. An end with J <= 0
// does not contribute.
// [in]     h      (9,n)  displacement gradient [1]; the rest as above
template <int D, bool Central>
void viscous_force_deformed(const GradientOperator& g, const BondRate<std::int32_t>& rate,
                            const double* x, const double* v, const double* h, const double* ratio,
                            std::int64_t first, std::int64_t last, double* f) {
  const auto area = [&](std::int64_t end, std::int32_t half) {
    if (!(ratio[end] > 0)) return Vec<D>{};
    return multiply(cofactor(plus_identity(load_tensor<D>(h, end))), load_vector<D>(g.zeta, half));
  };
  for (std::int64_t i = first; i < last; ++i) {
    Vec<D> sum;
    for (auto b = g.begin(i); b < g.end(i); ++b) {
      const std::int64_t p = g.particle(b);
      const Vec<D> xip = difference<D>(x, i, p);
      const double l = rate.length_of(b);
      const double square = dot(xip, xip);
      const double pressure =
          rate.beta_rho_c * l * dot(difference<D>(v, i, p), xip) / (square + 0.01 * l * l);
      const Vec<D> own = area(i, b), other = area(p, g.back(b));
      Vec<D> direction;
      for (int k = 0; k < D; ++k) direction[k] = own[k] - other[k];
      if constexpr (Central) {
        const double projected = square > 0 ? std::fmax(0.0, dot(direction, xip)) / square : 0.0;
        for (int k = 0; k < D; ++k) direction[k] = projected * xip[k];
      }
      for (int k = 0; k < D; ++k) sum[k] += pressure * direction[k];
    }
    add_vector(sum, f, i);
  }
}

// The arrays of a viscous force, as above. w: form frozen only.
struct ViscousArrays {
  const double *w, *x, *v, *h, *ratio;
  double* f;
};

// The force of the chosen form on first <= i < last.
template <int D>
void viscous_force(ViscosityForm form, const GradientOperator& g,
                   const BondRate<std::int32_t>& rate, const ViscousArrays& a, std::int64_t first,
                   std::int64_t last) {
  switch (form) {
    case ViscosityForm::none:
      break;
    case ViscosityForm::frozen:
      viscous_force_frozen<D>(g, rate, a.w, a.x, a.v, a.ratio, first, last, a.f);
      break;
    case ViscosityForm::central:
      viscous_force_deformed<D, true>(g, rate, a.x, a.v, a.h, a.ratio, first, last, a.f);
      break;
    case ViscosityForm::paper:
      viscous_force_deformed<D, false>(g, rate, a.x, a.v, a.h, a.ratio, first, last, a.f);
      break;
  }
}

}  // namespace cleave
