"""A small run of the program with all its outputs, its uninterrupted files, and how to finish it after
something went wrong. What goes wrong is the business of the tests that use it."""

import collections
import contextlib
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

DECK = """
&run units='other' title='a plate that breaks' name='case' t_end=24 /
&lattice type='hexagonal' spacing=1 size=18,12,0 /
&body name='plate' kinematics='plane_stress' material='unit' /
&material name='unit' law='svk' E=1 nu=0.25 rho=1 /
&fracture critical_strain=0.03 /
&precrack points=0,6,5,6 /
&load name='low' kind='displacement' set='ymin' directions='xy' /
&load name='top' kind='velocity' set='ymax' directions='y' value=0.1 /
&output every_steps=7 /
&history every_steps=3 /
&checkpoint every_steps=5 keep=2 /
"""
CHECKPOINT = re.compile(r"case\.(\d+)\.checkpoint\.nc")

Call = collections.namedtuple("Call", "number name path")


def fail(what, shown=""):
    raise AssertionError(f"{what}\n{shown}")


@contextlib.contextmanager
def scratch_folder():
    """In memory where that is possible: thousands of flushes to a disk take minutes."""
    memory = "/dev/shm" if os.access("/dev/shm", os.W_OK) else None
    with tempfile.TemporaryDirectory(dir=os.environ.get("TMPDIR", memory)) as name:
        yield pathlib.Path(name).resolve()


def checkpoints(folder):
    """Step -> file, of the checkpoints that a restart looks at."""
    found = {}
    for path in folder.iterdir():
        match = CHECKPOINT.fullmatch(path.name)
        if match:
            found[int(match[1])] = path
    return found


class SmallRun:
    def __init__(self, program, root, faulty_calls=None, deck=DECK):
        self.program = str(pathlib.Path(program).resolve())
        self.faulty_calls = faulty_calls and str(pathlib.Path(faulty_calls).resolve())
        self.root = root
        self.deck = deck
        self.whole = self.folder("whole")
        done = self.start(self.whole)
        if done.returncode != 0:
            fail("the uninterrupted run", done.stdout + done.stderr)
        self.files = {path.name: path.read_bytes() for path in self.whole.iterdir()}
        self.last_step = max(checkpoints(self.whole))
        events = self.files["case.events.nc"]
        if int.from_bytes(events[4:12], "big") < 10:
            fail("the small run is to break bonds")

    def folder(self, name):
        """A new folder with the deck."""
        folder = self.root / str(name)
        folder.mkdir()
        (folder / "case.nml").write_text(self.deck)
        return folder

    def command(self, *words, threads=1):
        return [self.program, *words, "--threads", str(threads)]

    def do(self, folder, *words, threads=1, **fault):
        """Runs the program; fault: kind and at, or log, as faulty_calls.c knows them."""
        environment = dict(os.environ, LC_ALL="C")
        if fault:
            environment.update({f"FAULT_{key.upper()}": str(value) for key, value in fault.items()},
                               FAULT_FOLDER=str(folder), LD_PRELOAD=self.faulty_calls)
        return subprocess.run(self.command(*words, threads=threads), cwd=folder, env=environment,
                              capture_output=True, text=True, timeout=120)

    def start(self, folder, **options):
        return self.do(folder, "case.nml", "--quiet", **options)

    def restart(self, folder, **options):
        return self.do(folder, "restart", ".", **options)

    def calls(self, folder, action):
        """The calls that change files while `action` (start or restart) runs in the folder."""
        log = self.root / f"{folder.name}.calls"
        done = action(folder, log=log)
        if done.returncode != 0:
            fail("a run whose calls are counted", done.stdout + done.stderr)
        *lines, last = log.read_text().splitlines()
        calls = [Call(int(number), name, path)
                 for number, name, path in (line.split(" ", 2) for line in lines)]
        writes = re.fullmatch(r"writes (\d+) seen (\d+)", last)
        printed = done.stdout.count("\n") + done.stderr.count("\n")
        if writes is None or int(writes[1]) - int(writes[2]) > printed:
            fail("the test does not see all writes of the program", last)
        return calls

    def finish(self, folder, at_least=None, threads=1):
        """Restarts, or runs again where no checkpoint was finished; then all files must be those of the
        uninterrupted run. at_least: the step from which a restart must go on, if there is one."""
        newest = max(checkpoints(folder), default=None)
        if at_least is not None and (newest is None or newest < at_least):
            fail(f"the checkpoint of step {at_least} was finished and is gone; newest: {newest}")
        done = self.restart(folder, threads=threads)
        said = done.stdout + done.stderr
        if newest is None:
            if done.returncode == 0 or "no checkpoint here" not in said:
                fail("what a restart says where no checkpoint is", said)
            done = self.start(folder, threads=threads)
            said = done.stdout + done.stderr
        elif "skipped" in said:
            fail("a checkpoint with its final name does not verify", said)
        elif f"continued after step {newest}" not in said:
            fail(f"a restart goes on from the newest checkpoint, of step {newest}", said)
        if done.returncode != 0:
            fail("a restart ends well", said)
        self.compare(folder)

    def compare(self, folder):
        """All files but older checkpoints, which a restart may leave, and the copy of a failed run."""
        for name, data in self.files.items():
            path = folder / name
            match = CHECKPOINT.fullmatch(name)
            if match and int(match[1]) < self.last_step:
                continue
            if not path.exists():
                fail(f"{name} is missing")
            if path.read_bytes() != data:
                fail(f"{name} differs from that of the uninterrupted run")
        for path in folder.iterdir():
            known = path.name in self.files or path.name == "case.lastgood.checkpoint.nc"
            old = CHECKPOINT.fullmatch(path.name.removesuffix(".previous"))
            if not known and not old:
                fail(f"{path.name} is left behind")

    def steps_saved(self, calls):
        """For every call: the step of the newest checkpoint that has its name before it; None at first."""
        saved, newest = {}, None
        for call in calls:
            saved[call.number] = newest
            match = CHECKPOINT.fullmatch(pathlib.Path(call.path).name)
            if call.name == "rename" and match:
                newest = int(match[1])
        return saved


def copy_of(folder, name):
    target = folder.parent / str(name)
    shutil.copytree(folder, target)
    return target


def report(failures, what):
    for text in failures[:5]:
        print("FAILED:", text, file=sys.stderr)
    if failures:
        sys.exit(f"{len(failures)} of {what} failed")
    print(f"{what}: all as uninterrupted")
