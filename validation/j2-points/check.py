"""Law j2 at one point: tables of single steps and of homogeneous tension, and strain paths against the rate equations.

The program follows a path with `cleave point`.  What it is compared with is computed here and in tools/rates.py with
numpy: the return mapping with an iterative eigen-solver and bisection, and the rate equations integrated to high order.
"""
import functools
import math

import matplotlib.pyplot as plt
import numpy
from matplotlib.ticker import NullLocator
from tools import picture, rates
from tools.simulation import Run

LAW = rates.J2(80193.8, 164206, 450, 715, 129.24, 16.93)                 # MPa
YOUNG = 9 * LAW.kappa * LAW.G / (3 * LAW.kappa + LAW.G)
POISSON = (3 * LAW.kappa - 2 * LAW.G) / (2 * (3 * LAW.kappa + LAW.G))
PROPERTIES = {"rho": 0.01, "E": YOUNG, "nu": POISSON, "tau_y0": LAW.tau_y0, "tau_inf": LAW.tau_inf, "h0": LAW.h0,
              "alpha": LAW.alpha}
AXES, I = "xyz", numpy.eye(3)


def deformation(**entries):
    """I plus the entries, e.g. xy=0.1."""
    F = I.copy()
    for name, value in entries.items():
        F[AXES.index(name[0]), AXES.index(name[1])] += value
    return F


# F: plastic strain, P row by row; one step from the virgin state, computed independently
SINGLE = {
    "stretch": (deformation(xx=0.01), 4.676722834696e-03,
                (1928.470758994, 0, 0, 0, 1476.978308821, 0, 0, 0, 1476.978308821)),
    "shear": (deformation(xy=0.1), 5.514246313523e-02,
              (-17.81618220, 356.3236439, 0, 358.1052621, -17.81618220, 0, 0, 0, 0)),
    "mixed": (deformation(xx=0.05, xy=0.02, yx=-0.01, yy=-0.03, yz=0.03, zy=0.01, zz=0.02), 4.964519837591e-02,
              (6213.023434, 98.96678244, -0.9073663341, -83.75612583, 6089.212788, 95.13092809, 0.5967057287,
               -28.11934257, 6173.580130)),
}
# nominal strain: F_xx, P_yy, tau_eq, plastic strain of homogeneous plane-strain tension, computed independently
TENSION = {
    0.001: (0.999592, 225.56, 201.20, 0), 0.002: (0.999184, 450.44, 402.20, 0), 0.0025: (0.998863, 508.17, 451.25, 0.000271),
    0.005: (0.996580, 531.15, 463.36, 0.002965), 0.01: (0.991784, 556.38, 486.68, 0.008517),
    0.02: (0.982208, 597.15, 527.49, 0.019637), 0.03: (0.972788, 629.32, 561.36, 0.030693),
    0.05: (0.954433, 674.11, 612.99, 0.052580), 0.08: (0.928085, 708.75, 662.90, 0.084799),
    0.10: (0.911280, 718.57, 684.53, 0.105853), 0.12: (0.895057, 721.96, 700.26, 0.126561),
    0.15: (0.871759, 719.64, 716.71, 0.156982), 0.20: (0.835485, 705.84, 733.53, 0.206021),
}
DIGITS = (5e-7, 5e-3, 5e-3, 5e-7)                                        # half of the last digit printed
TENSION_STEP, TENSION_END = 1e-4, 0.2


def winding():
    """Stretch and shear in 300 steps, and the same while the body turns once."""
    straight, turned = [], []
    for part in numpy.linspace(0, 1, 301):
        c, s = math.cos(2 * math.pi * part), math.sin(2 * math.pi * part)
        straight.append(deformation(xx=-0.03 * part, yy=0.08 * part, xy=0.05 * math.sin(9 * part), zz=-0.04 * part))
        turned.append(numpy.array([[c, -s, 0], [s, c, 0], [0, 0, 1]]) @ straight[-1])
    return straight, turned


PATHS = {
    "corners": [I, deformation(xy=0.1), deformation(xy=0.1, xx=-0.03, yy=0.05), deformation(xy=0.02, xx=-0.03, yy=0.05),
                deformation(xy=-0.1, yy=0.02, zy=0.06)],
    "cycles": [I] + [deformation(xy=0.03 * sign, yy=0.01 * sign * sign) for sign in (1, -1, 1, -1)],
    "large": [I, deformation(xx=0.6, xy=0.5, yy=-0.3, zz=-0.1), deformation(xx=2.0, xy=0.8, yz=-0.3, yy=-0.4, zz=-0.4)],
}
SUBSTEPS = (250, 500, 1000, 2000)
PROPORTIONAL = deformation(xx=0.5)


# ---- runs

def path_text(rows):
    """A path of deformation gradients as the program reads it: F - I, one row per time."""
    names = [f"H_{a}{b}" for a in AXES for b in AXES]
    lines = [",".join(["time", *names])]
    lines += [",".join([repr(float(time)), *(repr(float(value)) for value in (F - I).ravel())]) for time, F in enumerate(rows)]
    return "\n".join(lines) + "\n"


