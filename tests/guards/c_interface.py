"""Every function of cleave.h is defined, called by a test or the driver, and described; every status
code is raised somewhere. The Fortran module binds every function too."""
import re

from tree import calls, without_comments

HEADER = "kernels/include/cleave/cleave.h"
# Never raised by name, with the reason.
NOT_RAISED = {"OK": "what success returns"}


def check(tree):
    declared = list(functions(tree.text(HEADER)))
    if not declared:
        return [f"{HEADER}: no CLEAVE_API functions found"]
    defined = _joined(tree, tree.paths("kernels/src/*"))
    used = _joined(tree, tree.paths("tests/*.cpp", "tests/*.c", "tests/*.f90", "driver/*.cpp", "driver/*.hpp"))
    fortran = _joined(tree, tree.paths("kernels/fortran/*.f90", "kernels/fortran/*.f90.in"))
    complaints = []
    for name, line, described in declared:
        place = f"{HEADER}:{line}: {name}"
        if not described:
            complaints.append(f"{place} has no comment; say direction, extent and units of its arguments")
        if not re.search(rf"\b{name}\s*\(", defined):
            complaints.append(f"{place} is not defined in kernels/src")
        if not re.search(rf"\b{name}\b", used):
            complaints.append(f"{place} is called neither in tests nor in the driver")
        if fortran and not re.search(rf"(?i)\b{name}\b", fortran):
            complaints.append(f"{place} is missing in kernels/fortran")
    return complaints + _statuses(tree, defined)


def functions(text):
    """(name, line, has a comment of its own or shares the one above its paragraph)."""
    described = False
    depth = False
    for number, line in enumerate(text.splitlines(), start=1):
        if "/*" in line:
            depth = True
        if depth:
            described = "----" not in line
            depth = "*/" not in line
            continue
        if not line.strip():
            described = False
        match = re.search(r"^CLEAVE_API\b.*?\b(cleave_\w+)\s*\(", line)
        if match:
            yield match.group(1), number, described


def _statuses(tree, defined):
    path = "kernels/include/cleave/tables/status.def"
    names = [arguments[0] for arguments in calls(tree.text(path), "CLEAVE_STATUS")]
    return [f"{path}: {name} is never raised in kernels/src; remove it or raise it"
            for name in names if name not in NOT_RAISED and not re.search(rf"\b(CLEAVE_)?{name}\b", defined)]


def _joined(tree, paths):
    return "\n".join(without_comments(tree.text(path)) if path.endswith((".c", ".cpp", ".hpp", ".h"))
                     else tree.text(path) for path in paths)
