"""Plane waves through peridynamic points: speed against lattice and material, dispersion, Poisson's ratio, energy.

A wave passes two points.  The phase between the two records gives a speed for each frequency, and its limit for long waves;
the best shift of one record onto the other is that of the wave as a whole, which short wavelengths slow down.  Exact
speeds of the lattice are sums over bonds (tools/lattice_sums.py).
"""
import math
import pathlib

import matplotlib.pyplot as plt
import numpy
from tools import deck, lattice_sums, picture
from tools.simulation import Run

HERE = pathlib.Path(__file__).resolve().parent
YOUNG, DENSITY, QUOTIENT = 210000.0, 8e-3, 3.015
NEAR, FAR, RAMP, PATH = 14.5, 34.5, 12.0, 62.0          # mm: the points, length of the wave, its way in the time of the run
LONG = (12.0, 50.0)                                     # mm: wavelengths from which the limit is taken
RATIO = {"bond_pd": 0.25, "cpd": 0.3, "lps": 0.3}
HALVED = {"lattice.spacing": 0.5, "peridynamics.horizon": QUOTIENT / 2}  # P waves of lps have the strongest dispersion
SWEEP = {"cpd": (0.25, 0.4), "lps": (0.1, 0.4)}
# spacing 1 mm / 2^level, horizon 3.015 spacings; shear waves need the widest columns
LEVELS = {"quick": (0, 1), "full": (0, 1, 2)}
FINER = {"quick": (2,), "full": (2, 3)}                 # spacing 1 mm / part, horizon 3.015 mm
DEEP_NEAR, DEEP_FAR = 10.5, 24.5
DEEP = {"quick": ("bond_pd",), "full": ("bond_pd", "lps", "cpd")}
CROSSINGS = 10                                          # of the column by the wave, for the energy


def shear_modulus(ratio):
    return YOUNG / (2 * (1 + ratio))


def lame(ratio):
    """lambda over mu."""
    return 2 * ratio / (1 - 2 * ratio)


def material_speed(ratio, wave):
    """mm/ms."""
    return math.sqrt((lame(ratio) + 2 if wave == "P" else 1) * shear_modulus(ratio) / DENSITY)


def lattice_speed(formulation, ratio, wave, reach=QUOTIENT, dimension=2):
    if formulation == "lps":
        moduli = lattice_sums.state_moduli(reach, lame(ratio) + 2 / dimension, dimension)
    else:
        moduli = numpy.array(lattice_sums.bond_moduli(reach, dimension))
        if formulation == "cpd":                        # own volume in the hood; triangles and tetrahedra: lambda - mu
            moduli = moduli * (1 + 1 / lattice_sums.number(reach, dimension)) + (lame(ratio) - 1, 0)
    return math.sqrt(moduli[0 if wave == "P" else 1] * shear_modulus(ratio) / DENSITY)


def width(ratio, wave):
    """Even number of mm from which the sides are not heard at the far point in the time of the run, at least 120."""
    quotient = material_speed(ratio, "P") / material_speed(ratio, "S")
    return max(120, 2 * math.ceil(math.sqrt(PATH**2 - FAR**2) * (quotient if wave == "S" else 1 / quotient)))


def levels(formulation, wave, mode):
    """Those of the mode; the triangles of a wide column only in full."""
    found = LEVELS[mode]
    return found[:-1] if formulation == "cpd" and wave == "S" else found


def column(name, formulation, ratio, wave, changes):
    text = (HERE / "column.nml").read_text(encoding="utf-8")
    if formulation != "cpd":
        text = deck.without(text, "cpd")
    speed = material_speed(ratio, wave)
    moving, held = ("x", "yz") if wave == "P" else ("y", "xz")
    if changes.get("body.kinematics") != "3d":
        held = held[0]
    middle = width(ratio, wave) / 2 - 0.5
    text = deck.vary(text, {
        "lattice.size": (60, width(ratio, wave), 0), "probe(1).point": (NEAR, middle, 0), "probe(2).point": (FAR, middle, 0),
        "body.formulation": formulation, "material.nu": ratio, "run.t_end": PATH / speed, "load(1).ramp": RAMP / speed,
        "load(1).directions": moving, "load(2).directions": held} | changes)
    return Run(name, command=(f"{name}.nml",), inputs={f"{name}.nml": text})


