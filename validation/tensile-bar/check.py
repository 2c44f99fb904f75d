"""Figs. 4 to 10 of the Continuum Bond Method paper: a necking bar by CBM, TLSPH and finite elements.

Particles of CBM and TLSPH are the same (bar.msh).  Fields are compared as in the paper: the finite-element field is
interpolated at the particles and the error is its equation (29), over all particles that are at least 4 l_c away from
the driven rows.  Measures of curves and fields stand in tools/curves.py and tools/interpolation.py, pictures in
bar_pictures.py.
"""
import functools
import math
import pathlib
import sys

import numpy
from tools import curves, interpolation
from tools.simulation import Mesh, Run

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))

HEIGHT, NECK, PULL, RAMP = 40.0, 6.0, 2.0, 0.8           # [mm, mm, mm, ms]
SPEED = math.sqrt((164210 + 4 / 3 * 80190) / 0.01)       # wave speed c0 [mm/ms]
SPACINGS = {100: 3.0, 200: 1.8, 350: 1.35, 1800: 0.55}   # particles (about): l_c [mm]
FINE = SPACINGS[1800]
COARSE_FEM = 7.0                                         # mesh of about 200 degrees of freedom [mm]
REFERENCE = {"quick": FINE, "full": 0.35}                # mesh of the finite-element reference [mm]
STRAIN, STRESS = "equivalent_plastic_strain", "kirchhoff_equivalent_stress"
FIELDS = {"eps": STRAIN, "tau": STRESS}
PSI = (0.01, 0.07, 0.1, 0.2, 1)
SHOULDERS = {"": None, "10": (10, 5), "16": (16, 5), "18": (18, 6)}   # bars: width, radius of the fillet [mm]
# How r of the paper is read: radius of (27), with neighbours within 2 r, or cut-off radius; and on which bar.
LITERAL, CUTOFF = {2: 2, 3: 3, 4: 4}, {2: 1, 3: 1.5, 4: 2}           # r/l_c of the paper: radius of (27) over l_c
READINGS = {"literal": ("", LITERAL), "cutoff": ("", CUTOFF), "round": ("18", CUTOFF)}
SLOWER = 5                                               # ramp of the slow runs over the paper's
YIELDED = 0.0025                                         # nominal strain after which the neck has yielded
TABLE = {0.001: 225.56, 0.002: 450.44, 0.0025: 508.17, 0.005: 531.15, 0.01: 556.38, 0.02: 597.15, 0.03: 629.32,
         0.05: 674.11, 0.08: 708.75, 0.10: 718.57, 0.12: 721.96, 0.15: 719.64, 0.20: 705.84}   # P_yy, homogeneous


# ---- runs

def mesh(spacing, bar=""):
    shoulder = (("shoulder", SHOULDERS[bar][0]), ("fillet", SHOULDERS[bar][1])) if bar else ()
    return Mesh("bar.geo", (("l_c", spacing), *shoulder), "bar.msh")


def cbm(name, spacing, bar="", slower=1):
    """`slower` stretches the ramp and the run in time: less inertia than in the paper."""
    changes = {"run.time_step": 0.2 * spacing / SPEED}
    if slower != 1:
        changes |= {"run.t_end": 1.0 * slower, "load(3).ramp": RAMP * slower, "history.every_time": 0.001 * slower}
    return Run(name, "cbm.nml", changes, mesh(spacing, bar))


def fem(name, spacing, bar=""):
    return Run(name, "fem.nml", {}, mesh(spacing, bar))


def sph_name(radius, psi, bar=""):
    return f"sph{bar}-{radius:g}-{psi:g}"


def sph(radius, psi, bar=""):
    changes = {"kernel.radius": radius * FINE, "hourglass.psi": psi}
    return Run(sph_name(radius, psi, bar), "tlsph.nml", changes, mesh(FINE, bar))


def sph_settings(mode):
    """Radius of (27) over l_c, psi and bar; r = 4 l_c as cut-off and r = 2 l_c by (27) are one run."""
    if mode == "quick":
        return [(1.5, 0.07, ""), (3, 0.07, "")]
    pairs = sorted({(bar, radius) for bar, radii in READINGS.values() for radius in radii.values()})
    return [(radius, psi, bar) for bar, radius in pairs for psi in PSI] + [(1.5, 0.07, "10"), (1.5, 0.07, "16")]