def point(name, rows, steps):
    properties = tuple(f"{key}={value!r}" for key, value in PROPERTIES.items())
    command = ("point", "j2", *properties, "--path", "path.csv", "--steps", str(steps))
    return Run(name, command=command, inputs={"path.csv": path_text(rows)})


def runs(mode):
    made = [point(f"single-{name}", [I, F], 1) for name, (F, _, _) in SINGLE.items()]
    made += [point("chain", chain(), 1), point("tension", [F for F, _, _ in tension()], 1)]
    made += [point("proportional", [I, PROPORTIONAL], 7)]
    made += [point(name, rows, 1) for name, rows in zip(("straight", "turned"), winding())]
    made += [point(f"{name}-{steps}", corners, steps) for name, corners in PATHS.items() for steps in SUBSTEPS]
    return made


# ---- what it is compared with

def returned(F, Cpi, e):
    """One step of the return mapping: Cpi and plastic strain at its end."""
    strain = LAW.log_strain(F, Cpi)
    volume = numpy.trace(strain)
    deviator = strain - volume / 3 * I
    trial = 2 * LAW.G * rates.ROOT * numpy.linalg.norm(deviator)
    if trial <= LAW.strength(e):
        return Cpi, e
    flow, last = 0.0, -1.0
    while flow > last:                                   # Newton rises to the root of a convex, falling function
        last = flow
        flow += (trial - 3 * LAW.G * flow - LAW.strength(e + flow)) / (3 * LAW.G + LAW.hardening(e + flow))
    kept = 1 - 3 * LAW.G * flow / trial
    values, vectors = numpy.linalg.eigh(volume / 3 * I + kept * deviator)
    inverse = numpy.linalg.inv(F)
    return inverse @ (vectors @ numpy.diag(numpy.exp(2 * values)) @ vectors.T) @ inverse.T, e + flow


def chain():
    """Deformation gradients of a random walk, elastic and plastic steps of 1e-5 to 1e-2."""
    generator, F, rows = numpy.random.default_rng(3), I.copy(), [I]
    for _ in range(400):
        F = F + 10 ** generator.uniform(-5, -2) * generator.standard_normal((3, 3))
        F = F / numpy.linalg.det(F) ** (1 / 6)            # keeps the volume near one
        rows.append(F)
    return rows


@functools.lru_cache(maxsize=None)
def tension():
    """Homogeneous plane-strain tension in steps of 1e-4: (F, Cpi, plastic strain) with P_xx = 0, by secants."""
    states, across = [(I, I, 0.0)], 0.0
    for number in range(1, round(TENSION_END / TENSION_STEP) + 1):
        _, Cpi, e = states[-1]

        def pull(value):
            F = deformation(xx=value, yy=number * TENSION_STEP)   # noqa: B023
            state = returned(F, Cpi, e)                           # noqa: B023
            return LAW.stress(F, state[0])[0, 0], (F, *state)

        old, new = across, across - 0.9 * TENSION_STEP
        before, (now, state) = pull(old)[0], pull(new)
        for _ in range(20):
            if abs(now) < 1e-9 * LAW.tau_y0 or now == before:
                break
            old, new, before = new, new - now * (new - old) / (now - before), now
            now, state = pull(new)
        states.append(state)
        across = new
    return states


# ---- figures

def stress_of(table, row):
    return numpy.array([[table[f"P_{a}{b}"][row] for b in AXES] for a in AXES])


def relative(found, expected):
    return float(numpy.linalg.norm(numpy.asarray(found) - expected) / numpy.linalg.norm(expected))


def check(case):
    for name, (_, e, stress) in SINGLE.items():
        table = case.results[f"single-{name}"].table
        case.figure(f"single_{name}_eps", abs(table["equivalent_plastic_strain"][-1] / e - 1))
        case.figure(f"single_{name}_P", relative(stress_of(table, -1).ravel(), stress))
    check_chain(case)
    check_tension(case)
    check_proportional(case)
    check_rotation(case)
    for name in PATHS:
        found = Convergence(case, name)
        case.figure(f"path_{name}_order", found.order())
        case.figure(f"path_{name}_P", found.extrapolated(0))
        case.figure(f"path_{name}_eps", found.extrapolated(1))


def check_chain(case):
    table, Cpi, e = case.results["chain"].table, I, 0.0
    worst = {"P": 0.0, "eps": 0.0, "energy": 0.0, "work": 0.0}
    for row, F in enumerate(chain()):
        Cpi, e = returned(F, Cpi, e)
        if e == 0:
            continue
        strain = LAW.log_strain(F, Cpi)
        volume = numpy.trace(strain)
        stored = 0.5 * LAW.kappa * volume**2 + LAW.G * ((strain - volume / 3 * I) ** 2).sum()
        errors = {"P": relative(stress_of(table, row), LAW.stress(F, Cpi)),
                  "eps": abs(table["equivalent_plastic_strain"][row] / e - 1),
                  "energy": abs(table["energy"][row] / stored - 1),
                  "work": abs(table["plastic_work"][row] / LAW.plastic_work(e) - 1)}
        worst = {name: max(worst[name], value) for name, value in errors.items()}
    for name, value in worst.items():
        case.figure(f"chain_{name}", value)


