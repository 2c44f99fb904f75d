"""Runs the programs that measure and collects what they print, as a list of records; table.py makes the text of them."""
import argparse
import datetime
import json
import os
import pathlib
import platform
import subprocess
import sys
import tempfile
import time

import lammps
import table

ROOT = pathlib.Path(__file__).resolve().parents[2]
PAGE = ROOT / "manuals" / "reference" / "performance.md"
PARTS = ("machine", "step", "irregular", "mapping", "lammps")

SVK = ["svk", "svk+fracture", "svk+search", "svk+search+viscosity", "svk+breaking"]
J2 = ["j2", "j2+search", "j2+plastic", "j2+plastic+search", "j2+plastic+search+viscosity", "j2_table+plastic"]
FEW = ["svk", "svk+fracture", "svk+breaking", "svk+search+viscosity", "j2+plastic+search"]

# particles; turns of every case and thread count; least seconds of a turn; triad [MiB]; edges of LAMMPS blocks, their steps
MODES = {
    "quick": {"sizes": [10_000], "rounds": 2, "seconds": 0.02, "triad": 48, "mapping": 0.01, "blocks": [(12, 3)], "gmsh": None},
    "normal": {"sizes": [100_000, 1_000_000], "rounds": 5, "seconds": 0.3, "triad": 512, "mapping": 0.1, "blocks": [(60, 5)], "gmsh": None},
    "full": {"sizes": [100_000, 1_000_000, 4_000_000], "rounds": 7, "seconds": 0.5, "triad": 768, "mapping": 0.3,
             "blocks": [(60, 10), (100, 4)], "gmsh": 100_000},
}
SHARE_OF_MEMORY = 0.6
BYTES_AT_FIRST = 2500  # of a particle while a model is made, until it has been measured


