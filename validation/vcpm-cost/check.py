"""What an elastic lattice plate costs against its size: implicit with a direct and an iterative solver, explicit, and by finite elements;
and what one bond that breaks costs, with a factor that is corrected and with a new one each time.

Times are of the processor and of whole runs, set-up and files included.  With --full the smaller runs are made
three times, and the shortest counts.
"""
import pathlib

import matplotlib.pyplot as plt
import numpy
from tools import picture, rectangle
from tools.simulation import Run

HERE = pathlib.Path(__file__).resolve().parent
WIDTH, HEIGHT = 10.0, 30.0                                # mm
WAVE = numpy.sqrt(69000 * 0.7 / (1.3 * 0.4) / 2.7e-9)     # mm/s
STEPS = 10_000
COUNTS = (100, 400)                                       # steps that a step's time is measured with in large plates
# spacings across the width, by kind
SIZES = {"quick": {"direct": (24, 40, 60, 100), "iterative": (24, 40, 60, 100), "fem": (24, 40, 60, 100), "fem-iterative": (24, 40, 60, 100),
                   "relaxation": (24, 40), "explicit": (24, 40), "steps": ()},
         "full": {"direct": (24, 40, 60, 100, 170), "iterative": (24, 40, 60, 100, 170, 300, 540),
                  "fem": (24, 40, 60, 100, 170), "fem-iterative": (24, 40, 60, 100, 170, 300, 540),
                  "relaxation": (24, 40, 60, 100), "explicit": (24, 40, 60, 100), "steps": (170, 300, 540)}}
FITTED = {"direct": 40, "iterative": 40, "fem": 40, "fem-iterative": 40, "relaxation": 24, "explicit": 24}  # exponents from this size on
REPEATED = 100                                            # up to this size
# The strip that breaks: spacing and length of the pre-crack [mm] before a long and before a short ligament.
STRIP = 60.0                                              # mm, its length
CRACKS = {"quick": (0.25, 40.0, 54.0), "full": (0.1, 2.0, 58.0)}


def rows(n):
    """The odd number of rows nearest to the height, with the particles at both ends of the outer ones."""
    count = round(HEIGHT / (WIDTH / n * numpy.sqrt(0.75)))
    return count + 1 - count % 2


def particles(n):
    return sum(n + 1 - row % 2 for row in range(rows(n)))


def height(n):
    """Of the rectangle through the outer particles."""
    return float((rows(n) - 1) * WIDTH / n * numpy.sqrt(0.75))


def lattice(n):
    return {"lattice.spacing": WIDTH / n, "lattice.size": (WIDTH, height(n) + 0.1 * WIDTH / n, 0)}


def implicit(name, n, method, solver):
    return Run(name, "plate.nml", lattice(n) | {"static.method": method, "static.solver": solver})


def finite_elements(name, n, solver):
    """As many nodes as particles: corners and middles of equal elements, three times as many along as across."""
    count = round((particles(n) / 12) ** 0.5)
    x, y = numpy.linspace(0, WIDTH, count + 1), numpy.linspace(0, height(n), 3 * count + 1)
    return Run(name, "fem.nml", {"zone(1).centre": (0, height(n), 0), "static.solver": solver}, inputs={"rectangle.msh": rectangle.mesh(x, y)})


def explicit(name, n, steps):
    """A step is half of the time that a wave takes from particle to particle; the load needs all steps."""
    step = float(0.5 * WIDTH / n / WAVE)
    return Run(name, "explicit.nml", lattice(n) | {"run.time_step": step, "run.t_end": steps * step, "load(2).ramp": steps * step})


def made(kind, name, n):
    if kind in ("direct", "iterative"):
        return implicit(name, n, "newton", kind)
    if kind == "relaxation":
        return implicit(name, n, "relaxation", "direct")
    if kind == "explicit":
        return explicit(name, n, STEPS)
    return finite_elements(name, n, "iterative" if kind == "fem-iterative" else "direct")


def crack(name, mode, start, **changes):
    return Run(name, "crack.nml", {"lattice.spacing": CRACKS[mode][0], "precrack.points": (-1, 2.51, start, 2.51)} | changes)


def cracks(mode):
    """Nothing breaks in the first."""
    _, long, short = CRACKS[mode]
    return [crack("crack-none", mode, long, **{"load(2).value": 0.005}), crack("crack-long", mode, long),
            crack("crack-short", mode, short), crack("crack-factorised", mode, short, **{"static.corrections": 0})]


def repeats(mode, kind, n):
    return 3 if mode == "full" and n <= REPEATED and kind not in ("relaxation", "explicit") else 1


def runs(mode):
    sizes = SIZES[mode]
    found = [made(kind, f"{kind}-{n}-{number}", n) for kind in FITTED for n in sizes[kind] for number in range(repeats(mode, kind, n))]
    found += [explicit(f"steps-{n}-{count}", n, count) for n in sizes["steps"] for count in COUNTS]
    return found + cracks(mode)


# ---- figures

