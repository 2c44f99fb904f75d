"""A homogeneously strained cube of peridynamic points, and a free block: elastic constants, surfaces, forces, momentum.

Energy of the middle point gives K, C11 and C44 of the lattice, hence Poisson's ratio along a lattice axis; the force of
all points along the motion is the derivative of the energy; energies at the middle of a face follow from its hood.
"""
import pathlib

import matplotlib.pyplot as plt
import numpy
from tools import deck, picture
from tools.simulation import Run

HERE = pathlib.Path(__file__).resolve().parent
YOUNG, POINTS, HORIZON, STRAIN = 210000.0, 13, 3.015, 1e-3
AXES = "xyz"
# mode: gradient of the displacement over STRAIN, as {(component, along): factor}
MODES = {"hydrostatic": {(0, 0): 1, (1, 1): 1, (2, 2): 1}, "uniaxial": {(0, 0): 1}, "shear": {(0, 1): 1}}
RATIOS = {"bond_pd": (0.25,), "cpd": (0.25, 0.3, 0.4), "lps": (0.1, 0.25, 0.4)}
FREE = {"bond_pd": {"material.nu": 0.25}, "cpd": {}, "lps": {}, "cpd_paper": {"cpd.weights": "paper"}}


def for_formulation(text, formulation):
    """The deck with another formulation, and without the options that it does not have."""
    if formulation == "cpd":
        return text
    first = text.index("&cpd")
    return deck.vary(text[:first] + text[text.index("\n/\n", first) + 3:], {"body.formulation": formulation})


def layers(mode):
    """Zones and loads that impose a gradient layer by layer."""
    made = ""
    for axis in {along for _, along in MODES[mode]}:
        for layer in range(POINTS):
            centre, normal = numpy.zeros(3), numpy.zeros(3, int)
            centre[axis], normal[axis] = layer + 0.5, 1
            made += (f"&zone\n  name = 'l{AXES[axis]}{layer}', shape = 'plane', centre = {deck.written(centre.tolist())}, "
                     f"normal = {deck.written(normal.tolist())}\n/\n")
    for component, name in enumerate(AXES):
        along = [(axis, factor) for (row, axis), factor in MODES[mode].items() if row == component]
        moved = [(f"l{AXES[axis]}{layer}", STRAIN * factor * (layer + 0.5)) for axis, factor in along for layer in range(POINTS)]
        for zone, value in moved or [("all", 0.0)]:
            made += (f"&load\n  name = '{name}{zone}', kind = 'displacement', set = '{zone}', directions = '{name}'\n"
                     f"  value = {value!r}, curve = 'linear', ramp = 1e-3\n/\n")
    return made


def strained(formulation, ratio, mode):
    text = (HERE / "patch.nml").read_text(encoding="utf-8")
    text = deck.vary(for_formulation(text, formulation), {"material.nu": ratio}) + layers(mode)
    name = f"{formulation}-{ratio}-{mode}"
    return Run(name, command=(f"{name}.nml",), inputs={f"{name}.nml": text})


def flight(name, changes):
    text = (HERE / "flight.nml").read_text(encoding="utf-8")
    text = deck.vary(for_formulation(text, name.split("_paper")[0]), changes)
    return Run(f"flight-{name}", command=(f"flight-{name}.nml",), inputs={f"flight-{name}.nml": text})


def runs(mode):
    made = [strained(formulation, ratio, motion) for formulation in RATIOS for ratio in RATIOS[formulation] for motion in MODES]
    return made + [flight(name, changes) for name, changes in FREE.items()]


# ---- figures

def point_at(data, place):
    return int(abs(data.points - numpy.array(place)).sum(axis=1).argmin())


def energy_at(case, formulation, ratio, mode, place):
    data = case.results[f"{formulation}-{ratio}-{mode}"].exodus
    return data.nodal("strain_energy_density")[point_at(data, place)]


def moduli(case, formulation, ratio):
    """K, C11 and C44 of the middle point, MPa."""
    found = {mode: energy_at(case, formulation, ratio, mode, (POINTS / 2,) * 3) / STRAIN**2 for mode in MODES}
    return found["hydrostatic"] / 4.5, 2 * found["uniaxial"], 2 * found["shear"]


def ratio_of(K, C11):
    """Poisson's ratio for tension along a lattice axis: C12/(C11 + C12) with 3 K = C11 + 2 C12."""
    C12 = (3 * K - C11) / 2
    return C12 / (C11 + C12)


