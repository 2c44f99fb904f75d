"""Makes a mesh with gmsh, writes the deck of a run, runs cleave, hands back its files.

Every run has a folder of its own below the work folder, with the deck that reproduces it.
"""
import dataclasses
import functools
import os
import pathlib
import re
import shutil
import subprocess
import sys
import time
from collections.abc import Callable

from . import deck as decks
from . import results

COST = "cost.csv"                # beside the files of a run: what it took


class RunError(Exception):
    """gmsh or cleave could not do its part."""


@dataclasses.dataclass(frozen=True)
class Mesh:
    """A .geo file and the parameters given to it; the mesh file is called as the deck expects it."""

    geometry: str
    parameters: tuple = ()
    file: str = "plate.msh"
    dimension: int = 2

    def arguments(self):
        return [word for name, value in self.parameters for word in ("-setnumber", name, repr(value))]


@dataclasses.dataclass(frozen=True)
class Run:
    """One run of a case: name, deck, what is changed in it (group.key -> value), mesh if it needs one.

    Without a deck: another command of cleave with its arguments, whose output is kept as NAME.csv; `inputs` are the
    files it reads (name -> text).  Or `work`, a function of the case that does something else in the folder of its
    Site, such as building and running a host code (host_code.py).
    """

    name: str
    deck: str = ""
    changes: dict = dataclasses.field(default_factory=dict)
    mesh: Mesh | None = None
    command: tuple = ()
    inputs: dict = dataclasses.field(default_factory=dict)
    work: Callable | None = None


@dataclasses.dataclass(frozen=True)
class Site:
    """Where the work of a run is done, and with what."""

    case_folder: pathlib.Path
    folder: pathlib.Path
    cleave: str


class Result:
    """Files of a finished run; everything is read when it is asked for."""

    def __init__(self, run, folder, wall=float("nan")):
        self.run, self.folder, self.wall = run, pathlib.Path(folder), wall

    def path(self, ending):
        return self.folder / (self.run.name + ending)

    @functools.cached_property
    def exodus(self):
        return results.Exodus(self.path(".exo"))

    @functools.cached_property
    def history(self):
        return results.read_table(self.path(".history.nc"))

    @functools.cached_property
    def events(self):
        return results.read_table(self.path(".events.nc"))

    @functools.cached_property
    def cost(self):
        """Wall time, processor time (s) and largest memory (MB) of the run, by name."""
        return {name: float(values[0]) for name, values in results.read_csv(self.folder / COST).items()}

    @functools.cached_property
    def table(self):
        """Output of a command without a deck: columns by name, units cut off."""
        return results.read_csv(self.path(".csv"))


def find_cleave(given, root):
    """The executable: --cleave, the environment variable CLEAVE, or the release build."""
    path = given or os.environ.get("CLEAVE") or str(pathlib.Path(root) / "build/release/bin/cleave")
    found = shutil.which(path)
    if found is None:
        raise RunError(f"no executable at {path}.\nBuild it (./bootstrap build) or name it with --cleave PATH "
                       "or the environment variable CLEAVE.")
    return os.path.abspath(found)


def make_mesh(mesh, case_folder, folder):
    gmsh = shutil.which("gmsh")
    if gmsh is None:
        raise RunError("the program gmsh is not on PATH; it makes the meshes (Debian: apt-get install gmsh)")
    target = folder / mesh.file
    geometry = str(pathlib.Path(case_folder) / mesh.geometry)
    command = [gmsh, f"-{mesh.dimension}", "-v", "2", "-nt", "1", geometry, *mesh.arguments(), "-o", str(target)]
    done = subprocess.run(command, capture_output=True, text=True)
    if done.returncode != 0 or not target.exists():
        raise RunError(f"gmsh failed: {' '.join(command)}\n{done.stdout}{done.stderr}")


def _last_line(log):
    with open(log, "rb") as file:
        file.seek(max(0, log.stat().st_size - 400))
        lines = file.read().decode(errors="replace").replace("\r", "\n").strip().splitlines()
    return lines[-1] if lines else ""


def _peak_memory(pid):
    """Largest memory of a process so far, MB; 0 where the system does not say.  What wait4 reports includes its parent's."""
    try:
        found = re.search(r"VmHWM:\s+(\d+) kB", pathlib.Path(f"/proc/{pid}/status").read_text(encoding="utf-8"))
    except OSError:
        return 0.0
    return int(found[1]) * 1024e-6 if found else 0.0


def _wait(process, log, label):
    """Waits; returns processor time and largest memory.  With a label, shows the run's own status line on a terminal."""
    live, pause, memory = label is not None and sys.stderr.isatty(), 0.01, 0.0
    while True:
        memory = max(memory, _peak_memory(process.pid))
        ended, status, usage = os.wait4(process.pid, os.WNOHANG)
        if ended:
            break
        if live:
            shown = f"{label} {_last_line(log)}"[: shutil.get_terminal_size().columns]
            print(f"\r\033[K{shown}", end="", file=sys.stderr, flush=True)
        time.sleep(pause)
        pause = min(2 * pause, 0.5)
    process.returncode = os.waitstatus_to_exitcode(status)
    if live:
        print("\r\033[K", end="", file=sys.stderr)
    return usage.ru_utime + usage.ru_stime, memory


def _prepare(run, case_folder, folder):
    """Writes what the run reads; returns the arguments of cleave."""
    if run.mesh:
        make_mesh(run.mesh, case_folder, folder)
    for name, text in run.inputs.items():
        (folder / name).write_text(text, encoding="utf-8")
    if not run.deck:
        return list(run.command)
    text = (pathlib.Path(case_folder) / run.deck).read_text(encoding="utf-8")
    (folder / f"{run.name}.nml").write_text(decks.vary(text, run.changes), encoding="utf-8")
    return [f"{run.name}.nml"]


def execute(run, case_folder, folder, cleave, threads, label=None):
    """Does the run in `folder` and returns its Result."""
    folder = pathlib.Path(folder)
    if folder.exists():
        shutil.rmtree(folder)
    folder.mkdir(parents=True)
    if run.work:
        started = time.monotonic()
        run.work(Site(pathlib.Path(case_folder), folder, cleave))
        return Result(run, folder, time.monotonic() - started)
    arguments = _prepare(run, case_folder, folder)
    arguments += ["--threads", str(threads)] if run.deck else []
    log = folder / f"{run.name}.log"
    output = log if run.deck else folder / f"{run.name}.csv"
    started = time.monotonic()
    with open(output, "w", encoding="utf-8") as out, open(log, "a", encoding="utf-8") as errors:
        process = subprocess.Popen([cleave, *arguments], cwd=folder, stdout=out, stderr=subprocess.STDOUT if run.deck else errors,
                                   stdin=subprocess.DEVNULL)
        processor, memory = _wait(process, log, label)
    if process.returncode != 0:
        end = "\n".join(log.read_text(errors="replace").splitlines()[-12:])
        raise RunError(f"cleave ended with {process.returncode}; the end of {log}:\n{end}")
    wall = time.monotonic() - started
    (folder / COST).write_text(f"wall [s],processor [s],memory [MB]\n{wall:.2f},{processor:.2f},{memory:.1f}\n", encoding="utf-8")
    return Result(run, folder, wall)
