#!/usr/bin/env python3
"""How much the assumptions of branching.nml matter: run 14a (and others) at the paper's resolution with one thing changed.

    validation/cbm-branching/sensitivity.py [NAME...] [--cleave PATH] [--threads N]

Prints the table of README.md.  About half a minute a line.
"""
import argparse
import pathlib
import sys

HERE = pathlib.Path(__file__).resolve().parent
sys.path[:0] = [str(HERE.parent), str(HERE)]
from tools import python  # noqa: E402

if __name__ == "__main__":
    python.ensure(__file__)
import check  # noqa: E402
from tools import simulation  # noqa: E402

LOCAL = {"fracture.length_mode": "local"}
STUDIES = {
    "as-in-the-deck": ("14a", {}, 1),
    "ramp-10us": ("14a", {"load(3).ramp": 10e-6}, 1),
    "ramp-50us": ("14a", {"load(3).ramp": 50e-6}, 1),
    "ramp-60us": ("14a", {"load(3).ramp": 60e-6}, 1),
    "viscosity-central": ("14a", {"viscosity.form": "central"}, 1),
    "viscosity-paper": ("14a", {"viscosity.form": "paper"}, 1),
    "beta-0.25": ("14a", {"viscosity.beta": 0.25}, 1),
    "criterion-local-length": ("14a", LOCAL, 1),
    "step-half": ("14a", {"run.time_step": 0.05e-3 / 6 / check.SPEED}, 1),
    "prescription-paper": ("14a", {"load(3).prescription": "paper"}, 1),
    "mesh-factor-0.995": ("14a", {}, 0.995),
    "mesh-factor-0.997": ("14a", {}, 0.997),
    "mesh-factor-1.003": ("14a", {}, 1.003),
    "stabilised-0.05": ("14a", {"stabilisation.form": "blend", "stabilisation.alpha": 0.05}, 1),
    "14b-as-in-the-case": ("14b", {}, 1),
    "14b-ramp-50us": ("14b", {"load(3).ramp": 50e-6}, 1),
    "14b-ramp-60us": ("14b", {"load(3).ramp": 60e-6}, 1),
    "14b-mesh-factor-0.995": ("14b", {}, 0.995),
    "14b-mesh-factor-0.997": ("14b", {}, 0.997),
    "14b-mesh-factor-1.003": ("14b", {}, 1.003),
    "14b-viscosity-paper": ("14b", {"viscosity.form": "paper"}, 1),
}


def study(name, cleave, work, threads):
    variant, changes, factor = STUDIES[name]
    spacing = check.spacing_of("full")
    mesh = simulation.Mesh("plate.geo", (("l_ref", 1 / check.PARTS["full"]), ("factor", factor)))
    run = simulation.Run(name, "branching.nml", check.resolution(spacing) | check.VARIANTS[variant] | changes, mesh)
    result = simulation.execute(run, HERE, work / name, cleave, threads)
    crack = check.Crack(result, spacing)
    print(f"| {name} | {variant} | {len(result.exodus.points)} | {crack.first * 1e6:.1f} | {crack.arrival * 1e6:.1f} | {crack.broken} "
          f"| {crack.branches:.2f} | {crack.most_branches} | {check.closure(result.history):.1e} |", flush=True)


def main():
    parser = argparse.ArgumentParser(description="Sensitivity of the branching plate to what the paper leaves open.")
    parser.add_argument("name", nargs="*", help=f"of {', '.join(STUDIES)}; none: all")
    parser.add_argument("--cleave")
    parser.add_argument("--threads", type=int, default=1)
    given = parser.parse_args()
    root = HERE.parents[1]
    cleave = simulation.find_cleave(given.cleave, root)
    print("| changed | run | particles | first break (us) | arrival (us) | broken bonds | branches | most | closure |\n"
          "|---|---|---|---|---|---|---|---|---|")
    for name in given.name or STUDIES:
        study(name, cleave, root / "build/validation/sensitivity", given.threads)


if __name__ == "__main__":
    main()
