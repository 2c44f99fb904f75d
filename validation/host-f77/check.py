"""Program IMPACT, a Fortran 77 host of the array calls, against the driver: every bit of the state at the end.

Both compute the same plate (plane strain) and the same rod (in space) on the mesh that IMPACT wrote, with the same
step.  Then IMPACT against itself: restarted, on threads, compiled otherwise, and after errors.
"""
import re
import shutil

import matplotlib.pyplot as plt
import netCDF4
import numpy
from tools import deck, host_code, picture
from tools.results import read_table
from tools.simulation import Run

FLAGS = "-std=legacy -O2 -ffp-contract=off -fopenmp"
BUILDS = {  # name: flags of host and layer
    "impact": FLAGS,
    "native": "-std=legacy -O3 -march=native -ffp-contract=off -ffpe-trap=invalid,zero,overflow",
    "integer8": FLAGS + " -fdefault-integer-8",
}
BODIES = ("plate", "rod")
# Twice the cells in --full, and half the step: changes of the host's deck and of the driver's.
FINE = {
    "plate": ({"BAR.NX": 24, "BAR.NL": 120, "RUN.DT": 8e-9, "RUN.NSTEP": 6000, "MAT1.ALC": 0.25e-3},
              {"run.time_step": 8e-9, "viscosity.length": 0.25e-3}),
    "rod": ({"BAR.NX": 8, "BAR.NL": 40, "RUN.DT": 3e-8, "RUN.NSTEP": 2000, "MAT1.ALC": 0.8e-3},
            {"run.time_step": 3e-8, "viscosity.length": 0.8e-3}),
}
HALFWAY, WITHHELD = 700, 904   # step of the restart; step that fails for want of a property, between two restart files
# Records of the restart file after the counts and the energies, with their lengths, and the driver's names.
RECORDS = {"displacement": 3, "velocity": 3, "acceleration": 3, "internal_force": 3, "viscous_force": 3,
           "external_force": 3, "first_piola_kirchhoff_stress": 9, "history": 8, "strain_energy_density": 1}
HISTORY = ("plastic_metric", "equivalent_plastic_strain", "thickness_strain")
ENERGIES = ("kinetic", "elastic", "plastic", "viscous", "external")


def skip(case):
    return host_code.obstacle(case.cleave)


def runs(mode):
    return [Run("impact", work=lambda site: do_work(site, mode == "full"))]


def do_work(site, fine):
    prefix = host_code.install(site)
    programs = {name: host_code.build(prefix, site, "impact", name, FFLAGS=flags) for name, flags in BUILDS.items()}
    for body in BODIES:
        work_on(site, programs, body, *(FINE[body] if fine else ({}, {})))


def work_on(site, programs, body, host_changes, driver_changes):
    """All runs of one body, each in a folder BODY-NAME."""
    text = (site.case_folder / f"{body}.dat").read_text(encoding="utf-8")

    def host(name, program="impact", threads=1, expected=0, begin=None, **changes):
        folder = site.folder / f"{body}-{name}"
        if begin:
            shutil.copytree(begin, folder)
        changes = host_changes | {key.replace("_", "."): value for key, value in changes.items()}
        host_code.run(programs[program], folder, deck.vary(text, changes), threads, expected)
        return folder

    first = host("whole")
    host("threads", threads=4)
    host("native", "native")
    host("integer8", "integer8")
    half = host("half", RUN_NSTEP=HALFWAY)
    host("restarted", begin=half, RUN_NREST=1)
    failed = host("failed", threads=2, expected=2, RUN_NBAD=WITHHELD)
    host("continued", begin=failed, RUN_NREST=1)
    host("crushed", threads=2, expected=2, BAR_VEL=[0.0, -9e3, 0.0] if body == "plate" else [0.0, 0.0, -9e3])

    driver = site.folder / f"{body}-driver"
    driver.mkdir()
    shutil.copy(first / f"{body}.msh", driver)
    changed = deck.vary((site.case_folder / f"{body}.nml").read_text(encoding="utf-8"), driver_changes)
    (driver / f"{body}.nml").write_text(changed, encoding="utf-8")
    host_code.drive(site, driver, f"{body}.nml")


