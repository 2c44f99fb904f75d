"""Checkpoints on request, before a limit of wall time, and on a full disk: what the program writes and
says, its exit code, and that a run that was stopped is continued to the same bytes.

Files lie in memory where the system has a place for that: a disk that is busy with something else makes a checkpoint wait
for a second and more, which no limit of wall time of a few seconds can foresee."""

import filecmp
import os
import pathlib
import re
import resource
import shutil
import signal
import subprocess
import tempfile
import time

from run_support import FILES, PLATE, PROGRAM, check, cleave, write_deck

SHORT = PLATE.replace("&output every_steps=300 /", "&output fields='displacement' /")
# Its checkpoint of about 20 MB takes a while to be written.
LARGE = SHORT.replace("size=60,40,0", "size=260,190,0").replace("0,20,15,20", "0,95,60,95")


def start(directory, *words, prepare=None):
    """A running program; its output up to the first status line, so that it steps, is read."""
    run = subprocess.Popen([PROGRAM, *words, "case.nml"], cwd=directory, preexec_fn=prepare,
                           stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
    check(any(line.startswith("step ") for line in run.stdout), "a run steps")
    return run


def ended(run, code, *says):
    out, err = run.communicate(timeout=60)
    shown = out[-2000:] + err
    check(run.returncode == code, f"exit code {code}, not {run.returncode}", shown)
    for part in says:
        check(part in out + err, f"it says {part!r}", shown)
    return out + err


def whole(directory, keys, groups=PLATE):
    write_deck(directory, keys, groups)
    done = cleave(directory, "--quiet", "case.nml")
    check(done.returncode == 0 and not done.stdout + done.stderr, "a whole run", done.stdout + done.stderr)


def continued(directory, *words):
    done = cleave(directory, "restart", "--quiet", *(words or ["."]))
    check(done.returncode == 0, "restart", done.stdout + done.stderr)


def same(directory, other):
    for name in FILES:
        check(filecmp.cmp(directory / name, other / name, shallow=False),
              f"{name} of {directory.name} equals that of {other.name}")


def checkpoints(directory):
    return sorted(int(path.name.split(".")[1]) for path in directory.glob("case.*.checkpoint.nc"))


def wait_for(condition, what):
    end = time.monotonic() + 60
    while not condition():
        check(time.monotonic() < end, f"waiting for {what}")
        time.sleep(0.0005)


def on_usr1(root):
    """A checkpoint, and the run goes on; continued from that checkpoint it ends in the same bytes."""
    whole(root / "whole", "t_end=800")
    write_deck(root / "asked", "t_end=800 status_every=0.02")
    run = start(root / "asked")
    run.send_signal(signal.SIGUSR1)
    said = ended(run, 0, "checkpoint written on request: case.")
    same(root / "asked", root / "whole")
    step = int(re.search(r"on request: case\.(\d+)\.", said).group(1))
    check(0 < step < checkpoints(root / "asked")[-1], "it was written in the middle", said)
    continued(root / "asked", f"case.{step}.checkpoint.nc")
    same(root / "asked", root / "whole")


def on_terminate(root):
    """Queues send SIGTERM more than once: it is one request."""
    write_deck(root, "t_end=1e6 status_every=0.02")
    run = start(root)
    for _ in range(3):
        run.send_signal(signal.SIGTERM)
        time.sleep(0.003)
    ended(run, 3, "stopped on request after step", "cleave restart case.")


def on_second_interrupt(root):
    """One SIGINT: exit code 3. Two: at once, with what was half written out of the way later."""
    write_deck(root / "once", "t_end=1e6 status_every=0.02")
    run = start(root / "once")
    run.send_signal(signal.SIGINT)
    ended(run, 3, "stopped on request after step")
    keys = "t_end=20 threads=2 status_every=0.001"
    plan = LARGE + "&checkpoint every_steps=8 keep=3 /\n"
    whole(root / "whole", keys, plan)
    for attempt in range(20):  # the checkpoint may be ready before the second signal comes
        here = root / f"twice{attempt}"
        write_deck(here, keys, plan)
        run = start(here)
        half = here / "case.16.checkpoint.nc.part"
        wait_for(lambda: half.exists() or run.poll() is not None, "the second checkpoint")
        run.send_signal(signal.SIGINT)
        time.sleep(0.005)
        run.send_signal(signal.SIGINT)
        run.communicate()
        if run.returncode == -signal.SIGINT and half.exists():
            break
    check(run.returncode == -signal.SIGINT, f"a second SIGINT kills while writing, not {run.returncode}")
    check(half.exists() and checkpoints(here) == [8], "the older checkpoint is there, the new one is not")
    continued(here)
    same(here, root / "whole")
    check(not list(here.glob("*.part")), "nothing half written is left")


def read_while_running(root):
    """Records come to the files every two seconds, not only when 4096 of them wait; and a kill leaves them there."""
    write_deck(root, "t_end=1e6", SHORT.replace("every_steps=10", "every_steps=300"))
    run = start(root)

    def records():
        return len((root / "case.history.csv").read_text(encoding="utf-8").splitlines()) - 1

    wait_for(lambda: records() > 2, "records")
    check(run.poll() is None and records() < 4000, f"{records()} records of a run that goes on")
    resource.prlimit(run.pid, resource.RLIMIT_FSIZE, (100, resource.RLIM_INFINITY))
    warned = next((line for line in run.stdout if "warning: records wait in memory: " in line), "")
    check("cannot write to the file" in warned, "a full disk is not the end", warned)
    resource.prlimit(run.pid, resource.RLIMIT_FSIZE, (resource.RLIM_INFINITY, resource.RLIM_INFINITY))
    before = records()
    wait_for(lambda: records() > before, "the records that waited")
    run.kill()
    run.communicate()
    done = cleave(root, "info", "case.history.nc")
    check(done.returncode == 0 and re.search(r"table of \d+ records", done.stdout), "they can be read", done.stdout + done.stderr)


def on_stop_file(root):
    """It is seen, removed, and a leftover one is refused."""
    write_deck(root, "t_end=1e6 status_every=0.02", PLATE + "&checkpoint stop_file='case.stop' /\n")
    run = start(root)
    (root / "case.stop").touch()
    began = time.monotonic()
    ended(run, 3, "stopped by the stop file after step", "cleave restart case.")
    check(time.monotonic() - began < 5, "it is looked for every second")
    check(not (root / "case.stop").exists(), "the stop file is removed")
    check(len(checkpoints(root)) == 1, "there is a checkpoint")
    (root / "case.stop").touch()
    for words in (["case.nml"], ["restart", "."], ["check", "case.nml"]):
        done = cleave(root, *words)
        check(done.returncode == 2 and "is there already" in done.stderr, "a leftover is refused", done.stderr)
    check(len(checkpoints(root)) == 1, "and nothing has changed")


def before_wall_limit(root):
    """The deck's and the command line's; every job makes progress, however short its time is."""
    for name, keys, words in (("deck", "&checkpoint wall_limit=2.4 /\n", []),
                              ("words", "&checkpoint wall_limit=1000 /\n", ["--wall-limit", "0:00:02.4"])):
        write_deck(root / name, "t_end=1e6 status_every=0.02", PLATE + keys)
        began = time.monotonic()
        ended(start(root / name, *words), 3, "stopped for the wall-time limit of 2.4 s after step")
        took = time.monotonic() - began
        check(0.8 < took < 2.4, f"it stops before 2.4 s, and not long before: {took} s")
    whole(root / "whole", "t_end=8")
    write_deck(root / "jobs", "t_end=8", PLATE + "&checkpoint wall_limit=0.01 /\n")
    jobs = 1
    done = cleave(root / "jobs", "case.nml")
    while done.returncode == 3 and jobs < 30:
        done = cleave(root / "jobs", "restart", ".")
        jobs += 1
    check(done.returncode == 0 and jobs == checkpoints(root / "jobs")[-1], f"a step in each of {jobs} jobs",
          done.stdout + done.stderr)
    same(root / "jobs", root / "whole")
    write_deck(root / "none", "t_end=8", PLATE + "&checkpoint wall_limit=0.01 /\n")
    done = cleave(root / "none", "--wall-limit", "0", "case.nml")
    check(done.returncode == 0, "--wall-limit 0 switches that of the deck off", done.stdout)
    done = cleave(root / "none", "--wall-limit", "1:75", "case.nml")
    check(done.returncode == 2 and '"1:75" is no wall time' in done.stderr, "a bad limit", done.stderr)


def every_wall_time(root):
    """Results do not depend on when checkpoints are written."""
    whole(root / "whole", "t_end=800")
    began = time.monotonic()
    whole(root / "often", "t_end=800", PLATE + "&checkpoint every_wall=0.02 keep=1000 /\n")
    took = time.monotonic() - began
    steps = checkpoints(root / "often")
    check(3 < len(steps) <= took / 0.02 + 1, f"checkpoints every 0.02 s in {took} s, not {len(steps)}")
    same(root / "often", root / "whole")
    middle = steps[len(steps) // 2]
    shutil.copytree(root / "often", root / "cut")
    continued(root / "cut", f"case.{middle}.checkpoint.nc")
    same(root / "cut", root / "whole")


def on_full_disk(root):
    """No file may grow to the size of a checkpoint: the run goes on or stops, as the deck says."""
    plan = SHORT + "&checkpoint every_steps=200 on_failure='{}' /\n"
    keys = "t_end=2000 status_every=0.02"
    whole(root / "whole", keys, plan.format("continue"))
    largest = max((root / "whole" / name).stat().st_size for name in FILES)
    newest = checkpoints(root / "whole")[-1]
    needed = (root / "whole" / f"case.{newest}.checkpoint.nc").stat().st_size
    check(largest < 0.9 * needed, f"the test can tell a checkpoint, {needed}, from the rest, {largest}")
    limit = (largest + needed) // 2

    write_deck(root / "goes_on", keys, plan.format("continue"))
    run = start(root / "goes_on", prepare=lambda: resource.setrlimit(resource.RLIMIT_FSIZE, (limit, limit)))
    said = ended(run, 0, "warning: no checkpoint after step 200: case.200.checkpoint.nc", "'ulimit -f'",
                 f"warning: no checkpoint after step {newest}")
    check(not checkpoints(root / "goes_on"), "none could be written", said)
    check(not list((root / "goes_on").glob("*.part")), "no rest of one")
    same(root / "goes_on", root / "whole")

    # full for a while: also the records that wait to be written come later
    write_deck(root / "for_a_while", keys, plan.format("continue"))
    run = start(root / "for_a_while")
    wait_for(lambda: checkpoints(root / "for_a_while"), "the first checkpoint")
    resource.prlimit(run.pid, resource.RLIMIT_FSIZE, (100, resource.RLIM_INFINITY))
    warned = next((line for line in run.stdout if "warning: no checkpoint" in line), "")
    check("case.events.nc: " in warned, "the records could not be written", warned)
    resource.prlimit(run.pid, resource.RLIMIT_FSIZE, (resource.RLIM_INFINITY, resource.RLIM_INFINITY))
    ended(run, 0, "done: ")
    check(checkpoints(root / "for_a_while")[-1] == newest, "the next ones are written")
    same(root / "for_a_while", root / "whole")

    for name, policy, code, says in (("stops", "stop", 1, "as on_failure = 'stop'"),
                                     ("stopped", "continue", 1, "stopped on request after step ")):
        write_deck(root / name, keys, plan.format(policy))
        run = start(root / name)
        wait_for(lambda: checkpoints(root / name), "the first checkpoint")
        resource.prlimit(run.pid, resource.RLIMIT_FSIZE, (limit, limit))
        if policy == "continue":
            run.send_signal(signal.SIGTERM)
        said = ended(run, code, says, "no checkpoint after step",
                     "Continue from the last good one with: cleave restart case.")
        continued(root / name, re.search(r"cleave restart (case\.\d+\.checkpoint\.nc)", said).group(1))
        same(root / name, root / "whole")


MEMORY = "/dev/shm"
with tempfile.TemporaryDirectory(dir=MEMORY if os.access(MEMORY, os.W_OK | os.X_OK) else None) as temporary:
    for test in (on_usr1, on_terminate, on_second_interrupt, read_while_running, on_stop_file, before_wall_limit,
                 every_wall_time, on_full_disk):
        test(pathlib.Path(temporary) / test.__name__)
