"""A double cantilever beam that breaks bond by bond: compliance and load against beam theory, crack and energy against each other.

The beam is loaded until the crack has grown by about 30 mm; a tooth of the load-displacement curve is one bond.
"""
import matplotlib.pyplot as plt
import numpy
from tools import picture
from tools.simulation import Run

LENGTH, CRACK, OPENING = 110.0, 50.0, 1.8                 # mm; the opening between the loaded ends when the run ends
YOUNG, POISSON, STRENGTH = 3400.0, 0.3, 6.0 * numpy.sqrt(3.0)      # MPa
SPACINGS = {"1": 1.0, "0.625": 0.625, "0.5": 0.5, "0.4": 0.4, "0.25": 0.25}      # mm
COARSE, STRAIGHT, FULL = ("1", "0.625"), ("0.5", "0.4"), ("0.25",)                # the crack of the coarse ones does not run straight
MIDDLE = "0.5"                                            # on which options are compared; in the picture


def shown(mode):
    """Lattices whose crack is to run along the middle."""
    return STRAIGHT + (FULL if mode == "full" else ())


# ---- beam theory

def rows(name):
    """Of one arm."""
    return round(10 / SPACINGS[name])


def distance(name):
    """Of two rows."""
    return SPACINGS[name] * numpy.sqrt(0.75)


def depth(name):
    """Of one arm, every row with the thickness of its cells."""
    return rows(name) * distance(name)


def inertia(name):
    """Of one arm: rows that carry along their own lines, H^3/12 (1 - 1/n^2)."""
    return depth(name) ** 3 / 12 * (1 - rows(name) ** -2.0)


def root():
    """Williams' chi: the arm is longer by this part of its depth, for the rotation of its root and its shear."""
    ratio = 2 * (1 + POISSON)                             # E/G
    gamma = 1.18 * ratio
    return float(numpy.sqrt(ratio / 11 * (3 - 2 * (gamma / (1 + gamma)) ** 2)))


def compliance(name, a):
    return 2 * (a + root() * depth(name)) ** 3 / (3 * YOUNG * inertia(name))


def slope_of_compliance(name, a):
    return 2 * (a + root() * depth(name)) ** 2 / (YOUNG * inertia(name))


# ---- runs

def beam(name, breaking="one", increments=1):
    spacing, count = SPACINGS[name], 2 * rows(name)
    half = float(0.5 * (count - 1) * distance(name))
    changes = {"static.breaking": breaking, "static.increments": increments, "lattice.spacing": spacing,
               "lattice.size": (LENGTH, 2 * half + 0.1 * spacing, 0), "precrack.points": (-1, half, CRACK, half),
               "zone(1).lower": (-0.05, half), "zone(2).upper": (0.05, half), "vcpm.strength": float(STRENGTH)}
    label = "-".join([name, breaking] + ([str(increments)] if increments > 1 else []))
    return Run(label, "beam.nml", changes)


def runs(mode):
    return [beam(name) for name in COARSE + shown(mode)] + [beam(MIDDLE, "ties", 7)]


# ---- figures

