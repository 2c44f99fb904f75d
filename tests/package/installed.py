"""What is installed, looked at from outside: installed.py CHECK PREFIX VERSION ABI."""
import glob
import os
import re
import shutil
import subprocess
import sys


def said(*command):
    done = subprocess.run(command, capture_output=True, text=True, env={"PATH": os.environ["PATH"]}, check=False)
    if done.returncode:
        sys.exit(f"{' '.join(command)}\nreturned {done.returncode}\n{done.stdout}{done.stderr}")
    return done.stdout


def exports(prefix, version, abi):
    """The shared library shows the functions of the installed header and nothing else."""
    lines = said("nm", "-D", "--defined-only", f"{prefix}/lib/libcleave.so").splitlines()
    shown = {line.split()[-1] for line in lines}
    with open(f"{prefix}/include/cleave/cleave.h", encoding="utf-8") as header:
        declared = set(re.findall(r"(?m)^CLEAVE_API\b[^;]*?\b(cleave_\w+)\(", header.read()))
    assert len(declared) > 50, declared
    assert shown == declared, f"differ: {sorted(shown ^ declared)}"


def names(prefix, version, abi):
    """The number of the interface names the library; run paths are relative to the file."""
    dynamic = said("readelf", "-d", f"{prefix}/lib/libcleave.so")
    assert f"soname: [libcleave.so.{abi}]" in dynamic, dynamic
    assert os.path.realpath(f"{prefix}/lib/libcleave.so.{abi}").endswith(f"libcleave.so.{version}")
    assert "runpath: [$ORIGIN]" in dynamic, dynamic
    dynamic = said("readelf", "-d", f"{prefix}/bin/cleave")
    assert f"Shared library: [libcleave.so.{abi}]" in dynamic, dynamic
    assert "runpath: [$ORIGIN/../lib]" in dynamic, dynamic
    needed = re.findall(r"Shared library: \[(\w+)", said("readelf", "-d", f"{prefix}/lib/libcleave.so"))
    assert not set(needed) - {"libstdc", "libm", "libgcc_s", "libc", "ld", "libpthread"}, needed


def program(prefix, version, abi):
    """The program runs where it was moved to, also when it is called through a link from elsewhere."""
    assert said(f"{prefix}/bin/cleave", "--version") == f"cleave {version}\n"
    link = f"{prefix}/../link-to-cleave"
    if os.path.lexists(link):
        os.remove(link)
    os.symlink(f"{prefix}/bin/cleave", link)
    assert said(link, "--version") == f"cleave {version}\n"


def archive(prefix, version, abi):
    """Objects that nobody names are not linked, so none may register itself at the start of a program;
    and every function of the interface is there."""
    symbols = said("nm", f"{prefix}/lib/libcleave.a")
    starters = re.findall(r"\b_GLOBAL__sub_I_\w+", symbols)
    assert not starters, starters
    assert ".init_array" not in said("readelf", "-SW", f"{prefix}/lib/libcleave.a")
    assert len(set(re.findall(r"(?m) T (cleave_\w+)$", symbols))) > 50


def adapters(prefix, version, abi):
    """The installed adapters that need no file of a host's compile from the installed sources."""
    folder, scratch = f"{prefix}/share/cleave/adapters", f"{prefix}/../adapters"
    os.makedirs(scratch, exist_ok=True)
    said("cc", "-shared", "-fPIC", "-Wl,-z,defs", f"-I{prefix}/include", *sorted(glob.glob(f"{folder}/calculix/*.c")),
         f"-L{prefix}/lib", "-lcleave", "-lm", "-o", f"{scratch}/libCLEAVE.so")
    shown = said("nm", "-D", "--defined-only", f"{scratch}/libCLEAVE.so")
    wanted = re.findall(r" T (\w+)", said("nm", "-D", "--defined-only", f"{prefix}/lib/cleave/calculix/libCLEAVE.so"))
    assert len(wanted) > 5 and set(wanted) <= set(re.findall(r" T (\w+)", shown)), (wanted, shown)
    modules = glob.glob(f"{prefix}/include/cleave/gfortran-*")
    for source in glob.glob(f"{folder}/common/*.f90") if modules else ():
        said("gfortran", "-c", f"-I{modules[0]}", f"-J{scratch}", source, "-o", f"{scratch}/common.o")


def version(prefix, version, abi):
    """find_package takes this version and older patches of it, no other minor version."""
    major, minor, patch = map(int, version.split("."))
    for wanted, expected in ((version, True), (f"{major}.{minor}", True),
                             (f"{major}.{minor}.{patch + 1}", False), (f"{major}.{minor + 1}", False),
                             (f"{major}.{minor - 1}", False), (f"{major + 1}.{minor}", False)):
        assert _accepted(prefix, wanted) == expected, f"version {wanted} is {'' if not expected else 'not '}accepted"


def _accepted(prefix, wanted):
    files = f"{prefix}/lib/cmake/Cleave/CleaveConfigVersion.cmake"
    major, minor, *patch = wanted.split(".")
    defines = {"PACKAGE_FIND_NAME": "Cleave", "PACKAGE_FIND_VERSION": wanted, "PACKAGE_FIND_VERSION_MAJOR": major,
               "PACKAGE_FIND_VERSION_MINOR": minor, "PACKAGE_FIND_VERSION_PATCH": patch[0] if patch else "0",
               "PACKAGE_FIND_VERSION_COUNT": str(len(wanted.split("."))), "CMAKE_SIZEOF_VOID_P": "8"}
    script = f"{prefix}/../version-{wanted}.cmake"
    with open(script, "w", encoding="utf-8") as file:
        file.writelines(f'set({name} "{value}")\n' for name, value in defines.items())
        file.write(f'include("{files}")\nmessage(STATUS "${{PACKAGE_VERSION_COMPATIBLE}}")\n')
    return "TRUE" in said(shutil.which("cmake"), "-P", script)


globals()[sys.argv[1]](*sys.argv[2:])
