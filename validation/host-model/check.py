"""A Fortran host with the model handle: an impact with its own striker, step size and files, against closed forms, the
program cleave, and itself: saved and restored, on more threads, beside another model.

The host (strike.f90 and its modules) is compiled against the installed library; fields are read from the files it writes.
"""
import math

import matplotlib.pyplot as plt
import netCDF4
import numpy
from matplotlib.collections import PolyCollection
from tools import host_code, picture, results
from tools.simulation import Run

DENSITY, YOUNG, LENGTH, WIDTH, SPACING = 2700.0, 70e9, 60e-3, 4e-3, 1e-3       # bar.in
MASS, SPEED = 0.432, 1.0                                                        # of the punch
WAVE = math.sqrt(YOUNG / DENSITY)
IMPEDANCE = DENSITY * WAVE * WIDTH
LAYER = DENSITY * WAVE**2 * WIDTH / (2 * SPACING)      # springs of the foot of the coarsest bar, kept by the finer ones
SAVED = 907                                            # step of the tiles after which the state is saved
STORED = ("striker_energy", "contact_energy", "body_kinetic", "elastic", "plastic", "stabilisation", "fracture", "viscous")
FROM_ONE = ("bond_ends", "simplex_particles")          # fields that hold particles: Fortran counts them from 1
# wrong call: status, words of its message
MISTAKES = {
    "an unknown law": (5, "'steel' is unknown; known names: svk"),
    "positions (n,3)": (2, "argument 'X' has shape (36,3)"),
    "triangles for tetrahedra": (2, "argument 'simplices' has shape (3,72)"),
    "a parameter that is missing": (6, "needs nu"),
    "an unknown parameter": (5, "'poisson' of material law svk of body 1 'block' is unknown; known parameters: rho, E, nu"),
    "a parameter out of range": (2, "is 0.5 [1]; allowed: > -1 and < 0.5"),
    "a body that is not there": (2, "body 7 does not exist; the model has 1 bodies, counted from 1"),
    "a field before set-up": (8, "call cleave_model_setup first"),
    "too small an array": (2, "has shape (3,35); needed: (3,36)"),
    "too large a range": (3, "1 to 37 (inclusive) does not lie inside 1 to 36"),
    "an unknown field": (5, "no field 'velocities'; its fields: reference_position, mass"),
    "integers of a real field": (7, "field 'velocity' holds reals"),
    "update before initialise": (8, "cleave_model_update comes after cleave_model_advance"),
    "a step that is negative": (2, "allowed: > 0 and finite"),
    "update without advance": (8, "cleave_model_update comes after cleave_model_advance"),
    "a model that was never created": (1, "call cleave_model_create first"),
}


# ---- runs

def skip(case):
    return host_code.obstacle(case.cleave)


def runs(mode):
    return [Run("host", work=lambda site: strike_all(site, refinements(mode)))]


def refinements(mode):
    """The bar's cells in 1 mm."""
    return (4, 8, 16) if mode == "full" else (2, 4, 8)


def changed(text, **values):
    """An input of the host with other values in &control; there the last one counts."""
    lines = "".join(f"  run%{key} = {value!r}\n" for key, value in values.items())
    return text.replace("\n/", "\n" + lines.rstrip("\n") + "\n/", 1)


def finer_bar(text, times):
    """Smaller cells, and softer springs to each of the particles: the same springs to a length of the foot."""
    text = text.replace("4, 60, 0", f"{4 * times}, {60 * times}, 0")
    return changed(text.replace("= 1e-3", f"= {SPACING / times!r}"), stiffness=1 / times, every=1)


