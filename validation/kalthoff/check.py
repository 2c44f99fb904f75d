"""The plate of Kalthoff and Winkler by cpd, bond_pd and cbm: direction of the cracks, symmetry, protected end, momentum, cost.

The deck is kalthoff.nml, at the paper's resolution; --quick doubles the spacing.  The critical strain follows from the
fracture energy and the horizon.  The direction of a crack is measured by tools/crack_angle.py, in the first frame in which it has
run as far as the line is fitted.
"""
import matplotlib.pyplot as plt
import numpy
from matplotlib.colors import Normalize
from tools import crack_angle, picture
from tools.simulation import Mesh, Run

REACH, TORN = 30.0, 0.35                             # mm from the tip; damage of a point that belongs to a crack
COLUMNS, ROWS, LAYERS = 88, 177, 8                   # points along x, y, z
SPACING = {"full": 1.125, "quick": 2.25}
CBM_SPACING = {"full": 0.75, "quick": 1.5}
PROTECTED, STRUCK = 3, 5                             # layers of points
INTERACTIONS = 12635836 + 19488150000                # of the full plate, ordered sets; case cpd-counts has them from cleave check


def points_along(mode):
    return (COLUMNS, ROWS, LAYERS) if mode == "full" else (COLUMNS // 2, (ROWS + 1) // 2, LAYERS // 2)


def notches(mode):
    """The lower corner in y of the two rows of points that are taken out."""
    spacing, rows = SPACING[mode], points_along(mode)[1]
    away = round(25 / spacing)                       # rows from the middle one
    return [(rows // 2 + side * away) * spacing for side in (-1, 1)]


def tip_x(mode):
    """Where the notches end: with the last point whose middle is less than 50 mm from the edge."""
    return float(numpy.floor(50 / SPACING[mode] + 0.5) * SPACING[mode])


def resolution(mode):
    """Everything in the deck that follows the spacing."""
    spacing, count, (low, high) = SPACING[mode], points_along(mode), notches(mode)
    tip, thickness = tip_x(mode), count[2] * spacing
    changes = {"lattice.spacing": spacing, "lattice.size": tuple(n * spacing for n in count), "peridynamics.horizon": 3.015 * spacing,
               "zone(1).lower": (-1, low + spacing), "zone(1).upper": (STRUCK * spacing, high),
               "zone(2).lower": ((count[0] - PROTECTED) * spacing, -1)}
    for number, lower in enumerate((low, high), 1):
        middle = lower + spacing / 2
        changes |= {f"notch({number}).lower": (-1, lower), f"notch({number}).upper": (50, lower + spacing),
                    f"precrack({number}).points": (-1, middle, -1, tip, middle, -1, -1, middle, thickness + 1)}
    return changes


BOND = {"body.formulation": "bond_pd", "peridynamics.modulus": "young"}


def plate(mode):
    return Mesh("plate.geo", (("h", CBM_SPACING[mode]),))


def runs(mode):
    fine = resolution(mode)
    length = CBM_SPACING[mode]
    return [Run("cpd", "kalthoff.nml", fine), Run("bond", "kalthoff.nml", fine | BOND),
            Run("cbm", "cbm.nml", {"fracture.length": length, "viscosity.length": length}, plate(mode))]


# ---- figures

class Plate:
    """What one run has done to the plate."""

    def __init__(self, result, mode):
        self.data, self.history, self.events = result.exodus, result.history, result.events
        self.meshed = result.run.mesh is not None
        self.spacing = CBM_SPACING[mode] if self.meshed else SPACING[mode]
        low, high = (75.0, 125.0) if self.meshed else (notches(mode)[0], notches(mode)[1] + self.spacing)
        self.height = low + high
        self.link = self.spacing * (2 if self.meshed else 1)         # a thin crack in a mesh has gaps
        tip = 50.0 if self.meshed else tip_x(mode)
        self.tips = {"lower": ((tip, low), -1), "upper": ((tip, high), 1)}   # outer corner of the notch (meshed: its middle), outer side

    def crack(self, name, frame):
        tip, side = self.tips[name]
        found = crack_angle.crack_points(self.data.points, self.data.nodal("damage", frame), tip, REACH, self.link, least=TORN, side=side)
        return self.data.points[found, :2]

    def angle(self, name):
        """Degrees from the notch line in the first frame in which the crack has run REACH but for a spacing; the last one if none."""
        tip, side = self.tips[name]
        for frame in range(len(self.data.times)):
            crack = self.crack(name, frame)
            if crack_angle.extent(crack, tip) >= REACH - self.spacing:
                break
        return crack_angle.angle(crack, tip, side=side)

    def asymmetry(self):
        """Furthest that a torn point is from the mirror image of a torn one, in spacings, at the end."""
        torn = self.data.points[self.data.nodal("damage") > TORN]
        cells = numpy.round(torn / self.spacing * 2).astype(int)
        mirrored = numpy.round((torn * [1, -1, 1] + [0, self.height, 0]) / self.spacing * 2).astype(int)
        known = set(map(tuple, mirrored))
        lone = numpy.array([cell not in known for cell in map(tuple, cells)], bool)
        distances = [numpy.linalg.norm(mirrored - cell, axis=1).min() / 2 for cell in cells[lone]]
        return max(distances, default=0.0)

    def protected_damage(self):
        x = self.data.points[:, 0]
        return self.data.nodal("damage")[x > x.max() - (PROTECTED - 0.5) * self.spacing].max()

    def missing_momentum(self):
        """Largest difference of momentum and impulse of the projectile, over the momentum at the end."""
        time, force, momentum = (self.history[name] for name in ("time", "reaction_projectile_x", "momentum_x"))
        impulse = numpy.concatenate([[0], numpy.cumsum((force[1:] + force[:-1]) / 2 * numpy.diff(time))])
        return abs(momentum - impulse).max() / momentum[-1]

    def missing_energy(self):
        return abs(self.history["balance"]).max() / self.history["reaction"][-1]


def check(case):
    for name, result in case.results.items():
        found = Plate(result, case.mode)
        for crack in found.tips:
            case.figure(f"angle_{name}_{crack}", found.angle(crack))
        if not found.meshed:
            case.figure(f"asymmetry_{name}", found.asymmetry())
            case.figure(f"protected_{name}", found.protected_damage())
        case.figure(f"momentum_{name}", found.missing_momentum())
        case.figure(f"energy_{name}", found.missing_energy())
        case.figure(f"broken_{name}", len(found.events["time"]))
    if case.full:
        cost(case)


def cost(case):
    """What the plate took, beside the paper's 8 hours and 1 TB."""
    spent, steps = case.results["cpd"].cost, int(case.results["cpd"].history["step"][-1])
    case.figure("points", len(case.results["cpd"].exodus.points))
    case.figure("steps", steps)
    case.figure("wall", spent["wall"] / 3600)
    case.figure("processor", spent["processor"] / 3600)
    case.figure("memory", spent["memory"])
    case.figure("interactions_per_second", INTERACTIONS * steps / spent["processor"])


# ---- pictures

NAMES = {"cpd": "cpd, all three-neighbour interactions", "bond": "bond_pd", "cbm": "cbm, plane strain"}


def draw_points(axes, found):
    """The middle layer of the points as they have moved."""
    z = found.data.points[:, 2]
    layer = abs(z - z[abs(z - z.mean()).argmin()]) < found.spacing / 2
    place = (found.data.points + found.data.displacement())[layer]
    size = (axes.get_window_extent().height * 72 / axes.figure.dpi * 0.97 * found.spacing / found.height) ** 2
    axes.scatter(place[:, 0], place[:, 1], c=found.data.nodal("damage")[layer], cmap=picture.DAMAGE, norm=Normalize(0, 1), s=size,
                 marker="s", linewidths=0)
    axes.set_facecolor(picture.GROUND)
    axes.set_aspect("equal")


def pictures(case, folder):
    figure, row = plt.subplots(1, 3, figsize=(13.5, 8.2))
    for (name, result), axes in zip(case.results.items(), row):
        found = Plate(result, case.mode)
        axes.set(xlim=(-3, 107), ylim=(-4, found.height + 4), xlabel="x (mm)", ylabel="y (mm)" if name == "cpd" else "")
        if found.meshed:
            picture.draw_plate(axes, found.data, -1, "damage", "1", edge=0.4)
            axes.set(xlim=(-3, 107), ylim=(-4, found.height + 4), xlabel="x (mm)", ylabel="")
        else:
            draw_points(axes, found)
        for tip, side in found.tips.values():
            away = numpy.radians(64)
            axes.plot(tip[0] + numpy.array([5, 45]) * numpy.cos(away) + 8, tip[1] + side * numpy.array([5, 45]) * numpy.sin(away), "--",
                      color="#1f6f8b", lw=1.3)
        angles = " and ".join(f"{found.angle(crack):.0f}°" for crack in found.tips)
        axes.set_title(f"{NAMES[name]}\ncracks at {angles}", fontsize=11, loc="left", color=picture.INK)
    picture.save(figure, folder / "figure.png", dpi=110)
    return [("figure.png", f"Damage at {case.results['cpd'].exodus.times[-1] * 1e3:.0f} us, displacements as they are; dashed: 64 degrees, as in the paper")]