def slow_counts(mode):
    return (100, 350, 1800) if mode == "full" else (100, 350)


def runs(mode):
    made = [fem("fem", REFERENCE[mode])]
    made += [cbm(f"cbm-{count}", spacing) for count, spacing in reversed(SPACINGS.items())]
    made += [cbm(f"slow-{count}", SPACINGS[count], slower=SLOWER) for count in slow_counts(mode)]
    made += [fem("fem-200dof", COARSE_FEM)]
    made += [sph(*setting) for setting in sph_settings(mode)]
    made += [Run(f"patch-{method}", "patch.nml", {"body.formulation": method}) for method in ("fem", "cbm")]
    if mode == "full":
        made += [fem("fem-next", FINE)]
        made += [Run("static", "fem.nml", {"body.formulation": "cbm", "body.elements": "linear"}, mesh(FINE))]
        for bar in filter(None, SHOULDERS):
            made += [fem(f"fem{bar}", 0.4, bar), cbm(f"cbm{bar}-1800", FINE, bar)]
    return made


# ---- measures

def curve(result):
    """Nominal strain and stress: motion of the top over 40 mm, its reaction over 6 mm."""
    history = result.history
    s = history["time"] / result.run.changes.get("load(3).ramp", RAMP)
    smooth = numpy.where(s < 1, s**3 * (10 - 15 * s + 6 * s * s), 1.0)
    part = numpy.interp(history["time"], (0, 0.25, 1), (0, 0.05, 1)) if is_static(result) else smooth
    return PULL * part / HEIGHT, history["reaction_top_y"] / NECK


def is_static(result):
    return result.run.deck == "fem.nml"


def kinetic(result):
    """Largest kinetic over stored and dissipated energy after yield."""
    history, (strain, _) = result.history, curve(result)
    after = strain >= YIELDED
    return (history["kinetic"][after] / (history["elastic"] + history["plastic"])[after]).max()


def closure(result):
    """Largest error of the energy balance over the work of the top."""
    history = result.history
    return abs(history["balance"]).max() / history["reaction"][-1]


def centroids(data):
    return data.points[data.simplices[:, :3]].mean(axis=1)


def at_points(data, points):
    """Interpolates an element field of a finite-element result at points of the reference configuration."""
    return interpolation.Interpolation(centroids(data), points)


def on_fillets(data):
    """Particles on the free edge of the fillets of the default bar, a quarter of a spacing past their ends included."""
    edges = numpy.sort(numpy.concatenate([data.simplices[:, pair] for pair in ((0, 1), (1, 2), (2, 0))]), axis=1)
    ends, times = numpy.unique(edges, axis=0, return_counts=True)
    free = numpy.zeros(len(data.points), bool)
    free[ends[times == 1].ravel()] = True
    beyond = abs(data.points[:, 1] - HEIGHT / 2) - 9.0                  # past the end of the straight neck
    return free & (beyond >= 0) & (beyond <= 2 + 0.25 * FINE)


def compared(points, spacing=FINE):
    """Particles that enter (29): at least 4 l_c from the driven rows."""
    y, slack = points[:, 1], 1e-9 * HEIGHT
    return (y >= 4 * spacing - slack) & (y <= HEIGHT - 4 * spacing + slack)


def field_error(result, reference, field, between=None):
    """Equation (29) of a particle result; `between` is the interpolation if it is known already."""
    points = result.exodus.points
    inside, between = compared(points), between or at_points(reference.exodus, points)
    return curves.error_norm(result.exodus.nodal(field)[inside], between(reference.exodus.element(field))[inside])


