"""Checkpoints that are damaged while nobody looks: the restart says which and why, and takes the one before.

  damaged.py PROGRAM"""

import random
import shutil
import sys

from small_run import SmallRun, checkpoints, copy_of, fail, report, scratch_folder


def flipped(data, bit):
    damaged = bytearray(data)
    damaged[bit // 8] ^= 1 << bit % 8
    return bytes(damaged)


def damages(data, generator):
    """Name -> the damaged bytes."""
    size = len(data)
    yield "empty", b""
    yield "cut in the header", data[:500]
    yield "without its last byte", data[:-1]
    yield "one byte longer", data + b"\0"
    yield "zeros in a block", data[: size // 2] + bytes(4096) + data[size // 2 + 4096:]
    yield "text", b"not found\n" * 20
    for bit in sorted(generator.sample(range(8 * 8000), 6)) + generator.sample(range(8 * size), 12):
        yield f"bit {bit} flipped", flipped(data, bit)


def one_damage(run, whole, name, damaged):
    """A newest checkpoint with this damage."""
    folder = copy_of(whole, "damaged")
    try:
        files = checkpoints(folder)
        before, newest = sorted(files)
        files[newest].write_bytes(damaged)
        done = run.restart(folder)
        said = done.stdout + done.stderr
        if done.returncode != 0 or f"continued after step {before}" not in said:
            fail("the one before is taken", said)
        skipped = [line for line in said.splitlines() if "skipped" in line]
        if len(skipped) != 1 or files[newest].name not in skipped[0] or len(skipped[0]) < 60:
            fail("the damaged one is named with the reason", said)
        run.compare(folder)
    except AssertionError as error:
        return f"{name}: {error}"
    finally:
        shutil.rmtree(folder)
    return None


def no_good_one(run, whole):
    """Nothing to go on from: nothing is changed, and the message says what to do."""
    folder = copy_of(whole, "hopeless")
    for path in checkpoints(folder).values():
        path.write_bytes(flipped(path.read_bytes(), 5000))
    before = {path.name: path.read_bytes() for path in folder.iterdir()}
    done = run.restart(folder)
    if done.returncode == 0 or "no checkpoint verifies" not in done.stderr:
        return f"no good checkpoint: {done.stdout}{done.stderr}"
    if {path.name: path.read_bytes() for path in folder.iterdir()} != before:
        return "no good checkpoint: files were changed"
    done = run.start(folder)
    return None if done.returncode == 0 else f"run again: {done.stderr}"


def main(program):
    generator = random.Random(5)
    with scratch_folder() as root:
        run = SmallRun(program, root)
        newest = checkpoints(run.whole)[run.last_step].read_bytes()
        cases = list(damages(newest, generator))
        failures = [one_damage(run, run.whole, name, damaged) for name, damaged in cases]
        failures.append(no_good_one(run, run.whole))
        report([text for text in failures if text], f"{len(failures)} damages")


main(sys.argv[1])
