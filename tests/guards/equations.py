"""Equation tags such as [CBM 8] or [CBM 21, 23] in code stand at an equation of the theory manual.

An equation there carries a label `cbm-8`; `cbm-4-9` stands for the paper's 4 to 9.
"""
import re

from tree import SCRIPT, SOURCE

LABEL = r"^:label:\s*([a-z0-9]+)-([0-9a-z-]+)\s*$"


def check(tree):
    theory = tree.paths("manuals/theory/*.md")
    if not theory:
        return ["manuals/theory: no pages found"]
    known, complaints = {}, []
    for path, line, match in tree.find(LABEL, theory):
        for number in _expand(match.group(2)):
            key = (match.group(1).upper(), number)
            if key in known:
                complaints.append(f"{path}:{line}: [{key[0]} {number}] is also at {known[key]}; keep one")
            known[key] = f"{path}:{line}"
    methods = {method for method, _ in known}
    tag = r"\[(%s) ([^\]]*)(?:\]|$)" % "|".join(sorted(methods) or ["CBM"])
    users = tree.paths(*SOURCE, *SCRIPT, "*.nml", "*.md")
    for path, line, match in tree.find(tag, [path for path in users if not path.startswith("tests/guards/")]):
        if not match.group(0).endswith("]"):
            complaints.append(f"{path}:{line}: the tag {match.group(0)} goes on in the next line; keep it on one")
            continue
        for number in re.split(r"\s*,\s*", match.group(2)):
            for single in _expand(number):
                if (match.group(1), single) not in known:
                    complaints.append(f"{path}:{line}: {match.group(0)} is not in manuals/theory; "
                                      f"label an equation {match.group(1).lower()}-{single} or correct the tag")
    return complaints


def _expand(number):
    ends = re.fullmatch(r"(\d+)-(\d+)", number)
    return [str(n) for n in range(int(ends.group(1)), int(ends.group(2)) + 1)] if ends else [number]
