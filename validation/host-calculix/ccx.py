"""Runs CalculiX with libCLEAVE.so in reach and reads the totals and displacements it prints.

CalculiX is the one of the environment variable CCX, else build/ccx/bin/ccx, where build_ccx puts it when it is asked
for build/ccx; libCLEAVE.so the one of the environment variable CLEAVE_CALCULIX, else that of the build or the
installation to which the program cleave belongs.
"""
import os
import pathlib
import re
import shutil
import subprocess

import numpy

HERE = pathlib.Path(__file__).resolve().parent
ROOT = HERE.parents[1]
NO_BEHAVIOURS = "it was built without external behaviours and ignores materials with @ in their names; Debian's package is"

PROBE = """*NODE, NSET=NALL
1, 0., 0., 0.\n2, 1., 0., 0.\n3, 1., 1., 0.\n4, 0., 1., 0.\n5, 0., 0., 1.\n6, 1., 0., 1.\n7, 1., 1., 1.\n8, 0., 1., 1.
*ELEMENT, TYPE=C3D8, ELSET=ALL
1, 1, 2, 3, 4, 5, 6, 7, 8
*MATERIAL, NAME=@CLEAVE_SVK@PROBE
*USER MATERIAL, CONSTANTS=3
1., 1000., 0.25
*DENSITY
1.
*SOLID SECTION, ELSET=ALL, MATERIAL=@CLEAVE_SVK@PROBE
*NSET, NSET=FOOT
1, 2, 3, 4
*NSET, NSET=TOP
5, 6, 7, 8
*BOUNDARY
FOOT, 1, 3
*STEP, NLGEOM
*DYNAMIC, EXPLICIT
1e-5, 1e-3, 1e-9, 1e-5
*BOUNDARY
TOP, 3, 3, 0.001
*NODE PRINT, NSET=TOP, TOTALS=ONLY, FREQUENCY=1000
RF
*END STEP
"""


class CcxError(Exception):
    """CalculiX or libCLEAVE.so is missing or did not finish."""


def program():
    """Path of CalculiX, or None."""
    given = os.environ.get("CCX")
    return shutil.which(given) if given else shutil.which(str(ROOT / "build/ccx/bin/ccx"))


def library(cleave):
    """Folder of libCLEAVE.so that belongs to the program cleave, or None."""
    top = pathlib.Path(cleave).resolve().parents[1]
    places = [top / "kernels/adapters/calculix", *sorted(top.glob("lib*/cleave/calculix")),
              *sorted(top.glob("lib*/*/cleave/calculix"))]
    given = os.environ.get("CLEAVE_CALCULIX")
    for place in [pathlib.Path(given).parent] if given else places:
        if (place / "libCLEAVE.so").is_file():
            return place
    return None


def execute(ccx, behaviours, folder, name, files):
    """Writes the files (name -> text) and runs ccx NAME in the folder; returns the path of NAME.dat."""
    folder = pathlib.Path(folder)
    shutil.rmtree(folder, ignore_errors=True)
    folder.mkdir(parents=True)
    for file, text in files.items():
        (folder / file).write_text(text, encoding="utf-8")
    # One thread: with more the results are reproducible to rounding only.
    environment = dict(os.environ, OMP_NUM_THREADS="1", LD_LIBRARY_PATH=os.pathsep.join(
        filter(None, (str(behaviours), os.environ.get("LD_LIBRARY_PATH")))))
    log = folder / f"{name}.log"
    with open(log, "w", encoding="utf-8") as out:
        status = subprocess.run([ccx, name], cwd=folder, env=environment, stdin=subprocess.DEVNULL, stdout=out,
                                stderr=subprocess.STDOUT, check=False).returncode
    text = log.read_text(errors="replace")
    if status != 0 or "*ERROR" in text or re.search(r"Wave Speed.*NaN", text):
        errors = [line.strip() for line in text.splitlines() if "ERROR" in line or "NaN" in line][:3] or text.splitlines()[-3:]
        raise CcxError(f"ccx {name} ended with {status}; see {log}: " + " ".join(errors))
    return folder / f"{name}.dat"


def has_behaviours(ccx, behaviours, folder):
    """Whether this CalculiX calls libCLEAVE.so: without external behaviours it runs on without a stress, exit status 0."""
    try:
        dat = execute(ccx, behaviours, folder, "probe", {"probe.inp": PROBE})
    except CcxError as error:
        if "NaN" in str(error):
            return False
        raise
    _, force = totals(dat)
    return bool(abs(force[-1, 2]) > 0)


def _blocks(dat, title):
    """(time, lines) of every block whose title holds the text."""
    lines = dat.read_text(errors="replace").splitlines()
    for k, line in enumerate(lines):
        if title in line:
            rows = []
            for row in lines[k + 2:]:
                if not row.strip():
                    break
                rows.append([float(word) for word in row.split()])
            yield float(line.split()[-1]), rows


def totals(dat):
    """Times and total forces (n, 3) of the one set that is printed."""
    times, rows = zip(*_blocks(dat, "total force"))
    return numpy.array(times), numpy.array([row[0] for row in rows])


def displacements(dat, node_set):
    """Times and displacements (n, 3) of a set of one node."""
    times, rows = zip(*_blocks(dat, f"displacements (vx,vy,vz) for set {node_set} and"))
    return numpy.array(times), numpy.array([row[0][1:] for row in rows])


def iterations(dat):
    """Newton iterations of a run, those of increments that were tried again included."""
    return len(re.findall(r"^ iteration +\d+", dat.with_suffix(".log").read_text(errors="replace"), re.MULTILINE))
