#!/usr/bin/env python3
"""Draws a two-dimensional result: the deformed plate, coloured by a nodal field, with its cracks open.

    validation/tools/picture.py RESULT.exo --out X.png [--field damage] [--step last] [--deform 10]

Live simplices are drawn, deleted ones are left out, so cracks show the background.  Damage is
drawn with a scale of its own; any other nodal field uses a sequential or, if it changes sign, a diverging one.
"""
import argparse
import pathlib
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1]))
from tools import python  # noqa: E402

if __name__ == "__main__":
    python.ensure(__file__)
import matplotlib  # noqa: E402

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402
import numpy  # noqa: E402
from matplotlib.colors import LinearSegmentedColormap, Normalize  # noqa: E402
from matplotlib.ticker import MaxNLocator, MultipleLocator  # noqa: E402
from PIL import Image  # noqa: E402
from tools import results  # noqa: E402

# Sound material pale on a dark ground, torn material glowing: the crack must be seen at thumbnail size.
DAMAGE = LinearSegmentedColormap.from_list("damage", ["#dce6ee", "#f7c548", "#ee6c2b", "#c4173a", "#7a0f3c"])
INK, GROUND = "#1d2733", "#141b26"


def frame_number(text, count):
    """Index of a frame from `last`, `first` or a number (negative: from the end)."""
    if text in ("last", "first"):
        return count - 1 if text == "last" else 0
    number = int(text)
    if not -count <= number < count:
        raise SystemExit(f"picture.py: there are {count} frames, 0 to {count - 1}; frame {number} is not among them")
    return number % count


def magnification(points, displacement, wanted):
    """The factor on displacements; 'auto' opens the largest one to 4 % of the plate."""
    if wanted != "auto":
        return float(wanted)
    largest = numpy.abs(displacement).max()
    if largest == 0:
        return 1.0
    factor = 0.04 * numpy.ptp(points, axis=0).max() / largest
    steps = numpy.array([1, 2, 5]) * 10.0 ** numpy.floor(numpy.log10(factor))
    return max(1.0, float(steps[steps <= factor].max()))


def colours(field, values):
    """Colour map and range of a field."""
    if field == "damage":
        return DAMAGE, Normalize(0, 1)
    low, high = numpy.percentile(values, [0.5, 99.5])
    if low < 0 < high:
        return plt.get_cmap("RdBu_r"), Normalize(-max(-low, high), max(-low, high))
    return plt.get_cmap("viridis"), Normalize(low, high if high > low else low + 1)


def length_unit(size):
    """A unit in which the plate measures a handy number: factor and name (SI results)."""
    return next(((1 / scale, name) for scale, name in ((1, "m"), (1e-3, "mm"), (1e-6, "um")) if size >= scale), (1, ""))


def draw_plate(axes, result, step, field, deform, edge=0.12):
    """The plate in the axes; returns the drawn collection and the magnification.

    `edge` is the width of the triangles' own-coloured edges: thin ones let the mesh shine through, wide ones hide it.
    """
    points, displacement = result.points[:, :2], result.displacement(step)[:, :2]
    factor = magnification(points, displacement, deform)
    scale, unit = length_unit(numpy.ptp(points, axis=0).max())
    values = result.nodal(field, step)
    cmap, norm = colours(field, values)
    shown = scale * (points + factor * displacement)
    live = result.simplices[result.alive(step)]
    drawn = axes.tripcolor(shown[:, 0], shown[:, 1], live, facecolors=values[live].mean(axis=1), cmap=cmap, norm=norm,
                           edgecolors="face", linewidth=edge)
    axes.set_aspect("equal")
    axes.set_facecolor(GROUND)
    # a fragment that flies off does not shrink the plate
    low, high = numpy.quantile(shown[numpy.unique(live)], [0.001, 0.999], axis=0)
    margin = 0.02 * (high - low).max()
    axes.set_xlim(low[0] - margin, high[0] + margin)
    axes.set_ylim(low[1] - margin, high[1] + margin)
    ticks = MaxNLocator(7, steps=[1, 2, 5, 10]).tick_values(0, (high - low).max())
    axes.xaxis.set_major_locator(MultipleLocator(ticks[1] - ticks[0]))
    axes.yaxis.set_major_locator(MultipleLocator(ticks[1] - ticks[0]))
    axes.set_xlabel(f"x ({unit})" if unit else "x")
    axes.set_ylabel(f"y ({unit})" if unit else "y")
    return drawn, factor


def time_text(time):
    """Seconds with a fitting prefix."""
    for scale, name in ((1, "s"), (1e-3, "ms"), (1e-6, "µs")):
        if abs(time) >= scale:
            return f"{time / scale:.4g} {name}"
    return f"{time:.4g} s"


def style(axes):
    for side in ("top", "right", "left", "bottom"):
        axes.spines[side].set_visible(False)
    axes.tick_params(colors=INK, length=3, labelsize=9)
    axes.xaxis.label.set_color(INK)
    axes.yaxis.label.set_color(INK)


def save(figure, out, dpi):
    """Writes and closes a figure; a PNG is reduced to 256 colours, a quarter of its size."""
    figure.savefig(out, dpi=dpi, bbox_inches="tight", pad_inches=0.12)
    plt.close(figure)
    if str(out).lower().endswith(".png"):
        with Image.open(out) as image:
            small = image.convert("RGB").quantize(256, Image.Quantize.FASTOCTREE, dither=Image.Dither.NONE)
        small.save(out, optimize=True)


def picture(path, out, field="damage", step="last", deform="auto", title=""):
    """Writes one picture of a result file."""
    result = results.Exodus(path)
    if not result.is_plane:
        raise SystemExit("picture.py draws two-dimensional results; open this one in ParaView")
    number = frame_number(str(step), len(result.times))
    extent = numpy.ptp(result.points[:, :2], axis=0)
    width = 10.0
    size = (width, width * extent[1] / extent[0] * 0.86 + 0.9)
    figure, axes = plt.subplots(figsize=size, facecolor="white", layout="constrained")
    drawn, factor = draw_plate(axes, result, number, field, deform)
    style(axes)
    bar = figure.colorbar(drawn, ax=axes, shrink=0.85, aspect=32, pad=0.015)
    bar.set_label(field.replace("_", " "), color=INK)
    bar.outline.set_visible(False)
    words = [title or field.replace("_", " "), f"t = {time_text(result.times[number])}"]
    if factor != 1:
        words.append(f"displacements × {factor:g}")
    axes.set_title("   ".join(words), color=INK, fontsize=12, loc="left")
    save(figure, out, dpi=160)


def main():
    parser = argparse.ArgumentParser(description="Draws a two-dimensional Exodus result of cleave.")
    parser.add_argument("result", help="RESULT.exo")
    parser.add_argument("--out", required=True, help="PNG (or any format of matplotlib) to write")
    parser.add_argument("--field", default="damage", help="nodal field (default damage)")
    parser.add_argument("--step", default="last", help="frame: last, first or a number")
    parser.add_argument("--deform", default="auto", help="factor on displacements (default: a round one that shows them)")
    parser.add_argument("--title", default="", help="first words of the title")
    given = parser.parse_args()
    try:
        picture(given.result, given.out, given.field, given.step, given.deform, given.title)
    except (OSError, KeyError) as error:
        sys.exit(f"picture.py: {error.args[0] if isinstance(error, KeyError) else error}")


if __name__ == "__main__":
    main()
