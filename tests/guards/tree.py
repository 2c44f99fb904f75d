"""The files of the repository as the guards see them: paths relative to the root, and their text.

A guard is a module with `check(tree)` that returns one complaint a line, "path:line: what, remedy".
Guards read; they never build, run or change anything. test_guards.py gives each of them a small
broken tree, so that every rule here has been seen to fail.
"""
import fnmatch
import os
import re
import shutil
import subprocess

TEXT = ("*.c *.h *.cpp *.hpp *.def *.in *.f90 *.f *.inc *.py *.md *.txt *.cmake *.json *.nml *.geo "
        "*.csv *.css *.sh *.yml bootstrap run LICENSE .clang-format .clang-tidy .gitignore").split()
SOURCE = ("*.c", "*.h", "*.cpp", "*.hpp", "*.def", "*.f90", "*.f")
SCRIPT = ("*.py", "*/run", "bootstrap")


class Tree:
    """Text files by path; `files` maps a path to its text or to a function that reads it."""

    def __init__(self, files, root="."):
        self._files = dict(files)
        self._root = root

    @classmethod
    def from_directory(cls, root):
        files = {}
        for path in _listed(root):
            if any(fnmatch.fnmatch(os.path.basename(path), pattern) for pattern in TEXT):
                files[path] = lambda full=os.path.join(root, path): _read(full)
        return cls(files, root)

    def paths(self, *patterns, under=()):
        """Paths that match one of the patterns (all if none is given) below one of the folders."""
        folders = (under,) if isinstance(under, str) else tuple(under)
        return [path for path in sorted(self._files)
                if (not patterns or any(fnmatch.fnmatch(path, pattern) for pattern in patterns))
                and (not folders or path.startswith(folders))]

    def absolute(self, path):
        return os.path.join(self._root, path)

    def has(self, path):
        return path in self._files

    def text(self, path):
        value = self._files[path]
        if callable(value):
            value = self._files[path] = value()
        return value

    def lines(self, path):
        return list(enumerate(self.text(path).splitlines(), start=1))

    def find(self, pattern, paths, code_only=False):
        """(path, line number, match) of a regular expression, line by line; comments left out on
        request."""
        expression = re.compile(pattern)
        for path in paths:
            text = without_comments(self.text(path)) if code_only else self.text(path)
            for number, line in enumerate(text.splitlines(), start=1):
                for match in expression.finditer(line):
                    yield path, number, match


def without_comments(text):
    """C and C++ source with comments blanked, line numbers kept. Strings are kept."""
    def blank(match):
        piece = match.group(0)
        return piece if piece[0] == '"' else re.sub(r"[^\n]", " ", piece)
    return re.sub(r'"(?:\\.|[^"\\\n])*"|//[^\n]*|/\*.*?\*/', blank, text, flags=re.S)


def calls(text, macro):
    """Argument lists of MACRO("a", b, ...) lines of an X-macro table, strings joined and unquoted."""
    body = re.sub(r"(?m)^\s*(//|#).*$", "", text)
    for match in re.finditer(macro + r"\(((?:\"(?:\\.|[^\"\\])*\"|[^()\"]|\([^()]*\))*)\)", body):
        yield [_argument(part) for part in _split(match.group(1))]


def _split(arguments):
    return re.findall(r'\s*((?:"(?:\\.|[^"\\])*"|[^,"])+)', arguments)


def _argument(text):
    strings = re.findall(r'"((?:\\.|[^"\\])*)"', text)
    return "".join(strings).replace('\\"', '"') if strings or '""' in text else text.strip()


def _listed(root):
    """What git tracks or would track; without git, everything but build and run folders."""
    if shutil.which("git"):
        git = subprocess.run(["git", "-C", root, "ls-files", "-z", "--cached", "--others", "--exclude-standard"],
                             capture_output=True, text=True, check=False)
        if git.returncode == 0 and git.stdout:
            return [path for path in git.stdout.split("\0") if path and os.path.isfile(os.path.join(root, path))]
    found = []
    for folder, below, names in os.walk(root):
        below[:] = [name for name in below if name not in ("build", "runs", ".git", "__pycache__")]
        found += [os.path.relpath(os.path.join(folder, name), root) for name in names]
    return found


def _read(path):
    with open(path, encoding="utf-8", errors="replace") as file:
        return file.read()
