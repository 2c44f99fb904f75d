// Metals under impact: strength and failure of Johnson and Cook, with linear volumetric elasticity or
// with an equation of state. The first for moderate pressures (below a tenth of the bulk modulus);
// neither for brittle materials.
#pragma once

#include "material/j2.hpp"
#include "material/johnson_cook_hardening.hpp"
#include "material/mie_gruneisen_bulk.hpp"

namespace cleave {

// tau_m = kappa ln J, and no tension where the point has failed.
class FailingBulk : public LogarithmicBulk {
 public:
  static constexpr std::array kMemory = {
      point_history("volumetric_energy", 1, "J m-3", false, "stored by the change of volume"),
  };
  using LogarithmicBulk::LogarithmicBulk;

  template <class R, class M>
  Spherical<R> respond(const Volume<R>& v, M& memory, const Setting<R>& setting) const {
    Spherical<R> out = LogarithmicBulk::respond(v, memory, setting);
    const MaskOf<R> torn = v.failed & (v.log_ratio > 0.0);
    out.released = select(torn, memory[0], R(0.0));
    out.stress = select(torn, R(0.0), out.stress);
    out.energy = select(torn, R(0.0), out.energy);
    memory[0] = out.energy;
    return out;
  }
  template <class M>
  double modulus(const Volume<double>& v, const M& memory, const Setting<double>& setting) const {
    return v.failed && v.log_ratio > 0 ? 0.0 : LogarithmicBulk::modulus(v, memory, setting);
  }
};

using JohnsonCook = LogStrainLaw<JohnsonCookHardening, HenckyElasticity<FailingBulk>>;
using JohnsonCookEos = LogStrainLaw<JohnsonCookHardening, MieGruneisenElasticity>;

}  // namespace cleave
