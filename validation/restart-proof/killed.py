"""A run that is killed at random moments and continued until it is done; and what happened on the way.

A kill is SIGKILL, SIGTERM or SIGINT in turn, at a random moment: after a random step, some while the program starts, and
every second SIGKILL while a checkpoint is being written.  Before every fifth restart the folder is copied and the
original removed, before every fourth the newest checkpoint is damaged.  Knows nothing of what the run computes.
"""
import dataclasses
import os
import pathlib
import re
import shutil
import signal
import subprocess
import time

SIGNALS = (signal.SIGKILL, signal.SIGTERM, signal.SIGINT)
THREADS = (1, 2, 3)
CHECKPOINT = re.compile(r"\.(\d+)\.checkpoint\.nc$")
STOPPED = 3                                        # exit status after a request to stop


@dataclasses.dataclass
class Attempt:
    """One process: from where to where it came, and how it ended."""

    threads: int
    expected: int = 0                              # step of the newest checkpoint that is whole
    first: int = 0                                 # step after which it went on
    seen: int = 0                                  # last step that it told of
    ended: str = ""                                # done, KILL, TERM, INT, or failed
    status: int = 0
    in_write: bool = False                         # killed while it wrote a checkpoint
    copied: bool = False                           # before it began
    damaged: str = ""                              # what was done to the newest checkpoint before it began
    ignored: int = 0                               # damaged checkpoints newer than the expected one
    skipped: int = 0                               # checkpoints that it says it skipped


def checkpoints(folder):
    """Finished checkpoints by their step, in order."""
    found = {int(CHECKPOINT.search(path.name)[1]): path for path in folder.iterdir() if CHECKPOINT.search(path.name)}
    return dict(sorted(found.items()))


def run_whole(cleave, folder, deck, threads):
    """The run that nothing happens to."""
    with open(folder / "log", "wb") as log:
        subprocess.run([cleave, deck, "--threads", str(threads)], cwd=folder, stdout=log,
                       stderr=subprocess.STDOUT, stdin=subprocess.DEVNULL, check=True)


