"""Waves and the first crack in a curved bar, in the plane and in space, by cpd; finite elements and a straight bar for comparison.

The force through the middle of the bar shows the waves: two that come from the ends at once, or one.  Arrival is when it is
first 5 % of the height of one pulse.  Bonds break in runs of their own, at 0.8 of the largest stretch of the run without.
"""
import pathlib
import re
import sys

import matplotlib.pyplot as plt
import numpy
from matplotlib.colors import LinearSegmentedColormap
from tools import deck, picture
from tools.simulation import Run

HERE = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(HERE))
import arch  # noqa: E402

PULSE = 300e-6                                       # s
HEIGHT = {"2d": 4e5, "3d": 1e6}                      # N/m (for a unit of depth) and N/m2
ARRIVED = 0.05
ACROSS = {"2d": (16, 24), "3d": (8, 12)}              # points across the bar, coarse and fine; bonds break in the coarse one
HORIZON = 3.015                                      # spacings, as in the other problems of the paper
LIMIT = {"2d": 2.315e-6, "3d": 7.76e-6}              # 0.8 of the largest stretch of the coarse run in which nothing breaks
ELEMENTS = 8                                         # quadratic ones across the bar


def loads(kind, value, direction, ends):
    """The pulse on the ends: loads of each component, with the parabola as a table."""
    times = numpy.linspace(0, PULSE, 61)
    table = f"  times = {deck.written(times.tolist())}\n  factors = {deck.written((1 - (2 * times / PULSE - 1) ** 2).tolist())}\n/\n"
    made = ""
    for end in ends:
        for axis, component in zip("xy", -direction * ([1, 1] if end == "right" else [-1, 1])):
            if component != 0:
                made += (f"&load\n  name = '{end}_{axis}', kind = '{kind}', set = '{end} end', directions = '{axis}'\n"
                         f"  value = {float(component) * value!r}, curve = 'table'\n{table}")
    return made


def ends_of(place, direction):
    """The zones of the ends."""
    x, y, along, across = map(float, (*place, *direction))
    return {"zone(1).centre": (-x, y, 0), "zone(1).normal": (-along, across, 0),
            "zone(2).centre": (x, y, 0), "zone(2).normal": (along, across, 0)}


def bar(name, across, dimension="2d", limit=None, ends=("left", "right"), curved=True, t_end=1.4e-3):
    """A run of points."""
    _, step = arch.rows(across)
    place, direction = arch.right_end(arch.HALF - step / 2, curved)
    changes = ends_of(place, direction) | {"peridynamics.horizon": HORIZON * step, "fracture.critical_strain": limit or 1.0,
                                           "body.kinematics": "3d" if dimension == "3d" else "plane_strain", "run.t_end": t_end}
    text = deck.vary((HERE / "bar.nml").read_text(encoding="utf-8"), changes)
    text += loads("body_force", HEIGHT[dimension] / step, direction, ends)
    files = {f"{name}.nml": text, "points.csv": arch.points_file(across, across if dimension == "3d" else 0, curved)}
    return Run(name, command=(f"{name}.nml",), inputs=files)


def elements(name):
    """The same by finite elements: a mesh of its own, total forces on the ends."""
    text = (HERE / "bar.nml").read_text(encoding="utf-8")
    text = re.sub(r"(?ms)^&points$.*?^/$", "&mesh\n  file = 'bar.msh'\n/", text)
    text = re.sub(r"(?ms)^&(peridynamics|fracture)$.*?^/$\n", "", text).replace(", 'largest_stretch', 'damage'", "")
    text = text.replace("  formulation = 'cpd'", "  formulation = 'fem', elements = 'quadratic'")
    place, direction = arch.right_end(arch.HALF)
    text = deck.vary(text, ends_of(place, direction)) + loads("force", HEIGHT["2d"] * arch.THICKNESS, direction, ("left", "right"))
    return Run(name, command=(f"{name}.nml",), inputs={f"{name}.nml": text, "bar.msh": arch.mesh_file(ELEMENTS)})


