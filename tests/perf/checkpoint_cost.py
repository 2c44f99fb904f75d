"""What a checkpoint costs: MB/s of writing and verifying, and its share of the run time.

    checkpoint_cost.py --cleave BUILD/bin/cleave [--particles N] [--steps N] [--interval S] [--folder DIR]

A cracking plate of CBM is run for some steps; its last checkpoint is then written and verified again and again in DIR, which
should lie on the disk that the runs use. Judges nothing.
"""
import argparse
import math
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import time

DECK = """! {particles} particles, about
&run units = 'other', name = 'plate', t_end = {t_end}, time_step = {step}, status_every = 0.2 /
&lattice type = 'hexagonal', spacing = 1, size = {side}, {side}, 0 /
&body kinematics = 'plane_stress', material = 'unit' /
&material name = 'unit', law = 'svk', E = 1, nu = 0.25, rho = 1 /
&fracture critical_strain = 0.05 /
&precrack points = -1, {middle}, {quarter}, {middle} /
&load name = 'low', kind = 'displacement', set = 'ymin', directions = 'xy' /
&load name = 'top', kind = 'velocity', set = 'ymax', directions = 'y', value = 0.02 /
"""


def run(cleave, folder, given):
    """Wall time of a step, and the checkpoint at the end; the time of the start is taken off with a run of one step."""
    side = 2 * math.ceil(math.sqrt(given.particles) / 2)
    seconds = {}
    for steps in (1, 1 + given.steps):
        text = DECK.format(particles=given.particles, side=side, middle=side / 2 + 0.25, quarter=side / 4,
                           step=0.1, t_end=0.1 * steps)
        (folder / "plate.nml").write_text(text, encoding="utf-8")
        begun = time.monotonic()
        subprocess.run([cleave, "plate.nml", "--quiet", "--threads", str(given.threads)], cwd=folder, check=True)
        seconds[steps] = time.monotonic() - begun
    last = max(folder.glob("*.checkpoint.nc"), key=lambda path: int(path.name.split(".")[1]))
    return max(seconds[1 + given.steps] - seconds[1], 1e-9) / given.steps, last


def measure(speed, checkpoint, folder, repeats):
    done = subprocess.run([speed, checkpoint, folder, str(repeats)], check=True, capture_output=True, text=True)
    return {name: float(value) for name, value in re.findall(r"(\w+) (\S+)", done.stdout)}


def main():
    parser = argparse.ArgumentParser(description="Prints what a checkpoint costs.")
    parser.add_argument("--cleave", required=True, type=pathlib.Path, help="the program; checkpoint_speed lies beside it")
    parser.add_argument("--particles", type=int, default=100000)
    parser.add_argument("--steps", type=int, default=50, help="steps that are timed")
    parser.add_argument("--threads", type=int, default=1)
    parser.add_argument("--repeats", type=int, default=5, help="of writing and verifying; the median is printed")
    parser.add_argument("--interval", type=float, default=1800, help="wall time between checkpoints, s")
    parser.add_argument("--folder", help="where files are written; default: the system's folder for temporary files")
    given = parser.parse_args()
    cleave = shutil.which(given.cleave)
    if cleave is None:
        sys.exit(f"no program at {given.cleave}")
    cleave = pathlib.Path(cleave).resolve()
    with tempfile.TemporaryDirectory(dir=given.folder) as temporary:
        folder = pathlib.Path(temporary)
        step, checkpoint = run(cleave, folder, given)
        cost = measure(cleave.with_name("checkpoint_speed"), checkpoint, folder, given.repeats)
    megabytes = cost["bytes"] / 1e6
    print(f"checkpoint                {megabytes:.3g} MB, {cost['bytes'] / given.particles:.0f} bytes per particle")
    print(f"write, flush and verify   {megabytes / cost['write']:.4g} MB/s, {cost['write']:.3g} s")
    print(f"verify                    {megabytes / cost['verify']:.4g} MB/s, {cost['verify']:.3g} s")
    print(f"one checkpoint            as long as {cost['write'] / step:.3g} steps")
    print(f"share of the run time     {100 * cost['write'] / (given.interval + cost['write']):.2g} % with one every {given.interval:g} s")


if __name__ == "__main__":
    main()
