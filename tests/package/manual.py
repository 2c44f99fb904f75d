"""Tries the manual: the link lines of its table, and its Makefile with the host in Fortran 77.

    manual.py PAGE HOST.c HOST.f PREFIX WORK C_COMPILER"""
import ctypes
import os
import re
import shutil
import subprocess
import sys


def main(page, host, host77, prefix, work, compiler):
    shutil.rmtree(work, ignore_errors=True)
    os.makedirs(work)
    os.chdir(work)
    environment = {"PATH": os.environ["PATH"], "P": prefix, "LC_ALL": "C"}
    subprocess.run([compiler, "-fPIC", "-c", f"-I{prefix}/include", host, "-o", "host.o"], check=True, env=environment)
    with open(page, encoding="utf-8") as file:
        text = file.read()
    rows = re.findall(r"(?m)^\| `(\w[^`]* host\.o[^`]*)` \| (.*) \|$", text)
    assert len(rows) > 10, rows
    wrong = [f"{line}\n  manual: {expected}\n  here: {found}" for line, expected in rows
             for found in [attempt(line, environment)] if not agrees(expected, *found)]
    if wrong:
        sys.exit("\n".join(wrong))
    if shutil.which("make"):
        make(re.search(r"```make\n(.*?)```", text, flags=re.S).group(1), host77,
             {**environment, "PKG_CONFIG_PATH": f"{prefix}/lib/pkgconfig"})


def make(recipe, host, environment):
    with open("Makefile", "w", encoding="utf-8") as file:
        file.write(recipe)
    shutil.copy(host, ".")
    subprocess.run(["make", "-s"], check=True, env=environment)
    subprocess.run(["./host"], check=True, env={"PATH": environment["PATH"]})


def attempt(line, environment):
    """What happens, in the words of the table, and the message."""
    if os.path.exists("a.out"):
        os.remove("a.out")
    linked = subprocess.run(line, shell=True, capture_output=True, text=True, env=environment, check=False)
    if linked.returncode:
        return "does not link", linked.stderr
    if " -shared " in line:
        loaded = subprocess.run([sys.executable, "-c", f"import ctypes; ctypes.CDLL('./a.out', {ctypes.RTLD_GLOBAL | 2})"],
                                capture_output=True, text=True, env=environment, check=False)
        return ("links, does not load" if loaded.returncode else "loads"), loaded.stderr
    ran = subprocess.run(["./a.out"], capture_output=True, text=True, env=environment, check=False)
    if ran.returncode:
        return "links, does not start", ran.stderr
    needed = subprocess.run(["readelf", "-d", "a.out"], capture_output=True, text=True, env=environment, check=True).stdout
    return "works", "no library" if "NEEDED" not in needed else needed


def agrees(expected, happened, message):
    if not expected.startswith(happened):
        return False
    if "needs no library" in expected:
        return message == "no library"
    if "needs no C++ library" in expected:
        return "libstdc++" not in message
    return all(text in message for text in re.findall(r"`([^`]*)`", expected))


main(*sys.argv[1:])
