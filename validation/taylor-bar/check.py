"""Taylor test: final shape of an OFHC copper rod after 190 m/s, energy, refinement, strength sets.

Final length L, diameter of the mushroom (the widest place) and diameter at the height 0.2 L0 above the wall,
from the particles of the rod's surface at the last frame, as the experiment is measured.
"""
import matplotlib.pyplot as plt
import numpy
from tools import picture
from tools.simulation import Mesh, Run

LENGTH, RADIUS = 25.4, 3.81                      # of the rod [mm]
HEIGHT = 0.2 * LENGTH                            # where the intermediate diameter is measured [mm]
KINETIC = 0.5 * 8960 * numpy.pi * (RADIUS * 1e-3) ** 2 * LENGTH * 1e-3 * 190**2   # [J]
SET_1983 = {"material.A": 90e6, "material.B": 292e6, "material.n": 0.31, "material.C": 0.025,
            "material.eps_dot_0": 1.0}           # Johnson and Cook 1983
COARSE, FINE, FINEST = 1.0, 0.635, 0.423         # mesh sizes [mm]

# name: (deck, mesh size, changes, modes)
RUNS = {
    "cbm_coarse": ("cbm.nml", COARSE, {}, ("quick", "full")),
    "tlsph_coarse": ("tlsph.nml", COARSE, {"kernel.radius": 1.3e-3 * COARSE}, ("quick", "full")),
    "cbm": ("cbm.nml", FINE, {}, ("full",)),
    "cbm_finest": ("cbm.nml", FINEST, {}, ("full",)),
    "cbm_alpha0": ("cbm.nml", FINE, {"stabilisation.alpha": 0.0}, ("full",)),
    "cbm_set1983": ("cbm.nml", FINE, SET_1983, ("full",)),
    "tlsph": ("tlsph.nml", FINE, {}, ("full",)),
    "tlsph_psi0": ("tlsph.nml", FINE, {"hourglass.psi": 0.0}, ("full",)),
}


def names(mode):
    return [name for name, run in RUNS.items() if mode in run[3]]


def runs(mode):
    made = []
    for name in names(mode):
        deck, size, changes, _ = RUNS[name]
        mesh = Mesh("rod.geo", (("size", size),), file="rod.msh", dimension=3)
        made.append(Run(name, deck, changes, mesh))
    return made


def shape(result):
    """Length, mushroom and intermediate diameter [mm]."""
    reference = result.exodus.points * 1e3
    current = reference + result.exodus.displacement() * 1e3
    surface = numpy.hypot(reference[:, 0], reference[:, 1]) > RADIUS * (1 - 1e-3)
    radius, height = numpy.hypot(current[:, 0], current[:, 1]), current[:, 2]
    size = RUNS[result.run.name][1]
    beside = surface & (abs(height - HEIGHT) < 0.6 * size)
    return numpy.ptp(height), 2 * radius.max(), 2 * radius[beside].mean()


def check(case):
    lengths = {}
    for name in names(case.mode):
        result = case.results[name]
        length, mushroom, middle = shape(result)
        lengths[name] = length
        case.figure(f"length_{name}", length)
        case.figure(f"mushroom_{name}", mushroom)
        case.figure(f"middle_{name}", middle)
        case.figure(f"closure_{name}", abs(result.history["balance"]).max() / KINETIC)
        case.figure(f"stabilisation_{name}", result.history["stabilisation"][-1] / KINETIC)
        case.figure(f"jmin_{name}", result.exodus.nodal("volume_ratio").min())
        case.figure(f"jmax_{name}", result.exodus.nodal("volume_ratio").max())
    if case.mode == "full":
        case.figure("refinement", abs(lengths["cbm_finest"] - lengths["cbm"]) / lengths["cbm_finest"])


def pictures(case, folder):
    figure, axes = plt.subplots(figsize=(8, 4.6), layout="constrained")
    for name in names(case.mode):
        reference = case.results[name].exodus.points * 1e3
        current = reference + case.results[name].exodus.displacement() * 1e3
        surface = numpy.hypot(reference[:, 0], reference[:, 1]) > RADIUS * (1 - 1e-3)
        order = numpy.argsort(current[surface, 2])
        axes.plot(current[surface, 2][order], numpy.hypot(*current[surface, :2].T)[order], ".", ms=2, label=name)
    axes.plot([16.2], [RADIUS], "k^", label="experiment: length")
    axes.plot([0.0], [13.5 / 2], "kv", label="experiment: mushroom")
    axes.plot([HEIGHT], [10.1 / 2], "ks", label="experiment: at 0.2 L0")
    axes.set(xlabel="height above the wall (mm)", ylabel="radius (mm)", xlim=(-0.5, 19), ylim=(3, 9))
    axes.legend(fontsize=7, markerscale=3)
    picture.save(figure, folder / "figure.png", dpi=130)
    return [("figure.png", "Surface of the rod after 80 µs")]
