"""Builds and runs a host against the installed package: host.py WAY LANGUAGE KIND PREFIX WORK C=... CXX=... [-D...]

The environment is empty but for PATH, so that nothing but the package's own files leads to it. A host
prints nothing and returns 0 when its numbers are right."""
import glob
import os
import shutil
import subprocess
import sys

HOSTS = os.path.join(os.path.dirname(os.path.abspath(__file__)), "hosts")
COMPILER = {"c": "C", "cxx": "CXX", "f2003": "Fortran", "f77": "Fortran"}
PACKAGE = {"c": "cleave", "cxx": "cleave", "f2003": "cleave-fortran", "f77": "cleave-fortran"}
ENVIRONMENT = {"PATH": os.environ["PATH"]}


def said(*command, **more):
    done = subprocess.run(command, capture_output=True, text=True, env={**ENVIRONMENT, **more.pop("env", {})},
                          check=False, **more)
    if done.returncode:
        sys.exit(f"{' '.join(command)}\nreturned {done.returncode}\n{done.stdout}{done.stderr}")
    return done.stdout + done.stderr


def by_cmake(language, kind, prefix, work, compilers, more):
    cmake = shutil.which("cmake")
    options = [f"-DCMAKE_{name}_COMPILER={path}" for name, path in compilers.items()
               if name == COMPILER.get(language, name)]
    options += [f"-DCMAKE_PREFIX_PATH={prefix}",
                f"-DCleave_STATIC={'ON' if kind == 'static' else 'OFF'}", *more]
    said(cmake, "-G", "Ninja", "-S", os.path.join(HOSTS, language), "-B", work, *options)
    with open(os.path.join(work, "CMakeCache.txt"), encoding="utf-8") as cache:
        found = [line for line in cache if line.startswith("Cleave_DIR")]
    assert found == [f"Cleave_DIR:PATH={prefix}/lib/cmake/Cleave\n"], found
    said(cmake, "--build", work)
    run(os.path.join(work, "host"), kind)


def by_pkgconfig(language, kind, prefix, work, compilers, _):
    """Plain compiler lines. `static` is tried both ways: the archive beside shared system libraries, and
    everything static."""
    os.makedirs(work)
    package = PACKAGE[language]
    if kind == "shared":
        libraries = flags(prefix, "--libs", package)
        libraries.append("-Wl,-rpath," + " ".join(flags(prefix, "--variable=libdir", "cleave")))
        compile_and_run(language, kind, prefix, work, compilers, libraries)
    else:
        compile_and_run(language, kind, prefix, work, compilers, flags(prefix, "--libs", package + "-static"))
        everything = ["-static", *flags(prefix, "--static", "--libs", package)]
        compile_and_run(language, "everything", prefix, work, compilers, everything)


def flags(prefix, *arguments):
    return said("pkg-config", *arguments, env={"PKG_CONFIG_LIBDIR": f"{prefix}/lib/pkgconfig"}).split()


def compile_and_run(language, kind, prefix, work, compilers, libraries):
    sources = glob.glob(os.path.join(HOSTS, language, "host.*"))
    if language == "f77":
        sources.append(flags(prefix, "--variable=sources", "cleave-fortran")[0] + "/cleave77.f90")
    said(compilers[COMPILER[language]], *flags(prefix, "--cflags", PACKAGE[language]), *sources,
         "-o", f"{work}/{kind}", *libraries, cwd=work)
    run(f"{work}/{kind}", kind)


def run(host, kind):
    needed = said("readelf", "-d", host)
    assert ("libcleave" in needed) == (kind == "shared"), needed
    assert ("NEEDED" in needed) == (kind != "everything"), needed
    output = said(host)
    assert not output, output


def main(way, language, kind, prefix, work, *rest):
    shutil.rmtree(work, ignore_errors=True)
    build = by_cmake if way == "cmake" else by_pkgconfig
    build(language, kind, prefix, work, dict(word.split("=", 1) for word in rest if not word.startswith("-D")),
          [word for word in rest if word.startswith("-D")])


main(*sys.argv[1:])
