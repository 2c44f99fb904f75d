"""Direction of loading and strength of a triangular lattice: the uniaxial stress at which the first bond breaks, against closed forms.

A piece of lattice, turned by an angle, has the homogeneous strain of a uniaxial stress along x.  Only the bonds of
the middle particle can break, and all of them have the neighbours of an infinite lattice at both ends.
"""
import pathlib

import matplotlib.pyplot as plt
import numpy
from tools import deck, picture
from tools.simulation import Run

HERE = pathlib.Path(__file__).resolve().parent
YOUNG, STRENGTH, SPACING = 69000.0, 69.0, 0.1             # MPa, MPa, mm
FACTORS = (1 - 1e-10, 1 + 1e-10, 1.1)                     # of the load increments, on what is due; the last for what is off
ANGLES = tuple(range(0, 91, 5))                           # from the pull to a close-packed row, degrees
NAMED = (0, 15, 30, 45, 90)
RATIOS = (-0.5, 0.0, 0.25, 0.45)
CRITERIA = ("force", "strain", "energy")
CASES = {"strain": "plane_strain", "stress": "plane_stress"}
SQUASHED = (15, 25, 30)                                   # in compression


# ---- closed forms: sigma over strength when the first bond breaks

def bonds(angle):
    """Angles between the three directions of bonds and the pull, radians."""
    return numpy.radians(angle + numpy.array([0.0, 60.0, 120.0]))


def strains(case, nu):
    """Along and across a uniaxial stress of Young's modulus."""
    return (1.0, -nu) if case == "stress" else (1 - nu**2, -nu * (1 + nu))


def force(angle):
    """Of the three bonds, over 2 R sigma/sqrt(3)."""
    return 0.5 + numpy.cos(2 * bonds(angle))


def strain(angle, case, nu):
    """Of the three bonds, over sigma/E."""
    along, across = strains(case, nu)
    return along * numpy.cos(bonds(angle)) ** 2 + across * numpy.sin(bonds(angle)) ** 2


def due(criterion, angle, case="stress", nu=0.3, sign=1):
    """The limit of the energy is that of a row in tension at `STRENGTH`, in plane stress."""
    F, e = sign * force(angle), sign * strain(angle, case, nu)
    if criterion == "force":
        return 1 / F.max()
    return 1 / e.max() if criterion == "strain" else 1 / numpy.sqrt((2 / 3 * F * e)[(F > 0) & (e > 0)].max())


LIMITS = {"force": SPACING * STRENGTH / numpy.sqrt(3.0), "strain": STRENGTH / YOUNG,
          "energy": 0.5 * (0.5 * numpy.sqrt(3.0) * SPACING * STRENGTH) * (SPACING * STRENGTH / YOUNG)}


# ---- runs

def piece(angle):
    """Places of a particle, its six neighbours and theirs, rows turned by an angle."""
    at = [SPACING * numpy.array([i + 0.5 * j, numpy.sqrt(0.75) * j]) for i in range(-2, 3) for j in range(-2, 3) if abs(i + j) <= 2]
    c, s = numpy.cos(numpy.radians(angle)), numpy.sin(numpy.radians(angle))
    return [(float(c * x - s * y), float(s * x + c * y)) for x, y in at]


def load(number, direction, value):
    return (f"&load\n  name = 'p{number}{direction}', kind = 'displacement', set = 'p{number}', directions = '{direction}', value = {value!r}\n"
            f"  curve = 'table', times = 0, 1, 2, 3, factors = 0, {deck.written(FACTORS)}\n/\n")


def name_of(criterion, angle, case="stress", nu=0.3, sign=1):
    return f"{criterion}-{case}-{nu:g}-{angle}{'' if sign > 0 else '-squashed'}"


def pull(criterion, angle, case="stress", nu=0.3, sign=1):
    stress = sign * float(due(criterion, angle, case, nu, sign)) * STRENGTH
    along, across = (stress / YOUNG * part for part in strains(case, nu))
    text = deck.vary((HERE / "piece.nml").read_text(encoding="utf-8"), {
        "body.kinematics": CASES[case], "material.nu": nu, "vcpm.criterion": criterion, "vcpm.limit": float(LIMITS[criterion])})
    places = piece(angle)
    for number, (x, y) in enumerate(places):
        if abs(x) + abs(y) > 0:                           # the middle is free
            lower, upper = (deck.written([x + side * SPACING / 9, y + side * SPACING / 9]) for side in (-1, 1))
            text += f"&zone\n  name = 'p{number}', lower = {lower}, upper = {upper}\n/\n"
            text += load(number, "x", along * x) + load(number, "y", across * y)
    points = "X,Y,Z,volume\n" + "".join(f"{x!r},{y!r},0,1\n" for x, y in places)
    name = name_of(criterion, angle, case, nu, sign)
    return Run(name, command=(f"{name}.nml",), inputs={f"{name}.nml": text, "piece.csv": points})


