"""A deck of the manual runs: manual_deck.py CLEAVE DECK. Its mesh is made with gmsh if a .geo file lies
beside it; the run leaves results that are not empty, and `cleave check` accepts the deck before."""
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile


def run(command, folder):
    done = subprocess.run(command, cwd=folder, capture_output=True, text=True, check=False)
    if done.returncode != 0:
        sys.exit(f"{' '.join(map(str, command))} ended with {done.returncode}\n{done.stdout}{done.stderr}")
    return done.stdout


def make_mesh(deck, folder):
    """The mesh files the deck names, from geometry of the same name."""
    for name in re.findall(r"file\s*=\s*'([^']+)\.msh'", deck.read_text(encoding="utf-8")):
        run([shutil.which("gmsh") or "gmsh", "-v", "1", "-2", deck.parent / f"{name}.geo", "-o", f"{name}.msh"], folder)


def copy_points(deck, folder):
    for name in re.findall(r"file\s*=\s*'([^']+\.csv)'", deck.read_text(encoding="utf-8")):
        shutil.copy(deck.parent / name, folder)


def main(cleave, deck):
    with tempfile.TemporaryDirectory() as folder:
        make_mesh(deck, folder)
        copy_points(deck, folder)
        shutil.copy(deck, folder)
        said = run([cleave, "check", deck.name], folder)
        if not re.search(r"\d+ (particles|steps)", said):
            sys.exit(f"cleave check {deck.name} says nothing of particles or steps:\n{said}")
        if list(pathlib.Path(folder).rglob("*.exo")):
            sys.exit("cleave check has left result files")
        run([cleave, deck.name, "--quiet"], folder)
        results = list(pathlib.Path(folder).rglob("*.exo"))
        if len(results) != 1 or results[0].stat().st_size < 1000:
            sys.exit(f"{deck.name} has left no results: {sorted(pathlib.Path(folder).rglob('*'))}")


if __name__ == "__main__":
    main(pathlib.Path(sys.argv[1]).resolve(), pathlib.Path(sys.argv[2]).resolve())
