"""Pictures of the tensile bar like Figs. 4 to 10 of the paper; what is measured stands in check.py."""
import matplotlib.pyplot as plt
import numpy
from matplotlib.colors import Normalize
from tools import picture

COLOURS = {"fem": "#1d2733", "cbm": "#c4173a", "sph": "#1f6f8b"}
SHADES = ("#f7c548", "#ee6c2b", "#c4173a", "#6a4c93", "#1f6f8b")


class Bar:
    """The particles of the default bar, with the finite-element fields interpolated at them."""

    def __init__(self, check, case):
        self.check, self.case = check, case
        self.fem, self.particles = case.results["fem"].exodus, case.results["cbm-1800"].exodus
        self.between = check.at_points(self.fem, self.particles.points)

    def field(self, name, field):
        """Values at the particles of a run, `fem` included."""
        if name == "fem":
            return self.between(self.fem.element(field))
        return self.case.results[name].exodus.nodal(field)

    def shape(self, name):
        """Current positions; the reference is drawn in the shape of CBM."""
        data = self.particles if name == "fem" else self.case.results[name].exodus
        return data.points[:, :2] + data.displacement()[:, :2]

    def draw(self, axes, name, values, norm, cmap, window=(-0.5, 42.5), half=7.2):
        x, y = self.shape(name).T
        drawn = axes.tripcolor(x, y, self.particles.simplices, values, shading="gouraud", cmap=cmap, norm=norm)
        axes.set(aspect="equal", xlim=(-half, half), ylim=window, xticks=[], yticks=[])
        for side in axes.spines.values():
            side.set_visible(False)
        return drawn


def pictures(check, case, folder):
    made = [("figure.png", "Nominal stress over nominal strain: Figs. 4 and 6"),
            ("fields.png", "Fig. 5: equivalent plastic strain and equivalent Kirchhoff stress on the deformed bar"),
            ("difference.png", "Figs. 8 and 10: differences from the finite elements")]
    bar = Bar(check, case)
    draw_curves(check, case, folder / "figure.png")
    draw_fields(bar, best_names(check, case), folder / "fields.png")
    draw_differences(bar, best_names(check, case), folder / "difference.png")
    if case.full:
        draw_errors(check, case, folder / "errors.png")
        made.append(("errors.png", "Fig. 9: error (29) over r and psi, both readings of r"))
        for reading in ("literal", "cutoff"):
            draw_necks(bar, reading, folder / f"necks-{reading}.png")
            made.append((f"necks-{reading}.png", f"Fig. 7: plastic strain in the neck by TLSPH, r read as {reading}"))
    return made


def best_names(check, case):
    """TLSPH runs that stand for r = 2, 3, 4 l_c (as cut-off), each at the psi of its smallest error; label by run."""
    if not case.full:
        return {check.sph_name(1.5, 0.07): "TLSPH, cut-off 3 $l_c$", check.sph_name(3, 0.07): "TLSPH, cut-off 6 $l_c$"}
    found = {}
    for row, (times, radius) in zip(check.Errors(case).table("cutoff", "eps"), check.CUTOFF.items()):
        psi = check.PSI[int(row.argmin())]
        found[check.sph_name(radius, psi)] = f"TLSPH, cut-off {times} $l_c$, ψ = {psi:g}"
    return found


def draw_curves(check, case, out):
    figure, (left, right) = plt.subplots(1, 2, figsize=(11, 4.6), layout="constrained", sharey=True)
    known = lambda name: (check.curve(case.results[name])[0] * 100, check.curve(case.results[name])[1])  # noqa: E731
    for (count, _), colour in zip(check.SPACINGS.items(), SHADES):
        left.plot(*known(f"cbm-{count}"), color=colour, lw=1.6, label=f"CBM, {len(case.results[f'cbm-{count}'].exodus.points)} particles")
    left.plot(*known("fem-200dof"), "--", color="#888888", lw=1.4, label=f"FEM, {2 * len(case.results['fem-200dof'].exodus.points)} dof")
    left.plot(*known("fem"), ":", color=COLOURS["fem"], lw=1.8, label=f"FEM, {2 * len(case.results['fem'].exodus.points)} dof")
    for (radius, psi, *_), colour in zip(shown_settings(check, case), SHADES):
        right.plot(*known(check.sph_name(radius, psi)), color=colour, lw=1.4, label=f"r = {radius:g} $l_c$, ψ = {psi:g}")
    right.plot(*known("cbm-1800"), color="#1d2733", lw=1.2, label="CBM")
    left.set(xlabel="nominal strain (%)", ylabel="nominal stress (MPa)", title="Fig. 4: CBM and finite elements", ylim=(0, None))
    right.set(xlabel="nominal strain (%)", title="Fig. 6: TLSPH, about 1800 particles")
    for axes in (left, right):
        axes.legend(fontsize=8, loc="lower right")
        axes.grid(color="#e3e8ee")
    picture.save(figure, out, dpi=130)