def strike_all(site, times):
    programs = host_code.build_with_cmake(host_code.install(site), site)
    text = {path.stem: path.read_text(encoding="utf-8") for path in site.case_folder.glob("*.in")}

    def strike(folder, **inputs):
        (site.folder / folder).mkdir()
        for name, content in inputs.items():
            (site.folder / folder / f"{name}.in").write_text(content, encoding="utf-8")
        host_code.run(programs / "strike", site.folder / folder, arguments=[f"{name}.in" for name in inputs])

    for number in times:
        strike(f"bar-{number}", bar=finer_bar(text["bar"], number))
    tiles = changed(text["tiles"], save_at=SAVED)
    strike("tiles", tiles=tiles)
    strike("ball", ball=text["ball"])
    strike("together", tiles=tiles, ball=text["ball"])
    for threads in (1, 2):
        strike(f"resumed-{threads}", tiles=changed(tiles, threads=threads, resume="../tiles/tiles.state"))
    strike("spin", spin=text["spin"])
    (site.folder / "spin/spin.nml").write_text((site.case_folder / "spin.nml").read_text(encoding="utf-8"), encoding="utf-8")
    host_code.drive(site, site.folder / "spin", "spin.nml")
    for name in ("first", "mistakes"):
        host_code.run(programs / name, site.folder / name)


# ---- what the host wrote

class State:
    """A file NAME.fields or NAME.state: striker, and for every body its fields by name, (entries, components)."""

    def __init__(self, path):
        self.bytes, self.at, self.bodies = path.read_bytes(), 0, []
        self.fingerprint, self.step = self.take("u8", 1)[0], self.take("i4", 1)[0]
        self.time, self.dt, self.limit = self.take("f8", 3)
        self.position, self.velocity, self.force = self.take("f8", 9).reshape(3, 3)
        self.stored = self.take("f8", 1)[0]
        while self.at < len(self.bytes):
            self.bodies.append(dict(self.fields()))

    def take(self, kind, count):
        values = numpy.frombuffer(self.bytes, kind, count, self.at)
        self.at += values.nbytes
        return values

    def fields(self):
        while True:
            name, (kind, components, count) = self.take("S64", 1)[0].decode().strip(), self.take("i4", 3)
            if kind == 0:
                return
            yield name, self.take("f8" if kind == 1 else "i4", components * count).reshape(count, components)

    def angular_momentum(self, mass):
        """Of bodies and striker about the origin."""
        total = mass * numpy.cross(self.position, self.velocity)
        for body in self.bodies:
            total = total + (body["mass"] * numpy.cross(body["position"], body["velocity"])).sum(axis=0)
        return total


def difference(one, other):
    """How many fields, striker values and clocks of two states are not the same bits."""
    heads = sum(getattr(one, name).tobytes() != getattr(other, name).tobytes()
                for name in ("step", "time", "dt", "limit", "position", "velocity", "force", "stored"))
    names = [sorted(body) for body in one.bodies] != [sorted(body) for body in other.bodies]
    return heads + names + sum(mine[name].tobytes() != theirs[name].tobytes()
                               for mine, theirs in zip(one.bodies, other.bodies) for name in mine)


# ---- exact solution of the bar

def contact_force(t):
    """Of a mass that strikes an endless bar through springs: m s'' + m K/Z s' + K s = 0 for the indentation s, F = K s.
    With stiff springs it is Z v exp(-Z t / m)."""
    middle = LAYER / IMPEDANCE / 2
    root = math.sqrt(middle**2 - LAYER / MASS)
    t = numpy.maximum(t, 0)
    return LAYER * SPEED * (numpy.exp((root - middle) * t) - numpy.exp(-(root + middle) * t)) / (2 * root)


def rigid_force(t):
    """F = rho c A v exp(-rho c A t / m)."""
    return numpy.where(t < 0, 0.0, IMPEDANCE * SPEED * numpy.exp(-IMPEDANCE * t / MASS))


def bar_velocity(y, t):
    """The wave on its way up, and the one that the free end sends back."""
    return (contact_force(t - y / WAVE) + contact_force(t - (2 * LENGTH - y) / WAVE)) / IMPEDANCE


def norm(x, y):
    """L2 norm of samples at uneven places."""
    return math.sqrt(numpy.trapz(y**2, x))


# ---- figures

