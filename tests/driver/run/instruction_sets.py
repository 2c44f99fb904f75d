"""The same decks under every value of CLEAVE_INSTRUCTION_SET: all files that a run writes have the same bytes.
A value that is unknown is refused with the list of those that this machine runs."""

import os
import pathlib
import re
import subprocess
import tempfile

from run_support import PLATE, PROGRAM, check, write_deck

# A bar that yields in tension and tears.
BAR = """
&lattice type='cubic' spacing=1 size=12,5,5 /
&body name='bar' kinematics='3d' material='metal' /
&material name='metal' law='j2' E=1 nu=0.3 rho=1 tau_y0=0.004 tau_inf=0.006 h0=0.001 alpha=17 /
&fracture critical_strain=0.08 /
&load name='low' kind='velocity' set='xmin' directions='x' value=-0.01 /
&load name='high' kind='velocity' set='xmax' directions='x' value=0.01 /
&output every_steps=40 /
&history every_steps=1 /
&checkpoint every_steps=30 /
"""
# A notched block of peridynamics with all interactions, and a sheet with its triangles, tearing.
BLOCK = """
&lattice type='cubic' spacing=1 size=11,6,4 points='centres' /
&notch lower=5,-1 upper=6,2.2 /
&body name='block' kinematics='3d' formulation='cpd' material='unit' /
&material name='unit' law='linear_elastic' E=1 nu=0.3 rho=1 /
&peridynamics horizon=2.4 /
&fracture critical_strain=0.02 /
&load name='low' kind='velocity' set='xmin' directions='x' value=-0.04 /
&load name='high' kind='velocity' set='xmax' directions='x' value=0.04 /
&output every_steps=10 fields='damage','equivalent_stress' /
&history every_steps=1 /
&checkpoint every_steps=15 /
"""
SHEET = BLOCK.replace("size=11,6,4", "size=21,12,0").replace("'cubic'", "'square'").replace("'3d'", "'plane_strain'")
# A lattice whose bonds soften, and one in space in the equations of small displacements.
LATTICE = """
&lattice type='hexagonal' spacing=1 size=20,12,0 /
&notch lower=9,-1 upper=10.5,3 /
&body name='sheet' kinematics='plane_strain' formulation='vcpm' material='unit' /
&material name='unit' law='linear_elastic' E=1 nu=0.4 rho=1 /
&vcpm criterion='strain' limit=0.01 softening='bilinear' final_strain=0.04 kink_strain=0.02 kink_force=0.3 /
&load name='low' kind='velocity' set='xmin' directions='x' value=-0.04 /
&load name='high' kind='velocity' set='xmax' directions='x' value=0.04 /
&output every_steps=10 fields='damage','equivalent_stress' /
&history every_steps=1 /
&checkpoint every_steps=15 /
"""
BALLS = re.sub("&vcpm.*", "&vcpm geometry='linear' surface='extend' limit=0.02 /", LATTICE).replace(
    "'hexagonal' spacing=1 size=20,12,0", "'fcc' spacing=1.5 size=16,8,6").replace("'plane_strain'", "'3d'")
DECKS = {
    "lattice": ("t_end=40", LATTICE),
    "lattice-space": ("t_end=30", BALLS),
    "block": ("t_end=25", BLOCK),
    "block-weighed": ("t_end=25", BLOCK + "&cpd weights='conservative' /\n"),
    "block-cloud": ("t_end=25", BLOCK.replace("horizon=2.4", "horizon=2.4 stencil='never'")
                    + "&cpd weights='conservative' /\n"),
    "sheet-regions": ("t_end=40", SHEET.replace("'cpd'", "'bond_pd'").replace("nu=0.3", "nu=0.25") + """
&material name='stiff' law='linear_elastic' E=3 nu=0.25 rho=2 /
&zone name='layer' lower=-1,5 upper=99,9 /
&region set='layer' material='stiff' critical_strain=0.01 /
"""),
    "sheet": ("t_end=40", SHEET),
    "sheet-state": ("t_end=40", SHEET.replace("'cpd'", "'lps'")),
    "plate": ("t_end=40", PLATE + "&checkpoint every_steps=60 /\n"),
    "bar": ("t_end=60", BAR),
}


def run(directory, deck, instruction_set):
    keys, groups = DECKS[deck]
    write_deck(directory, keys, groups)
    environment = {name: value for name, value in os.environ.items() if name != "CLEAVE_INSTRUCTION_SET"}
    if instruction_set is not None:
        environment["CLEAVE_INSTRUCTION_SET"] = instruction_set
    return subprocess.run([PROGRAM, "--quiet", "case.nml"], cwd=directory, env=environment, capture_output=True,
                          text=True)


def available(scratch):
    refused = run(scratch / "refused", "plate", "mmx")
    shown = refused.stdout + refused.stderr
    check(refused.returncode == 2, f"an unknown set is bad input, not {refused.returncode}", shown)
    check("CLEAVE_INSTRUCTION_SET is 'mmx'" in shown, "the message quotes the variable", shown)
    listed = re.search(r"runs on this machine: ([a-z0-9, ]+);", shown)
    check(listed, "the message lists what the machine runs", shown)
    return listed.group(1).split(", ")


def written(directory):
    return {path.relative_to(directory): path.read_bytes() for path in sorted(directory.rglob("*")) if path.is_file()}


with tempfile.TemporaryDirectory() as folder:
    scratch = pathlib.Path(folder)
    sets = available(scratch)
    check("baseline" in sets, "the baseline always runs", sets)
    for deck in DECKS:
        results = {}
        for name in [None, *sets]:
            directory = scratch / f"{deck}-{name}"
            done = run(directory, deck, name)
            check(done.returncode == 0, f"{deck} with {name}", done.stdout + done.stderr)
            results[name] = written(directory)
        first = results["baseline"]
        check(any("checkpoint" in str(path) for path in first), "a checkpoint was written", sorted(map(str, first)))
        for name, files in results.items():
            check(set(files) == set(first), f"{deck} with {name}: the same files", f"{set(files)} {set(first)}")
            for path, content in files.items():
                check(content == first[path], f"{deck} with {name}: the bytes of {path}")