def runs(mode):
    made = [elements("elements"), bar("straight", ACROSS["2d"][1], curved=False), bar("one", ACROSS["2d"][1], ends=("left",))]
    for dimension, (coarse, fine) in ACROSS.items():
        made += [bar(f"{dimension}-coarse", coarse, dimension),
                 bar(f"{dimension}-fine", fine, dimension, t_end=0.8e-3 if dimension == "3d" else 1.4e-3),   # as long as it is judged
                 bar(f"{dimension}-crack", coarse, dimension, LIMIT[dimension])]
    return made


# ---- figures

def force(case, name):
    """Times, and force through the middle over that of the pulse at its height; tension is positive."""
    history = case.results[name].history
    unit = HEIGHT["3d"] * arch.THICKNESS**2 if name.startswith("3d") else HEIGHT["2d"] * arch.THICKNESS
    return history["time"], history["section_middle_force_x"] / unit


def crossing(time, value, level):
    """First time at which a value passes a level, linear between records."""
    last = int((value > level).argmax())
    return numpy.interp(level, value[last - 1:last + 1], time[last - 1:last + 1])


def arrival(case, name):
    time, value = force(case, name)
    return crossing(time, -value, ARRIVED) * 1e6


def far_arrival(case, name):
    """When the free end moves with 5 % of the velocity that one pulse gives it."""
    history = case.results[name].history
    _, direction = arch.right_end(arch.HALF)
    speed = history["far_x"] * direction[0] + history["far_y"] * direction[1]
    return crossing(history["time"], speed, ARRIVED * 2 * HEIGHT["2d"] / (8000 * 5291.1)) * 1e6


def limit(case, dimension, measure):
    """A measure for ever more points across, by two runs; its error falls with their number."""
    coarse, fine = ACROSS[dimension]
    return (fine * measure(case, f"{dimension}-fine") - coarse * measure(case, f"{dimension}-coarse")) / (fine - coarse)


def tension(case, name, begin=0.0):
    """Time (ms) and height of the largest tension in the middle."""
    time, value = force(case, name)
    later = time >= begin
    peak = value[later].argmax()
    return time[later][peak] * 1e3, value[later][peak]


def asymmetry(case, name):
    """Largest difference of left and right displacements over the largest, in the last frame; the halves follow each other in the file."""
    data = case.results[name].exodus
    left, right = numpy.split(data.displacement(), 2)
    return abs(left * [-1, 1, 1] - right).max() / abs(right).max()


def largest_stretch(case, name):
    data = case.results[name].exodus
    return max(data.nodal("largest_stretch", frame).max() for frame in range(len(data.times)))


def first_crack(case, name):
    """Distance from the middle of the bonds that break first, over the length of the bar, and their time (ms)."""
    events = case.results[name].events
    first = events["time"] == events["time"].min()
    place = numpy.column_stack([events["x"], events["y"]])[first]
    return arch.along(place).max() / (2 * arch.HALF), events["time"].min() * 1e3


def check(case):
    for dimension in ("2d", "3d"):
        for resolution in ("coarse", "fine"):
            case.figure(f"arrival_{dimension}_{resolution}", arrival(case, f"{dimension}-{resolution}"))
        case.figure(f"arrival_{dimension}_limit", limit(case, dimension, arrival))
        case.figure(f"asymmetry_{dimension}", asymmetry(case, f"{dimension}-fine"))
        case.figure(f"critical_{dimension}", LIMIT[dimension] / largest_stretch(case, f"{dimension}-coarse"))
        place, time = first_crack(case, f"{dimension}-crack")
        case.figure(f"crack_place_{dimension}", place)
        case.figure(f"crack_time_{dimension}", time)
        case.figure(f"broken_{dimension}", len(case.results[f"{dimension}-crack"].events["time"]))
        case.figure(f"meeting_{dimension}", tension(case, f"{dimension}-fine")[0])
    case.figure("arrival_elements", arrival(case, "elements"))
    case.figure("meeting_elements", tension(case, "elements")[0])
    case.figure("far_2d", far_arrival(case, "one"))
    case.figure("doubling_2d", tension(case, "2d-fine")[1] / tension(case, "one")[1])
    time, height = tension(case, "straight")
    case.figure("straight_arrival", arrival(case, "straight"))
    case.figure("straight_meeting", time)
    case.figure("straight_height", height)
    time, expected = force(case, "elements")
    case.figure("force_2d", numpy.linalg.norm(numpy.interp(time, *force(case, "2d-fine")) - expected) / numpy.linalg.norm(expected))