def check(case):
    folder = case.results["host"].folder
    check_bar(case, folder)
    for name in ("tiles", "ball"):
        check_balance(case, name, results.read_csv(folder / name / f"{name}.csv"))
    check_angular(case, folder)
    check_bits(case, folder)
    check_mistakes(case, (folder / "mistakes/listing").read_text(encoding="utf-8"))
    sums = numpy.loadtxt(folder / "first/listing", skiprows=1)[:, 3]
    case.figure("energy_first", abs(sums / sums[0] - 1).max())


def force_error(record):
    t = record["time"]
    return norm(t, -record["force_y"] - contact_force(t)) / norm(t, contact_force(t))


def check_bar(case, folder):
    records = [results.read_csv(folder / f"bar-{number}/bar.csv") for number in refinements(case.mode)]
    errors = [force_error(record) for record in records]
    finest = records[-1]
    check_balance(case, "bar", finest)
    case.figure("force_error", errors[-1])
    case.figure("force_order", math.log2(errors[-2] / errors[-1]))
    case.figure("force_peak", -finest["force_y"].min() / (IMPEDANCE * SPEED))
    t_end = finest["time"][-1]
    times = numpy.linspace(0, t_end, 100001)
    given = MASS * SPEED - math.sqrt(2 * MASS * finest["striker_energy"][-1])
    case.figure("transfer", given / numpy.trapz(contact_force(times), times) - 1)
    case.figure("transfer_rigid", given / (MASS * SPEED * (1 - math.exp(-IMPEDANCE * t_end / MASS))) - 1)
    state = State(folder / f"bar-{refinements(case.mode)[-1]}/bar.fields")
    y, v = state.bodies[0]["reference_position"][:, 1], state.bodies[0]["velocity"][:, 1]
    exact = bar_velocity(y, state.time)
    case.figure("velocity_error", numpy.linalg.norm(v - exact) / numpy.linalg.norm(exact))


def total_energy(record):
    return sum(record[name] for name in STORED)


def check_balance(case, name, record):
    """Drift of momentum and energy of striker and bodies; what the bodies were given, by Cleave's ledger and the striker's."""
    momentum = numpy.column_stack([record[f"momentum_{axis}"] for axis in "xyz"])
    energy = total_energy(record)
    lost = energy[0] - record["striker_energy"] - record["contact_energy"]
    case.figure(f"momentum_{name}", abs(momentum - momentum[0]).max() / numpy.linalg.norm(momentum[0]))
    case.figure(f"energy_{name}", abs(energy / energy[0] - 1).max())
    case.figure(f"work_{name}", abs(record["external"] - lost).max() / energy[0])
    case.figure(f"kinetic_{name}", abs(record["body_kinetic"] - record["kinetic"]).max() / record["kinetic"].max())


def check_angular(case, folder):
    """About the origin, where only the striker has any at the start."""
    state = State(folder / "ball/ball.fields")
    start = 3e-4 * numpy.cross((4e-3, 3e-3, 8.1e-3), (10, 0, -60))           # ball.in
    change = state.angular_momentum(3e-4) - start
    case.figure("angular_momentum_ball", numpy.linalg.norm(change) / numpy.linalg.norm(start))


def check_bits(case, folder):
    tiles, ball = (State(folder / name / f"{name}.fields") for name in ("tiles", "ball"))
    saved = State(folder / "tiles/tiles.state")
    record = results.read_csv(folder / "tiles/tiles.csv")
    case.figure("step_change", record["dt"].max() / record["dt"][record["step"] >= SAVED].min())
    broken = [(state.bodies[0]["bond_status"] == 1).sum() for state in (saved, tiles)]
    case.figure("broken_before", broken[0])
    case.figure("broken_after", broken[1] - broken[0])
    case.figure("fields", sum(len(body) for body in tiles.bodies))
    for threads in (1, 2):
        case.figure(f"resumed_{threads}", difference(tiles, State(folder / f"resumed-{threads}/tiles.fields")))
    case.figure("together", difference(tiles, State(folder / "together/tiles.fields"))
                + difference(ball, State(folder / "together/ball.fields")))
    compared, different = against_program(folder / "spin")
    case.figure("program_fields", compared)
    case.figure("program", different)


