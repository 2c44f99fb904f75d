"""A lattice plate in tension: reactions against a table and against finite elements, contours, Poisson's ratio.

Every lattice is compared with finite elements on the rectangle through its outer particles, whose height
depends on the spacing.
"""
import pathlib

import matplotlib.pyplot as plt
import numpy
from tools import picture, rectangle
from tools.simulation import Run

HERE = pathlib.Path(__file__).resolve().parent
WIDTH, PULL = 10.0, 0.5
ROWS = {12: 41, 24: 83, 40: 139, 60: 207, 100: 345}       # spacings across the width: rows
CASES = {"strain": "plane_strain", "stress": "plane_stress"}
TABLE = (60, 100)                                         # lattices of the paper
CONTOURS = (0.1, 0.4)
SWEEP = (-0.5, -0.25, 0.0, 0.1, 0.2, 0.25, 0.3, 0.3333, 0.4, 0.45, 0.49)
SWEPT = 24                                                # spacings across the width in the sweep
PATCH = ((2.5, 7.5), (5.0, 15.0))                         # far from the end that is held across


def height(n):
    """Of the rectangle through the outer particles."""
    return float((ROWS[n] - 1) * WIDTH / n * numpy.sqrt(0.75))


def lines(n, count=30):
    """Grid of the finite elements: a third as many across as along, small at the held corners."""
    return (rectangle.graded_to_both_ends(WIDTH, count, 0.1), rectangle.graded(height(n), 3 * count, 1.0, 0.05))


def plate(name, n, case, nu=0.3, surface="keep"):
    spacing = WIDTH / n
    changes = {"lattice.spacing": spacing, "lattice.size": (WIDTH, height(n) + 0.1 * spacing, 0),
               "body.kinematics": CASES[case], "material.nu": nu, "vcpm.surface": surface}
    return Run(name, "plate.nml", changes)


def finite_elements(name, n, case, nu=0.3, count=30):
    changes = {"zone(1).centre": (0, height(n), 0), "body.kinematics": CASES[case], "material.nu": nu}
    return Run(name, "fem.nml", changes, inputs={"rectangle.msh": rectangle.mesh(*lines(n, count))})


def contour_lattice(mode):
    return 100 if mode == "full" else 60


def runs(mode):
    made, n = [], contour_lattice(mode)
    for case in CASES:
        for size in ROWS:
            made += [plate(f"{case}-{size}", size, case), finite_elements(f"fem-{case}-{size}", size, case)]
            made += [plate(f"extend-{case}-{size}", size, case, surface="extend")] if size != 100 or mode == "full" else []
        made.append(finite_elements(f"fine-{case}", 60, case, count=40))
        for nu in CONTOURS:
            made += [plate(f"{case}-nu{nu}", n, case, nu), finite_elements(f"fem-{case}-nu{nu}", n, case, nu)]
        made += [plate(f"sweep-{case}-{nu}", SWEPT, case, nu) for nu in SWEEP]
    return made


# ---- figures

def reaction(case, name):
    """N/mm, of the lower edge."""
    return -case.results[name].history["reaction_bottom_y"][-1]


def error(case, kind, n, prefix=""):
    """Relative difference of the reaction from that of finite elements, percent."""
    return 100 * (reaction(case, f"{prefix}{kind}-{n}") / reaction(case, f"fem-{kind}-{n}") - 1)


def order(case, kind):
    """Exponent of the spacing in that difference, least squares over all lattices."""
    return -numpy.polyfit(numpy.log(list(ROWS)), numpy.log([-error(case, kind, n) for n in ROWS]), 1)[0]


def within(X, box):
    """Which points lie in a box."""
    return numpy.all([(X[:, axis] > lower) & (X[:, axis] < upper) for axis, (lower, upper) in enumerate(box)], axis=0)


def contours(case, kind, nu):
    """Particles, their displacements and those of finite elements there."""
    lattice, solid = (case.results[f"{prefix}{kind}-nu{nu}"].exodus for prefix in ("", "fem-"))
    grid = rectangle.Grid(*lines(contour_lattice(case.mode)), solid.points)
    there = numpy.column_stack([grid.at(solid.displacement()[:, axis], lattice.points) for axis in (0, 1)])
    return lattice.points[:, :2], lattice.displacement()[:, :2], there


def ratio(kind, across, along):
    """Poisson's ratio from the strains of uniaxial stress."""
    return -across / along if kind == "stress" else across / (across - along)