def reaction(case, kind, n):
    """N/mm, of the lower edge."""
    return -case.results[f"{kind}-{n}-0"].history["reaction_bottom_y"][-1]


def time(case, kind, n):
    """Processor time, s.  Of a large explicit run: that of the first and 9900 times what another step costs."""
    if kind == "explicit" and n in SIZES[case.mode]["steps"]:
        few, more = (case.results[f"steps-{n}-{count}"].cost["processor"] for count in COUNTS)
        return few + (more - few) * (STEPS - COUNTS[0]) / (COUNTS[1] - COUNTS[0])
    return min(case.results[f"{kind}-{n}-{number}"].cost["processor"] for number in range(repeats(case.mode, kind, n)))


def sizes(case, kind):
    return SIZES[case.mode][kind] + (SIZES[case.mode]["steps"] if kind == "explicit" else ())


def unknowns(n, kind):
    """Particles, or nodes of finite elements."""
    count = round((particles(n) / 12) ** 0.5)
    return (2 * count + 1) * (6 * count + 1) if kind.startswith("fem") else particles(n)


def exponent(case, kind):
    """Of the time over the number of particles, least squares."""
    chosen = [n for n in sizes(case, kind) if n >= FITTED[kind]]
    return numpy.polyfit(numpy.log([unknowns(n, kind) for n in chosen]), numpy.log([time(case, kind, n) for n in chosen]), 1)[0]


def of_event(case, name):
    """Processor time of one bond that breaks, s."""
    result, start = case.results[name], case.results["crack-none"]
    return (result.cost["processor"] - start.cost["processor"]) / result.history["broken"][-1]


def check_cracks(case):
    spacing, long, _ = CRACKS[case.mode]
    count = case.results["crack-long"].history["broken"][-1]
    case.figure("crack_none", case.results["crack-none"].history["broken"][-1])
    case.figure("crack_events", count)
    case.figure("crack_crossing", count / (2 * (STRIP - long) / spacing))
    short, factorised = (case.results[name].history for name in ("crack-short", "crack-factorised"))
    loads = [history["reaction_top_y"] for history in (short, factorised)]
    same = len(loads[0]) == len(loads[1])
    case.figure("crack_answer", abs(loads[0] - loads[1]).max() / loads[0].max() if same else numpy.inf)
    for name in ("long", "factorised"):
        case.figure(f"time_event_{name}", of_event(case, f"crack-{name}"))
    case.figure("ratio_event", of_event(case, "crack-factorised") / of_event(case, "crack-long"))
    case.figure("thousand", 1000 * of_event(case, "crack-long"))


def check(case):
    check_cracks(case)
    for kind in ("iterative", "relaxation", "explicit"):
        for n in SIZES[case.mode][kind]:
            if n in SIZES[case.mode]["direct"]:
                case.figure(f"answer_{kind}_{n}", abs(reaction(case, kind, n) / reaction(case, "direct", n) - 1))
    for n in SIZES[case.mode]["fem"]:
        case.figure(f"answer_fem-iterative_{n}", abs(reaction(case, "fem-iterative", n) / reaction(case, "fem", n) - 1))
    for kind in FITTED:
        case.figure(f"exponent_{kind}", exponent(case, kind))
        for n in sizes(case, kind):
            case.figure(f"time_{kind}_{n}", time(case, kind, n))
    for kind in ("direct", "iterative"):
        for n in sizes(case, "explicit"):
            if n in sizes(case, kind):
                case.figure(f"ratio_{kind}_{n}", time(case, "explicit", n) / time(case, kind, n))
    for kind in ("direct", "iterative", "fem", "fem-iterative"):
        n = max(SIZES[case.mode][kind])
        case.figure(f"memory_{kind}", case.results[f"{kind}-{n}-0"].cost["memory"] * 1e6 / unknowns(n, kind))


def pictures(case, folder):
    figure, axes = plt.subplots(figsize=(7.2, 5), layout="constrained")
    styles = {"explicit": ("#1d2733", "s-", f"explicit, {STEPS} steps"), "relaxation": ("#8a6d00", "^-", "dynamic relaxation"),
              "direct": ("#c4173a", "o-", "implicit, direct"), "iterative": ("#c4173a", "o:", "implicit, iterative"),
              "fem": ("#1f6f8b", "x-", "finite elements, direct"), "fem-iterative": ("#1f6f8b", "x:", "finite elements, iterative")}
    for kind, (colour, line, label) in styles.items():
        axes.loglog([unknowns(n, kind) for n in sizes(case, kind)], [time(case, kind, n) for n in sizes(case, kind)], line, mfc="none", color=colour,
                    label=f"{label}: {exponent(case, kind):.2f}")
    axes.set(xlabel="particles, or nodes", ylabel="processor time, s", title="With the exponent of the number of particles")
    axes.legend(fontsize=8)
    axes.grid(color="#e3e8ee", which="both")
    picture.save(figure, folder / "figure.png", dpi=110)
    return [("figure.png", "Processor time against the number of particles")]
