"""A bar along y = cos(pi x/2), |x| <= 1, or straight with the same length: points with volumes, or a mesh of triangles.

Points stand in rows at equal arc lengths s along the axis and distances n across, n positive to the outside.  The right half is
made and mirrored, so that both halves are the same to the last bit.
"""
import numpy

THICKNESS = 0.1
_X = numpy.linspace(0, 1, 200001)
_LENGTHS = numpy.hypot(1, numpy.pi / 2 * numpy.sin(numpy.pi / 2 * _X))
_S = numpy.concatenate([[0], numpy.cumsum((_LENGTHS[1:] + _LENGTHS[:-1]) / 2 * numpy.diff(_X))])
HALF = _S[-1]                                        # arc length from the middle to an end


def axis(s, curved=True):
    """Points, unit normals to the outside and curvatures of the right half of the axis."""
    if not curved:
        return numpy.column_stack([s, 0 * s]), numpy.column_stack([0 * s, 0 * s + 1]), 0 * s
    x = numpy.interp(s, _S, _X)
    slope, bend = -numpy.pi / 2 * numpy.sin(numpy.pi / 2 * x), -(numpy.pi / 2) ** 2 * numpy.cos(numpy.pi / 2 * x)
    length = numpy.hypot(1, slope)
    return (numpy.column_stack([x, numpy.cos(numpy.pi / 2 * x)]), numpy.column_stack([-slope, 0 * x + 1]) / length[:, None],
            -bend / length**3)


def rows(across):
    """Rows of the right half, and their length: cells as near to square as can be."""
    count = round(HALF / (THICKNESS / across))
    return count, HALF / count


def along(points):
    """Distance from the middle along the axis of points, by the nearest place of the axis."""
    place = numpy.column_stack([_X, numpy.cos(numpy.pi / 2 * _X)])[::100]
    offsets = numpy.abs(points[:, None, :1]) - place[None, :, :1], points[:, None, 1:2] - place[None, :, 1:]
    return _S[::100][(offsets[0] ** 2 + offsets[1] ** 2)[:, :, 0].argmin(axis=1)]


def cells(across, deep=0, curved=True):
    """Points (n, 2 or 3) and volumes: `across` cells across the bar, `deep` into it (0: plane)."""
    count, step = rows(across)
    place, normal, curvature = axis((numpy.arange(count) + 0.5) * step, curved)
    n = ((numpy.arange(across) + 0.5) / across - 0.5) * THICKNESS
    right = (place[:, None] + n[None, :, None] * normal[:, None]).reshape(-1, 2)
    area = (step * THICKNESS / across * (1 + curvature[:, None] * n)).ravel()
    points, volumes = numpy.vstack([right * [-1, 1], right]), numpy.concatenate([area, area])
    if deep == 0:
        return points, volumes
    z = (numpy.arange(deep) + 0.5) / deep * THICKNESS
    return (numpy.column_stack([numpy.repeat(points, deep, axis=0), numpy.tile(z, len(points))]),
            numpy.repeat(volumes, deep) * THICKNESS / deep)


def points_file(across, deep=0, curved=True):
    """The points as the text of a CSV file."""
    lines = ["X,Y,Z,volume" if deep else "X,Y,volume"]
    lines += [",".join(repr(float(value)) for value in (*point, volume)) for point, volume in zip(*cells(across, deep, curved))]
    return "\n".join(lines) + "\n"


def right_end(s, curved=True):
    """The axis at a distance from the middle, and its direction to the right."""
    place, normal, _ = axis(numpy.array([s]), curved)
    return place[0], numpy.array([normal[0, 1], -normal[0, 0]])


def mesh_file(across):
    """Triangles between points of equal s and n, as the text of a Gmsh file (2.2); the diagonals are mirrored too."""
    count, step = rows(across)
    place, normal, _ = axis(numpy.arange(count + 1) * step)
    n = (numpy.arange(across + 1) / across - 0.5) * THICKNESS
    right = place[:, None] + n[None, :, None] * normal[:, None]
    nodes = numpy.concatenate([(right * [-1, 1])[:0:-1], right]).reshape(-1, 2)
    number = numpy.arange(len(nodes)).reshape(-1, across + 1) + 1
    triangles = []
    for row in range(2 * count):
        for column in range(across):
            (a, b), (d, c) = number[row:row + 2, column:column + 2]
            triangles += [(a, d, b), (b, d, c)] if row < count else [(a, d, c), (a, c, b)]
    lines = ["$MeshFormat", "2.2 0 8", "$EndMeshFormat", "$PhysicalNames", "1", '2 1 "bar"', "$EndPhysicalNames", "$Nodes", str(len(nodes))]
    lines += [f"{index} {float(x)!r} {float(y)!r} 0" for index, (x, y) in enumerate(nodes, 1)]
    lines += ["$EndNodes", "$Elements", str(len(triangles))]
    lines += [f"{index} 2 2 1 1 {a} {b} {c}" for index, (a, b, c) in enumerate(triangles, 1)]
    return "\n".join([*lines, "$EndElements"]) + "\n"
