// Options of the volume-compensated particle model.
#pragma once

#include <array>

#include "core/parameter.hpp"

namespace cleave::vcpm {

enum class LatticeChoice { found, triangular, sc, fcc, bcc };
enum class Geometry { finite, linear };
enum class Surface { keep, extend };
enum class Criterion { force, strain, energy };
enum class SofteningLaw { none, linear, bilinear, exponential };

inline constexpr std::array kVcpmParameters = {
    choice_parameter("lattice", "found|triangular|sc|fcc|bcc", "found",
                     "lattice of the particles; found: triangular in the plane, in space by the "
                     "number of nearest neighbours",
                     "[VCPM lattices]"),
    choice_parameter("geometry", "finite|linear", "finite",
                     "elongation of a bond; finite: change of its length, free of rotation; "
                     "linear: displacements along its first direction, for small displacements",
                     "[VCPM bond]"),
    choice_parameter("surface", "keep|extend", "keep",
                     "volumetric strain of particles that have fewer bonds than the lattice; "
                     "keep: as published, surfaces are a little soft; extend: what is missing is "
                     "taken to be as what is there",
                     "[VCPM surface]"),
    choice_parameter("criterion", "force|strain|energy", "force",
                     "a bond breaks when this reaches its limit; force: of the bond; strain: its "
                     "elongation over its length; energy: half of force times elongation",
                     "[VCPM strength]"),
    real_parameter("strength", "Pa", kNotNegative, 0.0,
                   "tensile strength: critical force 2 R strength/sqrt(3) of the triangular "
                   "lattice, critical strain strength/E; 0: the limit itself is given, or bonds "
                   "do not break",
                   "[VCPM strength]"),
    real_parameter("limit", "1", kNotNegative, 0.0,
                   "limit of the criterion: force [N], strain [1] or energy [J]; in the plane of a "
                   "metre of thickness; 0: from strength or from group fracture, or bonds do not "
                   "break",
                   "[VCPM strength]"),
    choice_parameter("softening", "none|linear|bilinear|exponential", "none",
                     "how a bond gives way beyond the strain of its limit, criterion 'strain'; "
                     "none: at once",
                     "[VCPM softening]"),
    real_parameter("final_strain", "1", kNotNegative, 0.0,
                   "strain of a bond that carries nothing any more; exponential: where a linear "
                   "law of the same energy ends; 0: from softening_energy",
                   "[VCPM softening]"),
    real_parameter("kink_strain", "1", kNotNegative, 0.0, "bilinear: strain between the two lines",
                   "[VCPM softening]"),
    real_parameter("kink_force", "1", kNotNegative, 0.0,
                   "bilinear: force there over the largest force, > 0 and <= 1",
                   "[VCPM softening]"),
    real_parameter("softening_energy", "J m-2", kNotNegative, 0.0,
                   "instead of final_strain, triangular lattice: energy that the springs take for "
                   "a unit area of crack along a close-packed row",
                   "[VCPM toughness]"),
};

}  // namespace cleave::vcpm
