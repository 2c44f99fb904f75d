// Options of the volume-compensated particle model.
#pragma once

#include <array>

#include "core/parameter.hpp"

namespace cleave::vcpm {

enum class LatticeChoice { found, triangular, sc, fcc, bcc };
enum class Geometry { finite, linear };
enum class Surface { keep, extend };
enum class Criterion { force, strain, energy };

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
};

}  // namespace cleave::vcpm
