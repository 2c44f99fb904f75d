"""Host codes of the validation cases: programs of their own that link the installed library.

    prefix = host_code.install(site)                       the package, installed beside the run
    program = host_code.build(prefix, site, "impact", FFLAGS="-O2 ...")   copies the case's sources, runs make
    listing = host_code.run(program, folder, deck, threads=2)

Used from the `work` of a simulation.Run; `site` is what that is given.  The case's Makefile gets CLEAVE_PREFIX.
"""
import os
import pathlib
import shutil
import subprocess

from .simulation import RunError

COMPILERS = ("gfortran", "flang-new", "ifx", "ifort")
SOURCES = ("*.f", "*.f90", "*.inc", "Makefile")


def _call(command, folder, log, environment=None, text=None, expected=0):
    """Output of a command, also kept in the file `log`; RunError if it ends otherwise than expected."""
    done = subprocess.run([str(word) for word in command], cwd=folder, env=os.environ | (environment or {}), input=text,
                          stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, check=False)
    pathlib.Path(log).write_text(done.stdout, encoding="utf-8")
    if done.returncode != expected:
        end = "\n".join(done.stdout.splitlines()[-12:])
        raise RunError(f"{pathlib.Path(command[0]).name} ended with {done.returncode}, not {expected}; the end of {log}:\n{end}")
    return done.stdout


def obstacle(cleave):
    """Why no host can be linked to the build of this executable, for skip(case); None if one can."""
    cache = pathlib.Path(cleave).resolve().parent.parent / "CMakeCache.txt"
    if cache.exists() and "CLEAVE_SANITIZE:BOOL=ON" in cache.read_text(encoding="utf-8"):
        return "a library built with sanitizers wants their run time in every host"
    if not (os.environ.get("FC") or any(map(shutil.which, COMPILERS))):
        return "there is no Fortran compiler to build the host with; install gfortran, or name one in the environment variable FC"
    return None


def install(site):
    """The prefix of the installation that the executable belongs to; one from a build tree is installed first."""
    above = pathlib.Path(site.cleave).resolve().parent.parent
    if not (above / "CMakeCache.txt").exists():
        return above
    prefix = site.folder / "prefix"
    _call(["cmake", "--install", above, "--prefix", prefix], site.folder, site.folder / "install.log")
    return prefix


def build(prefix, site, program, name="", **variables):
    """Path of the program, made in a folder of its own (`name`, else that of the program) from the case's sources."""
    folder = site.folder / ("build-" + (name or program))
    folder.mkdir()
    for pattern in SOURCES:
        for path in sorted(pathlib.Path(site.case_folder).glob(pattern)):
            shutil.copy(path, folder)
    given = [f"{key}={value}" for key, value in variables.items()]
    _call(["make", program, f"CLEAVE_PREFIX={prefix}", *given], folder, folder / "make.log")
    return folder / program


def build_with_cmake(prefix, site, name="build"):
    """Folder with the programs of the case's CMakeLists.txt, which finds the installed package."""
    folder = site.folder / name
    _call(["cmake", "-S", site.case_folder, "-B", folder, f"-DCMAKE_PREFIX_PATH={prefix}"], site.folder,
          site.folder / f"{name}-configure.log")
    _call(["cmake", "--build", folder], site.folder, site.folder / f"{name}.log")
    return folder


def run(program, folder, deck="", threads=1, expected=0, arguments=()):
    """Listing of a run in `folder`, made if it is not there; `deck` is its standard input.  RunError if the exit status
    is another than the expected one."""
    folder = pathlib.Path(folder)
    folder.mkdir(parents=True, exist_ok=True)
    environment = {"OMP_NUM_THREADS": str(threads), "OMP_WAIT_POLICY": "passive"}  # there may be fewer cores
    return _call([program, *arguments], folder, folder / "listing", environment, deck, expected)


def drive(site, folder, deck):
    """Runs `cleave DECK` in `folder`, with one thread."""
    return _call([site.cleave, deck, "--threads", "1"], folder, pathlib.Path(folder) / "cleave.log")
