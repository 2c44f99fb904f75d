"""Figs. 14-16 of the Continuum Bond Method paper: seven runs of the branching plate, their figures and pictures.

The deck is branching.nml (run 14a); every other run is that deck with the values in `runs`.  Measures
are defined in tools/cracks.py, bands in reference.csv.
"""
import math

import matplotlib.pyplot as plt
from tools import cracks, picture
from tools.simulation import Mesh, Run

WIDTH, CRACK = 30e-3, 3e-3                    # plate, pre-crack [m]
SPEED = math.sqrt(3.24e9 / (1190 * (1 - 0.35**2)))  # plate wave speed c0 [m/s]
PARTS = {"full": 6, "quick": 3}               # refined spacings in a millimetre

# name: changes of the deck.  15b needs a longer run; its crack starts late.
VARIANTS = {
    "14a": {},
    "14b": {"fracture.Gf": 250},
    "14c": {"fracture.Gf": 500},
    "15a": {"load(3).value": 0.75},
    "15b": {"load(3).value": 0.15, "run.t_end": 400e-6, "output.every_time": 20e-6},
    "16a": {},
    "16b": {"viscosity.beta": 1.0},
}
STATED_ARRIVAL = ("14a", "14b", "14c", "15a")  # runs whose arrival the paper gives


def spacing_of(mode):
    return 1e-3 / PARTS[mode]


def plate(mode, second=False):
    """The plate's mesh; the second one is rearranged by target sizes 0.3 % smaller."""
    parameters = (("l_ref", 1 / PARTS[mode]),) + ((("factor", 0.997),) if second else ())
    return Mesh("plate.geo", parameters)


def resolution(spacing):
    """Everything in the deck that follows the refined spacing."""
    return {"fracture.length": spacing, "viscosity.length": spacing, "run.time_step": 0.1 * spacing / SPEED}


def runs(mode):
    return [Run(name, "branching.nml", resolution(spacing_of(mode)) | changes, plate(mode, second=name == "16a"))
            for name, changes in VARIANTS.items()]


class Crack:
    """What one run broke, when and where."""

    def __init__(self, result, spacing):
        events = result.events
        self.x, self.y, self.time = events["x"], events["y"], events["time"]
        self.spacing = spacing
        self.arrival = cracks.arrival_time(self.x, self.time, WIDTH, spacing)
        self.broken = len(self.x)
        self.first = self.time.min() if self.broken else math.nan
        self.branches, self.most_branches = cracks.branches(self.x, self.y, WIDTH / 3, WIDTH - spacing, spacing)
        self.tip_speed = cracks.tip_speed(self.x, self.time, WIDTH / 2, WIDTH - spacing)


def closure(history):
    """Largest error of the energy balance over the run, relative to the work done by the edges."""
    work = abs(history["external"][-1] + history["reaction"][-1])
    return abs(history["balance"]).max() / work


def check(case):
    spacing = spacing_of(case.mode)
    found = {name: Crack(result, spacing) for name, result in case.results.items()}
    case.figure("particles", len(case.results["14a"].exodus.points))
    case.figure("particles_16a", len(case.results["16a"].exodus.points))
    for name, crack in found.items():
        case.figure(f"arrival_{name}", crack.arrival * 1e6)
        case.figure(f"first_break_{name}", crack.first * 1e6)
        case.figure(f"broken_{name}", crack.broken)
        case.figure(f"branches_{name}", crack.branches)
        case.figure(f"most_branches_{name}", crack.most_branches)
        case.figure(f"tip_speed_{name}", crack.tip_speed)
        if name in STATED_ARRIVAL:
            case.figure(f"mean_speed_{name}", (WIDTH - CRACK) / crack.arrival)
        case.figure(f"closure_{name}", closure(case.results[name].history))
    trends(case, found)