def check(case):
    folder = case.results["impact"].folder
    case.figure("not_fixed_form", len(breaches(case.folder)))
    for body in BODIES:
        host, driver = state_of_host(folder, body, "whole"), state_of_driver(folder, body)
        for name in RECORDS:
            case.figure(f"{name}_{body}", different(host[name], driver[name]))
        case.figure(f"values_{body}", sum(array.size for array in driver.values()))
        case.figure(f"plastic_strain_{body}", host["history"][:, 6].max())
        case.figure(f"energies_{body}", energy_difference(folder, body))
        case.figure(f"closure_{body}", closure(folder, body))
        for name in ("threads", "native", "restarted", "continued"):
            case.figure(f"{name}_{body}", different_bytes(folder, body, name))
        other = state_of_host(folder, body, "integer8", 8)
        case.figure(f"integer8_{body}", sum(different(host[name], other[name]) for name in RECORDS))
        case.figure(f"withheld_{body}", withheld(folder, body))
        case.figure(f"crushed_{body}", crushed(folder, body))


def breaches(folder):
    """Lines beyond column 72 and names of more than six letters in the sources of the host."""
    known = {"PROGRAM", "INCLUDE", "IMPLICIT", "PARAMETER", "CHARACTER", "SUBROUTINE", "FUNCTION", "DIMENSION", "NAMELIST",
             "CONTINUE", "INTEGER", "BACKSPACE"}
    found = []
    for path in sorted([*folder.glob("*.f"), *folder.glob("*.inc")]):
        for line in path.read_text(encoding="ascii").splitlines():
            words = [] if line.startswith("C") else re.findall(r"[A-Z][A-Z0-9]{6,}", re.sub("'[^']*'", "", line))
            found += [line] * (len(line) > 72) + [word for word in words if word not in known]
    return found


def records(path):
    """Records of an unformatted sequential file."""
    data, found, place = path.read_bytes(), [], 0
    while place < len(data):
        length = int.from_bytes(data[place:place + 4], "little")
        found.append(data[place + 4:place + 4 + length])
        place += length + 8
    return found


def state_of_host(folder, body, name, integer=4):
    """Arrays of the restart file, one row a particle."""
    counts, _, *arrays = records(folder / f"{body}-{name}" / f"{body}.rst")
    particles = int(numpy.frombuffer(counts, f"<i{integer}")[1])
    return {name: numpy.frombuffer(array).reshape(particles, columns)
            for (name, columns), array in zip(RECORDS.items(), arrays, strict=True)}


def state_of_driver(folder, body):
    """The same of the checkpoint at the end."""
    path, = (folder / f"{body}-driver").glob("*.checkpoint.nc")
    with netCDF4.Dataset(path) as file:
        file.set_auto_mask(False)
        read = {name: numpy.asarray(file.variables["bar:" + name][:]) for name in (*RECORDS, *HISTORY) if name != "history"}
    rows = {name: array.reshape(len(read["displacement"]), -1) for name, array in read.items()}
    rows["history"] = numpy.hstack([rows[name] for name in HISTORY])
    return {name: rows[name] for name in RECORDS}


def different(one, other):
    """How many numbers differ in a bit; not-a-number where they are none."""
    if one.shape != other.shape or not numpy.isfinite(other).all():
        return numpy.nan
    bits = [numpy.ascontiguousarray(array, "<f8").view("<i8") for array in (one, other)]
    return int((bits[0] != bits[1]).sum())


def different_bytes(folder, body, name):
    """How many bytes of restart and history file differ from those of the run in one go."""
    count = 0
    for ending in ("rst", "his"):
        one, other = ((folder / f"{body}-{run}" / f"{body}.{ending}").read_bytes() for run in ("whole", name))
        if len(one) != len(other) or not one:
            return numpy.nan
        count += int((numpy.frombuffer(one, "u1") != numpy.frombuffer(other, "u1")).sum())
    return count


