"""Compares cleave's namelist reader with the Fortran compiler's own namelist READ.

Two sources of files: the hand-written ones in cases/, which Fortran must accept, and random ones, seeded,
of which Fortran may refuse a few. Whatever Fortran accepts must give the same values here, bit for
bit. Not a test of messages: what is refused, and how, is tested in test_errors.cpp.
"""
import argparse
import pathlib
import subprocess
import sys

from random_namelist import random_file

RANDOM_FILES = 800
# Measured: Fortran accepts 91 % of the random files; fewer would mean that the generator is broken.
ACCEPTED_FRACTION = 0.85


def run(program, files):
    """The lines that `program` prints for each file."""
    names = "".join(f"{f}\n" for f in files).encode()
    output = subprocess.run([program], input=names, stdout=subprocess.PIPE, check=True).stdout
    result = {}
    for line in output.split(b"\n"):
        if line.startswith(b"file "):
            lines = result[line[5:].decode()] = []
        elif line:
            lines.append(line)
    return result


def accepts(lines, groups):
    """Whether a program read all groups; at its end of file Fortran stops without a word."""
    return lines.count(b"group g") + lines.count(b"group h") == groups and b"refused" not in b" ".join(lines)


def first_difference(fortran, cleave):
    for a, b in zip(fortran, cleave):
        if a != b:
            return f"Fortran {a.decode('latin1')}\n   cleave  {b.decode('latin1')}"
    return f"Fortran reads {len(fortran)} lines, cleave {len(cleave)}"


def compare(files, oracle, reader, must_accept):
    """Number of files that Fortran accepts, and the complaints. files: {path: number of groups}"""
    fortran = run(oracle, files)
    cleave = run(reader, files)
    accepted, complaints = 0, []
    for f, groups in files.items():
        if not accepts(fortran[f], groups):
            if must_accept:
                last = fortran[f][-1].decode("latin1") if fortran[f] else ""
                complaints.append(f"{f}: Fortran does not read {groups} groups: {last}")
            continue
        accepted += 1
        if fortran[f] != cleave[f]:
            complaints.append(f"{f}: {first_difference(fortran[f], cleave[f])}")
    return accepted, complaints


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--oracle", required=True)
    parser.add_argument("--reader", required=True)
    parser.add_argument("--cases", type=pathlib.Path, required=True)
    parser.add_argument("--work", type=pathlib.Path, required=True)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--count", type=int, default=RANDOM_FILES)
    args = parser.parse_args()

    # The first line of a case says how many groups it has.
    cases = {str(p): int(p.read_bytes().split()[1]) for p in sorted(args.cases.glob("*.nml"))}
    if not cases:
        sys.exit(f"no cases in {args.cases}")
    _, complaints = compare(cases, args.oracle, args.reader, must_accept=True)

    args.work.mkdir(parents=True, exist_ok=True)
    randoms = {}
    for n in range(args.count):
        path = args.work / f"{n}.nml"
        text, randoms[str(path)] = random_file(f"{args.seed}/{n}")
        path.write_bytes(text)
    accepted, more = compare(randoms, args.oracle, args.reader, must_accept=False)
    complaints += more
    if accepted < ACCEPTED_FRACTION * len(randoms):
        complaints.append(f"Fortran accepts only {accepted} of {len(randoms)} random files")

    for complaint in complaints[:20]:
        print(complaint, file=sys.stderr)
    sys.exit(1 if complaints else 0)


if __name__ == "__main__":
    main()
