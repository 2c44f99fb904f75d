"""The quasi-static block of Figs. 3 to 5: stiffness, peak load and crack on finer and finer lattices with one horizon.

Slopes come from one small increment.  The stiffness and the toughness of a lattice are sums over the bonds of an inner
point, which swing with the number of points within the horizon; `own` slopes and peaks are those over what the sums say.
"""
import pathlib

import matplotlib.pyplot as plt
import numpy
from tools import deck, lattice_sums, picture
from tools.simulation import Run

HERE = pathlib.Path(__file__).resolve().parent
HORIZON, TOUGHNESS, LIGAMENT = 0.0675, 2.7, 0.05        # mm, N/mm, mm2
SLOPES = {"quick": (40, 50), "full": (40, 50, 60, 70, 80, 90, 100)}
# n: displacement of the top [um] before which nothing breaks, and at the end; increments of 0.1 between
COURSES = {40: (4.4, 6.2), 50: (3.6, 5.6), 60: (3.4, 5.6), 70: (3.2, 6.2), 80: (3.0, 6.2), 90: (2.9, 6.2), 100: (2.7, 6.2)}
TORN = {"quick": {"cpd": (40, 50), "bond": (40,)}, "full": {"cpd": SLOPES["full"], "bond": SLOPES["full"]}}
NAMES = {"cpd": "cpd", "bond": "bond_pd"}
SMALL = 0.25                                            # um
FRONT = 0.35                                            # damage of a point beside a crack


def block(name, formulation, n, changes):
    text = (HERE / "block.nml").read_text(encoding="utf-8")
    if formulation != "cpd":
        text = deck.without(text, "cpd")
    text = deck.vary(text, {"lattice.spacing": 1 / n, "body.formulation": NAMES[formulation]} | changes)
    return Run(name, command=(f"{name}.nml",), inputs={f"{name}.nml": text})


def pulled(formulation, n):
    """One small increment; the field of the largest stretch tells when the first bond will break."""
    return block(f"slope-{formulation}-{n}", formulation, n, {
        "run.t_end": 1, "static.increments": 1, "static.tolerance": 1e-4, "load(2).value": SMALL * 1e-3,
        "load(2).times": (0, 1), "load(2).factors": (0, 1), "output.fields": ("displacement", "largest_stretch")})


def torn(name, formulation, n, course, step=0.1, changes=None):
    start, end = course
    count = 1 + round((end - start) / step)
    return block(name, formulation, n, {
        "run.t_end": count, "static.increments": count, "load(2).times": (0, 1, count),
        "load(2).factors": (0, start, end)} | (changes or {}))


def runs(mode):
    made = [pulled(formulation, n) for n in SLOPES[mode] for formulation in NAMES]
    return made + [torn(f"torn-{formulation}-{n}", formulation, n, COURSES[n]) for formulation in NAMES for n in TORN[mode][formulation]]


# ---- measures

def curve(result, course):
    """Displacement of the top [um] and load [N] of a run with this course of the top."""
    time = result.history["time"]
    return numpy.interp(time, (0, 1, time[-1]), (0, *course)), result.history["reaction_top_y"]


def slope(case, formulation, n):
    """Load over displacement, N/um."""
    return case.results[f"slope-{formulation}-{n}"].history["reaction_top_y"][-1] / SMALL


def volumes(formulation, n):
    """What the volumes that a formulation gives to bonds are over those of the neighbours."""
    return {"bond": 1, "cpd": 1 + 1 / lattice_sums.number(HORIZON * n)}[formulation]


def lattice_modulus(formulation, n):
    """Young's modulus along a lattice axis over that of the material."""
    C11, C12 = lattice_sums.bond_moduli(HORIZON * n)
    return volumes(formulation, n) * (C11 - 2 * C12**2 / (C11 + C12)) / 2.5


def lattice_toughness(formulation, n):
    return volumes(formulation, n) * lattice_sums.toughness(HORIZON * n)


def largest_rise(values):
    """Largest quotient of a value and the one before: below 1 if they fall all the time."""
    return max(after / before for before, after in zip(values, values[1:]))


def first_break(case, formulation, n):
    """Displacement of the top at which the first bond reaches its critical stretch, um, by proportion."""
    critical = numpy.sqrt(5 * TOUGHNESS / (9 * 140000 * HORIZON))
    data = case.results[f"slope-{formulation}-{n}"].exodus
    may_break = abs(data.points[:, 1] - 0.5) < 0.5 - 2 * HORIZON
    return SMALL * critical / data.nodal("largest_stretch")[may_break].max()


