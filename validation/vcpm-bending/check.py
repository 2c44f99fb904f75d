"""A lattice plate in bending: displacements of its corner against a table and finite elements; a turned piece of lattice.

The load is the same force on every particle of the left edge; that of the finite elements is uniform over the
edge, as forces on nodes that check.py adds one by one.
"""
import pathlib

import matplotlib.pyplot as plt
import numpy
from tools import deck, picture, rectangle
from tools.simulation import Run

HERE = pathlib.Path(__file__).resolve().parent
WIDTH, FORCE = 10.0, 173.0                                # mm, N/mm
ROWS = {24: 83, 40: 139, 60: 207, 100: 345}               # spacings across the width: rows
PAPER, OTHER = 100, 60                                    # the paper's lattice; that of other options
CASES = {"strain": "plane_strain", "stress": "plane_stress"}
ANGLES = (1, 10, 90, 170)                                 # degrees
YOUNG, POISSON = 69000.0, 0.3


def height(n):
    """Of the rectangle through the outer particles."""
    return float((ROWS[n] - 1) * WIDTH / n * numpy.sqrt(0.75))


def lines(n, count=30):
    """Grid of the finite elements: a third as many across as along, small at the held corners."""
    return rectangle.graded_to_both_ends(WIDTH, count, 0.1), rectangle.graded(height(n), 3 * count, 1.0, 0.05)


def zone(name, x, y, size):
    """A box around a place."""
    return f"&zone\n  name = '{name}', lower = {x - size!r}, {y - size!r}, upper = {x + size!r}, {y + size!r}\n/\n"


def load(name, kind, direction, value):
    return (f"&load\n  name = '{name}{direction}', kind = '{kind}', set = '{name}', directions = '{direction}', value = {value!r}\n"
            "  curve = 'linear', ramp = 1\n/\n")


def plate(n, case, geometry="linear", surface="keep"):
    spacing = WIDTH / n
    changes = {"lattice.spacing": spacing, "lattice.size": (WIDTH, height(n) + 0.1 * spacing, 0),
               "body.kinematics": CASES[case], "vcpm.geometry": geometry, "vcpm.surface": surface}
    name = "-".join([case, str(n)] + [option for option in (geometry, surface) if option in ("finite", "extend")])
    return Run(name, "plate.nml", changes)


def edge_forces(y):
    """Simpson's rule for a uniform load on the edges of quadratic elements with corners y: places and forces."""
    forces, sizes = numpy.zeros(2 * len(y) - 1), numpy.diff(y)
    forces[1::2] = 4 * sizes / 6
    forces[:-2:2] += sizes / 6
    forces[2::2] += sizes / 6
    return rectangle.with_middles(y).tolist(), (forces * FORCE / y[-1]).tolist()


def finite_elements(n, case, count=30, name="fem"):
    x, y = lines(n, count)
    changes = {"zone(1).centre": (0, height(n), 0), "body.kinematics": CASES[case]}
    text, size = deck.vary((HERE / "fem.nml").read_text(encoding="utf-8"), changes), float(numpy.diff(y).min() / 5)
    for number, (place, force) in enumerate(zip(*edge_forces(y))):
        if number < 2 * len(y) - 2:                       # the last node is held
            text += zone(f"n{number}", 0.0, place, size) + load(f"n{number}", "force", "x", force)
    run = f"{name}-{case}-{n}"
    return Run(run, command=(f"{run}.nml",), inputs={f"{run}.nml": text, "rectangle.msh": rectangle.mesh(x, y)})


def lattice_points():
    """Places of the lattice of rotation.nml: rows of seven and six."""
    return [(float(column + 0.5 * (row % 2)), float(row * numpy.sqrt(0.75))) for row in range(7) for column in range(7 - row % 2)]


def rotation(geometry, angle):
    text = deck.vary((HERE / "rotation.nml").read_text(encoding="utf-8"), {"vcpm.geometry": geometry})
    c, s = (float(f(numpy.radians(angle))) for f in (numpy.cos, numpy.sin))
    for number, (x, y) in enumerate(lattice_points()):
        name = f"p{number}"
        text += zone(name, x, y, 0.1) + load(name, "displacement", "x", (c - 1) * x - s * y) + load(name, "displacement", "y", s * x + (c - 1) * y)
    run = f"turned-{geometry}-{angle}"
    return Run(run, command=(f"{run}.nml",), inputs={f"{run}.nml": text})