def check_tension(case):
    table, states = case.results["tension"].table, tension()
    case.figure("tension_P", max(relative(stress_of(table, row), LAW.stress(F, Cpi))
                                 for row, (F, Cpi, _) in enumerate(states) if row))
    rows = {strain: round(strain / TENSION_STEP) for strain in TENSION}
    names = ("F_xx", "P_yy", "kirchhoff_equivalent_stress", "equivalent_plastic_strain")
    beyond = [max(0.0, abs(table[name][rows[strain]] - value) - digit) / value for strain, values in TENSION.items()
              for name, value, digit in zip(names, values, DIGITS) if value]
    case.figure("tension_table", 100 * max(beyond))
    case.figure("tension_lateral", max(abs(table["P_xx"])) / LAW.tau_y0)
    top = int(numpy.argmax(table["P_yy"]))
    case.figure("tension_largest", table["P_yy"][top])
    case.figure("tension_largest_strain", top * TENSION_STEP)


def check_proportional(case):
    """Uniaxial strain keeps the direction of flow: the return mapping is exact for any step."""
    stretch = math.log(PROPORTIONAL[0, 0])
    low, high = 0.0, stretch
    while low < 0.5 * (low + high) < high:
        middle = 0.5 * (low + high)
        low, high = (middle, high) if 2 * LAW.G * stretch - 3 * LAW.G * middle > LAW.strength(middle) else (low, middle)
    case.figure("proportional_eps", abs(case.results["proportional"].table["equivalent_plastic_strain"][-1] / high - 1))


def check_rotation(case):
    """A superposed rotation turns the stress and nothing else."""
    straight, turned = (case.results[name].table for name in ("straight", "turned"))
    turns = [F @ numpy.linalg.inv(U) for U, F in zip(*winding())]
    case.figure("rotation_P", max(relative(stress_of(turned, row), R @ stress_of(straight, row))
                                  for row, R in enumerate(turns) if row))
    case.figure("rotation_eps", relative(turned["equivalent_plastic_strain"], straight["equivalent_plastic_strain"]))


@functools.lru_cache(maxsize=None)
def followed(name):
    """States at the corners of a path by the rate equations."""
    return rates.follow(LAW, PATHS[name], parts=100 if name == "large" else 20)[1:]


class Convergence:
    """Stress and plastic strain at the corners of a path for several steps, against the rate equations."""

    def __init__(self, case, name):
        states = followed(name)
        exact = (numpy.array([LAW.stress(F, Cpi) for F, Cpi, _ in states]), numpy.array([e for _, _, e in states]))
        self.exact, self.found = exact, []
        for steps in SUBSTEPS:
            table = case.results[f"{name}-{steps}"].table
            corners = range(steps, steps * len(states) + 1, steps)
            self.found.append((numpy.array([stress_of(table, row) for row in corners]),
                               table["equivalent_plastic_strain"][steps::steps]))

    def error(self, level, which):
        return relative(self.found[level][which], self.exact[which])

    def order(self):
        return math.log2(self.error(-2, 0) / self.error(-1, 0))

    def extrapolated(self, which):
        """Error of the limit of small steps, from the two finest."""
        return relative(2 * self.found[-1][which] - self.found[-2][which], self.exact[which])


def pictures(case, folder):
    figure, (left, right) = plt.subplots(1, 2, figsize=(11, 4.4), layout="constrained")
    table = case.results["tension"].table
    strain = (table["F_yy"] - 1) * 100
    left.plot(strain, table["P_yy"], color="#c4173a", lw=1.6, label="nominal stress $P_{yy}$")
    left.plot(strain, table["kirchhoff_equivalent_stress"], color="#1f6f8b", lw=1.6, label="equivalent Kirchhoff stress")
    left.plot([100 * e for e in TENSION], [row[1] for row in TENSION.values()], "o", ms=4, color="#1d2733", label="table")
    left.plot([100 * e for e in TENSION], [row[2] for row in TENSION.values()], "o", ms=4, color="#1d2733")
    left.set(xlabel="nominal strain (%)", ylabel="MPa", title="Homogeneous plane-strain tension", ylim=(0, None))
    for name, colour in zip(PATHS, ("#f7c548", "#ee6c2b", "#c4173a", "#6a4c93")):
        found = Convergence(case, name)
        right.loglog(SUBSTEPS, [found.error(level, 0) for level in range(len(SUBSTEPS))], "o-", color=colour, label=name)
    right.loglog(SUBSTEPS, [0.013 / steps for steps in SUBSTEPS], "k:", label="first order")
    right.set(xlabel="steps per piece of the path", ylabel="relative error of P", title="Strain paths against the rate equations")
    right.set_xticks(SUBSTEPS, [str(steps) for steps in SUBSTEPS])
    right.xaxis.set_minor_locator(NullLocator())
    for axes in (left, right):
        axes.legend(fontsize=8)
        axes.grid(color="#e3e8ee")
    picture.save(figure, folder / "figure.png", dpi=130)
    return [("figure.png", "Tension against the table; convergence of strain paths")]
