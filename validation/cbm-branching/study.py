#!/usr/bin/env python3
"""How much the assumptions of branching.nml matter: runs at the paper's resolution with one thing changed.

    validation/cbm-branching/study.py [NAME...] [--cleave PATH]      prints the tables of README.md
"""
import pathlib
import sys

HERE = pathlib.Path(__file__).resolve().parent
sys.path[:0] = [str(HERE.parent), str(HERE)]
from tools import python  # noqa: E402

if __name__ == "__main__":
    python.ensure(__file__)
import check  # noqa: E402
from tools import sensitivity  # noqa: E402
from tools.simulation import Mesh, Run  # noqa: E402

SPACING = check.spacing_of("full")
HALF_STEP = {"run.time_step": 0.05 * SPACING / check.SPEED}
FACTORS = (0.990, 0.995, 0.997, 0.998, 1.003)
CHANGES = {
    "as in the deck": {},
    "ramp 10 us": {"load(3).ramp": 10e-6},
    "ramp 50 us": {"load(3).ramp": 50e-6},
    "ramp 60 us": {"load(3).ramp": 60e-6},
    "viscosity central": {"viscosity.form": "central"},
    "viscosity paper": {"viscosity.form": "paper"},
    "beta 0.25": {"viscosity.beta": 0.25},
    "length local": {"fracture.length_mode": "local"},
    "half the step": HALF_STEP,
    "prescription paper": {"load(3).prescription": "paper"},
    "stabilisation 0.05": {"stabilisation.form": "blend", "stabilisation.alpha": 0.05},
}
STUDIED = {
    "14a": tuple(CHANGES),
    "14b": ("as in the deck", "ramp 10 us", "ramp 50 us", "ramp 60 us", "viscosity paper", "half the step"),
}
COLUMNS = ["particles", "first break (us)", "arrival (us)", "broken bonds", "branches", "most", "closure"]


def plate(factor=1.0):
    return Mesh("plate.geo", (("l_ref", 1 / check.PARTS["full"]), ("factor", factor)))


def runs():
    made = {}
    for variant, names in STUDIED.items():
        base = check.resolution(SPACING) | check.VARIANTS[variant]
        for name in names:
            made[f"{variant}, {name}"] = (base | CHANGES[name], plate())
        for factor in FACTORS:
            made[f"{variant}, mesh factor {factor:g}"] = (base, plate(factor))
    return {name: Run(name.replace(", ", "-").replace(" ", "-"), "branching.nml", *rest) for name, rest in made.items()}


def row(result):
    crack = check.Crack(result, SPACING)
    return [f"{len(result.exodus.points)}", f"{crack.first * 1e6:.1f}", f"{crack.arrival * 1e6:.1f}", f"{crack.broken}",
            f"{crack.branches:.2f}", f"{crack.most_branches}", f"{check.closure(result.history):.1e}"]


if __name__ == "__main__":
    sensitivity.main(HERE, runs(), COLUMNS, row)
