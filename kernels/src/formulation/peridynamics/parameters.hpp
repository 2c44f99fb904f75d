// Options of the peridynamic formulations besides fracture: the neighbourhood, and how the
// continuum-kinematics-based one weighs its interactions.
#pragma once

#include <array>
#include <limits>

#include "core/parameter.hpp"

namespace cleave::peridynamics {

enum class KeptModulus { exact, shear, bulk, young };
enum class Influence { inverse_distance, constant, cone };
enum class Interface { series, mean };
enum class Stencil { lattice, never };
enum class HoodVolume { sum, sphere };
enum class Calibration { paper, energy };
enum class ThreeNeighbour { paper, signed_volume };
enum class Weights { paper, conservative };
enum class Negative { refuse, allow };

inline constexpr double kFromMaterial = std::numeric_limits<double>::quiet_NaN();

inline constexpr std::array kPeridynamicsParameters = {
    real_parameter("horizon", "m", kNotNegative, 0.0,
                   "reach of the bonds, required; 3.015 times the spacing of a lattice is usual",
                   "[PD hood]"),
    choice_parameter("modulus", "exact|shear|bulk|young", "exact",
                     "bond_pd only: exact: Poisson's ratio must be that of bond-based "
                     "peridynamics; others: any ratio is taken and this modulus of the material "
                     "is kept",
                     "[PD bond]"),
    choice_parameter("influence", "inverse_distance|constant|cone", "inverse_distance",
                     "lps only: weight of a bond by its length", "[PD lps]"),
    real_parameter("section", "m2", kNotNegative, 0.0,
                   "area of the cross-section of a bar along x, kinematics plane_stress: the "
                   "one-dimensional constants are used and volumes are in m3; 0: no bar"),
    choice_parameter("interface", "series|mean", "series",
                     "bond_pd only: constant of a bond between two materials: that of two "
                     "springs in series (harmonic mean), or the arithmetic mean",
                     "[PD interface]"),
    real_parameter("interface_strain", "1", kNotNegative, 0.0,
                   "critical stretch of bonds between two materials; 0: the smaller of the two",
                   "[PD interface]"),
    choice_parameter("stencil", "lattice|never", "lattice",
                     "bond_pd and cpd; lattice: points within 1e-6 spacings of a square or cubic "
                     "lattice share one list of interactions, which is faster, never: they are "
                     "treated as any cloud; same forces but for rounding",
                     "[PD lattice]"),
};

inline constexpr std::array kCpdParameters = {
    choice_parameter(
        "hood_volume", "sum|sphere", "sum",
        "volume of a neighbourhood; sum: of its points; sphere: of the ball, times the "
        "share of its lattice points that are there (lattices only)",
        "[PD hood]"),
    choice_parameter("c3_calibration", "paper|energy", "paper",
                     "paper: the published constants C2 and C3; energy: one factor that makes the "
                     "energy of a full neighbourhood that of the material",
                     "[PD calibration]"),
    choice_parameter("three_nbr", "paper|signed", "paper",
                     "paper: an inverted tetrahedron is pushed further; signed: it is pushed back",
                     "[PD three]"),
    choice_parameter("weights", "paper|conservative", "paper",
                     "paper: each point weighs its interactions by its own volumes; conservative: "
                     "all points of an interaction share one weight, so that momentum is kept",
                     "[PD weights]"),
    choice_parameter(
        "negative_constants", "refuse|allow", "refuse",
        "C2 or C3 below zero (Poisson's ratio below 1/4) take energy away; allow: as in "
        "the paper"),
    real_parameter("C1", "1", Range{}, kFromMaterial,
                   "constant of one-neighbour interactions; default: from the material",
                   "[PD constants]"),
    real_parameter("C2", "1", Range{}, kFromMaterial,
                   "constant of two-neighbour interactions; default: from the material",
                   "[PD constants]"),
    real_parameter("C3", "1", Range{}, kFromMaterial,
                   "constant of three-neighbour interactions; default: from the material",
                   "[PD constants]"),
};

}  // namespace cleave::peridynamics