def measured(case, kind, nu):
    """Poisson's ratio of the inner patch, and with the change of the whole width."""
    data = case.results[f"sweep-{kind}-{nu}"].exodus
    X, u = data.points, data.displacement()
    here = within(X, PATCH)
    terms = numpy.column_stack([numpy.ones(here.sum()), X[here, :2]])
    across, along = (numpy.linalg.lstsq(terms, u[here, axis], rcond=None)[0][1 + axis] for axis in (0, 1))
    level = (X[:, 1] > PATCH[1][0]) & (X[:, 1] < PATCH[1][1])
    left, right = (u[level & (abs(X[:, 0] - side) < 1e-6), 0].mean() for side in (0, WIDTH))
    return ratio(kind, across, along), ratio(kind, (right - left) / WIDTH, along)


def check(case):
    for kind in CASES:
        for n in TABLE:
            case.figure(f"reaction_{kind}_{n}", reaction(case, f"{kind}-{n}"))
            case.figure(f"fem_{kind}_{n}", reaction(case, f"fem-{kind}-{n}"))
        case.figure(f"fem_change_{kind}", abs(reaction(case, f"fine-{kind}") / reaction(case, f"fem-{kind}-60") - 1))
        for n in ROWS:
            case.figure(f"error_{kind}_{n}", error(case, kind, n))
        case.figure(f"order_{kind}", order(case, kind))
        for n in ROWS if case.full else list(ROWS)[:-1]:
            case.figure(f"extend_{kind}_{n}", error(case, kind, n, "extend-"))
        for nu in CONTOURS:
            X, u, there = contours(case, kind, nu)
            for axis, name in enumerate("xy"):
                case.figure(f"contour_{kind}_{nu}_{name}", abs(u - there)[:, axis].max() / abs(there[:, axis]).max())
            case.figure(f"inside_{kind}_{nu}_x", abs(u - there)[within(X, PATCH), 0].max() / abs(there[:, 0]).max())
        for nu in SWEEP:
            inside, whole = measured(case, kind, nu)
            case.figure(f"nu_{kind}_{nu:g}", inside)
            case.figure(f"whole_{kind}_{nu:g}", whole)


def pictures(case, folder):
    figure, (left, middle, right) = plt.subplots(1, 3, figsize=(13, 4.6), layout="constrained", width_ratios=(1, 1, 0.55))
    colours = {"strain": "#c4173a", "stress": "#1f6f8b"}
    for kind, colour in colours.items():
        label = CASES[kind].replace("_", " ")
        spacing = WIDTH / numpy.array(list(ROWS))
        left.loglog(spacing, [-error(case, kind, n) for n in ROWS], "o-", color=colour, label=label)
        extended = list(ROWS) if case.full else list(ROWS)[:-1]
        left.loglog(WIDTH / numpy.array(extended), [abs(error(case, kind, n, "extend-")) for n in extended], "x:", color=colour,
                    label=f"{label}, extended (magnitude)")
        found = numpy.array([measured(case, kind, nu) for nu in SWEEP])
        middle.plot(SWEEP, found[:, 0], ls="none", marker="o" if kind == "strain" else "x", ms=8, mfc="none", color=colour, label=f"{label}, inside")
        middle.plot(SWEEP, found[:, 1], ":", lw=1, color=colour, label=f"{label}, whole width")
    middle.plot([-0.5, 0.5], [-0.5, 0.5], color="#f7c548", lw=4, zorder=0, label="material")
    left.set(xlabel="spacing 2R, mm", ylabel="reaction below finite elements, %", title="Convergence, nu = 0.3")
    middle.set(xlabel="Poisson's ratio of the material", ylabel="of the plate", title="Poisson's ratio, 25 particles across")
    X, u, there = contours(case, "strain", 0.4)
    shown = right.tricontourf(X[:, 0], X[:, 1], 1e3 * u[:, 0], 11, cmap="RdBu_r")
    right.tricontour(X[:, 0], X[:, 1], 1e3 * there[:, 0], levels=shown.levels, colors="#1d2733", linewidths=0.8)
    figure.colorbar(shown, ax=right)
    right.set(aspect="equal", title="u_x, um, plane strain, 0.4;\nlines: finite elements")
    for axes in (left, middle):
        axes.legend(fontsize=7)
        axes.grid(color="#e3e8ee", which="both")
    picture.save(figure, folder / "figure.png", dpi=110)
    return [("figure.png", "Error of the reaction, Poisson's ratio, displacement across")]
