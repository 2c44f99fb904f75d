"""A plate with 31 holes torn bond by bond, at several resolutions: load curve, first break, peak and path of the crack.

Before anything breaks, stiffness and first break are compared with finite elements on a mesh that follows the holes.
"""
import pathlib
import re

import matplotlib.pyplot as plt
import numpy
from tools import deck, picture
from tools.simulation import Mesh, Run

HERE = pathlib.Path(__file__).resolve().parent
WIDTH, PULL = 82.5, 0.5                                   # mm
YOUNG, STRENGTH = 3260.0, 62.89                           # MPa
MAIN, CHAIN, PLATES = 7, 8, (1, 2, 3, 4, 5, 6, 7, 8)      # blocks of holes.geo; CHAIN has more holes in a row
COARSE, MEDIUM = 100, 150                                 # spacings across; options are compared on the first
COLOURS = {100: "#c4173a", 150: "#8a6d00", 300: "#1f6f8b"}


def sizes(mode):
    """Spacings across the plate."""
    return (COARSE, MEDIUM, 300) if mode == "full" else (COARSE, MEDIUM)


def spacing(n):
    return WIDTH / n


def height(n):
    """From the lowest row of particles to the highest."""
    distance = float(numpy.sqrt(0.75)) * spacing(n)
    return int(WIDTH / distance) * distance


def critical_force(n):
    return spacing(n) * STRENGTH / numpy.sqrt(3.0)


def holes(plate):
    """x, y and radius of the holes of a plate."""
    block = re.search(rf"If \(plate == {plate}\)(.*?)EndIf", (HERE / "holes.geo").read_text(encoding="utf-8"), re.DOTALL)
    return [tuple(float(word) for word in row.split(",")) for row in re.findall(r"\{(.+?)\}", block[1])]


# ---- runs

def notch(x, y, radius):
    return f"&notch\n  shape = 'cylinder', centre = {x!r}, {y!r}, 0, radius = {radius!r}\n/\n"


def torn(name, plate=MAIN, n=COARSE, criterion="force", breaking="one", pull=PULL, along_rows=False):
    changes = {"lattice.spacing": spacing(n), "lattice.size": (WIDTH, WIDTH + 0.01 * spacing(n), 0), "vcpm.criterion": criterion,
               "static.breaking": breaking, "load(1).value": pull}
    if along_rows:
        changes |= {"load(1).set": "xmax", "load(1).directions": "x", "load(2).set": "xmax", "load(2).directions": "y", "load(3).set": "xmin"}
    text = deck.vary((HERE / "plate.nml").read_text(encoding="utf-8"), changes)
    text += "".join(notch(*((y, x) if along_rows else (x, y)), radius) for x, y, radius in holes(plate))
    return Run(name, command=(f"{name}.nml",), inputs={f"{name}.nml": text})


def finite_elements(name, n, h=0.3):
    return Run(name, "fem.nml", {"zone(1).centre": (0, height(n), 0)},
               Mesh("plate.geo", (("plate", MAIN), ("height", height(n)), ("h", h))))


def runs(mode):
    made = [torn(f"plate-{MAIN}-{n}", n=n) for n in sizes(mode)]
    made += [torn(f"plate-{plate}-{COARSE}", plate) for plate in PLATES if plate != MAIN] + [torn(f"plate-{CHAIN}-{n}", CHAIN, n) for n in sizes(mode)[1:]]
    made += [torn("ties", breaking="ties"), torn("strain", criterion="strain", pull=1.5 * PULL), torn("turned", along_rows=True)]
    return made + [finite_elements(f"fem-{n}", n) for n in sizes(mode)] + [finite_elements("fem-coarse", COARSE, h=0.45)]


# ---- figures

class Solid:
    """The finite elements: reaction at the full pull, and at which part of it the first bond of an infinitely fine lattice breaks."""

    def __init__(self, case, name, plate=MAIN):
        self.result = case.results[name]
        self.data = self.result.exodus
        self.reaction = self.result.history["reaction_top_y"][-1]
        self.plate = plate

    def edges(self):
        """Ends of the sides of elements that lie on holes."""
        corners = self.data.simplices[:, :3]
        sides = numpy.sort(numpy.concatenate([corners[:, [0, 1]], corners[:, [1, 2]], corners[:, [2, 0]]]), axis=1)
        sides, count = numpy.unique(sides, axis=0, return_counts=True)
        sides = sides[count == 1]
        X, rim = self.data.points, numpy.zeros(len(sides), bool)
        for x, y, radius in holes(self.plate):
            rim |= (abs(numpy.hypot(X[sides, 0] - x, X[sides, 1] - y) - radius) < 1e-6).all(axis=1)
        return sides[rim]

    def first(self, rows=0):
        """With rows at that angle to x, degrees.  The stress s along a free surface is its strain times E; the bond at an angle a to it has the force 2R s/sqrt(3) (1/2 + cos 2a)."""
        one, other = self.edges().T
        along = (self.data.points[other] - self.data.points[one])[:, :2]
        moved = (self.data.displacement()[other] - self.data.displacement()[one])[:, :2]
        stress = YOUNG * (along * moved).sum(axis=1) / (along**2).sum(axis=1)
        angles = numpy.arctan2(along[:, 1], along[:, 0])[:, None] - numpy.radians([rows, rows + 60, rows + 120])
        return 1 / (stress[:, None] * (0.5 + numpy.cos(2 * angles)) / STRENGTH).max()


