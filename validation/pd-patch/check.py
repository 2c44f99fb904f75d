"""A homogeneously strained cube or square of peridynamic points, and a free block: elastic constants, surfaces, forces, momentum.

Energy of the middle point gives K, C11 and C44 of the lattice, hence Poisson's ratio along a lattice axis; the force of
all points along the motion is the derivative of the energy; energies at the middle of a face follow from its hood.
In the plane K is half of C11 + C12.
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
THIRD = 0.3333333333333333                       # of bond-based peridynamics in plane stress
PLANES = {"plane_strain": RATIOS, "plane_stress": {"bond_pd": (THIRD,), "cpd": (THIRD, 0.4), "lps": (0.1, 0.25, 0.4)}}
FREE = {"bond_pd": {"material.nu": 0.25}, "cpd": {}, "lps": {}, "cpd_paper": {"cpd.weights": "paper"}}


def for_formulation(text, formulation):
    """The deck with another formulation, and without the options that it does not have."""
    if formulation == "cpd":
        return text
    return deck.vary(deck.without(text, "cpd"), {"body.formulation": formulation})


def gradient(mode, axes):
    """The entries of a mode for a body with these axes."""
    return {entry: factor for entry, factor in MODES[mode].items() if max(entry) < len(axes)}


def layers(mode, axes):
    """Zones and loads that impose a gradient layer by layer."""
    made, entries = "", gradient(mode, axes)
    for axis in {along for _, along in entries}:
        for layer in range(POINTS):
            centre, normal = numpy.zeros(3), numpy.zeros(3, int)
            centre[axis], normal[axis] = layer + 0.5, 1
            made += (f"&zone\n  name = 'l{AXES[axis]}{layer}', shape = 'plane', centre = {deck.written(centre.tolist())}, "
                     f"normal = {deck.written(normal.tolist())}\n/\n")
    for component, name in enumerate(axes):
        along = [(axis, factor) for (row, axis), factor in entries.items() if row == component]
        moved = [(f"l{AXES[axis]}{layer}", STRAIN * factor * (layer + 0.5)) for axis, factor in along for layer in range(POINTS)]
        for zone, value in moved or [("all", 0.0)]:
            made += (f"&load\n  name = '{name}{zone}', kind = 'displacement', set = '{zone}', directions = '{name}'\n"
                     f"  value = {value!r}, curve = 'linear', ramp = 1e-3\n/\n")
    return made


def label(kinematics, formulation, ratio):
    """Part of names: '3d' is left out."""
    return f"{'' if kinematics == '3d' else kinematics + '_'}{formulation}_{round(ratio, 4):g}"


def strained(kinematics, formulation, ratio, mode):
    changes = {"material.nu": ratio}
    if kinematics != "3d":
        changes |= {"body.kinematics": kinematics, "lattice.type": "square", "lattice.size": (POINTS, POINTS, 0)}
    text = deck.vary(for_formulation((HERE / "patch.nml").read_text(encoding="utf-8"), formulation), changes)
    text += layers(mode, AXES if kinematics == "3d" else AXES[:2])
    name = f"{label(kinematics, formulation, ratio)}-{mode}"
    return Run(name, command=(f"{name}.nml",), inputs={f"{name}.nml": text})


def flight(name, changes):
    text = (HERE / "flight.nml").read_text(encoding="utf-8")
    text = deck.vary(for_formulation(text, name.split("_paper")[0]), changes)
    return Run(f"flight-{name}", command=(f"flight-{name}.nml",), inputs={f"flight-{name}.nml": text})


def patches():
    """Kinematics, formulations and Poisson's ratios."""
    for kinematics, ratios in ({"3d": RATIOS} | PLANES).items():
        for formulation in ratios:
            for ratio in ratios[formulation]:
                yield kinematics, formulation, ratio


def runs(mode):
    made = [strained(*patch, motion) for patch in patches() for motion in MODES]
    return made + [flight(name, changes) for name, changes in FREE.items()]


# ---- figures

def point_at(data, place):
    return int(abs(data.points - numpy.array(place)).sum(axis=1).argmin())


def energy_at(case, patch, mode, place):
    data = case.results[f"{label(*patch)}-{mode}"].exodus
    return data.nodal("strain_energy_density")[point_at(data, place)]


def moduli(case, patch):
    """K, C11 and C44 of the middle point, MPa."""
    deep = patch[0] == "3d"
    middle = (POINTS / 2, POINTS / 2, POINTS / 2 if deep else 0)
    found = {mode: energy_at(case, patch, mode, middle) / STRAIN**2 for mode in MODES}
    return found["hydrostatic"] / (4.5 if deep else 2), 2 * found["uniaxial"], 2 * found["shear"]


def material_moduli(kinematics, ratio):
    """K as defined above, and the shear modulus."""
    shear = YOUNG / (2 * (1 + ratio))
    return {"3d": YOUNG / (3 * (1 - 2 * ratio)), "plane_strain": shear / (1 - 2 * ratio),
            "plane_stress": shear * (1 + ratio) / (1 - ratio)}[kinematics], shear


def ratio_of(kinematics, K, C11):
    """Poisson's ratio for tension along a lattice axis."""
    C12 = (3 * K - C11) / 2 if kinematics == "3d" else 2 * K - C11
    return C12 / C11 if kinematics == "plane_stress" else C12 / (C11 + C12)


def force_error(case, patch):
    """Largest relative difference over the modes of the power of forces from the energy's central difference of fourth order."""
    worst = 0.0
    for mode in MODES:
        data = case.results[f"{label(*patch)}-{mode}"].exodus
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
    for patch in patches():
        (kinematics, _, ratio), name = patch, label(*patch)
        (K, C11, C44), (bulk, shear) = moduli(case, patch), material_moduli(kinematics, ratio)
        case.figure(f"nu_{name}", ratio_of(kinematics, K, C11))
        case.figure(f"K_{name}", K / bulk)
        case.figure(f"G_{name}", C44 / shear)
        case.figure(f"force_{name}", force_error(case, patch))
    for formulation in RATIOS:
        face, middle = (energy_at(case, ("3d", formulation, 0.25), "hydrostatic", place) for place in (FACE, MIDDLE))
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
        for kinematics, shade in (("3d", 1.0), ("plane_strain", 0.5), ("plane_stress", 0.25)):
            present = (PLANES | {"3d": RATIOS})[kinematics][formulation]
            found = [moduli(case, (kinematics, formulation, ratio)) for ratio in present]
            left.plot(present, [ratio_of(kinematics, K, C11) for K, C11, _ in found], ls="none", alpha=shade,
                      label=f"{formulation}, {kinematics.replace('_', ' ')}", **styles[formulation])
        data = case.results[f"{label('3d', formulation, 0.25)}-hydrostatic"].exodus
        energies = data.nodal("strain_energy_density")
        line = [energies[point_at(data, (layer + 0.5, POINTS / 2, POINTS / 2))] for layer in range(POINTS)]
        right.plot(numpy.arange(POINTS) + 0.5, numpy.array(line) / line[POINTS // 2], lw=1, label=formulation,
                   **styles[formulation])
    left.set(xlabel="Poisson's ratio of the material", ylabel="of the points, along a lattice axis", title="Middle of the body")
    right.set(xlabel="way through the cube, spacings", ylabel="energy density over that in the middle",
              title="Hydrostatic strain, nu = 1/4", ylim=(0, 1.1))
    for axes in (left, right):
        axes.legend(fontsize=7)
        axes.grid(color="#e3e8ee")
    picture.save(figure, folder / "figure.png", dpi=130)
    return [("figure.png", "Poisson's ratio of the points; energy from face to face")]
