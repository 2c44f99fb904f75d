"""Plane P and S waves against the exact solution, in two and three dimensions; a spinning free body.

Wave runs: the decks wave_*.nml with other spacings and kinematics.  Error: L2 norm of u - g(t - y/c) over
all particles relative to that of g, at the last frame.  Speed: the shift that fits the wave best is taken in two frames;
its change over the time between them is the error of the speed.  Order: log2 of the errors of the two finest spacings.
"""
import math

import matplotlib.pyplot as plt
import numpy
from matplotlib.ticker import NullLocator
from tools import picture
from tools.simulation import Mesh, Run

DENSITY, YOUNG, POISSON = 2700.0, 70e9, 0.3
SHEAR = YOUNG / (2 * (1 + POISSON))
LONGITUDINAL = {
    "plane_strain": YOUNG * (1 - POISSON) / ((1 + POISSON) * (1 - 2 * POISSON)),
    "plane_stress": YOUNG / (1 - POISSON**2),
    "3d": YOUNG * (1 - POISSON) / ((1 + POISSON) * (1 - 2 * POISSON)),
}
WIDTH, BAR = 4e-3, 40e-3                         # of the bar [m]
LENGTH, TRAVEL, FRAME = 12e-3, 30e-3, 10e-3      # of the wave, its way, its way between frames [m]
HEIGHT = 1e-8                                    # displacement behind the wave [m]

# name: (mesh, kinematics, refinements in quick, in full); spacing 1 mm / 2^refinement
SERIES = {
    "square": ("square", "plane_strain", (0, 1, 2), (1, 2, 3)),
    "hexagonal": ("hexagonal", "plane_stress", (0, 1, 2), (1, 2, 3)),
    "irregular": ("gmsh", "plane_strain", (0, 1, 2), (1, 2, 3)),
    "cubic": ("cubic", "3d", (0, 1, 2), (1, 2, 3)),
    "irregular3d": ("gmsh", "3d", (0, 1), (0, 1, 2)),
}
SPINS = {
    "block": {},
    "disc": {"lattice.type": "hexagonal", "lattice.shape": "sphere", "lattice.size": (0, 0, 0), "lattice.radius": 5e-3,
             "body.kinematics": "plane_stress", "initial.velocity": (10, -5, 0), "initial.angular_velocity": (0, 0, 22e3),
             "initial.centre": (0, 0, 0)},
}


def refinements(series, mode):
    return SERIES[series][3 if mode == "full" else 2]


def wave_speed(kinematics, wave):
    return math.sqrt((LONGITUDINAL[kinematics] if wave == "P" else SHEAR) / DENSITY)


def wave_axis(series):
    """Along which axis the wave of a series runs: 0 or 1; see wave_hexagonal.nml."""
    return 0 if series == "hexagonal" else 1


def moving_axis(series, wave):
    return wave_axis(series) if wave == "P" else 1 - wave_axis(series)


def timing(speed):
    return {"run.t_end": TRAVEL / speed, "load(1).ramp": LENGTH / speed, "output.every_time": FRAME / speed}


def wave_run(series, wave, level):
    """One plane wave: what moves, what is held, and times that follow the wave's speed."""
    mesh, kinematics, _, _ = SERIES[series]
    spacing, speed, deep = 1e-3 / 2**level, wave_speed(kinematics, wave), kinematics == "3d"
    name, moving = f"{series}-{wave}-{level}", "xyz"[moving_axis(series, wave)]
    changes = timing(speed) | {"body.kinematics": kinematics, "load(1).directions": moving}
    held = "xyz"[: 3 if deep else 2].replace(moving, "")
    if mesh == "gmsh":
        parameters = (("h", spacing * 1e3),) + ((("depth", WIDTH * 1e3),) if deep else ())
        mesh = Mesh("bar.geo", parameters, "bar.msh", 3 if deep else 2)
        return Run(name, "wave_mesh.nml", changes | {"load(2).directions": held}, mesh)
    changes["lattice.spacing"] = spacing
    if mesh == "hexagonal":
        later = {"zone(2).centre": (spacing / 2, 0, 0), "load(2).begin": spacing / 2 / speed, "load(2).ramp": LENGTH / speed,
                 "load(2).directions": moving, "load(3).directions": held}
        return Run(name, "wave_hexagonal.nml", changes | later)
    changes |= {"lattice.type": mesh, "lattice.size": (WIDTH, BAR, WIDTH if deep else 0), "load(2).directions": held}
    return Run(name, "wave_lattice.nml", changes)


def runs(mode):
    waves = [wave_run(series, wave, level) for series in SERIES for wave in "PS" for level in refinements(series, mode)]
    return waves + [Run(f"spin-{name}", "spin.nml", changes) for name, changes in SPINS.items()]


def ramp(s):
    """[CBM 26] and its derivative."""
    s = numpy.clip(s, 0, 1)
    return s**3 * (10 - 15 * s + 6 * s * s), 30 * s * s * (1 - s) ** 2


