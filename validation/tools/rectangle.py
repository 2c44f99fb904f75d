"""A rectangle of graded triangles as text of a Gmsh MSH 2.2 file, and values at any place from the nodes of such a grid.

For finite-element references on a rectangle that a lattice prescribes: the lines of the grid are given, so that
they can be dense where the solution is steep, and the places of all nodes are known.
"""
import numpy


def graded(length, count, first, last):
    """`count` intervals over a length whose sizes go geometrically from `first` to `last` times those of equal ones, scaled to fit."""
    sizes = numpy.geomspace(first, last, count)
    return numpy.concatenate([[0.0], numpy.cumsum(sizes) * length / sizes.sum()])


def graded_to_both_ends(length, count, end):
    """An even number of intervals, small at both ends."""
    half = graded(length / 2, count // 2, end, 1.0)
    return numpy.concatenate([half, length - half[-2::-1]])


def with_middles(lines):
    """Lines of the nodes of quadratic elements."""
    return numpy.sort(numpy.concatenate([lines, (lines[1:] + lines[:-1]) / 2]))


def mesh(x, y):
    """Text of the mesh with grid lines x and y; the diagonals alternate."""
    columns = len(x)
    nodes = [f"{row * columns + column + 1} {a!r} {b!r} 0" for row, b in enumerate(y.tolist()) for column, a in enumerate(x.tolist())]
    triangles = []
    for row in range(len(y) - 1):
        for column in range(columns - 1):
            a = row * columns + column + 1
            b, c, d = a + 1, a + columns + 1, a + columns
            triangles += [(a, b, c), (a, c, d)] if (row + column) % 2 == 0 else [(a, b, d), (b, c, d)]
    elements = [f"{number} 2 2 1 1 {a} {b} {c}" for number, (a, b, c) in enumerate(triangles, 1)]
    return "\n".join(["$MeshFormat", "2.2 0 8", "$EndMeshFormat", "$Nodes", str(len(nodes)), *nodes, "$EndNodes",
                      "$Elements", str(len(elements)), *elements, "$EndElements", ""])


class Grid:
    """Values at the nodes of quadratic elements on the grid, read at other places by tensor products of quadratics."""

    def __init__(self, x, y, points):
        """x, y: lines of the mesh; points: places of the nodes, in any order."""
        self.lines = with_middles(x), with_middles(y)
        index = [self._nearest(line, points[:, axis]) for axis, line in enumerate(self.lines)]
        self.order = numpy.full((len(self.lines[0]), len(self.lines[1])), -1)
        self.order[index[0], index[1]] = numpy.arange(len(points))
        if (self.order < 0).any():
            raise ValueError("the nodes are not those of the grid with middles")

    @staticmethod
    def _nearest(line, places):
        right = numpy.clip(numpy.searchsorted(line, places), 1, len(line) - 1)
        return numpy.where(places - line[right - 1] < line[right] - places, right - 1, right)

    @staticmethod
    def _weights(line, places):
        """First of three lines, and the weights of these."""
        first = 2 * numpy.clip(numpy.searchsorted(line[::2], places, side="right") - 1, 0, len(line) // 2 - 1)
        s = (places - line[first]) / (line[first + 2] - line[first])
        return first, numpy.stack([(1 - s) * (1 - 2 * s), 4 * s * (1 - s), s * (2 * s - 1)])

    def at(self, values, places):
        (i, a), (j, b) = (self._weights(line, places[:, axis]) for axis, line in enumerate(self.lines))
        return sum(a[p] * b[q] * values[self.order[i + p, j + q]] for p in range(3) for q in range(3))
