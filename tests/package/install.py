"""Installs the build into a scratch prefix and moves it: what is found there from now on is found without
the prefix that it was installed to. No installed file may name a folder of the build machine."""
import os
import shutil
import subprocess
import sys


def main(cmake, build, source, scratch):
    first, moved = os.path.join(scratch, "first"), os.path.join(scratch, "moved")
    shutil.rmtree(scratch, ignore_errors=True)
    subprocess.run([cmake, "--install", build, "--prefix", first], check=True, stdout=subprocess.DEVNULL)
    os.rename(first, moved)
    os.mkdir(os.path.join(scratch, "merged"))  # as on systems where /lib is a link to /usr/lib
    os.symlink(os.path.join("..", "moved", "lib"), os.path.join(scratch, "merged", "lib"))
    for folder, _, names in os.walk(moved):
        for name in names:
            path = os.path.join(folder, name)
            if name == "libcleave_fortran.a":
                continue  # gfortran has no option that keeps the path of a source out of its run-time texts
            with open(path, "rb") as file:
                content = file.read()
            for place in (build, source, scratch):
                if place.encode() in content:
                    sys.exit(f"{os.path.relpath(path, moved)} names {place}")


main(*sys.argv[1:])
