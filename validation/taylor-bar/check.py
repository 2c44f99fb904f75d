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


def shape(result, size):
    """Length, mushroom, diameter at the height 0.2 L0 and of what began there [mm]; size: of the mesh [mm]."""
    reference, position = current(result)
    surface = numpy.hypot(reference[:, 0], reference[:, 1]) > RADIUS * (1 - 1e-3)
    radius, height = numpy.hypot(position[:, 0], position[:, 1]), position[:, 2]
    beside = surface & (abs(height - HEIGHT) < 0.6 * size)
    began = surface & (abs(reference[:, 2] - HEIGHT) < 0.6 * size)
    return numpy.ptp(height), 2 * radius.max(), 2 * radius[beside].mean(), 2 * radius[began].mean()


def check(case):
    lengths = {}
    for name in names(case.mode):
        result = case.results[name]
        length, mushroom, middle, _ = shape(result, RUNS[name][1])
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


def current(result):
    """Reference and current positions [mm]."""
    reference = result.exodus.points * 1e3
    return reference, reference + result.exodus.displacement() * 1e3


def profiles(case):
    """Surface of every run, and the three measured numbers."""
    figure, axes = plt.subplots(figsize=(8, 4.6), layout="constrained")
    for name in names(case.mode):
        reference, position = current(case.results[name])
        surface = numpy.hypot(reference[:, 0], reference[:, 1]) > RADIUS * (1 - 1e-3)
        axes.plot(position[surface, 2], numpy.hypot(*position[surface, :2].T), ".", ms=3, label=name)
    for place, radius, mark, text in ((16.2, RADIUS, "^", "length"), (0.0, 13.5 / 2, "v", "mushroom"),
                                      (HEIGHT, 10.1 / 2, "s", "at 0.2 L0")):
        axes.plot([place], [radius], "k" + mark, ms=7, label="experiment: " + text)
    axes.set(xlabel="height above the wall (mm)", ylabel="radius (mm)", xlim=(-0.5, 19), ylim=(3, 9))
    axes.legend(fontsize=8)
    return figure


def cuts(case):
    """Particles near the plane y = 0, coloured by plastic strain."""
    shown = [name for name in ("cbm", "cbm_alpha0", "tlsph") if name in names(case.mode)] or names(case.mode)
    figure, axes = plt.subplots(1, len(shown), figsize=(3.2 * len(shown), 4.6), layout="constrained", sharey=True)
    for name, ax in zip(shown, axes):
        reference, position = current(case.results[name])
        near = abs(reference[:, 1]) < 0.6 * RUNS[name][1]
        strain = case.results[name].exodus.nodal("equivalent_plastic_strain")
        drawn = ax.scatter(position[near, 0], position[near, 2], c=strain[near], s=40 * RUNS[name][1] ** 2, vmin=0, vmax=2)
        ax.set(title=name, xlabel="x (mm)", aspect="equal", xlim=(-8.5, 8.5), ylim=(-0.5, 17))
    axes[0].set_ylabel("height (mm)")
    figure.colorbar(drawn, ax=list(axes), label="equivalent plastic strain")
    return figure


def pictures(case, folder):
    picture.save(profiles(case), folder / "figure.png", dpi=130)
    picture.save(cuts(case), folder / "cut.png", dpi=130)
    return [("figure.png", "Surface of the rod after 80 µs"), ("cut.png", "Plastic strain in a cut through the axis")]
