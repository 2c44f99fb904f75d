"""The two Fortran files as hosts compile them.

    sources.py warnings COMPILER FILE...     no warning of gfortran, with the kinds and habits of legacy hosts
    sources.py static COMPILER FILE...       no static variables even with -fno-automatic, but those named here
    sources.py syntax COMPILER FILE...       another compiler reads them; 77 if it is not there
"""
import pathlib
import subprocess
import sys
import tempfile

STRICT = "-std=f2003 -Wall -Wextra -Wimplicit-interface -pedantic -Werror".split()
HOSTS = ["-fsyntax-only", "-fsyntax-only -fdefault-integer-8", "-fsyntax-only -fdefault-integer-8 -fdefault-real-8",
         "-fsyntax-only -fno-automatic", "-O2 -fopenmp"]
# The list of models, and what stands for the address of an array without entries.
STATIC = {"cleave77_support_MOD_models", "cleave77_support_MOD_taken", "cleave77_support_MOD_uses",
          "cleave_networks_MOD_nothing"}


def run(command, folder):
    done = subprocess.run(command, cwd=folder, capture_output=True, text=True, check=False)
    if done.returncode != 0:
        sys.exit(" ".join(map(str, command)) + "\n" + done.stdout + done.stderr)
    return done.stdout


def warnings(compiler, files, folder):
    for host in HOSTS:
        for file in files:
            run([compiler, *STRICT, *host.split(), "-c", file], folder)


def static(compiler, files, folder):
    found = set()
    for file in files:
        run([compiler, "-fno-automatic", "-c", file], folder)
        symbols = run(["nm", pathlib.Path(file).with_suffix(".o").name], folder)
        found |= {line.split()[-1].lstrip("_") for line in symbols.splitlines()
                  if line.split()[-2] in "bBdD" and "vtab" not in line}
    if found != STATIC:
        sys.exit(f"static variables {sorted(found)}; expected {sorted(STATIC)}")


def syntax(compiler, files, folder):
    if compiler.endswith("NOTFOUND"):
        print("skipped: no second Fortran compiler (Debian: flang-16)")
        sys.exit(77)
    both = pathlib.Path(folder, "both.f90")
    both.write_text("".join(pathlib.Path(file).read_text() for file in files))
    said = run([compiler, "-fsyntax-only", both], folder)
    if said.strip():
        sys.exit(said)


what, program, *sources = sys.argv[1:]
with tempfile.TemporaryDirectory() as scratch:
    {"warnings": warnings, "static": static, "syntax": syntax}[what](program, sources, scratch)
