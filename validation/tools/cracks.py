"""Measures of a crack from the table of broken bonds: arrival, tip speed, branches.

All take reference midpoints (x, y) and times of the broken bonds, as in the event table; the crack
runs in direction x.  The paper gives pictures and arrival times only, so the definitions are ours and stand here.
"""
import numpy


def arrival_time(x, time, edge, spacing):
    """First time a bond breaks with its midpoint within one spacing of x = edge; nan if none does."""
    reached = x >= edge - spacing
    return time[reached].min() if reached.any() else numpy.nan


def tip_path(x, time):
    """Times and positions of the foremost tip: the records of the largest x, in order of time."""
    order = numpy.lexsort((x, time))
    front = numpy.maximum.accumulate(x[order])
    records = numpy.concatenate([[True], numpy.diff(front) > 0])
    return time[order][records], front[records]


def tip_speed(x, time, begin, end):
    """Slope of the straight line through the tip's path between x = begin and x = end (least squares)."""
    moment, front = tip_path(x, time)
    inside = (front >= begin) & (front <= end)
    if inside.sum() < 3:
        return numpy.nan
    return 1.0 / numpy.polyfit(front[inside], moment[inside], 1)[0]


def cracks_at(x, y, position, spacing, gap=3.0):
    """Number of separate cracks that cross the line x = position.

    Broken bonds within one spacing of the line belong to one crack if less than `gap` spacings lie between neighbours.
    """
    near = numpy.sort(y[numpy.abs(x - position) <= spacing])
    return 0 if len(near) == 0 else 1 + int((numpy.diff(near) > gap * spacing).sum())


def branches(x, y, begin, end, spacing):
    """Mean and largest number of cracks over lines one spacing apart between x = begin and x = end."""
    lines = numpy.arange(begin, end + 0.5 * spacing, spacing)
    counts = numpy.array([cracks_at(x, y, line, spacing) for line in lines])
    return counts.mean(), int(counts.max())


def path_distance(x, y, other_x, other_y):
    """Mean distance from a broken bond of one crack to the nearest broken bond of another."""
    points, others = numpy.column_stack([x, y]), numpy.column_stack([other_x, other_y])
    return numpy.mean([numpy.sqrt(((others - point) ** 2).sum(axis=1).min()) for point in points])