def runs(mode):
    made = []
    for formulation, ratio in RATIO.items():
        for wave in "PS":
            for level in levels(formulation, wave, mode):
                changes = {"lattice.spacing": 0.5**level, "peridynamics.horizon": QUOTIENT * 0.5**level}
                made.append(column(f"{formulation}-{wave}-{level}", formulation, ratio, wave, changes))
            for part in FINER[mode] if formulation != "cpd" else ():
                made.append(column(f"{formulation}-{wave}-part{part}", formulation, ratio, wave, {"lattice.spacing": 1 / part}))
            for other in SWEEP.get(formulation, ()):
                made.append(column(f"{formulation}-{wave}-nu{other}", formulation, other, wave, HALVED if (formulation, wave) == ("lps", "P") else {}))
        made.append(energetic(formulation, ratio))
    return made + [deep(formulation, RATIO[formulation]) for formulation in DEEP[mode]]


def deep(formulation, ratio):
    """In space, on a shorter way."""
    return column(f"{formulation}-P-deep", formulation, ratio, "P", {
        "body.kinematics": "3d", "lattice.type": "cubic", "lattice.size": (50, 62, 62), "run.t_end": 58 / material_speed(ratio, "P"),
        "probe(1).point": (DEEP_NEAR, 30.5, 30.5), "probe(2).point": (DEEP_FAR, 30.5, 30.5)})


def energetic(formulation, ratio):
    """The wave goes to and fro."""
    changes = {"lattice.size": (60, 20, 0), "probe(1).point": (NEAR, 9.5, 0), "probe(2).point": (FAR, 9.5, 0),
               "run.t_end": CROSSINGS * 60 / material_speed(ratio, "P")}
    if formulation == "cpd":
        changes["cpd.weights"] = "conservative"
    return column(f"{formulation}-energy", formulation, ratio, "P", changes)


# ---- measures

def records(result, wave):
    """Times and the velocities of the two points."""
    history, axis = result.history, "x" if wave == "P" else "y"
    return history["time"], history[f"near_{axis}"], history[f"far_{axis}"]


def spectrum(time, record, rates):
    return numpy.exp(-1j * numpy.outer(rates, time)) @ record


def phase_speeds(result, ratio, wave, way):
    """Speed by angular frequency."""
    time, near, far = records(result, wave)
    rates = 2 * math.pi * material_speed(ratio, wave) / numpy.linspace(*LONG[::-1], 30)
    lag = numpy.unwrap(-numpy.angle(spectrum(time, far, rates) / spectrum(time, near, rates)))
    return rates, rates * way / lag


def long_wave_speed(result, ratio, wave, way=FAR - NEAR):
    """The limit: dispersion is even in the frequency."""
    rates, speeds = phase_speeds(result, ratio, wave, way)
    return numpy.polyfit((rates / rates[-1]) ** 2, speeds, 2)[-1]


def whole_wave_speed(result, wave):
    """From the best shift, the maximum of the correlation of the two records."""
    time, near, far = records(result, wave)
    fine = numpy.linspace(time[0], time[-1], 1 << 15)
    spectra = [numpy.fft.rfft(numpy.interp(fine, time, record), 1 << 16) for record in (near, far)]
    shift = numpy.fft.irfft(spectra[1] * spectra[0].conj())[: len(fine)].argmax()
    return (FAR - NEAR) / (shift * (fine[1] - fine[0]))


def delay(case, formulation, wave, level):
    """By what part the wave as a whole is slower than the lattice's long waves."""
    result = case.results[f"{formulation}-{wave}-{level}"]
    return 1 - whole_wave_speed(result, wave) / lattice_speed(formulation, RATIO[formulation], wave)


