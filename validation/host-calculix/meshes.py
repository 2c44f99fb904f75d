"""Meshes as CalculiX reads them: the tensile bar from a result of cleave, the rod from its sizes."""
import numpy

LENGTH, HALF = 32.4e-3, 3.2e-3  # rod [m]


def _set(name, nodes):
    lines = [", ".join(str(node + 1) for node in nodes[k:k + 10]) for k in range(0, len(nodes), 10)]
    return f"*NSET, NSET={name}\n" + ",\n".join(lines) + "\n"


def _text(points, kind, elements, sets):
    """CalculiX reads the first 20 characters of a number: with 15 digits an exponent could be cut."""
    nodes = "".join(f"{k + 1}, {x:.12g}, {y:.12g}, {z:.12g}\n" for k, (x, y, z) in enumerate(points))
    rows = "".join(f"{k + 1}, " + ", ".join(str(node + 1) for node in row) + "\n" for k, row in enumerate(elements))
    return (f"*NODE, NSET=NALL\n{nodes}*ELEMENT, TYPE={kind}, ELSET=ALL\n{rows}"
            + "".join(_set(name, numpy.flatnonzero(where)) for name, where in sets.items()))


def bar(exodus):
    """Nodes and six-node triangles of an Exodus result in the plane."""
    points, rows = exodus.points.copy(), exodus.simplices[:, :6].copy()
    corner = points[rows[:, :3]]
    edges = corner[:, 1:] - corner[:, :1]
    turned = edges[:, 0, 0] * edges[:, 1, 1] - edges[:, 0, 1] * edges[:, 1, 0] < 0  # CalculiX counts anticlockwise
    rows[turned] = rows[turned][:, [0, 2, 1, 5, 4, 3]]
    y = points[:, 1]
    near = 1e-6 * numpy.ptp(y)
    return _text(points, "CPE6", rows, {"BOTTOM": y < y.min() + near, "TOP": y > y.max() - near})


def rod(across, along):
    """A quarter of the rod in across x across x along bricks with one integration point."""
    side, height = numpy.linspace(0, HALF, across + 1), numpy.linspace(0, LENGTH, along + 1)
    z, y, x = (a.ravel() for a in numpy.meshgrid(height, side, side, indexing="ij"))
    n = across + 1
    first = numpy.array([i + n * j + n * n * k for k in range(along) for j in range(across) for i in range(across)])
    face = numpy.array([0, 1, n + 1, n])
    rows = first[:, None] + numpy.concatenate((face, face + n * n))[None, :]
    sets = {"BASE": z == 0, "XSYM": x == 0, "YSYM": y == 0, "TIP": (x == 0) & (y == 0) & (z == LENGTH),
            "FOOT": (x == HALF) & (y == 0) & (z == 0)}
    return _text(numpy.column_stack((x, y, z)), "C3D8R", rows, sets)