class Bench:
    def __init__(self, given):
        self.given = given
        self.mode = MODES[given.mode]
        self.records = []
        self.begun = time.monotonic()
        self.peak_bytes = BYTES_AT_FIRST

    def say(self, text):
        print(f"[{time.monotonic() - self.begun:6.0f} s] {text}", file=sys.stderr, flush=True)

    def program(self, name):
        path = self.given.bin / name
        if not path.is_file():
            sys.exit(f"no program at {path}; build the target {name}, or say with --bin where it is")
        return str(path)

    def call(self, command, **marks):
        """Records of a program that prints lines of JSON, with the marks added."""
        done = subprocess.run(command, capture_output=True, text=True, check=False)
        if done.returncode != 0:
            sys.exit(f"{' '.join(command)}\nended with status {done.returncode}: {done.stderr.strip()}")
        found = [{**json.loads(line), **marks} for line in done.stdout.splitlines() if line.startswith("{")]
        self.records += found
        return found

    def machine(self):
        self.say("machine: triad and multiply-adds")
        self.call([self.program("machine_speed"), str(self.mode["triad"]), "0.1" if self.given.mode != "quick" else "0.01",
                   str(self.mode["rounds"]), *map(str, self.given.threads)], part="machine")

    def step_speed(self, cases, body, rounds, **marks):
        command = [self.program("step_speed"), "--json", "--rounds", str(rounds), "--seconds", str(self.mode["seconds"]),
                   "--triad", str(self.mode["triad"]), "--threads", ",".join(map(str, self.given.threads)), *body]
        for case in cases:
            command += ["--case", case]
        found = self.call(command, **marks)
        self.peak_bytes = max((r["peak"] / r["particles"] for r in found if r["kind"] == "model"), default=self.peak_bytes)

    def step(self):
        """Cases of one size take turns, as many at a time as the memory holds."""
        for dimension in self.given.dimensions:
            for particles in self.given.particles or self.mode["sizes"]:
                for group in self.groups(particles):
                    self.say(f"step: {dimension}D, {particles} particles: {', '.join(group)}")
                    self.step_speed(group, ["--dimension", str(dimension), "--particles", str(particles)], self.mode["rounds"],
                                    part="step", dimension=dimension, wanted=particles)

    def groups(self, particles):
        cases = self.given.case or (FEW if self.given.mode == "quick" else SVK + J2)
        fit = max(1, int(SHARE_OF_MEMORY * available_memory() / (self.peak_bytes * particles)))
        many = -(-len(cases) // fit)
        size = -(-len(cases) // many)
        return [cases[k:k + size] for k in range(0, len(cases), size)]

    def irregular(self):
        """The lattice, the same numbered at random, and a Delaunay mesh of gmsh as it numbers it, in turns."""
        particles = self.mode["gmsh"] or self.mode["sizes"][0]
        cases = ["svk+search", "j2+plastic+search"][:1 if self.given.mode == "quick" else 2]
        size = ["--dimension", "3", "--particles", str(particles)]
        with tempfile.TemporaryDirectory() as folder:
            bodies = {"lattice": size, "lattice, numbered at random": [*size, "--shuffle"]}
            if self.mode["gmsh"]:
                self.say(f"irregular: gmsh makes about {particles} points")
                made = delaunay(folder, particles)
                if made:
                    bodies["Delaunay (gmsh)"] = ["--mesh", made]
            rounds = 1 if self.given.mode == "quick" else 3
            for round_ in range(rounds):
                for name, body in bodies.items():
                    self.say(f"irregular: {name}, turn {round_ + 1} of {rounds}")
                    self.step_speed(cases, body, 1 if self.given.mode == "quick" else 2, part="irregular", mesh=name)

    def mapping(self):
        self.say("mapping: J2 return mapping beside textbook versions")
        program = self.given.bin / "bench_return_mapping"
        if not program.is_file():
            self.say("mapping: bench_return_mapping was not built (Google Benchmark); left out")
            return
        done = subprocess.run([str(program), "--benchmark_format=json", f"--benchmark_repetitions={self.mode['rounds']}",
                               f"--benchmark_min_time={self.mode['mapping'] / self.mode['rounds']}",
                               "--benchmark_enable_random_interleaving=true"], capture_output=True, text=True, check=True)
        for line in json.loads(done.stdout)["benchmarks"]:
            if line.get("run_type") == "iteration":
                self.records.append({"part": "mapping", "kind": "mapping", "name": line["run_name"], "seconds": line["per_point"]})

    def lammps(self):
        if lammps.program() is None:
            self.say("lammps: no lmp on the path; left out")
            return
        ranks = [n for n in self.given.threads if n == 1 or lammps.ranks_possible()]
        for edge, steps in self.mode["blocks"]:
            rounds = 1 if self.given.mode == "quick" else 3
            for round_ in range(rounds):
                self.say(f"lammps: {edge}^3 particles, turn {round_ + 1} of {rounds}")
                self.step_speed(["svk+fracture", "svk+search"], ["--dimension", "3", "--particles", str(edge**3)], 1,
                                part="lammps", edge=edge)
                for style in lammps.COEFFICIENTS:
                    for n in ranks:
                        try:
                            self.records.append({**lammps.run(style, edge, steps, n), "part": "lammps", "edge": edge})
                        except RuntimeError as error:
                            self.say(f"lammps: peri/{style} on {n} left out: {error}")

    def all(self):
        self.records.append(host(self.given.mode))
        for part in self.given.only or PARTS:
            getattr(self, part)()
        self.records.append({"part": "host", "kind": "end", "seconds": time.monotonic() - self.begun, "load": os.getloadavg()[0]})
        return self.records


def host(mode):
    name = platform.processor() or platform.machine()
    cpuinfo = pathlib.Path("/proc/cpuinfo")
    if cpuinfo.exists():
        lines = [line.split(":", 1)[1].strip() for line in cpuinfo.read_text().splitlines() if line.startswith("model name")]
        name = lines[0] if lines else name
    return {"part": "host", "kind": "host", "mode": mode, "cpu": name, "cores": len(os.sched_getaffinity(0)),
            "system": f"{platform.system()} {platform.release()}", "load": os.getloadavg()[0],
            "date": datetime.datetime.now(datetime.timezone.utc).strftime("%Y-%m-%d")}


def available_memory():
    for line in pathlib.Path("/proc/meminfo").read_text().splitlines():
        if line.startswith("MemAvailable"):
            return 1024 * int(line.split()[1])
    return 8 * 2**30


def delaunay(folder, particles):
    """A cube of about so many points, meshed by gmsh; None without gmsh. An irregular mesh has about 0.83 points in the cube of
    the edge length that is asked for."""
    edge = (0.83 / particles) ** (1 / 3)
    geometry, mesh = pathlib.Path(folder, "cube.geo"), pathlib.Path(folder, "cube.msh")
    geometry.write_text(f'SetFactory("OpenCASCADE");\nBox(1) = {{0, 0, 0, 1, 1, 1}};\nMesh.MeshSizeMin = {edge:.6g};\n'
                        f"Mesh.MeshSizeMax = {edge:.6g};\nMesh.Algorithm3D = 1;\n", encoding="utf-8")
    try:
        subprocess.run(["gmsh", "-3", "-format", "msh41", "-bin", "-o", str(mesh), str(geometry)], check=True, capture_output=True)
    except (OSError, subprocess.CalledProcessError):
        return None
    return str(mesh)


def arguments(words):
    parser = argparse.ArgumentParser(prog="tests/perf/run", description="Measures the speed of Cleave on this machine and prints one table.")
    mode = parser.add_mutually_exclusive_group()
    mode.add_argument("--quick", dest="mode", action="store_const", const="quick", help="a minute: small sizes, shows that everything runs")
    mode.add_argument("--full", dest="mode", action="store_const", const="full", help="all sizes, a Delaunay mesh, LAMMPS at two sizes: half an hour")
    parser.add_argument("--only", nargs="+", choices=PARTS, metavar="PART", help=f"some of the parts: {', '.join(PARTS)}")
    parser.add_argument("--case", nargs="+", help="cases of the step instead of all, as step_speed names them")
    parser.add_argument("--particles", nargs="+", type=lambda text: int(float(text)), help="sizes of the step")
    parser.add_argument("--dimensions", nargs="+", type=int, choices=(2, 3), default=[3, 2])
    parser.add_argument("--threads", nargs="+", type=int, default=[1, 2], help="thread counts that are compared; at most the free cores")
    parser.add_argument("--bin", type=pathlib.Path, default=ROOT / "build" / "release" / "bin", help="folder of the programs")
    parser.add_argument("--samples", type=pathlib.Path, help="writes every measurement, one line of JSON each")
    parser.add_argument("--from", dest="source", type=pathlib.Path, help="measures nothing: the table of an earlier --samples file")
    parser.add_argument("--report", type=pathlib.Path, help="writes the table to a file, too")
    parser.add_argument("--manual", action="store_true", help=f"writes the table into {PAGE.relative_to(ROOT)}")
    parser.set_defaults(mode="normal")
    return parser.parse_args(words)


def measure(given):
    """All records; what has been measured is kept when it ends early."""
    bench = Bench(given)
    try:
        return bench.all()
    finally:
        if given.samples:
            given.samples.write_text("".join(json.dumps(r) + "\n" for r in bench.records), encoding="utf-8")


def main(words):
    given = arguments(words)
    if given.source:
        records = [json.loads(line) for line in given.source.read_text(encoding="utf-8").splitlines()]
    else:
        records = measure(given)
    text = table.text(records)
    print(text)
    if given.report:
        given.report.write_text(text + "\n", encoding="utf-8")
    if given.manual:
        page = PAGE.read_text(encoding="utf-8")
        PAGE.write_text(table.put_between_marks(page, text), encoding="utf-8")
    return 0
