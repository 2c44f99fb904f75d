"""The queue scripts of the manual, with stand-ins for the commands of the queue: queue_scripts.py CLEAVE SCRIPT DECK.

A job is stopped by its wall limit, the next one by SIGTERM to the script, the next one dies with its machine, the last one
finishes the run: same bytes as in one go. And a chain of jobs ends where it leads nowhere."""
import filecmp
import os
import pathlib
import re
import shutil
import signal
import subprocess
import sys
import tempfile
import time

# sbatch, scancel, qsub or qdel: the file QUEUE has a line "JOB SCRIPT PREVIOUS" for every job that waits.
STAND_IN = """#!{python}
import os, pathlib, re, sys
queue, words = pathlib.Path(os.environ["QUEUE"]), sys.argv[1:]
jobs = queue.read_text().splitlines()
if pathlib.Path(sys.argv[0]).name in ("scancel", "qdel"):
    assert any(job.split()[0] == words[0] for job in jobs), words
    jobs = [job for job in jobs if job.split()[0] != words[0]]
else:
    said = " ".join(words)
    previous = re.search(r"previous=(\\d+)", said)[1]
    after = re.search(r"(?:--dependency=|-W depend=)afterany:(\\d+) ", said)[1]
    assert after == os.environ.get("SLURM_JOB_ID", os.environ.get("PBS_JOBID")), said
    assert pathlib.Path(sys.argv[0]).name == "qsub" or "--parsable" in words, said
    jobs.append(f"{{int(after) + 1}} {{words[-1]}} {{previous}}")
    print(int(after) + 1)
queue.write_text("".join(job + "\\n" for job in jobs))
"""
ENDINGS = (".exo", ".history.nc", ".history.csv", ".events.nc", ".resolved.nml")


class Queue:
    """A folder with the script, its deck and a queue of one job after the other."""

    def __init__(self, cleave, script, deck, root):
        self.folder, self.name, self.jobs = root / "submitted", script.name, root / "queue"
        (root / "bin").mkdir(parents=True)
        self.folder.mkdir()
        shutil.copy(script, self.folder)
        (self.folder / "long.nml").write_text(deck, encoding="utf-8")
        for name in ("sbatch", "scancel", "qsub", "qdel"):
            self.program(root / "bin" / name, STAND_IN.format(python=sys.executable))
        self.program(root / "bin/cleave", f'#!/bin/sh\nexec "{cleave}" "$@"\n')
        self.path = f"{root / 'bin'}:{os.environ['PATH']}"
        self.jobs.write_text(f"1 {self.name} none", encoding="utf-8")

    @staticmethod
    def program(path, text):
        path.write_text(text, encoding="utf-8")
        path.chmod(0o755)

    def waiting(self):
        return self.jobs.read_text(encoding="utf-8").splitlines()

    def next(self, act=lambda job, log: None, wall_limit="23:50:00"):
        """Starts the job that waits, lets `act` do something to it; its exit status and what it said."""
        number, script, previous = self.waiting()[0].split()
        self.jobs.write_text("", encoding="utf-8")
        path, log = self.folder / script, self.folder / f"job-{number}.log"
        path.write_text(re.sub(r"(?m)^wall_limit=\S+", f"wall_limit={wall_limit}", path.read_text(encoding="utf-8")), encoding="utf-8")
        environment = {"PATH": self.path, "QUEUE": str(self.jobs)}
        if script.endswith(".slurm"):
            environment |= {"SLURM_JOB_ID": number, "SLURM_SUBMIT_DIR": str(self.folder), "SLURM_CPUS_PER_TASK": "2"}
        else:
            environment |= {"PBS_JOBID": number, "PBS_O_WORKDIR": str(self.folder), "NCPUS": "2"}
        if previous != "none":
            environment["previous"] = previous
        with open(log, "wb") as output:
            job = subprocess.Popen(["bash", path], cwd="/", env=environment, stdout=output, stderr=subprocess.STDOUT,
                                   stdin=subprocess.DEVNULL, start_new_session=True)
            act(job, log)
            status = job.wait(300)
        return status, log.read_text(encoding="utf-8")


