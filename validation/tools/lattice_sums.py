"""Elastic constants and toughness of peridynamic bonds on a square or cubic lattice: sums over the bonds of an inner point.

Lengths are in spacings, constants over the shear modulus for which the bond constant was made: 30 mu/(pi delta^4) in space,
24 mu/(pi delta^3) in the plane.  A ball of many points gives C11 = 3, C44 = 1 and toughness 1.  Bonds have the volumes of the
neighbours; where a formulation gives them others, multiply by the quotient.  Nothing here is taken from the program.
"""
import math

import numpy

CONSTANT = {2: 24, 3: 30}
# Gc over mu, horizon and the square of the critical stretch (cpd.md, section 6)
GRIFFITH = {2: 6 / math.pi, 3: 3.0}


def hood(reach, dimension=3):
    """Directions and lengths of the bonds of an inner point with a horizon of `reach` spacings."""
    line = numpy.arange(-int(reach) - 1, int(reach) + 2)
    R = numpy.stack(numpy.meshgrid(*[line] * dimension, indexing="ij"), -1).reshape(-1, dimension).astype(float)
    L = numpy.sqrt((R**2).sum(axis=1))
    inside = (L > 0) & (L <= reach * (1 + 1e-6))
    return R[inside] / L[inside, None], L[inside]


def number(reach, dimension=3):
    """Neighbours of an inner point."""
    return len(hood(reach, dimension)[1])


def bond_moduli(reach, dimension=3):
    """C11 and C44 = C12 of the bonds."""
    n, L = hood(reach, dimension)
    weight = CONSTANT[dimension] / (2 * math.pi * reach ** (dimension + 1)) * L
    return (weight * n[:, 0] ** 4).sum(), (weight * n[:, 0] ** 2 * n[:, 1] ** 2).sum()


def state_moduli(reach, kappa, dimension=3, influence=lambda L, reach: reach / L):
    """C11 and C44 of `lps`: the dilatation is exact, the deviatoric part has the directions of the lattice."""
    n, L = hood(reach, dimension)
    weight = influence(L, reach) * L**2
    weight *= dimension * (dimension + 2) / weight.sum()
    C11 = kappa + (weight * (n[:, 0] ** 2 - 1 / dimension) ** 2).sum()
    return C11, (weight * n[:, 0] ** 2 * n[:, 1] ** 2).sum()


def toughness(reach, dimension=3):
    """Energy of all bonds across a plane between two layers, at their critical stretch, over that of the continuum."""
    n, L = hood(reach, dimension)
    per_plane = (numpy.maximum(0, n[:, 1]) * L**2).sum() / 2
    return CONSTANT[dimension] / (math.pi * reach ** (dimension + 1)) * per_plane / (GRIFFITH[dimension] * reach)
