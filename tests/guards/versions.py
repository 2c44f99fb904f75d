"""The version is written once, in the top CMakeLists.txt; the changelog begins with it; `since` is not ahead."""
import re

from tree import SCRIPT, SOURCE, calls

# The history, and figures that a command wrote together with the version that they were measured with.
WRITTEN_WITH_IT = ("CHANGELOG.md", "manuals/reference/performance.md")


def check(tree):
    stated = re.search(r"project\(\s*\w+\s+VERSION\s+(\d+\.\d+\.\d+)", tree.text("CMakeLists.txt"))
    if not stated:
        return ["CMakeLists.txt: project(... VERSION x.y.z) not found"]
    version = stated.group(1)
    complaints = []
    heading = re.search(r"(?m)^## (\d+\.\d+\.\d+)", tree.text("CHANGELOG.md"))
    if not heading or heading.group(1) != version:
        complaints.append(f"CHANGELOG.md: the newest heading is not '## {version}', the version of CMakeLists.txt")
    copies = [path for path in tree.paths(*SOURCE, *SCRIPT, "*.md", "*.cmake", "*/CMakeLists.txt")
              if path not in WRITTEN_WITH_IT and not path.startswith("tests/guards/")]
    for path, line, _ in tree.find(r"(?<![\d.])" + re.escape(version) + r"(?![\d.])", copies):
        complaints.append(f"{path}:{line}: the version is written down again; read it from CMakeLists.txt or version.h")
    for path in tree.paths("*keys.def"):
        for key in calls(tree.text(path), "CLEAVE_KEY"):
            if _number(key[-1]) > _number(version):
                complaints.append(f"{path}: key {key[0]}.{key[1]} says since {key[-1]}, but this is {version}")
    return complaints


def _number(version):
    return [int(part) for part in version.split(".")]