def listing(folder, body, name):
    """Text of the listing, and the steps after which it says that the restart file was saved."""
    text = (folder / f"{body}-{name}/listing").read_text(encoding="utf-8")
    return text, [int(step) for step in re.findall(r"restart file saved after step +(\d+)", text)]


def withheld(folder, body):
    """1 if the wrong count was told and the step before was saved."""
    text, saved = listing(folder, body, "failed")
    return int("law j2 takes 7 properties, not 6;" in text and saved == [WITHHELD - 1])


def crushed(folder, body):
    """1 if the message names the first particle that the host found marked in its own array, and a step was saved."""
    text, saved = listing(folder, body, "crushed")
    told = re.findall(r"law j2 has no answer at point (\d+);", text)
    marked = re.findall(r"no stress of particle +(\d+) at", text)
    return int(len(told) == 1 and told == marked[:1] and len(saved) == 1)


def history_of_host(folder, body):
    lines = (folder / f"{body}-whole/{body}.his").read_text(encoding="utf-8").splitlines()
    return dict(zip(lines[0].split(), numpy.array([line.split() for line in lines[1:]], float).T, strict=True))


def energy_difference(folder, body):
    """Largest difference of an energy in all records over the kinetic energy at impact."""
    host, driver = history_of_host(folder, body), read_table(folder / f"{body}-driver/{body}.history.nc")
    if not numpy.array_equal(host["step"], driver["step"]):
        return numpy.nan
    return max(abs(host[name] - driver[name]).max() for name in ENERGIES) / host["kinetic"][0]


def closure(folder, body):
    history = history_of_host(folder, body)
    return abs(history["balance"]).max() / history["kinetic"][0]


def pictures(case, folder):
    results = case.results["impact"].folder
    figure, axes = plt.subplots(1, 3, figsize=(11, 5), layout="constrained", width_ratios=(1, 1, 1.3))
    for body, ax in zip(BODIES, axes):
        draw_body(results, body, ax)
    draw_energies(results, axes[2])
    picture.save(figure, folder / "figure.png", dpi=130)
    return [("figure.png", "Plate and rod as the Fortran code computes them, and energies of the rod over the driver's")]


def draw_body(results, body, axes):
    """Particles (of the rod: in the plane y = 0), coloured by plastic strain."""
    up = 1 if body == "plate" else 2
    state = state_of_host(results, body, "whole")
    path, = (results / f"{body}-driver").glob("*.checkpoint.nc")
    with netCDF4.Dataset(path) as file:
        points = numpy.asarray(file.variables["bar:reference_position"][:])
    near = abs(points[:, 1]) < 1e-9 if up == 2 else slice(None)
    place = (points + state["displacement"])[near] * 1e3
    drawn = axes.scatter(place[:, 0], place[:, up], c=state["history"][near, 6], s=7, vmin=0, vmax=1.2)
    axes.set(title=body, xlabel="x (mm)", ylabel="height (mm)", aspect="equal", ylim=(-0.5, 30))
    if body == "rod":
        axes.figure.colorbar(drawn, ax=axes, label="equivalent plastic strain")


def draw_energies(results, axes):
    host, driver = history_of_host(results, "rod"), read_table(results / "rod-driver/rod.history.nc")
    for name, colour in zip(("kinetic", "plastic", "viscous"), ("#1f6f8b", "#c4173a", "#ee6c2b")):
        axes.plot(driver["time"] * 1e6, driver[name], color=colour, lw=5, alpha=0.4)
        axes.plot(host["time"] * 1e6, host[name], "k", lw=1)
        axes.annotate(name, (host["time"][-1] * 1e6, host[name][-1]), xytext=(0, 7), textcoords="offset points", ha="right")
    axes.set(title="energies of the rod: IMPACT (black), driver", xlabel="time (µs)", ylabel="energy (J)")