def runs(mode):
    made = [pull(criterion, angle) for criterion in CRITERIA for angle in ANGLES]
    made += [pull("force", angle, case, nu) for case in CASES for nu in RATIOS for angle in NAMED]
    made += [pull("strain", angle, "strain", 0.3) for angle in NAMED]
    return made + [pull("force", angle, sign=-1) for angle in SQUASHED]


# ---- figures

class Pull:
    """What a run says of the first bond that broke."""

    def __init__(self, case, criterion, angle, kind="stress", nu=0.3, sign=1):
        self.result = case.results[name_of(criterion, angle, kind, nu, sign)]
        self.angle, self.sign, self.due = angle, sign, due(criterion, angle, kind, nu, sign)
        events = self.result.events
        self.held = events["step"][0] == 2
        quotient = events["limit"][0] / events["criterion"][0]
        applied = self.due * FACTORS[int(events["step"][0]) - 1]
        self.sigma = applied * (numpy.sqrt(quotient) if criterion == "energy" else quotient)
        self.bond = numpy.arctan2(events["y"][0], events["x"][0])

    def error(self):
        return abs(self.sigma / self.due - 1)

    def is_largest(self):
        """Whether that bond has the largest force: the nearest to the pull, or the one farthest from it."""
        return self.sign * numpy.cos(2 * self.bond) > (self.sign * numpy.cos(2 * bonds(self.angle))).max() - 1e-6

    def stress_error(self):
        """Of the middle particle from the uniaxial stress, over it, before anything breaks."""
        data = self.result.exodus
        middle = int(abs(data.points).sum(axis=1).argmin())
        P = [[data.nodal(f"first_piola_kirchhoff_stress_{row}{column}", 1)[middle] for column in "xy"] for row in "xy"]
        wanted = self.sign * self.due * STRENGTH * FACTORS[0]
        return abs(numpy.array(P) / wanted - [[1, 0], [0, 0]]).max()


def check(case):
    pulls = {criterion: [Pull(case, criterion, angle) for angle in ANGLES] for criterion in CRITERIA}
    others = [Pull(case, "force", angle, kind, nu) for kind in CASES for nu in RATIOS for angle in NAMED]
    planes = [Pull(case, "strain", angle, "strain", 0.3) for angle in NAMED]
    squashed = [Pull(case, "force", angle, sign=-1) for angle in SQUASHED]
    for criterion in CRITERIA:
        for angle in NAMED:
            case.figure(f"{criterion}_{angle}", pulls[criterion][ANGLES.index(angle)].sigma)
        case.figure(f"curve_{criterion}", max(pull.error() for pull in pulls[criterion]))
    for pull in planes:
        case.figure(f"strain_plane_strain_{pull.angle}", pull.sigma)
    case.figure("others", max(pull.error() for pull in others))
    for pull in squashed:
        case.figure(f"squashed_{pull.angle}", pull.sigma)
    everything = sum(pulls.values(), []) + others + planes + squashed
    case.figure("held", sum(pull.held for pull in everything))
    case.figure("largest", sum(pull.is_largest() for pull in everything))
    case.figure("stress", max(pull.stress_error() for pull in everything))


def pictures(case, folder):
    figure, axes = plt.subplots(figsize=(7.2, 4.6), layout="constrained")
    fine = numpy.linspace(0, 90, 721)
    styles = {"force": ("#c4173a", "o"), "strain": ("#1f6f8b", "x"), "energy": ("#8a6d00", "^")}
    for criterion, (colour, marker) in styles.items():
        axes.plot(fine, [due(criterion, angle) for angle in fine], color=colour, lw=1)
        axes.plot(ANGLES, [Pull(case, criterion, angle).sigma for angle in ANGLES], ls="none", marker=marker, mfc="none", color=colour, label=criterion)
    axes.set(xlabel="angle between pull and a close-packed row, degrees", ylabel="stress at the first broken bond over strength",
             title="Lines: closed forms; plane stress, nu = 0.3", xticks=range(0, 91, 15), ylim=(0.6, 1.55))
    axes.legend(fontsize=8, title="criterion")
    axes.grid(color="#e3e8ee")
    picture.save(figure, folder / "figure.png", dpi=110)
    return [("figure.png", "Strength against the direction of the pull")]