class Beam:
    """What a run says: one entry for every number of broken bonds, at the top of its tooth."""

    def __init__(self, case, label):
        self.result = case.results[label]
        self.name = label.split("-")[0]
        self.spacing = SPACINGS[self.name]
        self.events, history = self.result.events, self.result.history
        self.history = history
        broken = history["broken"].astype(int)
        self.tops = numpy.array([numpy.flatnonzero(broken == count)[-1] for count in numpy.unique(broken)])
        self.broken = broken[self.tops]
        self.opening, self.load = OPENING * history["time"][self.tops], history["reaction_up_y"][self.tops]
        self.compliance = self.opening / self.load
        self.crack = CRACK + 0.5 * self.spacing * self.broken      # half way from the last broken bond to the first that is not
        self.taken = (history["fracture"] + history["viscous"])[self.tops]

    def offset(self):
        """Largest distance of broken bonds from the middle, spacings."""
        return abs(self.events["y"] - (rows(self.name) - 0.5) * distance(self.name)).max() / self.spacing

    def skipped(self):
        """Largest distance of a broken bond from where the crack has come to, spacings."""
        due = CRACK + 0.5 * self.spacing * (numpy.arange(len(self.events["x"])) + 0.5)
        return abs(self.events["x"] - due).max() / self.spacing

    def excess(self):
        """Largest difference from 1 of the force of bonds, when they break, over F_c."""
        return abs(self.events["criterion"] / (SPACINGS[self.name] * STRENGTH / numpy.sqrt(3.0)) - 1)

    def balance(self):
        return abs(self.history["balance"]).max() / abs(self.history["reaction"] + self.history["external"]).max()

    def error(self):
        """Of the compliance from beam theory, for every length of the crack."""
        return self.compliance / compliance(self.name, self.crack) - 1

    def exponent(self, arm):
        return numpy.polyfit(numpy.log(arm), numpy.log(self.compliance), 1)[0]

    def law(self):
        """Exponent of the load over the opening; the last record is no top."""
        return numpy.polyfit(numpy.log(self.opening[:-1]), numpy.log(self.load[:-1]), 1)[0]

    def measured_slope(self):
        """dC/da from a cubic through the measured compliances."""
        return numpy.polyval(numpy.polyder(numpy.polyfit(self.crack - CRACK, self.compliance, 3)), self.crack - CRACK)

    def released(self):
        """Energy for a unit of new crack over the whole growth."""
        return (self.taken[-1] - self.taken[0]) / (self.crack[-1] - self.crack[0])

    def of_spacings(self):
        """Energy for a unit of new crack of every two bonds, one of each direction, and the lengths in their middle."""
        count = (len(self.taken) - 1) // 2 * 2
        return numpy.diff(self.taken[:count + 1:2]) / numpy.diff(self.crack[:count + 1:2]), self.crack[1:count:2]

    def ratio(self, slope):
        """P^2/2 dC/da, the mean over the growth, over what the crack took."""
        return numpy.mean((0.5 * self.load ** 2 * slope)[:-1]) / self.released()


def slender(name, toughness):
    """Stress of bending at the root of the arm while the crack grows, over the strength along a row, 2/3 of that across."""
    return numpy.sqrt(3 * toughness * YOUNG / depth(name)) / (2 / 3 * STRENGTH)


def largest_difference(one, other):
    """Of bonds in their order and of openings at which they break, over spacing and last opening; infinite if their number differs."""
    if len(one.events["x"]) != len(other.events["x"]):
        return numpy.inf
    places = max(abs(one.events[axis] - other.events[axis]).max() for axis in "xy") / one.spacing
    return max(places, abs(one.events["time"] - other.events["time"]).max())


