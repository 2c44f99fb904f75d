#!/usr/bin/env python3
"""How much mesh and assumptions matter for the dissipated part of the energy: runs of mode1.nml with one thing changed.

    validation/cbm-mode1/study.py [NAME...] [--cleave PATH]      prints the table of README.md
"""
import pathlib
import sys

HERE = pathlib.Path(__file__).resolve().parent
sys.path[:0] = [str(HERE.parent), str(HERE)]
from tools import python  # noqa: E402

if __name__ == "__main__":
    python.ensure(__file__)
import check  # noqa: E402
import numpy  # noqa: E402
from tools import cracks, sensitivity  # noqa: E402
from tools.simulation import Run  # noqa: E402

FULL = {run.name: run for run in check.runs("full")}
RAMP = "load(3).ramp"


def variation(name, part, changes=None, factor=1.0):
    base = FULL[f"l{part}"]
    parameters = base.mesh.parameters + (("factor", factor),)
    mesh = type(base.mesh)(base.mesh.geometry, parameters)
    return Run(name.replace(" ", "-").replace(",", ""), base.deck, base.changes | (changes or {}), mesh)


def runs():
    made = {}
    for part in check.PARTS["full"]:
        for ramp in (55, 10, 30, 80):
            made[f"1/{part} mm, ramp {ramp} us"] = variation(f"l{part} ramp {ramp}", part, {RAMP: ramp * 1e-6})
        for factor in (0.995, 0.997, 1.003):
            made[f"1/{part} mm, mesh factor {factor:g}"] = variation(f"l{part} factor {factor:g}", part, factor=factor)
    made["1/6 mm, viscosity paper"] = variation("l6 viscosity paper", 6, {"viscosity.form": "paper"})
    return made


def longest_rest(x, time):
    """Longest time without progress of the tip between the first quarter of its way and its arrival."""
    moment, front = cracks.tip_path(x, time)
    inside = (front > 12.5e-3) & (front < check.WIDTH - 0.5e-3)
    return numpy.diff(moment[inside]).max()


def row(result):
    events, history = result.events, result.history
    _, total = check.energies(history)
    arrival = cracks.arrival_time(events["x"], events["time"], check.WIDTH, result.run.changes["fracture.length"])
    return [f"{len(result.exodus.points)}", f"{events['time'].min() * 1e6:.1f}", f"{arrival * 1e6:.1f}",
            f"{longest_rest(events['x'], events['time']) * 1e6:.1f}", f"{len(events['x'])}", f"{total[-1]:.3f}",
            f"{check.dissipated_part(history)[-1]:.3f}"]


if __name__ == "__main__":
    sensitivity.main(HERE, runs(), ["particles", "first break (us)", "arrival (us)", "longest rest (us)", "broken bonds",
                                    "total energy (J/m)", "dissipated part"], row)
