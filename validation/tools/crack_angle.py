"""Direction of a crack that runs from the tip of a notch, from the damage of points.  Nothing of times or broken bonds.

Papers say "initial crack angle" and not how they drew it; the definition is ours: the straight line that fits the damaged
points around the crack best, distances taken across the line, so that steep cracks are no worse than flat ones.
"""
import numpy


def crack_points(points, damage, tip, reach, spacing, *, least=0.35, ahead=(1, 0), side=1):
    """Which points are the crack: damage above `least`, at most `reach` from the tip, ahead of it, on that side of the notch,
    and in one piece with the tip: a chain of such points leads there, none further than 1.5 spacings from the next.

    `ahead` is the direction in which the notch points; side = 1 is to its left, -1 to its right.  Only x and y count.
    """
    along, across = _frame(points, tip, ahead, side)
    candidates = numpy.flatnonzero((damage > least) & (numpy.hypot(along, across) <= reach) & (along >= 0) & (across >= 0))
    places = numpy.column_stack([along, across])[candidates]
    found = numpy.zeros(len(points), bool)
    found[candidates[_piece(places, 1.5 * spacing)]] = True
    return found


def extent(points, tip):
    """Distance from the tip to the furthest of the points; 0 if there are none."""
    return numpy.hypot(*(numpy.asarray(points)[:, :2] - tip).T).max(initial=0.0)


def angle(points, tip, *, ahead=(1, 0), side=1):
    """Degrees between the notch and the line through the points: 0 straight on, 90 square to the notch, on that side; nan for fewer than three."""
    if len(points) < 3:
        return numpy.nan
    along, across = _frame(points, tip, ahead, side)
    offsets = numpy.column_stack([along - along.mean(), across - across.mean()])
    direction = numpy.linalg.svd(offsets, full_matrices=False)[2][0]
    return numpy.degrees(numpy.arctan2(direction[1], direction[0])) % 180


def _frame(points, tip, ahead, side):
    """Coordinates of the points along the notch and across it, from its tip."""
    offsets, unit = numpy.asarray(points)[:, :2] - numpy.asarray(tip), numpy.asarray(ahead) / numpy.hypot(*ahead)
    return offsets @ unit, side * (offsets @ numpy.array([-unit[1], unit[0]]))


def _piece(places, step):
    """Indices of the places that steps of that length connect with the origin."""
    inside = numpy.hypot(*places.T) <= step
    edge = numpy.flatnonzero(inside)
    while len(edge):
        rest = numpy.flatnonzero(~inside)
        near = (numpy.linalg.norm(places[rest, None] - places[None, edge], axis=2) <= step).any(axis=1)
        edge = rest[near]
        inside[edge] = True
    return numpy.flatnonzero(inside)
