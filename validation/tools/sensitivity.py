"""Runs variations of a case one by one and prints a row of a Markdown table for each.

A case that has a study offers study.py with RUNS (name -> simulation.Run), COLUMNS and row(result) -> texts.
"""
import argparse
import pathlib

from . import deck, simulation

ROOT = pathlib.Path(__file__).resolve().parents[2]


def main(folder, runs, columns, row):
    """The command line of a study.py."""
    parser = argparse.ArgumentParser(description="Runs variations of the case and prints a table.")
    parser.add_argument("name", nargs="*", help="one of: " + "; ".join(runs) + ". None: all")
    parser.add_argument("--cleave", metavar="PATH", help="the executable; else $CLEAVE, else build/release/bin/cleave")
    parser.add_argument("--work", metavar="DIR", default=str(ROOT / "build/validation/study"))
    parser.add_argument("--threads", type=int, default=1)
    given = parser.parse_args()
    unknown = set(given.name) - set(runs)
    if unknown:
        parser.error(f"no variation {', '.join(sorted(unknown))}; there are {', '.join(runs)}")
    try:
        cleave = simulation.find_cleave(given.cleave, ROOT)
        print("| variation | " + " | ".join(columns) + " |\n" + "|---" * (len(columns) + 1) + "|", flush=True)
        for name in given.name or runs:
            place = pathlib.Path(given.work) / pathlib.Path(folder).name / runs[name].name
            result = simulation.execute(runs[name], folder, place, cleave, given.threads, name)
            print(f"| {name} | " + " | ".join(row(result)) + " |", flush=True)
    except (simulation.RunError, deck.DeckError) as error:
        parser.exit(1, f"{error}\n")
