"""A disk that fills up: a memory disk too small for the files of a run, then larger, or the folder is copied
elsewhere, and a restart ends in the files of the uninterrupted run.

  full_disk.py PROGRAM

Needs user and mount namespaces (unshare -Urm); exit code 77, with the reason, where there are none."""

import os
import pathlib
import shutil
import subprocess
import sys

from small_run import SmallRun, checkpoints, fail, report, scratch_folder

SKIPPED = 77
INSIDE = "--inside"


def mount(folder, kilobytes, remount=False):
    options = f"{'remount,' if remount else ''}size={kilobytes}k"
    subprocess.run(["mount", "-t", "tmpfs", "-o", options, "tmpfs", str(folder)], check=True)


def one_disk(run, disk, kilobytes):
    """A run on a disk of this size, and two ways to go on; the exit code of the run and its checkpoints."""
    mount(disk, kilobytes)
    try:
        folder = disk / "run"
        folder.mkdir()
        (folder / "case.nml").write_text(run.deck)
        done = run.start(folder)
        said = done.stdout + done.stderr
        if done.returncode != 0 and "No space left on device" not in said:
            fail("a full disk is called so", said)
        saved = sorted(checkpoints(folder))
        elsewhere = run.root / f"elsewhere-{kilobytes}"
        shutil.copytree(folder, elsewhere)
        run.finish(elsewhere)
        mount(disk, 65536, remount=True)
        run.finish(folder)
        return done.returncode, saved
    finally:
        subprocess.run(["umount", str(disk)], check=True)


def inside(program):
    with scratch_folder() as root:
        run = SmallRun(program, root)
        disk = root / "disk"
        disk.mkdir()
        enough = sum(len(data) + 4096 for data in run.files.values()) // 1024 + 4
        failures, outcomes = [], {}
        for kilobytes in range(16, enough + 160, 24):
            try:
                outcomes[kilobytes] = one_disk(run, disk, kilobytes)
            except AssertionError as error:
                failures.append(f"a disk of {kilobytes} kB: {error}")
        for kilobytes, (code, saved) in outcomes.items():
            print(f"{kilobytes:5} kB: exit code {code}, checkpoints of steps {saved}")
        codes = {code for code, _ in outcomes.values()}
        if not failures and (0 not in codes or not any(code and saved
                                                       for code, saved in outcomes.values())):
            failures.append("the sizes are to lie between too small and enough")
        report(failures, f"{len(outcomes) + len(failures)} disks")


def main():
    if INSIDE in sys.argv:
        inside(sys.argv[1])
        return
    try:
        possible = subprocess.run(["unshare", "-Urm", "mount", "-t", "tmpfs", "tmpfs", "/mnt"],
                                  capture_output=True, text=True)
        reason = possible.stderr.strip() if possible.returncode != 0 else None
    except FileNotFoundError as error:
        reason = str(error)
    if reason is not None:
        print(f"skipped: no private memory disk: {reason}")
        sys.exit(SKIPPED)
    os.execvp("unshare", ["unshare", "-Urm", sys.executable, str(pathlib.Path(__file__).resolve()),
                          sys.argv[1], INSIDE])


main()
