"""The Debian packages, made and looked into, unpacked together and run: debian.py CPACK BUILD WORK VERSION ABI."""
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


def main(cpack, build, work, version, abi):
    if not shutil.which("dpkg-deb"):
        print("skipped: this is no Debian, dpkg-deb is missing")
        return
    shutil.rmtree(work, ignore_errors=True)
    said(cpack, "--config", f"{build}/CPackConfig.cmake", "-B", work)
    packages = {re.match(r"[^_]+", name).group(): f"{work}/{name}" for name in os.listdir(work) if name.endswith(".deb")}
    assert set(packages) == {f"libcleave{abi}", "libcleave-dev", "cleave"}, packages
    for name, path in packages.items():
        check_control(name, path, version, abi)
        check_contents(name, path, version, abi)
        said("dpkg", "-x", path, f"{work}/unpacked")
    run(f"{work}/unpacked/usr", version, abi)


def check_control(name, path, version, abi):
    field = dict(re.findall(r"(?m)^ (\S+): (.*)$", said("dpkg-deb", "-I", path)))
    assert field["Package"] == name and field["Version"] == version, field
    assert field["Section"] == {"cleave": "science", "libcleave-dev": "libdevel"}.get(name, "libs"), field
    if name != f"libcleave{abi}":
        assert f"libcleave{abi} (= {version})" in field["Depends"], field
    if name != "libcleave-dev" and shutil.which("dpkg-shlibdeps") and shutil.which("file"):
        assert "libstdc++6 (>= " in field["Depends"], field
        assert ("libnetcdf" in field["Depends"]) == (name == "cleave"), field


def check_contents(name, path, version, abi):
    lines = [line.split() for line in said("dpkg-deb", "-c", path).splitlines()]
    files = {words[5][1:]: words[0] for words in lines if not words[0].startswith("d")}
    assert all(words[1] == "root/root" for words in lines), lines
    assert files.pop(f"/usr/share/doc/{name}/copyright").startswith("-rw-r--r--")
    if name == "cleave":
        assert files == {"/usr/bin/cleave": "-rwxr-xr-x"}, files
    elif name == f"libcleave{abi}":
        wanted = {f"lib/libcleave.so.{abi}", f"lib/libcleave.so.{version}", "share/doc/cleave/LICENSE",
                  "share/doc/cleave/CHANGELOG.md"}
        assert set(files) == {f"/usr/{file}" for file in wanted}, files
        assert files[f"/usr/lib/libcleave.so.{version}"] == "-rw-r--r--", files
    else:
        wanted = ("include/cleave/cleave.h", "include/cleave/version.h", "include/cleave/tables/status.def",
                  "lib/libcleave.a", "lib/libcleave.so", "lib/pkgconfig/cleave.pc",
                  "lib/cmake/Cleave/CleaveConfig.cmake", "share/cleave/fortran/cleave.f90",
                  "share/cleave/fortran/cleave77.f90", "share/doc/cleave/examples/c/host.c")
        assert not {f"/usr/{file}" for file in wanted} - set(files), files


def run(usr, version, abi):
    """The program finds the library of the other package."""
    assert said(f"{usr}/bin/cleave", "--version") == f"cleave {version}\n"
    libraries = said("ldd", f"{usr}/bin/cleave")
    found = os.path.realpath(re.search(rf"libcleave\.so\.{abi} => (\S+)", libraries).group(1))
    assert found == os.path.realpath(f"{usr}/lib/libcleave.so.{abi}"), libraries
    assert "not found" not in libraries, libraries


main(*sys.argv[1:])
