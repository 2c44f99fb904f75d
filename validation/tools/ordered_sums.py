"""Forces of the peridynamic formulations as their papers print them: ordered sums over all pairs of points, damage included.

Continuum-kinematics-based: (14) to (16) with constants of one, (16) with the bracket 1/|V| - 1/|v|; the failure of pairs and triples
by (12) and (13) at each point.  State-based: forces from the energy of Silling et al. 2007.  All points are looked at, so
for small bodies only.  Nothing here is taken from the program.  Points of the plane have z = 0.
"""
import numpy

FLAT = 1e-9                                      # of the horizon to the power of the dimension


def lengths(vectors):
    return numpy.sqrt((vectors**2).sum(axis=-1))


class Cloud:
    """Points X with volumes, now at x; `intact` is a symmetric matrix of bonds that carry, all if it is not given.

    Weights: 'paper', each point weighs its sets by its own volumes, or 'conservative', all points of a set share the mean
    of their weights, each with the failure as seen from there.
    """

    def __init__(self, X, x, volumes, horizon, intact=None, hoods=None, weights="paper", signed=False):
        self.X, self.x, self.v, self.horizon, self.weights, self.signed = X, x, volumes, horizon, weights, signed
        distance = lengths(X[:, None] - X[None])
        self.near = (distance <= horizon * (1 + 1e-9)) & (distance > 0)
        self.intact = self.near if intact is None else self.near & intact
        self.hoods = volumes + self.near @ volumes if hoods is None else hoods
        self.sets = [[self.ordered_sets(i, order) for i in range(len(X))] for order in (1, 2, 3)]

    def ordered_sets(self, i, order):
        """The ordered sets of point i: rows of its partners' numbers."""
        points = numpy.flatnonzero(self.near[i])
        if order == 1:
            return points[:, None]
        mutual = self.near[numpy.ix_(points, points)]
        j, k = numpy.nonzero(mutual)
        if order == 2:
            found = points[numpy.column_stack([j, k])]
            area = lengths(numpy.cross(*self.vectors(self.X, i, found)))
            return found[area > FLAT * self.horizon**2]
        pair, l = numpy.nonzero(mutual[j] & mutual[k])
        found = points[numpy.column_stack([j[pair], k[pair], l])]
        return found[abs(self.volume(self.X, i, found)) > FLAT * self.horizon**3]

    @staticmethod
    def vectors(place, i, sets):
        return [place[column] - place[i] for column in sets.T]

    def volume(self, place, i, sets):
        j, k, l = self.vectors(place, i, sets)
        return (numpy.cross(j, k) * l).sum(axis=1)

    def terms(self, i, sets):
        """The terms of the three sums, without constants and weights, for the ordered sets of point i."""
        if sets.shape[1] == 1:
            (R,), (r,) = self.vectors(self.X, i, sets), self.vectors(self.x, i, sets)
            return (1 / lengths(R) - 1 / lengths(r))[:, None] * r
        if sets.shape[1] == 2:
            A, area = lengths(numpy.cross(*self.vectors(self.X, i, sets))), numpy.cross(*self.vectors(self.x, i, sets))
            return 2 * numpy.cross(self.x[sets[:, 1]] - self.x[i], (1 / A - 1 / lengths(area))[:, None] * area)
        V, v = self.volume(self.X, i, sets), self.volume(self.x, i, sets)
        bracket = (v / V - 1) * numpy.sign(V) if self.signed else (1 / abs(V) - 1 / abs(v)) * v
        _, k, l = self.vectors(self.x, i, sets)
        return 3 * bracket[:, None] * numpy.cross(k, l)

    def own_weight(self, apex, partners):
        """Volume of the apex times V_H^order over the number of its sets, 0 where one of its bonds in the set has failed."""
        order = partners.shape[1]
        numbers = numpy.array([max(1, len(sets)) for sets in self.sets[order - 1]])
        carries = self.intact[apex[:, None], partners].all(axis=1)
        return carries * (self.v * self.hoods**order / numbers)[apex]

    def weight(self, i, sets):
        members = numpy.column_stack([numpy.full(len(sets), i), sets])
        if self.weights == "paper":
            return self.own_weight(members[:, 0], members[:, 1:])
        return sum(self.own_weight(members[:, m], numpy.delete(members, m, axis=1)) for m in range(members.shape[1])) / members.shape[1]

    def unit_forces(self, order):
        """Forces of the sets of one, two or three partners on all points, with a constant of one."""
        return numpy.array([self.weight(i, sets) @ self.terms(i, sets) if len(sets) else numpy.zeros(3)
                            for i, sets in enumerate(self.sets[order - 1])])

    def bond_forces(self, constant):
        """bond_pd: the volume of the neighbour in place of that of the hood."""
        forces = numpy.zeros_like(self.x)
        for i, sets in enumerate(self.sets[0]):
            weight = constant * self.v[i] * self.v[sets[:, 0]] * self.intact[i, sets[:, 0]]
            forces[i] = weight @ self.terms(i, sets)
        return forces

    def state_forces(self, kappa, mu, dimension):
        """lps with the influence delta/L: for each point the gradient of its own energy, by the chain rule."""
        forces = numpy.zeros_like(self.x)
        for i, sets in enumerate(self.sets[0]):
            j = sets[:, 0]
            L, r = lengths(self.X[j] - self.X[i]), self.x[j] - self.x[i]
            volume, carries, e = self.horizon / L * self.v[j], self.intact[i, j], lengths(r) - L
            m = (volume * L**2).sum()
            carried = volume * carries
            theta = dimension / m * (carried * L * e).sum()
            alpha = dimension * (dimension + 2) * mu / m
            deviator = e - theta * L / dimension
            by_theta = kappa * theta - alpha / dimension * (carried * deviator * L).sum()
            by_e = by_theta * dimension / m * carried * L + alpha * carried * deviator
            pull = self.v[i] * by_e[:, None] * r / lengths(r)[:, None]
            forces[i] += pull.sum(axis=0)
            forces[j] -= pull
        return forces


def constants(data, horizon, volume):
    """C1, C2, C3 that give the forces of the last frame best, and the forces they leave over all forces."""
    found = data.vector("internal_force").ravel()
    cloud = Cloud(data.points, data.points + data.displacement(), numpy.full(len(data.points), volume), horizon)
    columns = numpy.array([cloud.unit_forces(order) for order in (1, 2, 3)]).reshape(3, -1)
    scale = numpy.linalg.norm(columns, axis=1)
    fitted = numpy.linalg.lstsq((columns / scale[:, None]).T, found, rcond=None)[0] / scale
    return fitted, numpy.linalg.norm(fitted @ columns - found) / numpy.linalg.norm(found)
