"""The disk fails, or the process is killed, at every call that changes a file: of a run and of a restart.
Afterwards a restart ends in the files of the uninterrupted run.

  every_call.py PROGRAM FAULTY_CALLS [--full]

Without --full the kills come at every call (but closing, which changes no file), and the errors at a sample
in which every kind of call on every file occurs with every kind of error."""

import collections
import concurrent.futures
import os
import pathlib
import random
import shutil
import sys

from small_run import SmallRun, copy_of, fail, report, scratch_folder

KINDS = ["kill", "torn", "ENOSPC", "EIO", "full", "short"]
WRITES = ("write", "pwrite", "writev")


def fits(kind, call):
    """Others come to the same as a fault of this kind at another call, or as another kind."""
    if kind == "kill":
        return call.name != "close"
    if kind in ("torn", "short"):
        return call.name in WRITES
    return kind != "full" or call.name != "unlink"


def chosen(calls, full):
    """Pairs of a kind of fault and a call."""
    if full:
        return [(kind, call) for kind in KINDS for call in calls]
    fitting = [(kind, call) for kind in KINDS for call in calls if fits(kind, call)]
    pairs = [pair for pair in fitting if pair[0] == "kill"]
    groups = collections.defaultdict(list)
    for kind, call in fitting:
        name = "".join(c for c in pathlib.Path(call.path).name if not c.isdigit())
        groups[kind, call.name, name].append((kind, call))
    generator = random.Random(5)
    for (kind, _, _), members in groups.items():
        if kind != "kill":
            pairs += generator.sample(members, min(1, len(members)))
    return pairs


def one_fault(run, label, prepared, action, kind, call, saved):
    """A run with a fault, and its restart; the text of what is wrong, or None."""
    name = f"{label}-{kind}-{call.number}"
    folder = copy_of(prepared, name)
    try:
        hurt = action(folder, kind=kind, at=call.number)
        if kind in ("kill", "torn") and hurt.returncode != -9:
            fail(f"the run was to be killed: exit code {hurt.returncode}", hurt.stdout + hurt.stderr)
        if hurt.returncode not in (-9, 0, 1, 2) or (hurt.returncode > 0 and not hurt.stderr):
            fail(f"exit code {hurt.returncode} after an error", hurt.stdout + hurt.stderr)
        run.finish(folder, saved[call.number], threads=2 if call.number % 16 == 0 else 1)
    except AssertionError as error:
        return f"{name} ({call.name} {pathlib.Path(call.path).name}): {error}"
    finally:
        shutil.rmtree(folder)
    return None


def all_faults(run, pool, label, prepared, action, full):
    counted = copy_of(prepared, f"{label}-counted")
    calls = run.calls(counted, action)
    run.compare(counted)
    saved = run.steps_saved(calls)
    if label == "restart":
        newest = max(int(p.name.split(".")[1]) for p in prepared.glob("case.*.checkpoint.nc"))
        saved = {number: step or newest for number, step in saved.items()}
    pairs = chosen(calls, full)
    print(f"{label}: {len(calls)} calls,",
          ", ".join(f"{sum(k == kind for k, _ in pairs)} {kind}" for kind in KINDS), flush=True)
    jobs = [pool.submit(one_fault, run, label, prepared, action, kind, call, saved)
            for kind, call in pairs]
    failures = [text for text in (job.result() for job in jobs) if text]
    report(failures, f"{len(pairs)} faults in a {label}")
    return calls


def main(program, faulty_calls, full):
    with scratch_folder() as root, concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
        run = SmallRun(program, root, faulty_calls)
        calls = all_faults(run, pool, "run", run.folder("fresh"), run.start, full)
        # Killed while the fourth checkpoint is written: what a restart finds on most days.
        third = [call for call in calls if call.name == "rename" and "checkpoint" in call.path][2]
        cut = run.folder("cut")
        run.start(cut, kind="kill", at=third.number + 30)
        all_faults(run, pool, "restart", cut, run.restart, full)


if __name__ == "__main__":
    main(sys.argv[1], sys.argv[2], "--full" in sys.argv[3:])