class Torn:
    """What a run says: displacements as parts of the pull, loads in N/mm."""

    def __init__(self, case, name, n=COARSE, plate=MAIN, direction="y"):
        self.result = case.results[name]
        self.n, self.plate = n, plate
        self.events, self.history = self.result.events, self.result.history
        self.load = self.history[f"reaction_top_{direction}"]
        whole = numpy.flatnonzero(self.history["broken"] == 0)
        self.first, self.first_load = self.history["time"][whole[-1]], self.load[whole[-1]]
        self.peak, self.at_peak = self.load.max(), self.history["time"][self.load.argmax()]
        self.places = numpy.column_stack([self.events["x"], self.events["y"]])
        if direction == "x":
            self.places = self.places[:, ::-1]

    def stiffness(self):
        """Reaction at the full pull, had nothing broken."""
        return self.first_load / self.first

    def starts(self):
        """Events that broke a bond when the load had risen; the others follow under the same displacement."""
        return numpy.diff(self.events["time"], prepend=0) > 0

    def excess(self):
        ratio = self.events["criterion"] / self.events["limit"]
        return abs(ratio[self.starts()] - 1).max()

    def balance(self):
        return abs(self.history["balance"]).max() / self.work()

    def work(self):
        return abs(self.history["reaction"]).max()

    def touched(self):
        """Numbers of the holes at which bonds broke: their middles within a spacing of the hole."""
        found = set()
        for number, (x, y, radius) in enumerate(holes(self.plate), 1):
            if (numpy.hypot(self.places[:, 0] - x, self.places[:, 1] - y) < radius + spacing(self.n)).any():
                found.add(number)
        return found


def nearest(one, other):
    """Distance of every broken bond of one plate from the nearest of another, mm."""
    return numpy.sqrt(((one.places[:, None] - other.places[None]) ** 2).sum(axis=2).min(axis=1))


def rises_apart(one, other):
    """Largest difference of the parts of the pull at which a load that rises finds a bond; infinite if their number differs."""
    found = [of.events["time"][of.starts()] for of in (one, other)]
    return abs(found[0] - found[1]).max() if len(found[0]) == len(found[1]) else numpy.inf


def other_bonds(one, other):
    """How many bonds only one of two plates on the same lattice breaks."""
    found = [{tuple(numpy.round(place / spacing(of.n), 3)) for place in of.places} for of in (one, other)]
    return len(found[0] ^ found[1])


def check_plate(case, of, solid):
    n, history = of.n, of.history
    case.figure(f"events_{n}", len(of.places))
    case.figure(f"rises_{n}", of.starts().sum())
    case.figure(f"limit_{n}", abs(of.events["limit"] / critical_force(n) - 1).max())
    case.figure(f"reached_{n}", of.excess())
    case.figure(f"stiffness_{n}", of.stiffness() / solid.reaction - 1)
    case.figure(f"first_{n}", PULL * of.first)
    case.figure(f"first_fem_{n}", of.first / solid.first())
    case.figure(f"first_load_{n}", of.first_load)
    case.figure(f"peak_{n}", of.peak)
    case.figure(f"at_peak_{n}", PULL * of.at_peak)
    case.figure(f"end_{n}", abs(of.load[-1]) / of.peak)
    case.figure(f"balance_{n}", of.balance())
    case.figure(f"left_{n}", history["elastic"][-1] / of.work())
    case.figure(f"work_{n}", of.work())
    case.figure(f"springs_{n}", history["fracture"][-1] / (history["fracture"][-1] + history["viscous"][-1]))
    case.figure(f"holes_{n}", len(of.touched()))