def crossing_bonds(n):
    """Half of the bonds that cross the mid-plane: those of the ligament."""
    directions, L = lattice_sums.hood(HORIZON * n)
    X, Y, Z = numpy.round(directions * L[:, None]).T
    return ((n - abs(X)) * numpy.maximum(0, n // 10 - abs(Z)) * numpy.maximum(0, Y)).sum() / 2


def offset(result):
    """Largest distance of a damaged point ahead of the pre-crack from the plane of the crack, over the horizon."""
    data = result.exodus
    ahead = (data.nodal("damage") > FRONT) & (data.points[:, 0] > 0.5 + HORIZON)
    return abs(data.points[ahead, 1] - 0.5).max() / HORIZON


def check(case):
    for formulation in NAMES:
        slopes = [slope(case, formulation, n) for n in SLOPES[case.mode]]
        own = [value / lattice_modulus(formulation, n) for value, n in zip(slopes, SLOPES[case.mode])]
        for n, value, clean in zip(SLOPES[case.mode], slopes, own):
            case.figure(f"slope_{formulation}_{n}", value)
            case.figure(f"own_slope_{formulation}_{n}", clean)
            case.figure(f"first_break_{formulation}_{n}", first_break(case, formulation, n))
        case.figure(f"stiffest_{formulation}", max(slopes))
        case.figure(f"slope_rise_{formulation}", largest_rise(slopes))
        case.figure(f"own_slope_rise_{formulation}", largest_rise(own))
        peaks, clean = [], []
        for n in TORN[case.mode][formulation]:
            result = case.results[f"torn-{formulation}-{n}"]
            u, load = curve(result, COURSES[n])
            history = result.history
            peaks.append(load.max())
            clean.append(load.max() / numpy.sqrt(lattice_modulus(formulation, n) * lattice_toughness(formulation, n)))
            case.figure(f"peak_{formulation}_{n}", load.max())
            case.figure(f"own_peak_{formulation}_{n}", clean[-1])
            case.figure(f"peak_at_{formulation}_{n}", u[load.argmax()])
            case.figure(f"left_{formulation}_{n}", load[-1] / load.max())
            case.figure(f"crack_energy_{formulation}_{n}", (history["fracture"] + history["viscous"])[-1] / (TOUGHNESS * LIGAMENT))
            case.figure(f"bonds_{formulation}_{n}", history["broken"][-1] / crossing_bonds(n))
            case.figure(f"offset_{formulation}_{n}", offset(result))
            case.figure(f"balance_{formulation}_{n}", abs(history["balance"]).max() / history["reaction"][-1])
        if len(peaks) > 1:
            case.figure(f"peak_rise_{formulation}", largest_rise(peaks))
            case.figure(f"own_peak_rise_{formulation}", largest_rise(clean))
    for n in SLOPES[case.mode]:
        case.figure(f"slope_ratio_{n}", slope(case, "bond", n) / slope(case, "cpd", n))


def draw_crack(axes, result, n):
    """The outer layer of points, displaced twentyfold, coloured by damage."""
    data = result.exodus
    layer = data.points[:, 2] < 0.5 / n + 1e-9
    place = (data.points + 20 * data.displacement())[layer]
    shown = axes.scatter(place[:, 0], place[:, 1], c=data.nodal("damage")[layer], s=(195 / n) ** 2, marker="s", cmap=picture.DAMAGE, vmin=0,
                         vmax=0.6, linewidths=0)
    axes.set(aspect="equal", xlabel="x (mm)", title=f"cpd, n = {n}, torn (displacements × 20)")
    axes.set_facecolor(picture.GROUND)
    return shown


def pictures(case, folder):
    figure, (left, right) = plt.subplots(1, 2, figsize=(11.5, 5), layout="constrained", width_ratios=(1.25, 1))
    colours = dict(zip(SLOPES["full"], plt.get_cmap("plasma")(numpy.linspace(0.05, 0.85, 7))))
    for formulation, style in (("cpd", "-"), ("bond", "--")):
        for n in SLOPES[case.mode]:
            if n in TORN[case.mode][formulation]:
                left.plot(*curve(case.results[f"torn-{formulation}-{n}"], COURSES[n]), style, color=colours[n], lw=1.6,
                          label=f"{NAMES[formulation]}, n = {n}")
            elif formulation == "cpd":
                u = first_break(case, formulation, n)
                left.plot((0, u), (0, u * slope(case, formulation, n)), style, color=colours[n], lw=1, label=f"cpd, n = {n}, to the first bond")
    left.plot([0, 5.1], [0, 62.5], color="#8a98a8", lw=1, zorder=0, label="linear theory to its onset, plane stress")
    left.set(xlabel="displacement of the top (µm)", ylabel="load (N)", xlim=(0, 6.2), ylim=(0, 70), title="Figs. 3 and 4")
    left.grid(color="#e3e8ee")
    left.legend(fontsize=7, loc="upper left")
    n = TORN[case.mode]["cpd"][-1]
    figure.colorbar(draw_crack(right, case.results[f"torn-cpd-{n}"], n), ax=right, shrink=0.8, label="damage")
    picture.save(figure, folder / "figure.png", dpi=120)
    return [("figure.png", "Load over displacement, and the torn block")]