def trends(case, found):
    """The paper's four statements, as differences that must have a sign or stay small."""
    a, b, c = found["14a"], found["14b"], found["14c"]
    slow, slowest, other, damped = found["15a"], found["15b"], found["16a"], found["16b"]
    case.figure("trend1_arrival_14b-14a", (b.arrival - a.arrival) * 1e6)
    case.figure("trend1_arrival_14c-14b", (c.arrival - b.arrival) * 1e6)
    case.figure("trend2_broken_14b/14a", b.broken / a.broken)
    case.figure("trend2_broken_14c/14b", c.broken / b.broken)
    case.figure("trend2_broken_15a/14a", slow.broken / a.broken)
    case.figure("trend2_broken_15b/15a", slowest.broken / slow.broken)
    case.figure("trend3_arrival_16b-14a", (damped.arrival - a.arrival) * 1e6)
    case.figure("trend3_broken_16b/14a", damped.broken / a.broken)
    case.figure("trend4_arrival_16a/14a", other.arrival / a.arrival)
    case.figure("trend4_path_distance", cracks.path_distance(other.x, other.y, a.x, a.y) / a.spacing)


def frame_at_arrival(result, spacing):
    """The first frame in which a crack has arrived; the last one if none has."""
    arrival, times = Crack(result, spacing).arrival, result.exodus.times
    return int((times >= arrival).argmax()) if math.isfinite(arrival) else len(times) - 1


def pictures(case, folder):
    spacing = spacing_of(case.mode)
    first = case.results["14a"]
    picture.picture(first.path(".exo"), folder / "figure.png", step=frame_at_arrival(first, spacing), title="PMMA plate, damage")
    panels(case, folder / "runs.png")
    tip_figure(case, folder / "tip.png")
    energy_figure(case, folder / "energy.png")
    return [("figure.png", "Run 14a when its crack has reached the right edge: damage on the deformed plate"),
            ("runs.png", "All runs, each when its crack has reached the right edge"),
            ("tip.png", "Position of the foremost crack tip; crosses: arrival times of the paper"),
            ("energy.png", "Energies of run 14a")]


def panels(case, file):
    """All runs side by side, each when its crack has arrived."""
    figure, grid = plt.subplots(3, 3, figsize=(12, 8.4), layout="constrained")
    for axes in grid.flat[len(case.results):]:
        axes.set_axis_off()
    for (name, result), axes in zip(case.results.items(), grid.flat):
        frame = frame_at_arrival(result, spacing_of(case.mode))
        picture.draw_plate(axes, result.exodus, frame, "damage", "5", edge=0.5)
        axes.set(xticks=[], yticks=[], xlabel="", ylabel="")
        time = picture.time_text(result.exodus.times[frame])
        axes.set_title(f"{name}   t = {time}", fontsize=11, loc="left", color=picture.INK)
    picture.save(figure, file, dpi=110)


def tip_figure(case, file):
    figure, axes = plt.subplots(figsize=(8, 4.6), layout="constrained")
    for name, result in case.results.items():
        events = result.events
        time, front = cracks.tip_path(events["x"], events["time"])
        line, = axes.plot(time * 1e6, front * 1e3, lw=1.4, label=name)
        reference = case.ledger.references[f"arrival_{name}"]
        if name in STATED_ARRIVAL:
            axes.plot([reference.value], [WIDTH * 1e3], "x", ms=9, mew=2, color=line.get_color())
    axes.set(xlabel="time (µs)", ylabel="foremost tip x (mm)")
    axes.legend(title="run")
    picture.save(figure, file, dpi=130)


def energy_figure(case, file):
    history = case.results["14a"].history
    figure, axes = plt.subplots(figsize=(8, 4.2), layout="constrained")
    for name in ("elastic", "kinetic", "fracture", "viscous"):
        axes.plot(history["time"] * 1e6, history[name], label=name)
    axes.plot(history["time"] * 1e6, history["external"] + history["reaction"], "k--", label="work of the edges")
    axes.set(xlabel="time (µs)", ylabel="energy (J/m)")
    axes.legend()
    picture.save(figure, file, dpi=130)
