"""Runs of the program that only a process can show: signals, exit codes, what is printed."""

import filecmp
import itertools
import math
import os
import pathlib
import re
import shutil
import signal
import subprocess
import tempfile

from run_support import FILES, PLATE, PROGRAM, check, cleave, write_deck


def stopped_and_continued(root):
    """SIGTERM in the middle: exit code 3, a checkpoint, and after a restart the same bytes."""
    write_deck(root / "whole", "t_end=1500")
    done = cleave(root / "whole", "--quiet", "case.nml")
    check(done.returncode == 0 and done.stdout == "", "quiet run", done.stdout + done.stderr)
    write_deck(root / "cut", "t_end=1500 status_every=0.02")
    run = subprocess.Popen([PROGRAM, "case.nml"], cwd=root / "cut", stdout=subprocess.PIPE, text=True)
    for line in run.stdout:  # until it steps
        if line.startswith("step "):
            break
    run.send_signal(signal.SIGTERM)
    rest = run.stdout.read()
    check(run.wait() == 3, f"exit code 3 after SIGTERM, not {run.returncode}", rest)
    check("stopped on request after step" in rest, "what a stopped run says", rest)
    check("cleave restart case." in rest, "how to continue", rest)
    again = cleave(root / "cut", "restart", ".")
    check(again.returncode == 0, "restart of a directory", again.stdout + again.stderr)
    check("continued after step" in again.stdout, "banner of a restart", again.stdout)
    for name in FILES:
        same = filecmp.cmp(root / "whole" / name, root / "cut" / name, shallow=False)
        check(same, f"{name} of the stopped run equals that of the whole run")


def moved_directory(root):
    """A run may be moved as a whole, and its mesh is not needed again."""
    write_deck(root / "here", "t_end=20 directory='out'")
    check(cleave(root / "here", "--quiet", "case.nml").returncode == 0, "run into a directory")
    shutil.move(root / "here" / "out", root / "there")
    (root / "here" / "case.nml").unlink()
    done = cleave(root, "restart", "there")
    check(done.returncode == 0, "restart of a moved directory", done.stdout + done.stderr)


def failed(root):
    """A step far above the stable one: where nothing breaks, the plate explodes."""
    tough = PLATE.replace("&fracture critical_strain=0.05 /\n", "")
    write_deck(root / "bad", "t_end=4000 time_step=4 step_check='warn'", tough)
    done = cleave(root / "bad", "case.nml")
    check(done.returncode == 1, f"exit code 1, not {done.returncode}", done.stdout + done.stderr)
    check("warning: time_step = 4 is above the stable step" in done.stdout, "warning", done.stdout)
    check("the run failed in step" in done.stderr, "what a failed run says", done.stderr)
    check((root / "bad" / "case.lastgood.checkpoint.nc").exists(), "last good state")


def told(root):
    """What a run and a check print."""
    write_deck(root / "told", "t_end=50")
    done = cleave(root / "told", "case.nml")
    for part in ["(a plate)", "1 body,", " particles,", "method cbm: ", "(stable ", "100%  t 50",
                 "broken", "M/s", "ETA", "done: ", "0 warnings", "case.exo"]:
        check(part in done.stdout, f"a run says {part!r}", done.stdout)
    check("\r" not in done.stdout, "no carriage returns without a terminal", done.stdout)
    write_deck(root / "checked", "t_end=50")
    done = cleave(root / "checked", "check", "case.nml")
    for part in ["set 'ymax': ", "memory ", "stable step ", " steps to t = 50", "estimated ",
                 "the deck is good"]:
        check(part in done.stdout, f"a check says {part!r}", done.stdout)
    check([p.name for p in (root / "checked").iterdir()] == ["case.nml"], "a check writes no file")


