"""C and C++ sources are as clang-format 14 (Debian 12) leaves them. Another version formats differently,
so without it this guard has nothing to say."""
import re
import shutil
import subprocess

FOLDERS = ("kernels/", "io/", "driver/", "tests/")


def check(tree):
    program = next((name for name in ("clang-format-14", "clang-format") if _version(name) == 14), None)
    if program is None:
        return []
    complaints = []
    for path in tree.paths("*.c", "*.h", "*.cpp", "*.hpp", under=FOLDERS):
        text = tree.text(path)
        formatted = subprocess.run([program, "--style=file", f"--assume-filename={tree.absolute(path)}"], input=text,
                                   capture_output=True, text=True, check=True).stdout
        if formatted != text:
            different = next((number for number, (a, b) in
                              enumerate(zip(text.splitlines(), formatted.splitlines()), start=1) if a != b), 1)
            complaints.append(f"{path}:{different}: run clang-format -i {path}")
    return complaints


def _version(program):
    if not shutil.which(program):
        return None
    text = subprocess.run([program, "--version"], capture_output=True, text=True, check=False).stdout
    found = re.search(r"version (\d+)", text)
    return int(found.group(1)) if found else None
