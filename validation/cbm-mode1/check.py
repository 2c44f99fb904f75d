"""Figs. 12 and 13 of the Continuum Bond Method paper: dissipated over total energy for five meshes.

The deck is mode1.nml; the runs differ in the spacing of the refined strip.  "Dissipated" is the energy released
by broken bonds and taken by the artificial viscosity; "total" is elastic + kinetic + dissipated.
"""
import math

import matplotlib.pyplot as plt
import numpy
from tools import cracks, picture
from tools.simulation import Mesh, Run

WIDTH, MIDDLE, HALF_STRIP = 20e-3, 10e-3, 2e-3          # [m]
SPEED = math.sqrt(3.24e9 / (1190 * (1 - 0.35**2)))      # plate wave speed c0 [m/s]
PARTS = {"full": (4, 5, 6, 7, 8), "quick": (4, 5, 6)}   # spacings 1/4 mm ... 1/8 mm


def runs(mode):
    made = []
    for part in PARTS[mode]:
        spacing = 1e-3 / part
        mesh = Mesh("../cbm-branching/plate.geo", (("W", 20), ("strip", 4), ("l_ref", 1 / part)))
        changes = {"fracture.length": spacing, "viscosity.length": spacing, "run.time_step": 0.1 * spacing / SPEED}
        made.append(Run(f"l{part}", "mode1.nml", changes, mesh))
    return made


def energies(history):
    """Dissipated and total energy over time."""
    dissipated = history["fracture"] + history["viscous"]
    return dissipated, dissipated + history["elastic"] + history["kinetic"]


def dissipated_part(history):
    """The paper's ordinate of Fig. 12: dissipated energy over the total at the end."""
    dissipated, total = energies(history)
    return dissipated / total[-1]


def closure(history):
    """Largest error of the energy balance over the run, relative to the work done by the edges."""
    work = abs(history["external"][-1] + history["reaction"][-1])
    return abs(history["balance"]).max() / work


def check(case):
    ends = {}
    for part in PARTS[case.mode]:
        result, name = case.results[f"l{part}"], f"l{part}"
        events, curve = result.events, dissipated_part(result.history)
        ends[name] = curve[-1]
        case.figure(f"particles_{name}", len(result.exodus.points))
        case.figure(f"dissipated_{name}", curve[-1])
        case.figure(f"backslide_{name}", max(0.0, -numpy.diff(curve).min()))
        case.figure(f"closure_{name}", closure(result.history))
        case.figure(f"offset_{name}", abs(events["y"] - MIDDLE).max() / HALF_STRIP)
        case.figure(f"arrival_{name}", cracks.arrival_time(events["x"], events["time"], WIDTH, 1e-3 / part) * 1e6)
        case.figure(f"broken_{name}", len(events["time"]))
    case.figure("spread", max(ends.values()) - min(ends.values()))


def pictures(case, folder):
    figure, axes = plt.subplots(figsize=(8, 4.6), layout="constrained")
    for part in PARTS[case.mode]:
        history = case.results[f"l{part}"].history
        axes.plot(history["time"] * 1e6, dissipated_part(history), lw=1.5, label=f"1/{part} mm")
    axes.set(xlabel="time (µs)", ylabel="dissipated energy / total energy at the end", ylim=(0, 1))
    axes.legend(title="spacing")
    picture.save(figure, folder / "figure.png", dpi=130)
    made = [("figure.png", "Fig. 12: dissipated energy over the total energy at the end")]
    for part in PARTS[case.mode]:
        file = f"crack-l{part}.png"
        result = case.results[f"l{part}"].path(".exo")
        picture.picture(result, folder / file, title=f"Fig. 13, l = 1/{part} mm, damage", deform="1")
        made.append((file, f"Fig. 13: crack path with l = 1/{part} mm"))
    return made