def compare(case, label, of, base):
    """A plate and the same one on the coarse lattice."""
    case.figure(f"peaks_{label}", of.peak / base.peak)
    case.figure(f"firsts_{label}", of.first / base.first)
    case.figure(f"other_holes_{label}", len(of.touched() ^ base.touched()))
    apart = numpy.append(nearest(of, base), nearest(base, of))
    case.figure(f"apart_{label}", apart.mean())
    case.figure(f"farthest_{label}", apart.max())


def check(case):
    plates = {n: Torn(case, f"plate-{MAIN}-{n}", n) for n in sizes(case.mode)}
    solids = {n: Solid(case, f"fem-{n}") for n in sizes(case.mode)}
    for n, of in plates.items():
        check_plate(case, of, solids[n])
    base = plates[COARSE]
    for n, of in list(plates.items())[1:]:
        case.figure(f"stiffness_order_{n}", numpy.log((base.stiffness() / solids[COARSE].reaction - 1) / (of.stiffness() / solids[n].reaction - 1))
                    / numpy.log(n / COARSE))
        compare(case, str(n), of, base)
    for n in sizes(case.mode)[1:]:
        compare(case, f"chain_{n}", Torn(case, f"plate-{CHAIN}-{n}", n, CHAIN), Torn(case, f"plate-{CHAIN}-{COARSE}", plate=CHAIN))
    case.figure("first_fem", PULL * solids[COARSE].first())
    rough = Solid(case, "fem-coarse")
    case.figure("fem_change", abs(rough.reaction / solids[COARSE].reaction - 1))
    case.figure("fem_change_first", abs(rough.first() / solids[COARSE].first() - 1))
    for option in ("ties", "strain"):
        case.figure(f"{option}_rises", rises_apart(base, Torn(case, option)))
        case.figure(f"{option}_bonds", other_bonds(base, Torn(case, option)))
    turned = Torn(case, "turned", direction="x")
    case.figure("turned_first", turned.first / base.first)
    case.figure("turned_first_fem", turned.first / solids[COARSE].first(90))
    case.figure("turned_peak", turned.peak / base.peak)
    case.figure("turned_holes", len(turned.touched() ^ base.touched()))
    others = [Torn(case, f"plate-{plate}-{COARSE}", plate=plate) for plate in PLATES]
    case.figure("plates_peak_low", min(of.peak for of in others))
    case.figure("plates_peak_high", max(of.peak for of in others))
    case.figure("plates_beyond_first", max(of.peak / of.first_load for of in others))
    case.figure("plates_torn", sum(abs(of.load[-1]) < 1e-9 * of.peak for of in others))
    case.figure("plates_balance", max(of.balance() for of in others))
    case.figure("plates_reached", max(of.excess() for of in others))


def draw_plate(axes, of, title):
    touched = of.touched()
    for number, (x, y, radius) in enumerate(holes(of.plate), 1):
        axes.add_patch(plt.Circle((x, y), radius, fc="#e3e8ee" if number in touched else "white", ec="#8496a5", lw=0.7))
    drawn = axes.scatter(*of.places.T, c=numpy.arange(1, len(of.places) + 1), s=900 / of.n, cmap="plasma", lw=0)
    axes.figure.colorbar(drawn, ax=axes, label="number of the event", shrink=0.8)
    axes.set(aspect="equal", xlim=(0, WIDTH), ylim=(0, WIDTH), title=title)


def draw_loads(axes, of):
    axes.plot(PULL * of.history["time"], of.load, color=COLOURS[of.n], lw=0.9, label=f"2R = 82.5 mm/{of.n}")
    axes.set(xlabel="displacement of the top, mm", ylabel="load, N/mm", xlim=0, ylim=0)
    axes.grid(color="#e3e8ee")


def pictures(case, folder):
    names = sizes(case.mode)
    shown = {plate: [Torn(case, f"plate-{plate}-{n}", n, plate) for n in names] for plate in (MAIN, CHAIN)}
    figure, grid = plt.subplots(2, 1 + len(names), figsize=(4.4 * (1 + len(names)), 8), layout="constrained", squeeze=False)
    for (plate, lattices), row in zip(shown.items(), grid):
        for of, axes in zip(lattices, row[1:]):
            draw_loads(row[0], of)
            draw_plate(axes, of, f"Plate {plate}, broken bonds, 2R = 82.5 mm/{of.n}")
        row[0].set_title(f"Plate {plate}")
    solid = Solid(case, f"fem-{names[-1]}")
    grid[0, 0].plot([0, PULL * solid.first()], [0, solid.first() * solid.reaction], "k--", lw=0.9, label="finite elements to the first break")
    for axes in grid[:, 0]:
        axes.legend(fontsize=7)
    picture.save(figure, folder / "figure.png", dpi=90)
    return [("figure.png", "Load over displacement; broken bonds in their order")]