def told_of_interactions(root):
    """What a check says of peridynamics: ordered sets of two, three and four points, memory and time."""
    groups = """
&lattice type='cubic' spacing=1 size=4,3,3 points='centres' /
&body kinematics='3d' material='unit' formulation='cpd' /
&material name='unit' law='linear_elastic' E=1 nu=0.3 rho=1 /
&peridynamics horizon=1.8 /
"""
    write_deck(root, "t_end=50", groups)
    points = list(itertools.product(range(4), range(3), range(3)))
    near = [[sum((a - b) ** 2 for a, b in zip(p, q)) < 3.25 for q in points] for p in points]
    numbers = {2: 0, 4: 0}
    for size in numbers:
        for members in itertools.combinations(range(len(points)), size):
            if not all(near[a][b] for a, b in itertools.combinations(members, 2)):
                continue
            a, b, c = ([x - y for x, y in zip(points[m], points[members[0]])]
                       for m in (members + members)[1:4])
            flat = a[0] * (b[1] * c[2] - b[2] * c[1]) + a[1] * (b[2] * c[0] - b[0] * c[2]) \
                + a[2] * (b[0] * c[1] - b[1] * c[0]) == 0
            if size == 2 or not flat:
                numbers[size] += math.factorial(size)
    done = cleave(root, "check", "case.nml")
    check(done.returncode == 0, "check of peridynamics", done.stderr)
    check(f"interactions: {numbers[2]} one-neighbour, 0 two-neighbour, {numbers[4]} three-neighbour" in done.stdout,
          f"interactions are {numbers}", done.stdout)
    check(re.search(r"^memory [0-9.]+ [kM]B$", done.stdout, re.M), "memory", done.stdout)
    check(re.search(r"^estimated [0-9.e-]+ hours \(.+\) on 1 thread, without output$", done.stdout, re.M),
          "hours", done.stdout)
    write_deck(root / "static", "mode='static' t_end=50", groups + "&static method='relaxation' increments=5 /")
    done = cleave(root / "static", "check", "case.nml")
    check(re.search(r"^estimated at least [0-9.e-]+ hours \(.+\) on 1 thread, without output and bonds that break$", done.stdout, re.M),
          "hours of a static run", done.stdout + done.stderr)


def told_of_notches(root):
    """Bonds across a notch that is narrower than the horizon: those of two rows of six cells whose third are taken out."""
    group = """
&lattice type='square' spacing=1 size=6,2,0 points='centres' /
&body kinematics='plane_strain' material='unit' formulation='bond_pd' /
&material name='unit' law='linear_elastic' E=1 nu=0.25 rho=1 /
&peridynamics horizon=3.1 /
&notch lower=2,-1 upper=3,2 /
"""
    whole, cut = root / "whole", root / "cut"
    write_deck(whole, "t_end=50", group)
    # 0 1 | 3 4 5: 0-3 and 1-4 in each row, 1-3 also from row to row
    done = cleave(whole, "check", "case.nml")
    check(re.search(r"^  8 bonds reach across notch 1 and hold it together; &precrack cuts them$",
                    done.stdout, re.M), "bridges", done.stdout + done.stderr)
    write_deck(cut, "t_end=50", group + "&precrack points=2.5,-1,2.5,2 /\n")
    done = cleave(cut, "check", "case.nml")
    check(done.returncode == 0 and "reach across" not in done.stdout, "bridges that are cut", done.stdout + done.stderr)


def more_threads_than_cores(root):
    """Allowed and said, in a run and a check; not with --quiet, and not where there are cores enough."""
    if not hasattr(os, "sched_setaffinity"):
        return
    core = {min(os.sched_getaffinity(0))}
    write_deck(root, "t_end=5 threads=2")

    def printed(*words):
        done = subprocess.run([PROGRAM, *words], cwd=root, capture_output=True, text=True,
                              preexec_fn=lambda: os.sched_setaffinity(0, core))
        check(done.returncode == 0 and done.stderr == "", f"{words} on one core", done.stderr)
        return done.stdout

    note = "note: 2 threads, but 1 core for this process: --threads 1 is not slower\n"
    for words in (["case.nml"], ["check", "case.nml"]):
        check(note in printed(*words), f"{words} says {note!r}")
        check("note:" not in printed(*words, "--threads", "1"), f"{words} on one thread has nothing to say")
    check(printed("--quiet", "case.nml") == "", "--quiet is quiet")


with tempfile.TemporaryDirectory() as temporary:
    for test in (stopped_and_continued, moved_directory, failed, told, told_of_interactions, told_of_notches,
                 more_threads_than_cores):
        test(pathlib.Path(temporary) / test.__name__)