def force_error(case, formulation, ratio):
    """Largest relative difference over the modes of the power of forces from the energy's central difference of fourth order."""
    worst = 0.0
    for mode in MODES:
        data = case.results[f"{formulation}-{ratio}-{mode}"].exodus
        E = [data.nodal("strain_energy_density", frame).sum() for frame in (-5, -4, -2, -1)]  # volumes are 1
        motion = (data.displacement(-2) - data.displacement(-4)) / 2
        power = -(data.vector("internal_force", -3) * motion).sum()
        worst = max(worst, abs(12 * power / (8 * (E[2] - E[1]) - (E[3] - E[0])) - 1))
    return worst


def hood_sum(place, weight):
    """Sum of L over the neighbours of a point, by a weight of their number."""
    grid = numpy.stack(numpy.meshgrid(*[numpy.arange(POINTS) + 0.5] * 3, indexing="ij"), -1).reshape(-1, 3)
    L = numpy.sqrt(((grid - place) ** 2).sum(axis=1))
    L = L[(L > 0) & (L <= HORIZON)]
    return weight(len(L)) * L.sum()


FACE, MIDDLE = (0.5, POINTS / 2, POINTS / 2), (POINTS / 2,) * 3
# energy at a face over that in the middle, all bonds equally stretched, nu = 1/4; a ball has V_H over N the same everywhere
SURFACE = {"bond_pd": hood_sum(FACE, lambda N: 1) / hood_sum(MIDDLE, lambda N: 1),
           "cpd": hood_sum(FACE, lambda N: 1) / hood_sum(MIDDLE, lambda N: 1), "lps": 1.0}


def drift(result):
    """Largest change of momentum over the momentum."""
    history = result.history
    momentum = numpy.column_stack([history[f"momentum_{axis}"] for axis in AXES])
    return abs(momentum - momentum[0]).max() / numpy.linalg.norm(momentum[0])


def check(case):
    for formulation, ratios in RATIOS.items():
        for ratio in ratios:
            name, (K, C11, C44) = f"{formulation}_{ratio}", moduli(case, formulation, ratio)
            case.figure(f"nu_{name}", ratio_of(K, C11))
            case.figure(f"K_{name}", K / (YOUNG / (3 * (1 - 2 * ratio))))
            case.figure(f"G_{name}", C44 / (YOUNG / (2 * (1 + ratio))))
            case.figure(f"force_{name}", force_error(case, formulation, ratio))
        face, middle = (energy_at(case, formulation, 0.25, "hydrostatic", place) for place in (FACE, MIDDLE))
        case.figure(f"surface_{formulation}", face / middle)
        case.figure(f"surface_error_{formulation}", abs(face / middle / SURFACE[formulation] - 1))
    for name in FREE:
        case.figure(f"momentum_{name}", drift(case.results[f"flight-{name}"]))


def pictures(case, folder):
    figure, (left, right) = plt.subplots(1, 2, figsize=(11, 4.4), layout="constrained")
    left.plot([0.05, 0.45], [0.05, 0.45], color="#f7c548", lw=4, label="material")
    styles = {"bond_pd": {"color": "#1d2733", "marker": "s", "ms": 11, "mfc": "none"}, "cpd": {"color": "#c4173a", "marker": "o", "ms": 7},
              "lps": {"color": "#1f6f8b", "marker": "x", "ms": 8}}
    for formulation, ratios in RATIOS.items():
        found = [moduli(case, formulation, ratio) for ratio in ratios]
        left.plot(ratios, [ratio_of(K, C11) for K, C11, _ in found], ls="none", label=formulation, **styles[formulation])
        data = case.results[f"{formulation}-0.25-hydrostatic"].exodus
        energies = data.nodal("strain_energy_density")
        line = [energies[point_at(data, (layer + 0.5, POINTS / 2, POINTS / 2))] for layer in range(POINTS)]
        right.plot(numpy.arange(POINTS) + 0.5, numpy.array(line) / line[POINTS // 2], lw=1, label=formulation,
                   **styles[formulation])
    left.set(xlabel="Poisson's ratio of the material", ylabel="of the points, along a lattice axis", title="Middle of the cube")
    right.set(xlabel="way through the cube, spacings", ylabel="energy density over that in the middle",
              title="Hydrostatic strain, nu = 1/4", ylim=(0, 1.1))
    for axes in (left, right):
        axes.legend(fontsize=8)
        axes.grid(color="#e3e8ee")
    picture.save(figure, folder / "figure.png", dpi=130)
    return [("figure.png", "Poisson's ratio of the points; energy from face to face")]
