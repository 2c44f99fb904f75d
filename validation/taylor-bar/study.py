#!/usr/bin/env python3
"""What the shape of the foot depends on: runs of tlsph.nml and cbm.nml with one thing changed.

    validation/taylor-bar/study.py [NAME...] [--cleave PATH]      prints the table of README.md
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
from tools import sensitivity  # noqa: E402
from tools.simulation import Mesh, Run  # noqa: E402

MESH = Mesh("rod.geo", (("size", check.FINE),), file="rod.msh", dimension=3)
LATTICE = """&lattice
  name    = 'mesh'
  type    = 'cubic'
  shape   = 'cylinder'
  spacing = 0.635e-3
  radius  = 3.8100001e-3
  height  = 25.4e-3
/
"""


def lattice_deck(name):
    """The deck with a cubic lattice in place of the mesh, beside the runs of the study."""
    folder = sensitivity.ROOT / "build/validation/study/decks"
    folder.mkdir(parents=True, exist_ok=True)
    text = (HERE / f"{name}.nml").read_text(encoding="utf-8")
    path = folder / f"taylor-{name}-lattice.nml"
    path.write_text(re.sub(r"&mesh\n.*?\n/\n", LATTICE, text, count=1, flags=re.S), encoding="utf-8")
    return str(path)


def runs():
    made = {"TLSPH": Run("tlsph", "tlsph.nml", {}, MESH)}
    for sizes in (1.0, 1.65, 2.0):
        made[f"TLSPH, radius {sizes:g} mesh sizes"] = Run(f"radius-{sizes:g}", "tlsph.nml",
                                                          {"kernel.radius": sizes * check.FINE * 1e-3}, MESH)
    made["TLSPH, no hourglass penalty"] = Run("psi0", "tlsph.nml", {"hourglass.psi": 0.0}, MESH)
    made["TLSPH, cubic lattice"] = Run("lattice", lattice_deck("tlsph"))
    made["CBM"] = Run("cbm", "cbm.nml", {}, MESH)
    made["CBM, cubic lattice"] = Run("cbm-lattice", lattice_deck("cbm"))
    return made


def row(result):
    return [f"{len(result.exodus.points)}"] + [f"{value:.2f}" for value in check.shape(result, check.FINE)]


if __name__ == "__main__":
    sensitivity.main(HERE, runs(), ["particles", "length", "mushroom", "at height 0.2 L0", "began at 0.2 L0"], row)