class Errors:
    """Errors (29) of all runs on the particles of a bar."""

    def __init__(self, case, bar=""):
        self.case, self.bar, self.reference = case, bar, case.results[f"fem{bar}"]
        self.points = case.results[f"cbm{bar}-1800"].exodus.points
        self.between = at_points(self.reference.exodus, self.points)

    @functools.lru_cache(maxsize=None)
    def of(self, name, field):
        return field_error(self.case.results[name], self.reference, FIELDS[field], self.between)

    def cbm(self, field):
        return self.of(f"cbm{self.bar}-1800", field)

    def sph(self, radius, psi, field):
        return self.of(sph_name(radius, psi, self.bar), field)

    def table(self, reading, field):
        """Errors of TLSPH: rows r = 2, 3, 4 l_c, columns psi."""
        return numpy.array([[self.sph(radius, psi, field) for psi in PSI] for radius in READINGS[reading][1].values()])

    def best(self, reading, field):
        """Smallest error with its r/l_c and psi."""
        table = self.table(reading, field)
        row, column = numpy.unravel_index(table.argmin(), table.shape)
        return table[row, column], list(READINGS[reading][1])[row], PSI[column]


# ---- figures

def check(case):
    check_patch(case)
    check_curves(case)
    check_energies(case)
    errors = {bar: Errors(case, bar) for bar in (SHOULDERS if case.full else ("",))}
    for field in FIELDS:
        case.figure(f"{field}_cbm", errors[""].cbm(field))
    check_fillets(case, errors[""])
    if case.full:
        for reading, (bar, _) in READINGS.items():
            check_sph(case, errors[bar], reading)
        check_reference(case, errors[""])
        check_shoulders(case, errors)
    else:
        for radius, psi, _ in sph_settings("quick"):
            for field in FIELDS:
                case.figure(f"{field}_{sph_name(radius, psi)}", errors[""].sph(radius, psi, field))
        case.figure("eps_ratio", errors[""].sph(1.5, 0.07, "eps") / errors[""].cbm("eps"))


def check_patch(case):
    for method in ("fem", "cbm"):
        history = case.results[f"patch-{method}"].history
        stress = numpy.interp(list(TABLE), history["time"], history["reaction_top_y"])
        case.figure(f"patch_{method}", 100 * abs(stress / list(TABLE.values()) - 1).max())
        first = int(numpy.argmin(abs(history["time"] - 1e-4)))
        case.figure(f"slope_{method}", history["reaction_top_y"][first] / history["time"][first] / 1e3)


def check_curves(case):
    known = {name: curve(case.results[name]) for name in ("fem", "fem-200dof", *(f"cbm-{count}" for count in SPACINGS))}
    for count in SPACINGS:
        case.figure(f"particles_{count}", len(case.results[f"cbm-{count}"].exodus.points))
    case.figure("nodes_200dof", len(case.results["fem-200dof"].exodus.points))
    for name in ("cbm-100", "cbm-200"):
        case.figure(f"{name}_to_350", curves.largest_difference(known[name], known["cbm-350"], YIELDED, 0.05))
    case.figure("cbm-100_to_fem-200dof", curves.largest_difference(known["cbm-100"], known["fem-200dof"], YIELDED, 0.05))
    case.figure("cbm-1800_to_fem", curves.largest_difference(known["cbm-1800"], known["fem"], YIELDED, 0.05))
    for name, (strain, stress) in known.items():
        case.figure(f"plateau_{name}", stress[-1])
    for name in ("fem", "cbm-1800"):
        stiffness = curves.slope(known[name], 50, 350)
        case.figure(f"stiffness_{name}", stiffness / 1e3)
        case.figure(f"knee_{name}", curves.knee(known[name], stiffness))
    check_slow(case, known)
    strain, stress = known["fem"]
    case.figure("strain_of_largest_load", strain[numpy.argmax(stress)])


def check_slow(case, known):
    """The same curves with 1/25 of the kinetic energy."""
    slow = {count: curve(case.results[f"slow-{count}"]) for count in slow_counts(case.mode)}
    case.figure("slow-100_to_350", curves.largest_difference(slow[100], slow[350], YIELDED, 0.05))
    case.figure("slow-100_to_fem-200dof", curves.largest_difference(slow[100], known["fem-200dof"], YIELDED, 0.05))
    case.figure("kinetic_slow-350", kinetic(case.results["slow-350"]))
    if case.full:
        case.figure("slow-1800_to_fem", curves.largest_difference(slow[1800], known["fem"], YIELDED, 0.05))
        case.figure("knee_slow-1800", curves.knee(slow[1800], curves.slope(slow[1800], 50, 350)))