def energy(result):
    """Change of the mean energy from the first to the last crossing, and half the range of its swing, over the energy."""
    history, steps = result.history, len(result.history["time"]) // CROSSINGS
    # what the first steps of the drive book is no drift: the wave has left it when half a crossing is over
    total = (history["balance"] / (history["kinetic"] + history["elastic"])[-1])[steps // 2:]
    return abs(total[-steps:].mean() - total[:steps].mean()), (total.max() - total.min()) / 2


def check(case):
    for formulation, ratio in RATIO.items():
        for wave in "PS":
            name, present = f"{wave}_{formulation}", levels(formulation, wave, case.mode)
            for level in present:
                found = long_wave_speed(case.results[f"{formulation}-{wave}-{level}"], ratio, wave)
                case.figure(f"speed_{name}_{level}", found / lattice_speed(formulation, ratio, wave))
                case.figure(f"delay_{name}_{level}", delay(case, formulation, wave, level))
            case.figure(f"material_{name}", found / material_speed(ratio, wave))
            if len(present) > 1:
                case.figure(f"order_{name}", math.log2(delay(case, formulation, wave, present[-2]) / delay(case, formulation, wave, present[-1])))
            for part in FINER[case.mode] if formulation != "cpd" else ():
                found = long_wave_speed(case.results[f"{formulation}-{wave}-part{part}"], ratio, wave)
                case.figure(f"material_{name}_part{part}", found / material_speed(ratio, wave))
            for other in SWEEP.get(formulation, ()):
                found = long_wave_speed(case.results[f"{formulation}-{wave}-nu{other}"], other, wave)
                case.figure(f"speed_{name}_nu{other}", found / lattice_speed(formulation, other, wave))
        drift, swing = energy(case.results[f"{formulation}-energy"])
        case.figure(f"drift_{formulation}", drift)
        case.figure(f"swing_{formulation}", swing)
    for formulation in DEEP[case.mode]:
        found = long_wave_speed(case.results[f"{formulation}-P-deep"], RATIO[formulation], "P", DEEP_FAR - DEEP_NEAR)
        case.figure(f"speed_P_{formulation}_deep", found / lattice_speed(formulation, RATIO[formulation], "P", dimension=3))


COLOURS = {"bond_pd": "#1d2733", "cpd": "#c4173a", "lps": "#1f6f8b"}


def draw_dispersion(case, axes):
    for formulation, ratio in RATIO.items():
        for level, style in zip(LEVELS[case.mode], (":", "-", "--")):
            rates, speeds = phase_speeds(case.results[f"{formulation}-P-{level}"], ratio, "P", FAR - NEAR)
            length = 2 * math.pi * speeds / rates
            axes.plot(length, speeds / lattice_speed(formulation, ratio, "P"), style, color=COLOURS[formulation], lw=1.5,
                      label=f"{formulation}, spacing {0.5**level:g} mm")
    axes.set(xlabel="wavelength (mm)", ylabel="phase speed over that of the lattice's long waves", title="P waves, horizon 3.015 spacings",
             xlim=(10, 50), ylim=(0.85, 1.02))


def draw_sweep(case, axes):
    fine = numpy.linspace(0.05, 0.42, 75)
    for formulation in SWEEP:
        found = sorted([(ratio, f"nu{ratio}") for ratio in SWEEP[formulation]] + [(RATIO[formulation], "0")])
        for wave, marker, style in (("P", "o", "-"), ("S", "s", "--")):
            line = [ratio for ratio in fine if ratio >= found[0][0]]
            axes.plot(line, [lattice_speed(formulation, ratio, wave) for ratio in line], style, lw=1, color=COLOURS[formulation])
            axes.plot([ratio for ratio, _ in found],
                      [long_wave_speed(case.results[f"{formulation}-{wave}-{name}"], ratio, wave) for ratio, name in found], marker, ms=6,
                      color=COLOURS[formulation], label=f"{wave}, {formulation}")
    axes.plot(fine, [material_speed(ratio, "P") for ratio in fine], color="#f7c548", lw=5, zorder=0, label="material")
    axes.plot(fine, [material_speed(ratio, "S") for ratio in fine], color="#f7c548", lw=5, zorder=0)
    axes.set(xlabel="Poisson's ratio", ylabel="speed (m/s)", title="Long waves, plane strain; lines: lattice")


def pictures(case, folder):
    figure, (left, right) = plt.subplots(1, 2, figsize=(11, 4.6), layout="constrained")
    draw_dispersion(case, left)
    draw_sweep(case, right)
    for axes in (left, right):
        axes.grid(color="#e3e8ee")
        axes.legend(fontsize=8)
    picture.save(figure, folder / "figure.png", dpi=130)
    return [("figure.png", "Dispersion of P waves, and speeds over Poisson's ratio")]