def shown_settings(check, case):
    return [(2, 0.01), (2, 1), (4, 0.01), (4, 0.1), (4, 1)] if case.full else check.sph_settings("quick")


def draw_fields(bar, best, out):
    check = bar.check
    sph = check.sph_name(1.5, 0.07)
    names = {"fem": "FEM", "cbm-1800": "CBM", sph: "TLSPH"}
    figure, axes = plt.subplots(1, 6, figsize=(12.5, 6.4), layout="constrained")
    for first, field, label in ((0, check.STRAIN, "equivalent plastic strain"), (3, check.STRESS, "equivalent Kirchhoff stress (MPa)")):
        norm = Normalize(0, bar.field("fem", field).max())
        for axis, (name, title) in zip(axes[first:], names.items()):
            drawn = bar.draw(axis, name, bar.field(name, field), norm, "turbo")
            axis.set_title(title, fontsize=11)
        figure.colorbar(drawn, ax=list(axes[first:first + 3]), orientation="horizontal", shrink=0.7, aspect=30, label=label)
    picture.save(figure, out, dpi=130)


def draw_differences(bar, best, out):
    check = bar.check
    names = {"cbm-1800": "CBM"} | best
    figure, axes = plt.subplots(2, len(names), figsize=(3.1 * len(names), 8.2), layout="constrained")
    for row, field, label, limit, window, half in (
            (0, check.STRAIN, "|difference of plastic strain|", 0.02, (9.0, 33.0), 5.6),
            (1, check.STRESS, "|difference of equivalent stress| (MPa)", 60.0, (-0.5, 21.0), 7.2)):
        for axis, (name, title) in zip(axes[row], names.items()):
            difference = abs(bar.field(name, field) - bar.field("fem", field))
            drawn = bar.draw(axis, name, difference, Normalize(0, limit), "magma", window, half)
            axis.set_title(title, fontsize=9)
        figure.colorbar(drawn, ax=list(axes[row]), shrink=0.8, label=label, extend="max")
    picture.save(figure, out, dpi=130)


def draw_errors(check, case, out):
    figure, axes = plt.subplots(2, 3, figsize=(13, 7.6), layout="constrained", sharex=True, sharey="row")
    paper = {"eps": (0.07, 3.3), "tau": (0.2, 2.7)}
    meanings = {"literal": "default bar, neighbours within 2 r", "cutoff": "default bar, neighbours within r",
                "round": "bar 18 mm with r = 6 mm fillet, within r"}
    for column, (reading, (bar, radii)) in enumerate(check.READINGS.items()):
        errors = check.Errors(case, bar)
        for row, (field, title) in enumerate((("eps", "plastic strain"), ("tau", "equivalent stress"))):
            axis = axes[row, column]
            for line, times, colour in zip(errors.table(reading, field), radii, ("#f7c548", "#c4173a", "#1f6f8b")):
                axis.semilogx(check.PSI, line, "o-", color=colour, lw=1.5, ms=5, label=f"TLSPH, r = {times} $l_c$")
            axis.axhline(errors.cbm(field), color="#1d2733", lw=1.5, label="CBM")
            axis.plot(*paper[field], "*", ms=13, color="#3a7d44", label="paper, TLSPH optimum (r = 3 $l_c$)")
            if field == "eps":
                axis.axhline(1.5, color="#3a7d44", ls="--", lw=1.2, label="paper, CBM")
            axis.set(title=f"{title}: {meanings[reading]}", ylim=(0, 20))
            axis.title.set_fontsize(9)
            axis.grid(color="#e3e8ee")
    for row in axes:
        row[0].set_ylabel("error (29) [%]")
        row[-1].legend(fontsize=8, loc="upper right")
    for axis in axes[1]:
        axis.set_xlabel("ψ")
    picture.save(figure, out, dpi=120)


def draw_necks(bar, reading, out):
    check = bar.check
    radii, rows = check.READINGS[reading][1], (0.01, 0.1, 1)
    figure, axes = plt.subplots(3, 3, figsize=(7.2, 12), layout="constrained")
    centre = bar.field("fem", check.STRAIN)[abs(bar.particles.points[:, 1] - 20) < 1].mean()
    norm = Normalize(0.6 * centre, 1.15 * centre)
    for row, psi in enumerate(rows):
        for axis, (times, radius) in zip(axes[row], radii.items()):
            name = check.sph_name(radius, psi)
            drawn = bar.draw(axis, name, bar.field(name, check.STRAIN), norm, "turbo", (10.5, 31.5), 4.2)
            axis.set_title(f"r = {times} $l_c$, ψ = {psi:g}", fontsize=10)
    figure.colorbar(drawn, ax=list(axes.ravel()), shrink=0.6, aspect=35, label="equivalent plastic strain", extend="both")
    picture.save(figure, out, dpi=110)