def check_energies(case):
    case.figure("kinetic_cbm-1800", kinetic(case.results["cbm-1800"]))
    case.figure("balance_cbm-1800", closure(case.results["cbm-1800"]))
    settings = sph_settings(case.mode)
    case.figure("kinetic_sph", max(kinetic(case.results[sph_name(*setting)]) for setting in settings))
    case.figure("balance_sph", max(closure(case.results[sph_name(*setting)]) for setting in settings))


def check_sph(case, errors, reading):
    """Fig. 9: where the errors of TLSPH are smallest."""
    for field in FIELDS:
        value, radius, psi = errors.best(reading, field)
        case.figure(f"{field}_{reading}", value)
        case.figure(f"{field}_{reading}_r", radius)
        case.figure(f"{field}_{reading}_psi", psi)
    case.figure(f"eps_{reading}_ratio", errors.best(reading, "eps")[0] / errors.cbm("eps"))
    check_stiffening(case, errors.bar, reading)


def check_stiffening(case, bar, reading):
    """Fig. 6: the nominal stress at 2 mm hardly depends on r and psi, and is higher where both are large."""
    end = {psi: [curve(case.results[sph_name(radius, psi, bar)])[1][-1] for radius in READINGS[reading][1].values()]
           for psi in PSI}
    known = curve(case.results[f"fem{bar}"])[1][-1]
    mild = numpy.array([end[psi] for psi in PSI if psi <= 0.1])
    case.figure(f"curve_{reading}_mild", 100 * abs(mild / known - 1).max())
    case.figure(f"curve_{reading}_stiff", 100 * (end[1][2] / known - 1))
    rises = numpy.diff(numpy.array([end[psi] for psi in PSI]), axis=0)
    case.figure(f"curve_{reading}_softer", int((rises < 0).sum()))


def check_reference(case, errors):
    """How far the reference is converged, and what inertia does to CBM."""
    inside, coarser = compared(errors.points), case.results["fem-next"].exodus
    between = at_points(coarser, errors.points)
    for name, field in FIELDS.items():
        fine = errors.between(errors.reference.exodus.element(field))[inside]
        case.figure(f"{name}_fem-next", curves.error_norm(between(coarser.element(field))[inside], fine))
        static, dynamic = (case.results[run].exodus.nodal(field)[inside] for run in ("static", "cbm-1800"))
        case.figure(f"{name}_inertia", curves.error_norm(dynamic, static))
        case.figure(f"{name}_static", field_error(case.results["static"], errors.reference, field, errors.between))
    case.figure("plateau_fem-next", curve(case.results["fem-next"])[1][-1])


def check_fillets(case, errors):
    """Parts of the error of CBM: on the edge of the fillets and elsewhere; their squares add to its square."""
    data, reference = case.results["cbm-1800"].exodus, errors.between(errors.reference.exodus.element(STRAIN))
    inside, edge = compared(errors.points), on_fillets(data)
    squares = (data.nodal(STRAIN) - reference) ** 2 / (reference[inside] ** 2).sum()
    case.figure("particles_on_fillets", (inside & edge).sum())
    case.figure("eps_on_fillets", 100 * math.sqrt(squares[inside & edge].sum()))
    case.figure("eps_elsewhere", 100 * math.sqrt(squares[inside & ~edge].sum()))


def check_shoulders(case, errors):
    for bar in filter(None, SHOULDERS):
        strain_stress = curve(case.results[f"cbm{bar}-1800"])
        case.figure(f"particles_shoulder{bar}", len(errors[bar].points))
        for field in FIELDS:
            case.figure(f"{field}_shoulder{bar}", errors[bar].cbm(field))
            case.figure(f"{field}_shoulder{bar}_sph", errors[bar].sph(1.5, 0.07, field))
        case.figure(f"plateau_shoulder{bar}", strain_stress[1][-1])
        case.figure(f"stiffness_shoulder{bar}", curves.slope(strain_stress, 50, 350) / 1e3)


def pictures(case, folder):
    import bar_pictures
    return bar_pictures.pictures(sys.modules[__name__], case, folder)
