"""Numbers of interactions and constants of continuum-kinematics-based peridynamics.

Counts are those that `cleave check` prints.  The numbers of a full neighbourhood follow from four small blocks: a set of
span s fits prod (n_d - s_d) times in a block of n_d points, so that the mixed difference in the three n_d counts each
set once.  Constants follow from the forces of a run, by sums written as they are printed in the paper (tools/ordered_sums.py).
"""
import pathlib
import re

import matplotlib.pyplot as plt
import numpy
from tools import deck, ordered_sums, picture
from tools.simulation import Run

HERE = pathlib.Path(__file__).resolve().parent

SIZES = (40, 50, 60, 70, 80, 90, 100)             # n of Table 1
SPACING, SMALL = 1.125, ((5, 5, 5), (5, 5, 6), (5, 6, 6), (6, 6, 6))
ORDERS = (1, 2, 6)                               # how often an ordered sum has one set of a point
PLATE = {"lattice.spacing": SPACING, "peridynamics.horizon": 3.391875, "material.E": 190000, "material.nu": 0.3}
# name: changes of impact.nml; lengths and times of the second are 45 times those of the first
IMPACTS = {
    "block": {},
    "plate": PLATE | {"lattice.size": (5.625, 4.5, 4.5), "zone.lower": (2.7, -1, -1), "run.t_end": 45 * 2.5e-5},
}


def counted(name, text):
    return Run(name, command=("check", "deck.nml"), inputs={"deck.nml": text})


def runs(mode):
    block, plate = ((HERE / name).read_text(encoding="utf-8") for name in ("block.nml", "plate.nml"))
    made = [counted(f"block-{n}", deck.vary(block, {"lattice.spacing": 1 / n})) for n in SIZES]
    whole = re.sub(r"(?ms)^&notch$.*?^/$", "", plate)
    made += [counted("plate", whole), counted("notched", plate)]
    for small in SMALL:
        changes = {"lattice.size": tuple(SPACING * n for n in small), "cpd.C2": 1.0}
        made.append(counted(small_name(small), deck.vary(whole, changes)))
    return made + [Run(f"impact-{name}", "impact.nml", changes) for name, changes in IMPACTS.items()]


def small_name(points):
    return "small-" + "".join(str(n) for n in points)


# ---- what cleave check printed

def printed(case, name, pattern):
    """The numbers at the groups of a pattern."""
    text = case.results[name].path(".csv").read_text(encoding="utf-8")
    found = re.search(pattern, text)
    if found is None:
        raise ValueError(f"cleave check of {name} printed no '{pattern}':\n{text}")
    return found.groups()


def interactions(case, name):
    """One-, two- and three-neighbour interactions, ordered sets."""
    return [int(n) for n in printed(case, name, r"(\d+) one-neighbour, (\d+) two-neighbour, (\d+) three-neighbour")]


def megabytes(case, name):
    value, unit = printed(case, name, r"memory ([\d.e+]+) (kB|MB|GB)")
    return float(value) * {"kB": 1e-3, "MB": 1, "GB": 1e3}[unit]


def full_hood(case):
    """Unordered sets of an inner point, by the third mixed difference; the lattice is the same along all axes."""
    counts = [numpy.array(interactions(case, small_name(small))) for small in SMALL]
    return (counts[3] - 3 * counts[2] + 3 * counts[1] - counts[0]) / ORDERS


def check(case):
    for n in SIZES:
        case.figure(f"bonds_{n}", interactions(case, f"block-{n}")[0])
    for n in (40, 100):
        crossing = int(printed(case, f"block-{n}", r"(\d+) bonds inert")[0])
        case.figure(f"whole_bonds_{n}", interactions(case, f"block-{n}")[0] - 2 * crossing)
    for name in ("plate", "notched"):
        one, _, three = interactions(case, name)
        for row in ("", "_row") if name == "notched" else ("",):
            case.figure(f"{name}_one{row}", one)
            case.figure(f"{name}_three{row}", three)
    for name, value in zip(("one", "pairs", "triples"), full_hood(case)):
        case.figure(f"hood_{name}", value)
    case.figure("plate_memory", megabytes(case, "notched"))
    for name in IMPACTS:
        horizon = IMPACTS[name].get("peridynamics.horizon", 0.0675)
        spacing = IMPACTS[name].get("lattice.spacing", 0.025)
        constants, left = ordered_sums.constants(case.results[f"impact-{name}"].exodus, horizon, spacing**3)
        case.figure(f"C1_{name}", constants[0])
        case.figure(f"C2_{name}", constants[1] / constants[0] * horizon**3)
        case.figure(f"C3_{name}", constants[2] / (constants[0] / horizon**8 if name == "block" else 1))
        case.figure(f"fit_{name}", left)


def pictures(case, folder):
    figure, (left, right) = plt.subplots(1, 2, figsize=(11, 4.4), layout="constrained")
    found = [interactions(case, f"block-{n}")[0] for n in SIZES]
    paper = {name: int(reference.value) for name, reference in case.ledger.references.items() if reference.value}
    left.semilogy(SIZES, [paper[f"bonds_{n}"] for n in SIZES], "o", ms=9, mfc="none", color="#1d2733", label="paper, Table 1")
    left.semilogy(SIZES, found, "+", ms=9, color="#c4173a", label="cleave check")
    left.set(xlabel="points along an edge, n", ylabel="one-neighbour interactions", title="Block, horizon 0.0675 mm")
    left.legend()
    names, places = ("one-neighbour", "three-neighbour"), numpy.arange(2)
    bars = {"paper": (paper["notched_one"], paper["notched_three"]), "cleave, notched": interactions(case, "notched")[::2],
            "cleave, no notches": interactions(case, "plate")[::2]}
    for number, (label, values) in enumerate(bars.items()):
        shown = right.bar(places + 0.27 * (number - 1), values, 0.25, label=label, color=("#1d2733", "#c4173a", "#f7c548")[number])
        right.bar_label(shown, [f"{value:,}" for value in values], fontsize=7, rotation=90, padding=3)
    right.set_yscale("log")
    right.set_xticks(places, names)
    right.set(ylabel="ordered interactions", title="Plate, 88 x 177 x 8 points", ylim=(1e5, 1e14))
    right.legend(fontsize=8, ncols=3, loc="upper left")
    picture.save(figure, folder / "figure.png", dpi=130)
    return [("figure.png", "Interactions of the block and of the plate against the paper")]
