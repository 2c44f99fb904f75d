"""The law j2 inside CalculiX, through both interfaces of the adapter, against CalculiX's own *PLASTIC.

Needs a CalculiX with external behaviours (build_ccx makes one): the environment variable CCX names it, or it stands in
build/ccx; else the case is skipped.
"""
import concurrent.futures
import functools
import pathlib
import sys

import numpy
from matplotlib import pyplot as plt
from tools import picture
from tools.simulation import Mesh, Run

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))
import ccx  # noqa: E402
import materials  # noqa: E402
import meshes  # noqa: E402

SPACING = {"quick": 3.0, "full": 1.35}           # of the bar [mm]
BRICKS = {"quick": (3, 24), "full": (5, 40)}     # of the rod, across and along
STROKES = numpy.linspace(0.08, 2.0, 25)          # of the bar, ends of increments [mm]
KINDS = {"native": lambda metal: materials.cleave(metal), "abaqusnl": lambda metal: materials.cleave(metal, "ABAQUSNL"),
         "plastic": materials.plastic}
MANUAL = ccx.ROOT / "manuals/user/hosts/decks"
RUNS = [("tensile", "native"), ("tensile", "abaqusnl"), ("tensile", "plastic"), ("taylor", "native"), ("taylor", "plastic")]


def runs(mode):
    return [Run("fem", "../tensile-bar/fem.nml", {}, Mesh("../tensile-bar/bar.geo", (("l_c", SPACING[mode]),), "bar.msh"))]


def skip(case):
    found, behaviours = ccx.program(), ccx.library(case.cleave)
    if found is None:
        return (f"no CalculiX with external behaviours; make one by `{ccx.HERE.relative_to(ccx.ROOT)}/build_ccx build/ccx` (minutes, "
                "downloads Debian's source package) or name one with the environment variable CCX")
    if behaviours is None:
        return f"no libCLEAVE.so beside {case.cleave}; build the target cleave_calculix or name it with CLEAVE_CALCULIX"
    if not ccx.has_behaviours(found, behaviours, case.work / "probe"):
        return f"{found} cannot be used: {ccx.NO_BEHAVIOURS}; build_ccx makes one that can"
    return None


def folder(case, problem, kind):
    return case.work / f"{problem}-{kind}"


def do_run(case, problem, kind):
    metal = materials.BAR if problem == "tensile" else materials.COPPER
    mesh = meshes.bar(case.results["fem"].exodus) if problem == "tensile" else meshes.rod(*BRICKS[case.mode])
    files = {"mesh.inp": mesh, "material.inp": KINDS[kind](metal),
             f"{problem}.inp": (ccx.HERE / f"{problem}.inp").read_text(encoding="utf-8")}
    ccx.execute(ccx.program(), ccx.library(case.cleave), folder(case, problem, kind), problem, files)


def run_of_manual(case, name):
    """A deck of the manual page, as it stands there."""
    files = {f"{name}.inp": (MANUAL / f"{name}.inp").read_text(encoding="utf-8")}
    if case.evaluate:
        return case.work / name / f"{name}.dat"
    return ccx.execute(ccx.program(), ccx.library(case.cleave), case.work / name, name, files)


def dat(case, problem, kind):
    return folder(case, problem, kind) / f"{problem}.dat"


def pull(case, kind):
    """Force on the top [N/mm] over its stroke [mm]."""
    strokes, force = ccx.totals(dat(case, "tensile", kind))
    return numpy.interp(STROKES, strokes, force[:, 1])


def pull_of_driver(case):
    history = case.results["fem"].history
    stroke = 2 * numpy.interp(history["time"], (0, 0.25, 1), (0, 0.05, 1))
    return numpy.interp(STROKES, stroke, history["reaction_top_y"])


def difference(force, reference):
    return abs(force - reference).max() / abs(reference).max()


def rod(case, kind):
    """Shortening and growth of the foot at the end [mm]."""
    file = dat(case, "taylor", kind)
    return -1e3 * ccx.displacements(file, "TIP")[1][-1, 2], 1e3 * ccx.displacements(file, "FOOT")[1][-1, 0]


def check(case):
    if not case.evaluate:
        with concurrent.futures.ThreadPoolExecutor(case.jobs) as pool:
            list(pool.map(lambda pair: do_run(case, *pair), RUNS))
    native = pull(case, "native")
    case.figure("tensile_force", difference(native, pull(case, "plastic")))
    case.figure("tensile_driver", difference(native, pull_of_driver(case)))
    case.figure("tensile_abaqusnl", difference(pull(case, "abaqusnl"), native))
    count = functools.partial(dat, case, "tensile")
    case.figure("tensile_iterations", ccx.iterations(count("native")) / ccx.iterations(count("plastic")))
    (shortening, foot), (shortening_plastic, foot_plastic) = rod(case, "native"), rod(case, "plastic")
    case.figure("taylor_shortening", shortening / shortening_plastic)
    case.figure("taylor_foot", foot / foot_plastic)
    case.figure("taylor_shortening_plastic", shortening_plastic)
    case.figure("manual_pull", ccx.totals(run_of_manual(case, "calculix_pull"))[1][-1, 0])
    case.figure("manual_hit", -1e3 * ccx.displacements(run_of_manual(case, "calculix_hit"), "TOP")[1][-1, 2])


def pictures(case, target):
    figure, (left, right) = plt.subplots(1, 2, figsize=(9.6, 4.2), layout="constrained")
    left.plot(STROKES, pull_of_driver(case), color="0.6", lw=4, label="cleave, fem")
    left.plot(STROKES, pull(case, "native"), label="CalculiX, @CLEAVE_J2")
    left.plot(STROKES, pull(case, "plastic"), "k--", label="CalculiX, *PLASTIC")
    left.set(xlabel="stroke (mm)", ylabel="force (N/mm)", title="tensile bar", ylim=(0, None))
    for kind, style in (("native", "-"), ("plastic", "k--")):
        for node, direction, sign, name in (("TIP", 2, -1, "shortening"), ("FOOT", 0, 1, "growth of the foot")):
            times, u = ccx.displacements(dat(case, "taylor", kind), node)
            right.plot(1e6 * times, sign * 1e3 * u[:, direction], style, label=f"{name}, {'@CLEAVE_J2' if kind == 'native' else '*PLASTIC'}")
    right.set(xlabel="time (µs)", ylabel="(mm)", title="rod at 227 m/s")
    for axes in (left, right):
        axes.legend(fontsize=8)
    picture.save(figure, target / "figure.png", dpi=130)
    return [("figure.png", "Our law and CalculiX's own in the same elements")]