def against_program(folder):
    """Fields of the checkpoint of the program: how many, and how many are other bits than the host's."""
    state, compared, different = State(folder / "spin.fields"), 0, 0
    with netCDF4.Dataset(next(folder.glob("spin.*.checkpoint.nc"))) as file:
        file.set_auto_mask(False)
        for body, fields in zip(("block", "plate"), state.bodies):
            for name in (name for name in fields if f"{body}:{name}" in file.variables):
                theirs = numpy.asarray(file[f"{body}:{name}"][:]) + (name in FROM_ONE)
                compared += 1
                different += theirs.astype(fields[name].dtype).tobytes() != fields[name].tobytes()
    return compared, different


def check_mistakes(case, listing):
    """Each wrong call got its status and a message that helps; it did no harm."""
    *lines, last = listing.splitlines()
    answers = {what: (int(status), message) for what, status, message in (line.split(": ", 2) for line in lines)}
    right = [what in answers and answers[what][0] == status and words in answers[what][1]
             for what, (status, words) in MISTAKES.items()]
    case.figure("mistakes", sum(right) if len(answers) == len(MISTAKES) else -1)
    case.figure("mistakes_harmless", last == "the same displacements with and without the mistakes: T")


# ---- pictures

def pictures(case, folder):
    figure, (force, profile, tiles) = plt.subplots(1, 3, figsize=(15, 4.4), layout="constrained", width_ratios=(1, 1, 1.15))
    where = case.results["host"].folder
    draw_force(case, where, force)
    draw_profile(case, where, profile)
    draw_tiles(State(where / "tiles/tiles.fields"), figure, tiles)
    picture.save(figure, folder / "figure.png", dpi=130)
    return [("figure.png", "Contact force and velocity in the bar against the exact solution; the tiles after the impact")]


def draw_force(case, where, axes):
    record = results.read_csv(where / f"bar-{refinements(case.mode)[-1]}/bar.csv")
    t, unit = record["time"], IMPEDANCE * SPEED
    axes.plot(t * 1e6, contact_force(t) / unit, color="#f7c548", lw=5, label="exact, bar and springs")
    axes.plot(t * 1e6, rigid_force(t) / unit, "k:", label=r"$e^{-\rho c A t/m}$, rigid contact")
    axes.plot(t * 1e6, -record["force_y"] / unit, color="#7a0f3c", lw=1.2, label="host")
    axes.set(xlabel=r"time ($\mu$s)", ylabel=r"contact force / $\rho c A v$", title="Bar: force of the punch")
    axes.legend()


def draw_profile(case, where, axes):
    state = State(where / f"bar-{refinements(case.mode)[-1]}/bar.fields")
    y = numpy.linspace(0, LENGTH, 400)
    axes.plot(y * 1e3, bar_velocity(y, state.time), color="#f7c548", lw=5, label="exact")
    axes.plot(state.bodies[0]["reference_position"][:, 1] * 1e3, state.bodies[0]["velocity"][:, 1], ".", ms=2, color="#7a0f3c",
              label="particles")
    axes.set(xlabel="y (mm)", ylabel="velocity / v", title="Bar: velocity as the wave comes back")
    axes.legend()


def draw_tiles(state, figure, axes):
    for body, field, cmap, label in zip(state.bodies, ("damage", "equivalent_plastic_strain"), ("inferno_r", "viridis_r"),
                                        ("damage (glass)", "plastic strain (steel)")):
        corners = body["simplex_particles"][body["simplex_alive"][:, 0] == 1, :3] - 1
        shown = PolyCollection(1e3 * body["position"][corners][:, :, :2], array=body[field][corners, 0].mean(axis=1), cmap=cmap,
                               edgecolors="face", linewidths=0.2)
        axes.add_collection(shown)
        figure.colorbar(shown, ax=axes, label=label, shrink=0.9, pad=0.02)
    axes.add_patch(plt.Circle(1e3 * state.position[:2], 4, color="#8a94a0"))
    axes.set(xlim=(-10, 4), ylim=(-0.5, 11.5), aspect="equal", xlabel="x (mm)", ylabel="y (mm)", title="Tiles and disc")