def check(case):
    names = shown(case.mode)
    beams = {name: Beam(case, f"{name}-one") for name in names}
    for name, of in beams.items():
        case.figure(f"events_{name}", len(of.events["x"]))
        case.figure(f"offset_{name}", of.offset())
        case.figure(f"skipped_{name}", of.skipped())
        case.figure(f"first_{name}", of.excess()[0])
        case.figure(f"all_{name}", of.excess().max())
        case.figure(f"before_{name}", of.error()[0])
        case.figure(f"growing_{name}", abs(of.error()).max())
        case.figure(f"exponent_{name}", of.exponent(of.crack + root() * depth(name)))
        case.figure(f"exponent_plain_{name}", of.exponent(of.crack))
        case.figure(f"law_{name}", of.law())
        case.figure(f"balance_{name}", of.balance())
        case.figure(f"energy_beam_{name}", of.ratio(slope_of_compliance(name, of.crack)))
        case.figure(f"energy_measured_{name}", of.ratio(of.measured_slope()))
        of_spacings = of.of_spacings()[0]
        case.figure(f"constant_{name}", numpy.ptp(of_spacings) / of_spacings.mean())
        case.figure(f"toughness_{name}", of.released())
        case.figure(f"springs_{name}", (of.history["fracture"][-1]) / of.taken[-1])
    sizes = numpy.array([SPACINGS[name] for name in names])
    case.figure("toughness_exponent", numpy.polyfit(numpy.log(sizes), numpy.log([of.released() for of in beams.values()]), 1)[0])
    case.figure("toughness_paper", beams[names[-1]].released() * 0.1 / sizes[-1])
    for name in COARSE:
        of = Beam(case, f"{name}-one")
        away = abs(of.events["y"] - (rows(name) - 0.5) * distance(name)) > 1e-6 * of.spacing
        case.figure(f"before_{name}", of.error()[0])
        case.figure(f"first_{name}", of.excess()[0])
        case.figure(f"along_{name}", int(numpy.argmax(away)))
        case.figure(f"offset_{name}", of.offset())
        case.figure(f"balance_{name}", of.balance())
    for name in COARSE + names:
        case.figure(f"slender_{name}", slender(name, beams[names[-1]].released() * SPACINGS[name] / sizes[-1]))
    other = Beam(case, f"{MIDDLE}-ties-7")
    case.figure("ties_and_increments", largest_difference(beams[MIDDLE], other))


def pictures(case, folder):
    figure, ((left, right), (below, _)) = plt.subplots(2, 2, figsize=(10.5, 7.2), layout="constrained", height_ratios=(1, 0.62))
    grid = below.get_gridspec()
    below.remove()
    _.remove()
    below = figure.add_subplot(grid[1, :])
    colours = {"0.5": "#c4173a", "0.4": "#1f6f8b", "0.25": "#8a6d00"}
    for name in shown(case.mode):
        of = Beam(case, f"{name}-one")
        left.plot(OPENING * of.history["time"], of.history["reaction_up_y"], color=colours[name], lw=0.7, label=f"2R = {name} mm")
        lengths = numpy.linspace(of.crack[0], of.crack[-1], 100)
        loads = numpy.sqrt(2 * of.released() / slope_of_compliance(name, lengths))
        left.plot(numpy.append(0, loads * compliance(name, lengths)), numpy.append(0, loads), "k--", lw=0.9)
        energies, places = of.of_spacings()
        right.plot(places, energies / of.spacing, color=colours[name], label=f"2R = {name} mm: taken by the crack")
        right.plot(of.crack[:-1], (0.5 * of.load ** 2 * slope_of_compliance(name, of.crack))[:-1] / of.spacing, ":", color=colours[name],
                   label="P²/2 dC/da, top of every tooth")
    left.set(xlabel="opening of the loaded ends, mm", ylabel="load, N/mm", title="Dashed: beam theory, constant toughness", xlim=0, ylim=0)
    right.set(xlabel="length of the crack, mm", ylabel="energy of new crack / 2R, N/mm²", title="Energy of a unit of new crack", ylim=0)
    of = Beam(case, f"{MIDDLE}-one")
    data = of.result.exodus
    at = data.points + 2 * data.displacement()
    below.scatter(at[:, 0], at[:, 1], s=0.5, color="#c9d3dc", lw=0)
    ends = [of.events[end].astype(int) - 1 for end in ("first", "second")]
    middle = 0.5 * (at[ends[0]] + at[ends[1]])
    order = numpy.arange(1, len(middle) + 1)
    drawn = below.scatter(middle[:, 0], middle[:, 1], c=order, s=7, cmap="plasma", lw=0)
    figure.colorbar(drawn, ax=below, label="number of the event", aspect=12)
    below.set(aspect="equal", xlabel="x, mm", title="Broken bonds, 2R = 0.5 mm, displacements x 2")
    for axes in (left, right):
        axes.legend(fontsize=7)
        axes.grid(color="#e3e8ee")
    picture.save(figure, folder / "figure.png", dpi=110)
    return [("figure.png", "Load over opening, energy of the crack, broken bonds in their order")]