# ---- pictures

STRETCH = LinearSegmentedColormap.from_list("stretch", ["#dce6ee", "#f7c548", "#ee6c2b", "#c4173a", "#7a0f3c"])


def draw(axes, data, frame, name, top, across, scale=0.0):
    """The bar seen from the front, points coloured by a field."""
    place = data.points[:, :2] + scale * data.displacement(frame)[:, :2]
    shown = slice(None) if data.points[:, 2].max() == 0 else data.points[:, 2] > data.points[:, 2].max() * (1 - 1e-9)
    drawn = axes.scatter(*place[shown].T, c=data.nodal(name, frame)[shown], cmap=picture.DAMAGE if name == "damage" else STRETCH, vmin=0, vmax=top,
                         s=(20 / across) ** 2, linewidths=0)
    axes.set_aspect("equal")
    axes.set_facecolor(picture.GROUND)
    axes.set(xlim=(-1.15, 1.15), ylim=(-0.15, 1.15), xticks=(-1, 0, 1), yticks=(0, 1))
    return drawn


def frame_at(data, time):
    return int(abs(data.times - time).argmin())


def pictures(case, folder):
    figure, grid = plt.subplots(2, 2, figsize=(12, 8.4), layout="constrained")
    names = {"elements": ("finite elements, plane", "#1d2733", 3.0), "2d-coarse": (f"cpd, {ACROSS['2d'][0]} across", "#f7c548", 1.2),
             "2d-fine": (f"cpd, {ACROSS['2d'][1]} across", "#c4173a", 1.2), "one": ("cpd, one end pressed", "#1f6f8b", 1.2),
             "straight": ("cpd, straight bar", "#9aa7b4", 1.2)}
    for name, (label, colour, width) in names.items():
        time, value = force(case, name)
        grid[0, 0].plot(time * 1e6, value, color=colour, lw=width, label=label, alpha=0.5 if name == "elements" else 1)
    grid[0, 0].set(xlabel="time (us)", ylabel="force through the middle / pulse", title="In the plane; tension is positive")
    grid[0, 0].legend(fontsize=8)
    grid[0, 0].grid(color="#e3e8ee")
    data = case.results["2d-fine"].exodus
    frame = frame_at(data, 6e-4)
    drawn = draw(grid[0, 1], data, frame, "largest_stretch", data.nodal("largest_stretch", frame).max(), ACROSS["2d"][1])
    figure.colorbar(drawn, ax=grid[0, 1], shrink=0.6, label="largest stretch")
    grid[0, 1].set_title(f"cpd in the plane, {data.times[frame] * 1e6:.0f} us")
    data = case.results["3d-crack"].exodus
    for axes, time in zip(grid[1], (6.3e-4, 1.4e-3)):
        frame = frame_at(data, time)
        drawn = draw(axes, data, frame, "damage", 1, ACROSS["3d"][0], 2000)
        axes.set_title(f"cpd in space, {data.times[frame] * 1e6:.0f} us: damage, displacements x 2000")
    figure.colorbar(drawn, ax=grid[1, 1], shrink=0.6, label="damage")
    picture.save(figure, folder / "figure.png", dpi=110)
    return [("figure.png", "Force through the middle of the bar; stretch when tension is largest there; damage where bonds may break")]
