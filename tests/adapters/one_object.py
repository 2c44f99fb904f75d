"""The object file of the Abaqus page: adapter, Fortran module and library put into one by `ld -r` make a plug-in that
lacks nothing but what the host and the C++ run time bring, and keep the library's symbols to themselves.

one_object.py COMPILER FOLDER ADAPTER.a MODULE.a LIBRARY.a"""
import os
import subprocess
import sys

HOST = "".join(f"void {name}_(void) {{}}\n" for name in ("xplb_abqerr", "xplb_exit", "stdb_abqerr", "xit"))


def run(*command):
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    if done.returncode != 0:
        sys.exit(f"{' '.join(command)}\n{done.stdout}{done.stderr}")
    return done.stdout


def main(compiler, folder, adapter, module, library):
    os.makedirs(folder, exist_ok=True)
    one, host, plugin = (os.path.join(folder, name) for name in ("one.o", "host.c", "plugin.so"))
    with open(host, "w", encoding="ascii") as file:
        file.write(HOST)
    run("ld", "-r", "-o", one, "--whole-archive", adapter, "--no-whole-archive", module, library)
    run(compiler, "-shared", "-fPIC", "-Wl,-z,defs", "-o", plugin, one, host, "-lstdc++", "-lm")
    shown = {line.split()[-1] for line in run("nm", "-D", "--defined-only", plugin).splitlines()}
    missing = {"vumat_", "umat_"} - shown
    if missing:
        sys.exit(f"{plugin} does not show {sorted(missing)}")
    if "cleave_material_update" not in shown:
        sys.exit(f"{plugin} lacks the library")
    strangers = [name for name in shown if "Eigen" in name or name.startswith("_ZN6cleave")]
    if strangers:
        sys.exit(f"{plugin} shows {strangers[:3]} of the library's inside")


if __name__ == "__main__":
    main(*sys.argv[1:])
