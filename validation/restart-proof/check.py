"""Runs that are killed at random moments, restarted and finished, against the same runs left alone: every byte of the files.

problems.py has the decks, killed.py kills and restarts, timeline.py draws what happened.
"""
import dataclasses
import json
import math
import pathlib
import shutil
import sys
import zlib

import numpy
from tools import results
from tools.simulation import Run

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))
import killed  # noqa: E402
import problems  # noqa: E402

THREADS = (1, 2, 3, 4, 7)                          # of the runs left alone
FILES = {"results": ".exo", "history": ".history.nc", "csv": ".history.csv", "events": ".events.nc", "deck": ".resolved.nml"}
RECORD = "killed.json"
PROCESSES = {"quick": 8, "full": 20}               # in one run, about: how often it is killed


def runs(mode):
    return [Run(problem.name, work=lambda site, problem=problem: prove(site, problem, PROCESSES[mode]))
            for problem in problems.problems(mode)]


# ---- runs

def prove(site, problem, processes):
    """The run left alone on several numbers of threads; the run killed until it was killed often enough; the comparison."""
    source = site.folder / "source"
    source.mkdir()
    problem.prepare(site.case_folder.parent, source)
    deck = f"{problem.name}.nml"
    for threads in THREADS:
        killed.run_whole(site.cleave, shutil.copytree(source, site.folder / f"threads-{threads}"), deck, threads)
    whole = site.folder / "threads-1"
    record = {"steps": max(killed.checkpoints(whole)), "interval": problem.interval,
              "threads": {threads: total(differences(whole, site.folder / f"threads-{threads}", problem.name))
                          for threads in THREADS[1:]}, "runs": []}
    killer = killed.Killer(site.cleave, deck, record["steps"] / processes,
                           numpy.random.default_rng(zlib.crc32(problem.name.encode())))
    while not record["runs"] or (killer.kills < problem.kills and not failed(record)):
        folder = shutil.copytree(source, site.folder / f"killed-{len(record['runs']) + 1}")
        folder, attempts = killer.until_done(folder, problem.kills)
        found = differences(whole, folder, problem.name)
        record["runs"].append({"attempts": [dataclasses.asdict(attempt) for attempt in attempts], "bytes": found})
        if not any(found.values()):
            shutil.rmtree(folder)                  # one that differs stays, to be looked at
    (site.folder / RECORD).write_text(json.dumps(record, indent=1), encoding="utf-8")


def differences(whole, folder, name):
    """Bytes that differ, by kind of file; and how many files only one of the two folders has, checkpoints aside."""
    found = {kind: killed.differing_bytes(whole / (name + ending), folder / (name + ending)) for kind, ending in FILES.items()}
    last = f"{name}.{max(killed.checkpoints(whole))}.checkpoint.nc"
    found["checkpoint"] = killed.differing_bytes(whole / last, folder / last)
    names = [{path.name for path in place.iterdir() if not killed.CHECKPOINT.search(path.name)} for place in (whole, folder)]
    found["files"] = len(names[0] ^ names[1])
    return found


def total(found):
    return math.fsum(found.values())


def failed(record):
    return any(attempt["ended"] == "failed" for run in record["runs"] for attempt in run["attempts"])


# ---- figures

def check(case):
    for name, result in case.results.items():
        record = json.loads((result.folder / RECORD).read_text(encoding="utf-8"))
        check_attempts(case, name, record)
        for kind in (*FILES, "checkpoint", "files"):
            case.figure(f"{kind}_{name}", math.fsum(run["bytes"][kind] for run in record["runs"]))
        for threads in THREADS[1:]:
            case.figure(f"threads-{threads}_{name}", record["threads"][str(threads)])
    check_content(case)


def check_attempts(case, name, record):
    attempts = [attempt for run in record["runs"] for attempt in run["attempts"]]
    ends = [attempt["ended"] for attempt in attempts]
    case.figure(f"runs_{name}", len(record["runs"]))
    for kind in ("KILL", "TERM", "INT"):
        case.figure(f"kills_{kind}_{name}", ends.count(kind))
    case.figure(f"kills_in_write_{name}", sum(attempt["in_write"] for attempt in attempts))
    case.figure(f"restarts_{name}", sum(attempt["first"] > 0 for attempt in attempts))
    case.figure(f"copied_{name}", sum(attempt["copied"] for attempt in attempts))
    case.figure(f"damaged_{name}", sum(attempt["damaged"] != "" for attempt in attempts))
    case.figure(f"skipped_{name}", sum(attempt["skipped"] for attempt in attempts))
    case.figure(f"failed_{name}", ends.count("failed"))
    case.figure(f"wrong_checkpoint_{name}", sum(wrong(attempt) for attempt in attempts))
    pairs = [pair for run in record["runs"] for pair in zip(run["attempts"], run["attempts"][1:])]
    case.figure(f"lost_at_kill_{name}", largest(pairs, simple) / record["interval"])
    case.figure(f"lost_at_stop_{name}", largest(pairs, stopped))
    case.figure(f"repeated_{name}", sum(lost(*pair) for pair in pairs) / record["steps"] / len(record["runs"]))


def wrong(attempt):
    """It went on from another checkpoint than the newest whole one, or did not name every damaged one that is newer."""
    told = attempt["status"] >= 0 or attempt["seen"] > attempt["first"]      # a process killed early has said nothing yet
    return told and (attempt["first"], attempt["skipped"]) != (attempt["expected"], attempt["ignored"])


def lost(before, after):
    """Steps that are done again."""
    return max(0, before["seen"] - after["expected"])


def largest(pairs, kind):
    """Of the steps lost between two processes of a kind; not-a-number if there are none."""
    return max((lost(*pair) for pair in pairs if kind(*pair)), default=math.nan)


def simple(before, after):
    """A kill that nothing was added to."""
    return before["ended"] == "KILL" and not (after["damaged"] or after["ignored"])


def stopped(before, after):
    return before["status"] == killed.STOPPED and not after["damaged"]


def check_content(case):
    """That there was something to lose."""
    folders = {name: result.folder / "threads-1" for name, result in case.results.items()}
    case.figure("broken_plate", len(results.read_table(folders["plate"] / "plate.events.nc")["time"]))
    for name in ("bar", "static"):
        field = "equivalent_plastic_strain"
        data = results.Exodus(folders[name] / f"{name}.exo")
        case.figure(f"plastic_{name}", (data.nodal if name == "bar" else data.element)(field).max())


def pictures(case, folder):
    import timeline
    return timeline.pictures(case, folder)
