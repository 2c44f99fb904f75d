"""C and C++ sources are as clang-format 14 (Debian 12) leaves them. Another version formats differently,
so without it this guard has nothing to say."""
import os
import re
import shutil
import subprocess

FOLDERS = ("kernels/", "io/", "driver/", "tests/", "manuals/")


def check(tree):
    program = next((name for name in ("clang-format-14", "clang-format") if _version(name) == 14), None)
    paths = tree.paths("*.c", "*.h", "*.cpp", "*.hpp", under=FOLDERS)
    if program is None or not paths:
        return []
    said = subprocess.run([program, "--dry-run", "--style=file", *map(tree.absolute, paths)],
                          capture_output=True, text=True, check=False).stderr
    first_line = {}
    for found, line in re.findall(r"(?m)^(.+?):(\d+):\d+: (?:warning|error): code should be clang-formatted", said):
        first_line.setdefault(os.path.relpath(found, tree.absolute("")), line)
    return [f"{path}:{line}: run clang-format -i {path}" for path, line in first_line.items()]


def _version(program):
    if not shutil.which(program):
        return None
    text = subprocess.run([program, "--version"], capture_output=True, text=True, check=False).stdout
    found = re.search(r"version (\d+)", text)
    return int(found.group(1)) if found else None
