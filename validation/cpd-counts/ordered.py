"""The forces of one-, two- and three-neighbour interactions with unit constants, and the constants that fit given forces.

Sums (14) to (16) of the paper over ordered sets, (16) with the bracket 1/|V| - 1/|v|; the neighbourhood has the volume
of its points.  All pairs of points are looked at: for small blocks only.  Nothing here is taken from the program.
"""
import numpy

FLAT = 1e-9                                      # of the horizon to the power of the dimension


def lengths(vectors):
    return numpy.sqrt((vectors**2).sum(axis=-1))


class Hood:
    """The ordered sets of one point as indices among its neighbours."""

    def __init__(self, X, i, near, horizon):
        self.points = numpy.flatnonzero(near[i])
        self.R = X[self.points] - X[i]
        mutual = near[numpy.ix_(self.points, self.points)]
        area = lengths(numpy.cross(self.R[:, None], self.R[None]))
        self.pairs = numpy.argwhere(mutual & (area > FLAT * horizon**2))
        j, k = numpy.nonzero(mutual)
        pair, l = numpy.nonzero(mutual[j] & mutual[k])
        triples = numpy.column_stack([j[pair], k[pair], l])
        self.triples = triples[abs(self.volume(self.R, triples)) > FLAT * horizon**3]

    @staticmethod
    def volume(r, sets):
        return numpy.einsum("ij,ij->i", numpy.cross(r[sets[:, 0]], r[sets[:, 1]]), r[sets[:, 2]])

    def forces(self, r):
        """The three sums with the vectors r to the neighbours now, over the numbers of sets."""
        L, now = lengths(self.R), lengths(r)
        one = ((1 / L - 1 / now)[:, None] * r).sum(axis=0) / len(L)
        j, k = self.pairs.T
        A, area = lengths(numpy.cross(self.R[j], self.R[k])), numpy.cross(r[j], r[k])
        two = 2 * numpy.cross(r[k], (1 / A - 1 / lengths(area))[:, None] * area).sum(axis=0) / max(1, len(j))
        V, v = self.volume(self.R, self.triples), self.volume(r, self.triples)
        faces = numpy.cross(r[self.triples[:, 1]], r[self.triples[:, 2]])
        three = 3 * (((1 / abs(V) - 1 / abs(v)) * v)[:, None] * faces).sum(axis=0) / max(1, len(V))
        return one, two, three


def unit_forces(X, u, horizon, volume):
    """Forces on all points for C1 = 1, for C2 = 1 and for C3 = 1."""
    distance = lengths(X[:, None] - X[None])
    near = (distance <= horizon * (1 + 1e-9)) & (distance > 0)
    forces = numpy.zeros((3, len(X), 3))
    for i in range(len(X)):
        hood = Hood(X, i, near, horizon)
        whole = volume * (1 + len(hood.points))
        for power, force in enumerate(hood.forces((X + u)[hood.points] - (X + u)[i]), 1):
            forces[power - 1, i] = volume * whole**power * force
    return forces


def constants(data, horizon, volume):
    """C1, C2, C3 that give the forces of the last frame best, and the forces they leave over all forces."""
    found = data.vector("internal_force").ravel()
    columns = unit_forces(data.points, data.displacement(), horizon, volume).reshape(3, -1)
    scale = numpy.linalg.norm(columns, axis=1)
    fitted = numpy.linalg.lstsq((columns / scale[:, None]).T, found, rcond=None)[0] / scale
    return fitted, numpy.linalg.norm(fitted @ columns - found) / numpy.linalg.norm(found)
