"""What the tests of the program share: a plate that is torn, its files, and how a run is started."""

import pathlib
import subprocess
import sys

PROGRAM = str(pathlib.Path(sys.argv[1]).resolve())

PLATE = """
&lattice type='hexagonal' spacing=1 size=60,40,0 /
&body name='plate' kinematics='plane_stress' material='unit' /
&material name='unit' law='svk' E=1 nu=0.25 rho=1 /
&fracture critical_strain=0.05 /
&precrack points=0,20,15,20 /
&load name='low' kind='displacement' set='ymin' directions='xy' /
&load name='top' kind='velocity' set='ymax' directions='y' value=0.02 /
&output every_steps=300 /
&history every_steps=10 /
"""
FILES = ["case.exo", "case.history.nc", "case.history.csv", "case.events.nc"]


def write_deck(directory, keys, groups=PLATE):
    directory.mkdir(parents=True)
    text = f"&run units='other' title='a plate' name='case' {keys} /\n{groups}"
    (directory / "case.nml").write_text(text)


def cleave(directory, *words):
    return subprocess.run([PROGRAM, *words], cwd=directory, capture_output=True, text=True)


def check(condition, what, shown=""):
    if not condition:
        sys.exit(f"FAILED: {what}\n{shown}")