def runs(mode):
    made = []
    for case in CASES:
        for n in ROWS:
            made += [plate(n, case), finite_elements(n, case)]
        made += [plate(OTHER, case, "finite"), plate(OTHER, case, surface="extend"), finite_elements(PAPER, case, 40, "fine")]
    return made + [rotation(geometry, angle) for geometry in ("finite", "linear") for angle in ANGLES]


# ---- figures

def tip(case, name):
    """Displacement of the lower left corner, mm."""
    data = case.results[name].exodus
    return data.displacement()[int(abs(data.points[:, :2]).sum(axis=1).argmin()), :2]


def strain_of_turning(case, angle):
    """Strain that the linear geometry sees, from the energy of the particle in the middle: isotropic, 2 (lambda + mu) e^2."""
    data = case.results[f"turned-linear-{angle}"].exodus
    middle = int(abs(data.points[:, :2] - data.points[:, :2].mean(axis=0)).sum(axis=1).argmin())
    modulus = YOUNG / (2 * (1 + POISSON) * (1 - 2 * POISSON))      # lambda + mu
    return numpy.sqrt(data.nodal("strain_energy_density")[middle] / (2 * modulus))


def largest_force(case, geometry, angle):
    """Of all particles, over Young's modulus times spacing."""
    forces = case.results[f"turned-{geometry}-{angle}"].exodus.vector("internal_force")
    return numpy.linalg.norm(forces, axis=1).max() / YOUNG


def check(case):
    for kind in CASES:
        found, solid, fine = (tip(case, f"{prefix}{kind}-{PAPER}") for prefix in ("", "fem-", "fine-"))
        for axis, name in enumerate("xy"):
            case.figure(f"tip_{kind}_{name}", found[axis])
            case.figure(f"fem_{kind}_{name}", solid[axis])
            case.figure(f"fem_change_{kind}_{name}", abs(fine[axis] / solid[axis] - 1))
            for n in ROWS:
                case.figure(f"error_{kind}_{name}_{n}", 100 * (tip(case, f"{kind}-{n}")[axis] / tip(case, f"fem-{kind}-{n}")[axis] - 1))
            for option in ("finite", "extend"):
                case.figure(f"{option}_{kind}_{name}", 100 * (tip(case, f"{kind}-{OTHER}-{option}")[axis] / tip(case, f"{kind}-{OTHER}")[axis] - 1))
    for angle in ANGLES:
        case.figure(f"force_finite_{angle}", largest_force(case, "finite", angle))
        case.figure(f"force_linear_{angle}", largest_force(case, "linear", angle))
        case.figure(f"strain_linear_{angle}", strain_of_turning(case, angle) / (1 - numpy.cos(numpy.radians(angle))))


def pictures(case, folder):
    figure, (left, right) = plt.subplots(1, 2, figsize=(10.5, 4.6), layout="constrained", width_ratios=(1, 0.6))
    colours = {"strain": "#c4173a", "stress": "#1f6f8b"}
    for kind, colour in colours.items():
        for axis, marker in enumerate("ox"):
            errors = [100 * (tip(case, f"{kind}-{n}")[axis] / tip(case, f"fem-{kind}-{n}")[axis] - 1) for n in ROWS]
            left.loglog(WIDTH / numpy.array(list(ROWS)), errors, marker + "-", mfc="none", color=colour,
                        label=f"u_{'xy'[axis]}, {CASES[kind].replace('_', ' ')}")
    left.set(xlabel="spacing 2R, mm", ylabel="displacement of the corner above finite elements, %", title="Convergence")
    left.legend(fontsize=7)
    left.grid(color="#e3e8ee", which="both")
    for name, colour, size in ((f"strain-{PAPER}", "#c4173a", 0.2), (f"fem-strain-{PAPER}", "#1d2733", 0.4)):
        data = case.results[name].exodus
        order = numpy.argsort(data.points[:, 1])
        places = (data.points + 20 * data.displacement())[order]
        sides = [places[abs(data.points[order, 0] - side) < 1e-6] for side in (0, WIDTH)]
        for number, line in enumerate(sides):
            right.plot(line[:, 0], line[:, 1], "-" if "fem" in name else ".", ms=3, lw=1, color=colour,
                       label=None if number else ("finite elements" if "fem" in name else "particles"))
    right.set(aspect="equal", xlim=(-2, 22), title="Sides, displacement x 20,\nplane strain")
    right.legend(fontsize=7, loc="upper right")
    picture.save(figure, folder / "figure.png", dpi=110)
    return [("figure.png", "Convergence of the displacement of the corner; deformed sides")]