class Killer:
    """Kills runs of one deck.  `spacing` is the mean number of steps between kills, `draws` a numpy generator."""

    def __init__(self, cleave, deck, spacing, draws):
        self.cleave, self.deck, self.spacing, self.draws = cleave, deck, spacing, draws
        self.kills, self.restarts, self.damages, self.bad = 0, 0, 0, {}

    def until_done(self, folder, kills):
        """Kills the run in `folder` until it is done, or `kills` are reached in all; returns its folder and attempts."""
        attempts = []
        while not attempts or attempts[-1].ended not in ("done", "failed"):
            attempt = Attempt(THREADS[self.kills // len(SIGNALS) % len(THREADS)])      # each signal meets each number
            folder = self.disturb(folder, attempt, len(attempts))
            self.attempt(folder, attempt, kills)
            attempts.append(attempt)
        return folder, attempts

    def disturb(self, folder, attempt, number):
        """What happens to the files before a restart."""
        if number == 0:
            self.bad = {}
            return folder
        self.restarts += 1
        if self.restarts % 5 == 0:
            copy = folder.with_name(f"{folder.name.split('-copy')[0]}-copy{number}")
            shutil.copytree(folder, copy)
            shutil.rmtree(folder)
            folder, attempt.copied = copy, True
        whole = self.whole(folder)
        if len(whole) > 1 and self.restarts % 4 == 0:
            attempt.damaged = self.damage(whole[max(whole)])
        return folder

    def whole(self, folder):
        """Checkpoints that were not damaged, or have been written anew since."""
        return {step: path for step, path in checkpoints(folder).items() if self.bad.get(path.name) != path.read_bytes()}

    def damage(self, path):
        """One bit, the end, or everything; in turn."""
        data = bytearray(path.read_bytes())
        place = int(self.draws.integers(len(data)))
        kind = ("a bit", "the end", "everything")[self.damages % 3]
        if kind == "a bit":
            data[place] ^= 1 << int(self.draws.integers(8))
        else:
            del data[place if kind == "the end" else 0:]
        path.write_bytes(data)
        self.bad[path.name] = bytes(data)
        self.damages += 1
        return kind

    def attempt(self, folder, attempt, kills):
        """One process, killed unless there were enough."""
        present, whole = checkpoints(folder), self.whole(folder)
        attempt.expected = max(whole, default=0)
        attempt.ignored = sum(step > attempt.expected for step in present)
        words = ["restart", "."] if present else [self.deck]
        process = subprocess.Popen([self.cleave, *words, "--threads", str(attempt.threads)], cwd=folder,
                                   stdout=subprocess.PIPE, stderr=subprocess.STDOUT, stdin=subprocess.DEVNULL)
        log = []
        sent = self.kill(process, folder, attempt.expected, log) if self.kills < kills else None
        log += process.stdout.readlines()
        attempt.status = process.wait()
        (folder / "log").write_bytes(b"".join(log))
        self.judge(attempt, sent, folder)
        self.read(attempt, b"".join(log).decode(errors="replace"))

    def kill(self, process, folder, first, log):
        """Sends a signal at a random moment; the signal, or None if the run was done before.  What it said is added to `log`."""
        sent = SIGNALS[self.kills % len(SIGNALS)]
        target, delay = first + self.draws.exponential(self.spacing), self.draws.uniform(0, 0.02)
        if self.kills % 7 == 6:
            time.sleep(2 * delay)                  # while it starts
        elif not wait_for_step(process, target, log):
            return None
        elif sent == signal.SIGKILL and self.kills % 2 == 0:
            wait_for_write(process, folder, delay / 10)
        else:
            time.sleep(delay)
        process.send_signal(sent)
        return sent

    def judge(self, attempt, sent, folder):
        """How the process ended; a stop before it listens to signals is a kill like SIGKILL."""
        if attempt.status == 0:
            attempt.ended = "done"
        elif sent is not None and (attempt.status == -sent or (attempt.status == STOPPED and sent != signal.SIGKILL)):
            self.kills += 1
            attempt.ended = sent.name.removeprefix("SIG")
            attempt.in_write = attempt.status == -signal.SIGKILL and any(folder.glob("*.part"))
        else:
            attempt.ended = "failed"

    @staticmethod
    def read(attempt, log):
        """From the banner and the status lines."""
        begun = re.search(r"continued after step (\d+)", log)
        attempt.first = int(begun[1]) if begun else 0
        told = re.findall(r"(?m)^step (\d+)/|stopped on request after step (\d+) ", log)
        attempt.seen = max([attempt.first] + [int(one or other) for one, other in told])
        attempt.skipped = len(re.findall(r"(?m)^warning: skipped ", log))


def wait_for_step(process, target, log):
    """Whether the run tells of this step or a later one before it ends; what it says goes to `log`."""
    for line in process.stdout:
        log.append(line)
        told = re.match(rb"step (\d+)/", line)
        if told and int(told[1]) >= target:
            return True
    return False


def wait_for_write(process, folder, delay):
    """Until a checkpoint has been under construction for some moments."""
    def writes():
        return any(name.endswith(".part") for name in os.listdir(folder))

    begun = False
    while process.poll() is None and not begun:
        time.sleep(2e-4)
        begun = writes()
        if begun:
            time.sleep(delay)
            begun = writes()                       # a small one may be finished already: the next one then


def differing_bytes(one, other):
    """How many bytes of two files differ, those that only one has included; not-a-number if one is not there."""
    import numpy
    if not (pathlib.Path(one).exists() and pathlib.Path(other).exists()):
        return float("nan")
    left, right = (numpy.fromfile(path, "u1") for path in (one, other))
    common = min(len(left), len(right))
    return int((left[:common] != right[:common]).sum()) + abs(len(left) - len(right))
