"""The runs that are killed: decks and meshes of other cases in the size of the mode, with checkpoints added."""
import dataclasses
import re

from tools import deck as decks
from tools.simulation import Mesh, make_mesh

CHECKPOINTS = {"quick": 25, "full": 100}          # in a run, evenly spaced


@dataclasses.dataclass(frozen=True)
class Problem:
    """A deck of another case, what is changed in it, its mesh; how many steps it takes and how often it is killed."""

    name: str
    case: str
    deck: str
    changes: dict
    mesh: Mesh
    steps: int
    kills: int
    checkpoints: int

    @property
    def interval(self):
        """Steps between checkpoints."""
        return self.steps // self.checkpoints

    def prepare(self, cases, folder):
        """Mesh and deck NAME.nml in `folder`."""
        make_mesh(self.mesh, cases / self.case, folder)
        text = decks.vary((cases / self.case / self.deck).read_text(encoding="utf-8"), self.changes)
        text = re.sub(r"(?ms)^&checkpoint.*?^/", f"&checkpoint\n  every_steps = {self.interval}\n  keep = 3\n/", text)
        text = text.replace("&run\n", "&run\n  status_every = 0.01   ! wall time: shows how far a killed run had come\n", 1)
        (folder / f"{self.name}.nml").write_text(text, encoding="utf-8")


def plate(mode):
    parts, kills = {"quick": (2, 30), "full": (6, 400)}[mode]
    times = 6 / parts                              # coarser than the deck of the paper
    changes = {"fracture.length": 1e-3 / parts, "viscosity.length": 1e-3 / parts, "run.time_step": 9.4618e-9 * times}
    return Problem("plate", "cbm-branching", "branching.nml", changes, Mesh("plate.geo", (("l_ref", 1 / parts),)),
                   round(16910 / times), kills, CHECKPOINTS[mode])


def bar(mode):
    spacing, kills = {"quick": (1.35, 30), "full": (0.55, 300)}[mode]
    step = 2.1125e-5 * spacing / 0.55
    return Problem("bar", "tensile-bar", "cbm.nml", {"run.time_step": step, "output.every_time": 0.04},
                   Mesh("bar.geo", (("l_c", spacing),), "bar.msh"), round(1 / step), kills, CHECKPOINTS[mode])


def static(mode):
    spacing, kills = {"quick": (3.0, 30), "full": (0.8, 300)}[mode]
    increments = 120
    return Problem("static", "tensile-bar", "fem.nml", {"static.increments": increments, "output.every_time": 0.05},
                   Mesh("bar.geo", (("l_c", spacing),), "bar.msh"), increments, kills, 30)


def problems(mode):
    return [plate(mode), bar(mode), static(mode)]
