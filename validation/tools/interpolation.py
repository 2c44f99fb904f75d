"""A field given at scattered points, evaluated at others: local quadratic least squares.

Made to compare a finite-element field, given as one value per element at its centroid, with particles
elsewhere in the body.  Exact for quadratic fields; it does not know the boundary and extrapolates to it.
"""
import numpy


def _terms(offset):
    """Monomials of a quadratic in two dimensions, last axis."""
    x, y = offset[..., 0], offset[..., 1]
    return numpy.stack([numpy.ones_like(x), x, y, x * x, x * y, y * y], axis=-1)


def nearest(points, targets, count):
    """Indices (targets, count) of the nearest points of every target, nearest first."""
    found = numpy.empty((len(targets), count), int)
    for row, target in enumerate(targets):
        distance = ((points - target) ** 2).sum(axis=1)
        close = numpy.argpartition(distance, count - 1)[:count]
        found[row] = close[numpy.argsort(distance[close], kind="stable")]
    return found


def weights(points, targets, count=14):
    """Indices and weights (targets, count): value at a target = sum of weights times values of its neighbours.

    The fit is weighed by distance, so that the nearest points count most.
    """
    points, targets = numpy.asarray(points, float)[:, :2], numpy.asarray(targets, float)[:, :2]
    index = nearest(points, targets, count)
    offset = points[index] - targets[:, None]
    reach = numpy.sqrt((offset[:, -1:] ** 2).sum(axis=2, keepdims=True))
    offset = offset / reach
    share = numpy.exp(-2 * (offset**2).sum(axis=2))
    terms = _terms(offset) * share[..., None]
    return index, numpy.linalg.pinv(terms)[:, 0, :] * share


class Interpolation:
    """The same points and targets for several fields."""

    def __init__(self, points, targets, count=14):
        self.index, self.weights = weights(points, targets, count)

    def __call__(self, values):
        return (self.weights * numpy.asarray(values)[self.index]).sum(axis=1)
