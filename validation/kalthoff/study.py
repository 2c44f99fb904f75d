#!/usr/bin/env python3
"""How much the assumptions of kalthoff.nml matter: the reduced plate with one thing changed.

    validation/kalthoff/study.py [NAME...] [--cleave PATH]      prints the table of README.md
"""
import pathlib
import re
import sys

HERE = pathlib.Path(__file__).resolve().parent
sys.path[:0] = [str(HERE.parent), str(HERE)]
from tools import python  # noqa: E402

if __name__ == "__main__":
    python.ensure(__file__)
import check  # noqa: E402
from tools import deck, sensitivity  # noqa: E402
from tools.simulation import Run  # noqa: E402

SLOW, STRONG = {"load.value": 16.5}, {"fracture.relation": "paper1d"}
CHANGES = {
    "as in the deck": {},
    "16.5 m/s": SLOW,
    "critical stretch of the paper, x 1.5": STRONG,
    "16.5 m/s and x 1.5": SLOW | STRONG,
    "bond-based": check.BOND,
    "bond-based, 16.5 m/s": check.BOND | SLOW,
}
# name: changes, groups taken out, text added
OTHERS = {
    "bonds across the notches": ({}, "precrack", ""),
    "bonds across the notches, 16.5 m/s": (SLOW, "precrack", ""),
    "conservative weights": ({}, "", "&cpd\n  weights = 'conservative'\n/\n"),
    "C3 with the energy of the material": ({}, "", "&cpd\n  c3_calibration = 'energy'\n/\n"),
    "inverted tetrahedra pushed back": ({}, "", "&cpd\n  three_nbr = 'signed'\n/\n"),
}
COLUMNS = ["lower crack (deg)", "upper crack (deg)", "damage between the notches", "momentum", "energy"]


def file_name(name):
    return re.sub(r"[^a-zA-Z0-9.]+", "-", name)


def other(name):
    changes, without, added = OTHERS[name]
    text = deck.vary((HERE / "kalthoff.nml").read_text(encoding="utf-8"), check.resolution("quick") | changes)
    if without:
        text = re.sub(rf"(?ms)^&{without}$.*?^/$\n", "", text)
    return Run(file_name(name), command=(f"{file_name(name)}.nml",), inputs={f"{file_name(name)}.nml": text + added})


def runs():
    fine = check.resolution("quick")
    made = {name: Run(file_name(name), "kalthoff.nml", fine | changes) for name, changes in CHANGES.items()}
    return made | {name: other(name) for name in OTHERS}


def row(result):
    found = check.Plate(result, "quick")
    between = (abs(found.data.points[:, 1] - found.height / 2) < 20) & (found.data.points[:, 0] < 50)
    return [f"{found.angle('lower'):.0f}", f"{found.angle('upper'):.0f}", f"{found.data.nodal('damage')[between].mean():.2f}",
            f"{found.missing_momentum():.0e}", f"{found.missing_energy():.0e}"]


if __name__ == "__main__":
    sensitivity.main(HERE, runs(), COLUMNS, row)