def check(condition, what, shown=""):
    if not condition:
        sys.exit(f"FAILED: {what}\n{shown}")


def until(job, met):
    """Waits until something is so, while the job runs."""
    while job.poll() is None and not met():
        time.sleep(1e-3)


def newest(folder):
    return max((int(path.name.split(".")[-3]) for path in folder.glob("*.checkpoint.nc")), default=0)


def chain(queue, whole):
    """Four jobs of one run; their files are those of the run in one go."""
    run = queue.folder / "long"

    def stop(job, log):
        until(job, lambda: b"\nstep " in log.read_bytes())
        job.send_signal(signal.SIGTERM)            # to the script alone, as --signal=B:TERM does

    def die(job, _):
        begun = newest(run)
        until(job, lambda: newest(run) > begun)
        os.killpg(job.pid, signal.SIGKILL)

    for act, limit, expected in ((None, "0.7", 3), (stop, "23:50:00", 3), (die, "23:50:00", -9), (None, "23:50:00", 0)):
        begun = newest(run)
        status, said = queue.next(act or (lambda job, log: None), limit)
        check(status == expected, f"exit status {expected}, not {status}", said)
        check(begun == 0 or f"continued after step {begun}" in said, f"the job goes on after step {begun}", said)
        check(newest(run) > begun, "every job comes further", said)
        check(len(queue.waiting()) == (status != 0), f"jobs that wait after exit status {status}: {queue.waiting()}", said)
    for ending in (*ENDINGS, f".{newest(whole)}.checkpoint.nc"):
        check(filecmp.cmp(whole / f"long{ending}", run / f"long{ending}", shallow=False), f"long{ending} equals that of the run in one go")


def refused(queue):
    """A deck that is wrong: no job follows."""
    deck = queue.folder / "long.nml"
    deck.write_text(deck.read_text(encoding="utf-8").replace("kinematics", "cinematics"), encoding="utf-8")
    status, said = queue.next()
    check((status, queue.waiting()) == (2, []), f"exit status 2 and no further job, not {status}, {queue.waiting()}", said)


def nowhere(queue):
    """A program that dies before its first checkpoint: one more attempt, then no more."""
    queue.program(queue.folder.parent / "bin/cleave", "#!/bin/sh\nkill -KILL $$\n")
    first, _ = queue.next()
    check(first == 137 and len(queue.waiting()) == 1, "a job that was killed is followed by another one")
    second, said = queue.next()
    check(second == 137 and not queue.waiting() and "no job will follow" in said, "two in vain are enough", said)


def main(cleave, script, deck):
    limits = re.findall(r"(?:--time=|walltime=|wall_limit=)(\d+):(\d+):(\d+)", script.read_text(encoding="utf-8"))
    check(len(limits) == 2 and limits[0] > limits[1], f"the wall limit is less than that of the queue: {limits}")
    text = deck.read_text(encoding="utf-8").replace("t_end     = 0.03", "t_end     = 0.1, status_every = 0.01")
    text = text.replace("&checkpoint", "&checkpoint\n  every_steps = 50")
    with tempfile.TemporaryDirectory() as temporary:
        root = pathlib.Path(temporary)
        (root / "whole").mkdir()
        (root / "whole/long.nml").write_text(text, encoding="utf-8")
        subprocess.run([cleave, "long.nml", "--quiet", "--threads", "1"], cwd=root / "whole", check=True)
        for test in (chain, refused, nowhere):
            queue = Queue(cleave, script, text, root / test.__name__)
            test(queue, *([root / "whole/long"] if test is chain else []))


if __name__ == "__main__":
    main(*(pathlib.Path(word).resolve() for word in sys.argv[1:]))
