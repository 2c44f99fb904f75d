"""The same block in LAMMPS, if it is installed: bond-based (pmb) and state-based (lps) peridynamics of a cube of particles,
horizon three spacings, without breaking. On several cores it runs with as many MPI ranks. Nothing of it is linked.
"""
import os
import pathlib
import re
import shutil
import subprocess
import tempfile

SPACING = 5e-4
HORIZON = 3.0  # spacings, and a little more against rounding: 122 neighbours inside

DECK = """units si
boundary s s s
atom_style peri
atom_modify map array
neighbor {skin} bin
neigh_modify delay 1000000 check no
lattice sc {spacing}
region block block 0 {edge} 0 {edge} 0 {edge} units lattice
create_box 1 block
create_atoms 1 region block
pair_style peri/{style}
pair_coeff * * {coefficients}
set group all density 2200
set group all volume {volume}
velocity all create 1e10 1 dist uniform
fix 1 all nve
timestep 1e-9
thermo {steps}
run {steps}
"""
# critical stretch 0.5: bonds are tested, none breaks
COEFFICIENTS = {"pmb": "1.6863e22 {horizon} 0.5 0.25", "lps": "14.9e9 14.9e9 {horizon} 0.5 0.25"}


def program():
    return shutil.which("lmp")


def ranks_possible():
    return shutil.which("mpirun") is not None


def run(style, edge, steps, ranks):
    """A record of one run of edge^3 particles: particle-steps per second, neighbours, bytes per particle."""
    horizon = HORIZON * SPACING * 1.0001
    text = DECK.format(skin=0.5 * SPACING, spacing=SPACING, edge=edge - 0.5, style=style, volume=SPACING**3, steps=steps,
                       coefficients=COEFFICIENTS[style].format(horizon=horizon))
    command = [program(), "-in", "block.in", "-log", "block.log", "-screen", "none"]
    if ranks > 1:
        command = ["mpirun", "--allow-run-as-root", "--oversubscribe", "-np", str(ranks)] + command
    with tempfile.TemporaryDirectory() as folder:
        pathlib.Path(folder, "block.in").write_text(text, encoding="utf-8")
        done = subprocess.run(command, cwd=folder, capture_output=True, text=True, check=False,
                              env={**os.environ, "OMP_NUM_THREADS": "1"})
        log = pathlib.Path(folder, "block.log")
        log = log.read_text(encoding="utf-8", errors="replace") if log.exists() else ""
    if done.returncode != 0:
        raise RuntimeError(f"lmp ended with status {done.returncode}: {(log or done.stderr)[-400:]}")
    return {**read_log(log), "style": style, "threads": ranks}


def read_log(log):
    seconds, steps, particles = re.search(r"Loop time of (\S+) on \d+ procs for (\d+) steps with (\d+) atoms", log).groups()
    bonds = re.search(r"bonds/atom = (\S+)", log)
    memory = re.search(r"memory allocation \(min/avg/max\) = (\S+) \| (\S+) \| (\S+) Mbytes", log)
    ranks = int(re.search(r"Loop time of \S+ on (\d+) procs", log).group(1))
    return {"kind": "lammps", "particles": int(particles), "seconds_per_step": float(seconds) / int(steps),
            "neighbours": float(bonds.group(1)) if bonds else None,
            "bytes": float(memory.group(2)) * ranks * 2**20 if memory else None}
