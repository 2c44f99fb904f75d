// Options of the Continuum Bond Method that a body can set besides viscosity: fracture, hourglass
// stabilisation. A group none of whose parameters was set is off.
#pragma once

#include <array>

#include "core/parameter.hpp"
#include "formulation/common/viscosity.hpp"

namespace cleave::cbm {

enum class Criterion { none, bond_strain };
enum class GriffithRelation { dimension, paper1d };
enum class StabilisationForm { none, deviation, blend };

inline constexpr std::array kFractureParameters = {
    choice_parameter("criterion", "none|bond_strain", "bond_strain",
                     "bond_strain: a bond breaks when its elongation over its reference length "
                     "reaches the critical strain",
                     "[CBM 20]"),
    real_parameter(
        "critical_strain", "1", kNotNegative, 0.0,
        "critical bond strain; 0: from Gf and the length or, in peridynamics, the horizon",
        "[CBM 20]"),
    real_parameter("Gf", "J m-2", kNotNegative, 0.0,
                   "fracture energy: critical strain = sqrt(2 Gf / (E l)); 0: critical_strain is "
                   "given",
                   "[CBM 32]"),
    choice_parameter("length_mode", "constant|local", "constant",
                     "l in the critical strain: one length for all bonds, or each bond's own "
                     "reference length"),
    real_parameter("length", "m", kNotNegative, 0.0,
                   "l of length_mode constant: the spacing of the refined region", "[CBM 32]"),
    choice_parameter(
        "relation", "dimension|paper1d", "dimension",
        "peridynamics only, critical strain from Gf: dimension: the energy of all bonds "
        "across a crack in as many dimensions as the body has; paper1d: sqrt(3 Gf/(2 E "
        "horizon)) as published",
        "[PD critical]"),
};

inline constexpr std::array kStabilisationParameters = {
    choice_parameter("form", "none|deviation|blend", "deviation",
                     "deviation: energy of the difference between simplex and particle "
                     "deformation gradients, for any law; blend: part of the elastic energy is "
                     "taken on the simplices, for hyperelastic laws"),
    real_parameter("alpha", "1", Range{0.0, 1.0, false, false}, 0.05,
                   "strength; 0: the published method"),
};

}  // namespace cleave::cbm
