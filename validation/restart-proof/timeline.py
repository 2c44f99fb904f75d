"""Draws what happened to the runs of check.py: every process as a bar over the steps that it did."""
import json

import matplotlib.pyplot as plt
from tools import picture

COLOURS = {"KILL": "#c4173a", "TERM": "#ee6c2b", "INT": "#e0a800", "done": "#1f6f8b", "failed": "black"}
REPEATED = "#c9d4da"


def pictures(case, folder):
    records = {name: json.loads((result.folder / "killed.json").read_text(encoding="utf-8"))
               for name, result in case.results.items()}
    count = max(sum(len(run["attempts"]) for run in first_runs(record)) for record in records.values())
    figure, columns = plt.subplots(1, len(records), figsize=(12, 1.6 + 0.13 * count))
    for axes, (name, record) in zip(columns, records.items()):
        draw(axes, name, record)
    handles = [plt.Line2D([], [], color=colour, lw=4, label=label) for colour, label in
               ((COLOURS["KILL"], "ended by SIGKILL"), (COLOURS["TERM"], "SIGTERM"), (COLOURS["INT"], "SIGINT"),
                (COLOURS["done"], "done"), (REPEATED, "done again later"))]
    handles.append(plt.Line2D([], [], color="black", marker="x", ls="", label="newest checkpoint damaged before"))
    figure.legend(handles=handles, loc="lower center", ncol=6, frameon=False, fontsize=9)
    figure.tight_layout(rect=(0, 0.06, 1, 1))
    picture.save(figure, folder / "figure.png", dpi=110)
    return [("figure.png", "Every process as a bar over the steps that it did; pale: steps lost with it and done again")]


def first_runs(record):
    """As many as can be drawn."""
    return record["runs"][:4]


def draw(axes, name, record):
    steps, row = record["steps"], 0
    for number, run in enumerate(first_runs(record), 1):
        attempts = run["attempts"]
        for attempt, after in zip(attempts, [*attempts[1:], None]):
            begin, colour = attempt["expected"], COLOURS[attempt["ended"]]
            end = max(begin, attempt["seen"])
            kept = end if after is None else min(end, max(after["expected"], begin))
            for left, right, shade in ((begin, kept, colour), (kept, end, REPEATED)):
                axes.plot([100 * left / steps, 100 * right / steps], [row, row], color=shade, lw=4, solid_capstyle="butt")
            axes.plot(100 * end / steps, row, "|", color=colour, ms=7, mew=1.5)
            if attempt["damaged"]:
                axes.plot(100 * begin / steps - 2, row, "kx", ms=5)
            row += 1
        axes.text(101, row - 1, f"run {number}", va="center", fontsize=8)
        axes.axhline(row - 0.5, color="0.85", lw=0.8)
    axes.set(title=f"{name}: {record['steps']} steps", xlabel="step, % of the run", xlim=(-4, 112), yticks=[])
    axes.invert_yaxis()
    axes.spines[["left", "top", "right"]].set_visible(False)