def against_exact(result, series, wave, frame):
    """Relative L2 error and the shift [m] (positive: ahead) of the wave in one frame, with its time."""
    data, speed = result.exodus, wave_speed(SERIES[series][1], wave)
    along, time = data.points[:, wave_axis(series)], data.times[frame]
    shape, slope = ramp((speed * time - along) / LENGTH)
    exact, gradient = HEIGHT * shape, -HEIGHT * slope / LENGTH
    difference = data.displacement(frame)[:, moving_axis(series, wave)] - exact
    return numpy.linalg.norm(difference) / numpy.linalg.norm(exact), -(difference @ gradient) / (gradient @ gradient), time


def speed_error(result, series, wave):
    """Measured wave speed over the exact one, minus 1, between the last frame and the one 10 mm before."""
    speed, frames = wave_speed(SERIES[series][1], wave), result.exodus.times
    before = int(abs(frames - (frames[-1] - FRAME / speed)).argmin())
    (_, early, start), (_, late, end) = (against_exact(result, series, wave, frame) for frame in (before, -1))
    return (late - early) / (speed * (end - start))


def errors_of(case, series, wave):
    return [against_exact(case.results[f"{series}-{wave}-{level}"], series, wave, -1)[0]
            for level in refinements(series, case.mode)]


def check(case):
    for series in SERIES:
        for wave in "PS":
            errors = errors_of(case, series, wave)
            finest = case.results[f"{series}-{wave}-{refinements(series, case.mode)[-1]}"]
            case.figure(f"order_{wave}_{series}", math.log2(errors[-2] / errors[-1]))
            case.figure(f"error_{wave}_{series}", errors[-1])
            case.figure(f"speed_{wave}_{series}", speed_error(finest, series, wave))
    for name in SPINS:
        for quantity, value in spin(case.results[f"spin-{name}"]).items():
            case.figure(f"{quantity}_{name}", value)


def spin(result):
    """Drifts relative to the start (momenta) and to the kinetic energy; turns of the body."""
    data, history = result.exodus, result.history
    momenta = []
    for frame in range(len(data.times)):
        mass, velocity, position = numbers(data, frame)
        momenta.append(numpy.concatenate([mass @ velocity, mass @ numpy.cross(position, velocity)]))
    momenta = numpy.array(momenta)
    linear, angular = momenta[:, :3], momenta[:, 3:]
    half = len(history["time"]) // 2
    return {
        "momentum": abs(linear - linear[0]).max() / numpy.linalg.norm(linear[0]),
        "angular_momentum": abs(angular - angular[0]).max() / numpy.linalg.norm(angular[0]),
        "energy": abs(history["balance"]).max() / history["kinetic"][0],
        "breathing": history["elastic"][half:].max() / history["elastic"][:half].max(),
        "turns": turned(result),
    }


def numbers(data, frame):
    """Masses, velocities and positions of the particles."""
    return data.nodal("mass", frame), data.vector("velocity", frame), data.points + data.displacement(frame)


def turned(result):
    """Turns from the angular velocity of the deck: how long the conservation was watched."""
    rate = result.run.changes.get("initial.angular_velocity", (12e3, 8e3, 17e3))
    return numpy.linalg.norm(rate) * result.exodus.times[-1] / (2 * math.pi)


def pictures(case, folder):
    figure, (profiles, convergence) = plt.subplots(1, 2, figsize=(11, 4.6), layout="constrained")
    draw_profiles(case, profiles)
    draw_convergence(case, convergence)
    picture.save(figure, folder / "figure.png", dpi=130)
    return [("figure.png", "Plane waves: profiles against the exact solution, and convergence")]


def draw_profiles(case, axes):
    data = case.results[f"irregular-P-{refinements('irregular', case.mode)[-1]}"].exodus
    speed, y = wave_speed("plane_strain", "P"), numpy.linspace(0, BAR, 400)
    for frame in range(1, len(data.times)):
        exact, = axes.plot(y * 1e3, HEIGHT * 1e9 * ramp((data.times[frame] * speed - y) / LENGTH)[0], color="#f7c548", lw=5)
        particles, = axes.plot(data.points[:, 1] * 1e3, data.displacement(frame)[:, 1] * 1e9, ".", ms=2, color="#7a0f3c")
    axes.set(xlabel="y (mm)", ylabel="displacement (nm)", title="P wave, irregular mesh in plane strain")
    axes.legend([exact, particles], ["exact", "particles"])


def draw_convergence(case, axes):
    for series, colour in zip(SERIES, ("#1f6f8b", "#c4173a", "#ee6c2b", "#3a7d44", "#6a4c93")):
        spacings = [1 / 2**level for level in refinements(series, case.mode)]
        for wave, style in (("P", "o-"), ("S", "s--")):
            axes.loglog(spacings, errors_of(case, series, wave), style, color=colour, lw=1.2, ms=5, label=f"{wave} {series}")
    ends = numpy.array([1 / 2 ** max(refinements("square", case.mode)), 1])
    axes.loglog(ends, 0.032 * ends**2, "k:", label="second order")
    ticks = [1 / 2**level for level in refinements("square", case.mode)]
    axes.set_xticks(ticks, [f"{tick:g}" for tick in ticks])
    axes.xaxis.set_minor_locator(NullLocator())
    axes.set(xlabel="spacing (mm)", ylabel="relative error of the displacement", title="Convergence")
    axes.legend(fontsize=8)
